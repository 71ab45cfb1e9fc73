"""Which combinations of parameters are determined where single ones are not, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

SIMPLE = 12
"""Largest denominator of a coefficient or exponent that is written as a fraction."""
CLOSE = 1e-5
"""A number this near to a simple fraction, relatively, is meant to be it; derivatives have some eight digits."""
INVOLVED = 1e-6
"""Least share of a null direction, in parameters scaled by what they do, that counts."""


@dataclass(frozen=True)
class Combination:
    """Something that is determined: its text, value, and gradient (q,) with respect to the parameters [SI].

    local : whether its coefficients are those of a tangent, and hold near these values only.
    """

    text: str
    value: float
    gradient: np.ndarray
    local: bool = False


def involved(null: np.ndarray) -> np.ndarray:
    """(q,) which parameters a null space (q, k), orthonormal in parameters so scaled, leaves undetermined."""
    return np.linalg.norm(null, axis=1) > INVOLVED if null.size else np.zeros(len(null), dtype=bool)


def groups(null: np.ndarray) -> list[np.ndarray]:
    """Parameters that are undetermined together: blocks of the projector on the null space."""
    left, found = set(np.flatnonzero(involved(null))), []
    linked = np.abs(null @ null.T) > INVOLVED
    while left:
        group, edge = set(), {min(left)}
        while edge:
            group |= edge
            edge = {j for i in edge for j in np.flatnonzero(linked[i]) if j in left} - group
        left -= group
        found.append(np.array(sorted(group)))
    return found


def combinations(null: np.ndarray, names: Sequence[str], values: np.ndarray) -> list[Combination]:
    """What stays determined among the parameters `names` that the null space (q, k) [SI] moves.

    A null direction that multiplies each parameter by a power leaves products and ratios, one that
    adds a multiple leaves sums and differences; any other is written to first order.
    """
    found = []
    for group in groups(_normalised(null, values)):
        own = _basis(null[group])
        if own.shape[1] == len(group):
            continue
        found += _of_group(own, [names[i] for i in group], values[group], group, len(names))
    return found


def _of_group(
    null: np.ndarray, names: list[str], values: np.ndarray, group: np.ndarray, size: int
) -> list[Combination]:
    sums = _independent(null)
    powers = _independent(null / values[:, None]) if np.all(values != 0) else None
    as_product = not _simple(sums) and powers is not None and _simple(powers)
    rows = powers if as_product else sums
    texts = []
    for row in rows:
        gradient = np.zeros(size)
        if as_product:
            value = float(np.prod(np.abs(values) ** row * np.sign(values) ** np.round(row)))
            gradient[group] = value * row / values
        else:
            value, gradient[group] = float(row @ values), row
        text = product_text(row, names) if as_product else sum_text(row, names)
        texts.append(Combination(text, value, gradient, local=not _simple(rows)))
    return texts


def _independent(null: np.ndarray) -> np.ndarray:
    """(m - k, m) rows orthogonal to the null space (m, k), each with few parameters, the first with coefficient 1."""
    m, k = null.shape
    order, rest = [], null.copy()
    for _ in range(k):  # pivots: the parameters that move most, last ones first
        size = np.linalg.norm(rest, axis=1)
        size[order] = -1
        pivot = m - 1 - int(np.argmax(np.round(size[::-1] / size.max(), 6)))
        order.append(pivot)
        direction = rest[pivot] / np.linalg.norm(rest[pivot])
        rest = rest - np.outer(rest @ direction, direction)
    others = [i for i in range(m) if i not in order]
    rows = np.zeros((m - k, m))
    rows[np.arange(m - k), others] = 1
    rows[:, order] = -np.linalg.solve(null[order].T, null[others].T).T
    rows[np.abs(rows) < CLOSE] = 0
    return np.array([[_rounded(x) for x in row] for row in rows])


def _rounded(x: float) -> float:
    near = Fraction(x).limit_denominator(SIMPLE)
    return float(near) if abs(float(near) - x) <= CLOSE * abs(x) else x


def _simple(rows: np.ndarray) -> bool:
    return all(abs(Fraction(x).limit_denominator(SIMPLE) - Fraction(x)) < 1e-12 for x in rows.ravel())


def _basis(directions: np.ndarray) -> np.ndarray:
    u, s, _ = np.linalg.svd(directions, full_matrices=False)
    return u[:, s > 1e-8 * max(s[0], 1e-300)]


def _normalised(null: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Orthonormal null space of the parameters, each divided by its size in it."""
    size = np.linalg.norm(null, axis=1)
    return _basis(null / np.where(size > 0, np.maximum(size, 1e-300), 1)[:, None]) if null.size else null


def sum_text(row: Sequence[float], names: Sequence[str]) -> str:
    """``c + 2 c2 - 0.31 k``."""
    text = ""
    for x, name in zip(row, names, strict=True):
        if x:
            size = "" if abs(abs(x) - 1) < 1e-12 else f"{_number(abs(x))} "
            text += (" - " if x < 0 else " + ") + size + name
    return text[3:] if text.startswith(" + ") else "-" + text[3:]


def product_text(row: Sequence[float], names: Sequence[str]) -> str:
    """``k g / m^2``."""
    above, below = ([_power(n, abs(x)) for x, n in zip(row, names, strict=True) if x * sign > 0] for sign in (1, -1))
    top = " ".join(above) or "1"
    return top if not below else f"{top} / {below[0]}" if len(below) == 1 else f"{top} / ({' '.join(below)})"


def _power(name: str, x: float) -> str:
    return name if abs(x - 1) < 1e-12 else f"{name}^{_number(x)}"


def _number(x: float) -> str:
    near = Fraction(x).limit_denominator(SIMPLE)
    return str(near) if abs(float(near) - x) < 1e-12 else f"{x:.4g}"
