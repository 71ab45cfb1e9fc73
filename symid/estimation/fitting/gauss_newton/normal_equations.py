"""One Gauss-Newton step's linear system, from exact sensitivities of the predictions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.estimation.fitting.gauss_newton.memory import Memory
from symid.estimation.fitting.gauss_newton.secant import is_convex
from symid.estimation.predicting.growth import growth_normal
from symid.estimation.predicting.predictor import Predictor
from symid.estimation.sensors.whitening import past_of
from symid.simulation import Trajectory

SHARPNESS_STEP = 1e-3
"""Slopes by the logarithm of a filter's sharpness are differences over this."""


def normal_equations(
    predictor: Predictor,
    p: np.ndarray,
    x0: np.ndarray,
    gain: np.ndarray | None,
    process: np.ndarray,
    path: np.ndarray,
    runs: Sequence[Trajectory] | None = None,
) -> tuple[np.ndarray, np.ndarray, int] | None:
    """The matrix (u, u), the right side (u,) and the number q of free parameters; None where a run diverges.

    The u unknowns are the free parameters, the logarithms of what is tuned of the noise, and (E n) initial states.

    Parameters
    ----------
    predictor : with what is `tuned`, and whether it is `bounded`.
    p : (parameters,) values. x0 : (E, n) states. gain, process : as of a `Fit`.
    path : (N, n) states that the gain was made for. runs : those of the point with sensitivities, if they are known.
    """
    runs = runs or predictor.sensitive(p, x0, gain, process, path)
    if runs is None:
        return None
    if predictor.sharpness_at not in predictor.tuned:
        found = _gauss_newton(predictor, runs, process)
    else:
        sharper = process.copy()
        sharper[predictor.sharpness_at] *= np.exp(SHARPNESS_STEP)
        more = predictor.sensitive(p, x0, gain, sharper, path)
        if more is None:
            return None
        found = _with_sharpness(predictor, runs, process, more, sharper)
    H, g = found
    q = len(predictor.free)
    if predictor.bounded:
        own, pull = growth_normal(predictor, p, path)
        H[:q, :q] += own
        g[:q] += pull
    # Sensitivities of an unstable predictor overflow before the run itself does.
    return (H, g, q) if np.isfinite(H).all() and np.isfinite(g).all() else None


def _gauss_newton(
    predictor: Predictor, runs: Sequence[Trajectory], process: np.ndarray, sharpness: Sequence[np.ndarray] | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """The matrix and right side from the products of the slopes of the innovations.

    sharpness : (N, m) of each segment, slopes of the innovations by the logarithm of the sharpness of a filter.
    """
    innovations = predictor.innovations(runs, process)
    _, whitening = predictor.score(innovations, process)
    q, n, w = len(predictor.free), len(predictor.sim.states), len(predictor.tuned)
    size = q + w + len(runs) * n
    H, g = np.zeros((size, size)), np.zeros(size)
    own = [predictor.tuned.index(j) for j in predictor.tuned_gain]
    # Segments know nothing of each other's initial states: these stay apart where there are several.
    shared, memory = slice(0, size if len(runs) == 1 else q + w), Memory(predictor.data.memory)
    remembers = bool(memory.samples and shared.stop)
    with np.errstate(over="ignore", invalid="ignore"):
        for i, (t, s, spread) in enumerate(zip(runs, innovations, whitening.sizes, strict=True)):
            tuned = np.zeros((*s.shape, w))
            if t.dy.shape[2] > q + n:
                tuned[:, :, own] = t.dy[:, :, q + n :]
            if sharpness:
                tuned[:, :, predictor.tuned.index(predictor.sharpness_at)] = -sharpness[i]
            J = whitening(np.concatenate([t.dy[:, :, :q], tuned, t.dy[:, :, q : q + n]], axis=2), spread)
            r = whitening(s[:, :, None], spread)[:, 0]
            where = np.r_[0 : q + w, q + w + i * n : q + w + (i + 1) * n]
            H[np.ix_(where, where)] += J.T @ J
            g[where] += J.T @ r
            if remembers and np.isfinite(J).all():
                slopes = J.reshape(*s.shape, -1)
                before = past_of(s / spread, memory.samples)
                memory.add(before, slopes[:, :, shared], slopes[:, :, shared.stop :])
        if remembers and np.isfinite(H).all():
            H[shared, shared] -= memory.taken()
    return H, g


def _with_sharpness(predictor: Predictor, runs, process, more, sharper) -> tuple[np.ndarray, np.ndarray]:
    """The same where the sharpness of a filter is tuned, too, with `more` runs at a little more of it.

    All innovations together balance the volume of the filter, so that products of their slopes are far from the
    curvature; its row is the change of the right side. Where that is not convex, far away, the products must do.
    """
    at, samples = len(predictor.free) + predictor.tuned.index(predictor.sharpness_at), sum(t.y.size for t in runs)
    here, there = predictor.innovations(runs, process), predictor.innovations(more, sharper)
    ratio = float(np.exp(SHARPNESS_STEP))
    slopes = [(b - a) / (ratio - 1) for a, b in zip(here, there, strict=True)]
    H, g = _gauss_newton(predictor, runs, process, slopes)
    _, moved = _gauss_newton(predictor, more, sharper, [ratio * s for s in slopes])
    volume, bend = _volume(predictor, process)
    g[at] += samples * volume
    moved[at] += samples * _volume(predictor, sharper)[0]
    H[at, at] += samples * (volume - bend)
    newton = H.copy()
    newton[at] = newton[:, at] = (g - moved) / SHARPNESS_STEP
    return (newton if is_convex(newton, H) else H), g


def _volume(predictor: Predictor, process: np.ndarray) -> tuple[float, float]:
    """First and second derivative of what undoing a filter adds to the log-likelihood of each sample."""
    return predictor.data.filter.log_volume(predictor.step, predictor.sharpness(process))[1:]


def covariance_of(H: np.ndarray) -> np.ndarray:
    """The inverse of a normal matrix (q, q) of unknowns in whatever units; zero along what the data do not show.

    They do not show what has no positive curvature, such as stiffnesses so far away that sensitivities have lost every
    digit.
    """
    inverse, shown = np.zeros_like(H), np.flatnonzero(np.diag(H) > 0)
    scale = np.sqrt(np.diag(H)[shown])
    scaled = H[np.ix_(shown, shown)] / scale[:, None] / scale
    inverse[np.ix_(shown, shown)] = np.linalg.pinv(scaled, rcond=1e-13) / scale[:, None] / scale
    return inverse
