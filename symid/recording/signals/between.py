"""What an input does between its samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

CURVES = "cubic", "band-limited"
"""Splines through the samples, of degree 3 and 9. At six samples a period they lose 0.2 and 0.002 % of a sine, at three
6 and 0.2 %; the sharper one rings longer where an input jumps."""
ROUNDED = 1e-6
"""Part of an interval by which times that were computed otherwise may miss a sample."""
HALF = 5
"""Of the order of band-limited splines: beyond their ends they would go on as polynomials of a degree below this. With
the degree's own polynomials the first interval of a sine sampled three times a period would err by three times its size
(root mean square), so it does by a third of it, as with a cubic spline."""


STAYS, JUMPS = 0.5, 0.1
"""A signal that stays as it is over more than such a part of its samples, and else mostly jumps by more than such a
part of its range, is one of steps. A slow signal with few digits stays, too, and moves by its last digit."""


def is_stepped(u: np.ndarray) -> bool:
    """Whether a signal (N,) goes by steps, as the commands of a computer or a switch do; what is NaN does not count."""
    u = u[np.isfinite(u)]
    jumps = np.abs(np.diff(u))
    jumps = jumps[jumps > 0]
    if not jumps.size or len(jumps) > (1 - STAYS) * (len(u) - 1):
        return False
    return bool(np.median(jumps) > JUMPS * np.ptp(u))


def derivatives(time: np.ndarray, u: np.ndarray, holds: Sequence[str]) -> tuple[np.ndarray, np.ndarray | None]:
    """(N, k) slopes and second derivatives at the samples of (N, k) inputs, N >= 2, of the splines through them.

    Cubic ones are not-a-knot (de Boor 1978, chapter IV), the others natural. Zero for inputs that are neither of
    `CURVES`; None where no second ones are asked for.

    Parameters
    ----------
    holds : what each input does between its samples.
    """
    slopes, bends = np.zeros_like(u), np.zeros_like(u)
    cubic, limited = ([i for i, hold in enumerate(holds) if hold == curve] for curve in CURVES)
    if cubic:
        from scipy.interpolate import CubicSpline

        slopes[:, cubic] = CubicSpline(time, u[:, cubic])(time, 1)
    if limited:
        slopes[:, limited], bends[:, limited] = _band_limited(time, u[:, limited])
    return slopes, bends if limited else None


def _band_limited(time: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivatives of a natural spline of high degree."""
    from scipy.interpolate import make_interp_spline

    half, step = min(HALF, len(time)), float(np.median(np.diff(time)))
    flat = [(order, np.zeros(u.shape[1])) for order in range(half, 2 * half - 1)]
    at = (time - time[0]) / step  # of eighth derivatives by seconds no float keeps track
    spline = make_interp_spline(at, u, 2 * half - 1, bc_type=(flat, flat))
    return spline(at, 1) / step, spline(at, 2) / step**2


def bend(
    f: np.ndarray | float,
    h: np.ndarray | float,
    first: np.ndarray,
    last: np.ndarray,
    bends: tuple[np.ndarray, np.ndarray] | None = None,
    quintic: np.ndarray | bool = True,
) -> tuple[np.ndarray, np.ndarray]:
    """What Hermite's cubic adds to the straight line at the part `f` of an interval of `h` seconds, and its slope.

    Parameters
    ----------
    first, last : what the slopes at both samples differ from the straight line's.
    bends : second derivatives at both samples, with which it is his quintic. quintic : of which inputs.
    """
    g = 1 - f
    more, steeper = h * f * g * (g * first - f * last), g * (1 - 3 * f) * first - f * (2 - 3 * f) * last
    if bends is None:
        return more, steeper
    a, b = h * (h * bends[0] + 4 * first + 2 * last) / 2, h * (h * bends[1] - 2 * first - 4 * last) / 2
    line = g * a + f * b
    more = more + quintic * (f * g) ** 2 * line
    return more, steeper + quintic * f * g * (2 * (g - f) * line + f * g * (b - a)) / h


def between(time: np.ndarray, u: np.ndarray, at: np.ndarray, hold: str) -> np.ndarray:
    """(K,) an input with the (N,) samples `u`, N >= 2, at other times within them.

    Parameters
    ----------
    hold : what it does between its samples: "zero", one of `CURVES`, or lines for all else.
    """
    k = np.clip(np.searchsorted(time, at + ROUNDED * (time[1] - time[0]), side="right") - 1, 0, len(time) - 2)
    h = time[k + 1] - time[k]
    f, line = (at - time[k]) / h, (u[k + 1] - u[k]) / h
    if hold == "zero":
        return np.where(f < 1 - ROUNDED, u[k], u[k + 1])
    if hold not in CURVES:
        return u[k] + f * h * line
    slopes, bends = derivatives(time, u[:, None], [hold])
    ends = None if bends is None else (bends[k, 0], bends[k + 1, 0])
    return u[k] + f * h * line + bend(f, h, slopes[k, 0] - line, slopes[k + 1, 0] - line, ends)[0]
