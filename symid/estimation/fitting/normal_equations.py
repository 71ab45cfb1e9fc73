"""One Gauss-Newton step's linear system, from exact sensitivities of the predictions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.estimation.fitting.growth import growth_normal
from symid.estimation.fitting.kalman import kalman_gain
from symid.estimation.fitting.predictor import Predictor
from symid.simulation import Trajectory


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
    runs = runs or predictor.run(p, x0, gain, sensitivities=True, process=process)
    if runs is None:
        return None
    innovations = predictor.innovations(runs, process)
    _, whitening = predictor.score(innovations, process)
    noise = (
        _tuned_columns(predictor, p, x0, gain, process, path, innovations)
        if predictor.tuned
        else [np.zeros((*s.shape, 0)) for s in innovations]
    )
    q, n, w, E = len(predictor.free), x0.shape[1], noise[0].shape[2], len(runs)
    size = q + w + E * n
    H, g = np.zeros((size, size)), np.zeros(size)
    with np.errstate(over="ignore", invalid="ignore"):
        for i, (t, s, extra) in enumerate(zip(runs, innovations, noise, strict=True)):
            J = whitening(np.concatenate([t.dy[:, :, :q], -extra, t.dy[:, :, q:]], axis=2))
            r = whitening(s[:, :, None])[:, 0]
            where = np.r_[0 : q + w, q + w + i * n : q + w + (i + 1) * n]
            H[np.ix_(where, where)] += J.T @ J
            g[where] += J.T @ r
        if predictor.data.cutoff_free and predictor.tuned:
            _, slope, bend = predictor.data.filter.log_volume(predictor.step, predictor.sharpness(process))
            samples, at = sum(s.size for s in innovations), q + predictor.tuned.index(predictor.noises)
            H[at, at] += samples * (slope - bend)
            g[at] += samples * slope
        if predictor.bounded:
            own, pull = growth_normal(predictor, p, path)
            H[:q, :q] += own
            g[:q] += pull
    # Sensitivities of an unstable predictor overflow before the run itself does.
    return (H, g, q) if np.isfinite(H).all() and np.isfinite(g).all() else None


def _tuned_columns(predictor: Predictor, p, x0, gain, process, path, innovations):
    """Change of the innovations per unit of the logarithm of what is tuned, by differences."""
    linear, columns = predictor.linearised(p, path) if predictor.driven else None, []
    for j in predictor.tuned:
        more = process.copy()
        more[j] *= np.exp(0.1)
        moved = (
            gain
            if j == predictor.sharpness_at
            else kalman_gain(linear, predictor.step, more[: predictor.noises], predictor.sensors(more))
        )
        other = predictor.run(p, x0, moved, False, process=more)
        columns.append(
            [np.zeros_like(s) for s in innovations]
            if other is None
            else [(a - b) / 0.1 for a, b in zip(predictor.innovations(other, more), innovations, strict=True)]
        )
    return [np.stack([c[i] for c in columns], axis=2) for i in range(len(innovations))]


def covariance_of(H: np.ndarray) -> np.ndarray:
    """The inverse of a normal matrix (q, q) of unknowns in whatever units; zero along what the data do not show."""
    d = np.sqrt(np.maximum(np.diag(H), 1e-300))
    return np.linalg.pinv(H / np.outer(d, d), rcond=1e-13) / np.outer(d, d)
