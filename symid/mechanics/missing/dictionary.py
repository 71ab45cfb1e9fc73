"""Shapes of which a closed form may be made: powers, and smooth functions with a width of their own, with units."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import sympy as sm

from symid.mechanics.coordinates import signal_unit
from symid.model import Law, LawParameter, Model, Port

HIGHEST_POWER = 5
"""Of one signal; Duffing's and van der Pol's laws and their next terms are below."""
FUNCTIONS: dict[str, tuple[Callable, Callable]] = {
    "sin": (sm.sin, np.sin),
    "cos": (sm.cos, np.cos),
    "tanh": (sm.tanh, np.tanh),
    "exp": (sm.exp, np.exp),
    "sinh": (sm.sinh, np.sinh),
    "bell": (lambda q: sm.exp(-(q**2)), lambda q: np.exp(-(q**2))),
    "slip": (lambda q: q / sm.sqrt(1 + q**2), lambda q: q / np.sqrt(1 + q**2)),
    "hill": (lambda q: 1 / (1 + q**2), lambda q: 1 / (1 + q**2)),
}
"""Functions of a signal over a width: SymPy's and NumPy's. sin, tanh, exp and sinh cover magnets, stops and end ranges,
`bell` and `hill` what acts near one place only, `slip` what saturates slowly (Tustin 1947; Audu & Davy 1985)."""
_OF_BOTH_SIGNS = ("exp",)
_LOWEST_WIDTH, _HIGHEST_WIDTH, _WIDTHS = 0.08, 3.0, 16
"""Widths that are tried, in largest values of the signal."""


@dataclass(frozen=True)
class Shape:
    """One shape: powers of signals, times absolute values of signals, times a function of one over a width.

    Attributes
    ----------
    powers, absolute : signal -> exponent. function : name in `FUNCTIONS`, "" for none; of : its signal.
    centred : whether the function has a centre of its own besides its width.
    """

    powers: tuple[tuple[sm.Expr, int], ...] = ()
    absolute: tuple[tuple[sm.Expr, int], ...] = ()
    function: str = ""
    of: sm.Expr | None = None
    centred: bool = False

    @property
    def unknowns(self) -> int:
        """Its coefficient, and the width and centre of its function."""
        return 1 + bool(self.function) + self.centred

    def expression(self, width: sm.Expr | float = 1, centre: sm.Expr | float = 0) -> sm.Expr:
        out = sm.Mul(*(s**n for s, n in self.powers), *(sm.Abs(s) ** n for s, n in self.absolute))
        return out * FUNCTIONS[self.function][0]((self.of - centre) / width) if self.function else out

    def numbers(self, signals: dict, width: float = 1.0, centre: float = 0.0) -> np.ndarray:
        """(N,) along a motion, from the signals' values (N,) by expression."""
        out = np.ones(len(next(iter(signals.values()))))
        for s, n in self.powers:
            out = out * signals[s] ** n
        for s, n in self.absolute:
            out = out * np.abs(signals[s]) ** n
        return out * FUNCTIONS[self.function][1]((signals[self.of] - centre) / width) if self.function else out

    def places(self, signals: dict) -> list[tuple[float, float]]:
        """Widths and centres to try."""
        if not self.function:
            return [(1.0, 0.0)]
        values = signals[self.of]
        largest = float(np.abs(values).max())
        widths = [float(w) for w in largest * np.geomspace(_LOWEST_WIDTH, _HIGHEST_WIDTH, _WIDTHS)]
        if self.function in _OF_BOTH_SIGNS:
            widths = [w for w in widths if w > 0.2 * largest]  # a steeper one overflows
            widths += [-w for w in widths]
        centres = np.quantile(values, np.linspace(0.05, 0.95, 9)) if self.centred else [0.0]
        return [(w, float(c)) for w in widths for c in centres]


def shapes_of(position: sm.Expr, rate: sm.Expr, signals: Sequence[sm.Expr]) -> list[Shape]:
    """The dictionary for a force that follows some of the signals of a place.

    Powers up to `HIGHEST_POWER` in all, odd and even ones with absolute values, and functions of each signal,
    alone and times another one.
    """
    found = [Shape()]
    single = [s for s in (position, rate) if s in signals] + [s for s in signals if s not in (position, rate)]
    for s in single:
        found += [Shape(((s, n),)) for n in range(1, HIGHEST_POWER + 1)]
        found += [Shape(((s, 1),), ((s, n),)) for n in (1, 3)] + [Shape((), ((s, n),)) for n in (1, 3)]
        found += [Shape((), (), f, s) for f in FUNCTIONS] + [
            Shape((), (), f, s, True) for f in ("bell", "hill", "tanh")
        ]
    for a in single:
        for b in (s for s in single if s != a):
            first = single.index(a) < single.index(b)
            found += [Shape(((a, 1), (b, n))) for n in range(1, HIGHEST_POWER) if first or n > 1]
            found += [Shape(((a, 2), (b, 2))), Shape(((a, 2), (b, 3)))] if first else []
            found += [Shape(((a, 1),), ((b, 1),)), Shape(((a, 1),), ((a, 1), (b, 1)))]
            found += [Shape(((a, 1),), (), f, b) for f in ("cos", "bell", "hill", "exp", "sin", "tanh")]
    return found


# ---- as a law --------------------------------------------------------------------------------
def closed_law(model: Model, port: Port, shapes: Sequence[Shape], name: str = "closed_form") -> Law:
    """The sum of some shapes as a law: coefficients ``a``, ``b`` ..., widths ``a_width``, centres ``a_centre``."""
    parameters = []
    for letter, shape in zip("abcdefgh", shapes, strict=False):
        factors = [(signal_unit(model, s), n) for s, n in (*shape.powers, *shape.absolute)]
        parameters.append(LawParameter(letter, unit_quotient(port.unit, factors)))
        if shape.function:
            unit = signal_unit(model, shape.of)
            parameters.append(LawParameter(f"{letter}_width", unit, null=None))
            parameters += [LawParameter(f"{letter}_centre", unit, null=None)] if shape.centred else []

    def build(changed: Model, place: str, p: SimpleNamespace) -> None:
        changed.add_effort(port.name, closed_expression(shapes, vars(p)))

    said = "A force of a closed form acts on the {place}: " + ", ".join(f"{q.key} = {{{q.key}}}" for q in parameters)
    return Law(name, port.role, tuple(parameters), build, said)


def closed_expression(shapes: Sequence[Shape], values: dict) -> sm.Expr:
    """The sum of shapes with these coefficients, widths and centres by key."""
    return sm.Add(
        *(
            values[letter] * shape.expression(values.get(f"{letter}_width", 1), values.get(f"{letter}_centre", 0))
            for letter, shape in zip("abcdefgh", shapes, strict=False)
        )
    )


def unit_quotient(unit: str, factors: Sequence[tuple[str, int]]) -> str:
    """Unit text of something over powers of others: ``"N*m*s/rad^3"`` of "N*m" over rad^2 and rad/s."""
    powers: dict[str, int] = {}
    for text, times in ((unit, 1), *((u, -n) for u, n in factors)):
        for sign, symbol, power in re.findall(r"([*/]?)([A-Za-z_]+)(?:\^(-?\d+))?", text):
            powers[symbol] = powers.get(symbol, 0) + times * (-1 if sign == "/" else 1) * int(power or 1)
    above, below = ([_power(u, abs(n)) for u, n in powers.items() if n * side > 0] for side in (1, -1))
    top = "*".join(above) or "1"
    return top + "".join(f"/{b}" for b in below[:1]) if len(below) < 2 else f"{top}/({'*'.join(below)})"


def _power(symbol: str, n: int) -> str:
    return symbol if n == 1 else f"{symbol}^{n}"


def law_text(shapes: Sequence[Shape], names: dict[str, str]) -> str:
    """The sum of shapes in words of `names` by expression: ``a angle² speed + b sin(angle/b width)``."""
    return " + ".join(_shape_text(letter, s, names) for letter, s in zip("abcdefgh", shapes, strict=False))


def _shape_text(letter: str, shape: Shape, names: dict[str, str]) -> str:
    raised = {1: "", 2: "²", 3: "³", 4: "⁴", 5: "⁵"}
    parts = [letter, *(names[str(s)] + raised[n] for s, n in shape.powers)]
    parts += [f"|{names[str(s)]}|{raised[n]}" for s, n in shape.absolute]
    if shape.function:
        of = f"({names[str(shape.of)]} - {letter} centre)" if shape.centred else names[str(shape.of)]
        q = f"{of}/{letter} width"
        said = {"bell": f"exp(-({q})²)", "slip": f"({q})/√(1 + ({q})²)", "hill": f"1/(1 + ({q})²)"}
        parts.append(said.get(shape.function, f"{shape.function}({q})"))
    return " ".join(parts)
