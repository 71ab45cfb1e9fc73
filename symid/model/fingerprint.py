"""The fingerprint of a model: what its equations and conditions are, in any process."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import sympy as sm
from sympy.printing.repr import ReprPrinter

from symid.model.expressions.c_function import c_texts
from symid.model.parts.conditions import Boundary, Constraint, Objective

if TYPE_CHECKING:
    from symid.model.model import Model


def fingerprint_of(model: Model) -> str:
    """16 hexadecimal digits of the equations, outputs, conditions, delays and kinds of parts, in their order."""
    kinds = [(type(c).__name__, c.name) for c in model.components.values()]
    kinds += [(u.name, u.hold) for u in model.inputs.values() if u.hold != "smooth"]
    text = repr(
        (
            kinds,
            [_text(e) for e in (*model.residual(), *model.observed())],
            [(str(k), str(d.of), _text(d.lag)) for k, d in model.delays.items()],
        )
    )
    conditions = [c for c in model.components.values() if isinstance(c, (Constraint, Boundary, Objective))]
    text += "".join(map(repr, conditions))
    said = [
        getattr(c, k, None) for c in model.components.values() for k in ("expr", "condition", "running", "terminal")
    ]
    text += "".join(c_texts(e for e in said if isinstance(e, sm.Basic)))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


class _Printer(ReprPrinter):
    """`sm.srepr`, which knows the parts that it has printed before: a model's variants share most of theirs."""

    def _print(self, expr: Any, **how: Any) -> Any:
        return _text(expr) if isinstance(expr, sm.Basic) else super()._print(expr, **how)


@lru_cache(maxsize=65536)
def _text(expr: sm.Basic) -> Any:
    return ReprPrinter._print(_PRINTER, expr)


_PRINTER = _Printer()
