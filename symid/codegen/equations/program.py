"""A Program: the equations of one point, and what each of their symbols is."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import sympy as sm

from symid.errors import CodegenError


@dataclass(frozen=True)
class Program:
    """Rows to be evaluated at many points, with the first and second derivatives of some symbols.

    Parameters
    ----------
    name : for messages and for the name of a shipped source.
    rows : m SymPy expressions.
    local : symbols with one value per point, differentiated.
    shared : symbols with one value for all points, differentiated.
    data : symbols with one value per point, not differentiated.
    constants : symbols with one value for all points, not differentiated.

    Raises
    ------
    CodegenError
        If a symbol of the rows is in none of the tuples, or a symbol is in two of them.
    """

    name: str
    rows: tuple[sm.Expr, ...]
    local: tuple[sm.Symbol, ...]
    shared: tuple[sm.Symbol, ...] = ()
    data: tuple[sm.Symbol, ...] = ()
    constants: tuple[sm.Symbol, ...] = ()

    def __post_init__(self):
        object.__setattr__(self, "rows", tuple(sm.sympify(r, strict=True) for r in self.rows))
        for group in ("local", "shared", "data", "constants"):
            object.__setattr__(self, group, tuple(getattr(self, group)))
        symbols = (*self.local, *self.shared, *self.data, *self.constants)
        twice = sorted(str(s) for s, n in Counter(symbols).items() if n > 1)
        if twice:
            raise CodegenError(
                f"program '{self.name}': {', '.join(twice)} listed more than once among local, "
                "shared, data and constants; a symbol has one place"
            )
        known = set(symbols)
        for i, row in enumerate(self.rows):
            unknown = sorted(map(str, row.free_symbols - known))
            if unknown:
                raise CodegenError(
                    f"program '{self.name}', row {i}: unknown symbol {', '.join(unknown)}; list it "
                    "under local, shared, data or constants, or take it out of the equation"
                )
