"""Collocation schemes. A scheme is data: a Stencil and the order that it claims.

The names are written with a capital, because a user reads ``scheme=Midpoint()`` as a kind of
scheme; each is a function that gives one frozen Scheme.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from symid.codegen.equations.stencil import Stencil
from symid.errors import TranscriptionError


@dataclass(frozen=True, eq=False)
class Scheme:
    """A way to make the differential equations finite.

    Parameters
    ----------
    name : for the command line and for reports.
    order : the order of the global error in the step, observed by a test.
    stencil : the numbers.
    """

    name: str
    order: int
    stencil: Stencil


def _stencil(*numbers: ArrayLike) -> Stencil:
    return Stencil(*(np.asarray(n, dtype=float) for n in numbers))


def Midpoint() -> Scheme:
    """Implicit midpoint rule, also called the one-stage Gauss method; the article's scheme.

    Examples
    --------
    >>> si.Identification(model, recording, scheme=Midpoint()).scheme.order
    2
    """
    return Scheme("midpoint", 2, _stencil([0.5], [[0.5, 0.5]], [[-1, 1]], [[1]], np.zeros((0, 2))))


def BackwardEuler() -> Scheme:
    """Implicit Euler; strongly damping, for stiff or non-smooth models (Ascher & Petzold 1998, section 3.4).

    Examples
    --------
    >>> BackwardEuler().order
    1
    """
    return Scheme("backward_euler", 1, _stencil([1], [[0, 1]], [[-1, 1]], [[1]], np.zeros((0, 2))))


def Trapezoid() -> Scheme:
    """Implicit trapezoidal rule in residual form: the mean of the residuals at both ends (Ascher & Petzold 1998,
    section 3.6).

    Examples
    --------
    >>> Trapezoid().order
    2
    """
    return Scheme("trapezoid", 2, _stencil([0, 1], np.eye(2), [[-1, 1], [-1, 1]], [[0.5, 0.5]], np.zeros((0, 2))))


def HermiteSimpson() -> Scheme:
    """Hermite-Simpson, that is the three-stage Lobatto IIIA method (Hairer & Wanner 1996, table IV.5.7).

    Three interior slots hold the increments h x' at the start, middle and end of the interval.

    Examples
    --------
    >>> si.Identification(model, recording, scheme=HermiteSimpson()).solve().solved
    True
    """
    state: list[list[float]] = [[1, 0, 0, 0, 0], [1, 5 / 24, 1 / 3, -1 / 24, 0], [0, 0, 0, 0, 1]]
    rate = [[0, 1, 0, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 1, 0]]
    return Scheme(
        "hermite_simpson",
        4,
        _stencil([0, 0.5, 1], state, rate, np.eye(3), [[-1, -1 / 6, -2 / 3, -1 / 6, 1]], [0, 2 / 3, 0]),
    )


SCHEMES = {s().name: s for s in (Midpoint, BackwardEuler, Trapezoid, HermiteSimpson)}


def scheme_by_name(name: str) -> Scheme:
    """The scheme called `name`; TranscriptionError with the known names if there is none."""
    if name not in SCHEMES:
        raise TranscriptionError(f"no collocation scheme '{name}'; known: {', '.join(SCHEMES)}")
    return SCHEMES[name]()
