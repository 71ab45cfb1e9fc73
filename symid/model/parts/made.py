"""How parts are made: arguments that a part does not take are refused in words."""

from __future__ import annotations

from inspect import Parameter, signature
from typing import Any

from symid.errors import ModelError


class Made(type):
    """The class of the classes of parts."""

    def __call__(cls, *args: Any, **named: Any) -> Any:
        try:
            return super().__call__(*args, **named)
        except TypeError as problem:
            taken = signature(cls.__init__)
            try:
                taken.bind(None, *args, **named)
            except TypeError as told:
                names = ", ".join(
                    p.name if p.kind is Parameter.POSITIONAL_OR_KEYWORD else f"{p.name}=..."
                    for p in taken.parameters.values()
                    if p.name not in ("self", "name")
                )
                raise ModelError(f"{cls.__name__}: {told}; it takes {names}") from None
            raise problem


class Copies(dict[Any, Any]):
    """index -> the copy of a part that repeats itself; ModelError where there is none."""

    def __missing__(self, index: Any) -> Any:
        raise ModelError(f"there is no copy with the index {index!r}; there are {', '.join(map(repr, self))}"[:300])
