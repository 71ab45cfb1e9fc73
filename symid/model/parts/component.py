"""What every part of a model has in common."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sm

from symid.errors import ModelError
from symid.model.expressions.quantity import symbol
from symid.model.parts.made import Made


@dataclass(frozen=True, kw_only=True)
class Component(metaclass=Made):
    """What every part of a model has in common.

    Parameters
    ----------
    meaning : one plain phrase for reports.
    role, at : what the part is to physics (``"joint"``, ``"sensor"`` ...) and the place where
        it is (``"ankle"``). Missing-physics laws find where they can act by these two.
    latex : how the symbol prints; made from the name where empty.
    name : set by attaching; never written by the user.
    unit : as text, which every quantity must have (``"1"`` for a number without one).
    index : where a part repeats itself, the indices of its copies: ``m.x = State(unit="m", index=range(4))``
        declares ``x_0`` to ``x_3``, and ``m.x[2]`` is one of them. An Equation, Constraint, Expression or Output
        repeats itself where it is given a dictionary of index -> expression, or a SymPy matrix.
    """

    meaning: str = ""
    role: str = ""
    at: str = ""
    latex: str = ""
    name: str = field(default="", repr=True)
    index: Iterable[Any] | None = field(default=None, repr=False)

    def copies(self) -> dict[Any, Component] | None:
        """index -> the copy of this part that stands there, without an index; None where it does not repeat itself.

        Raises
        ------
        ModelError : `index` holds no indices.
        """
        for key in ("expr", "condition"):
            value = getattr(self, key, None)
            if isinstance(value, sm.MatrixBase):
                value = dict(enumerate(value))
            if isinstance(value, Mapping):
                return {i: replace(self, **{key: e}) for i, e in value.items()}
        if self.index is None:
            return None
        if not isinstance(self.index, Iterable):
            raise ModelError(f"index={self.index!r}: give the indices of the copies, for instance index=range(4)")
        indices = list(self.index)
        if len(set(indices)) < len(indices):
            raise ModelError(f"index={str(indices)[:60]}: an index occurs twice; each copy needs one of its own")
        return {i: replace(self, index=None) for i in indices}

    @property
    def symbol(self) -> sm.Symbol:
        """What stands for the part in SymPy.

        Raises
        ------
        ModelError : the part is not attached to a model yet.
        """
        if not self.name:
            raise ModelError(
                f"this {type(self).__name__} has no name yet: attach it to a model first "
                "(model.angle = State(...)) and then use model.angle"
            )
        return symbol(self.name)
