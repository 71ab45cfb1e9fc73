"""How much of each sample's innovation belongs to the state: the stationary Kalman gain."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.linalg import LinAlgError, expm, matrix_balance, solve_discrete_are

from symid.simulation import Linearised, Simulator

HOLD, MOST_HOLDS = 0.01, 8
"""Random forces last about this long [s], or this part of a sample: shorter ones within a sample look all alike."""
FLOOR = 1e-12
"""Every state is moved by at least so small a variance, that of a sensor's noise being one: a mode that nothing moves
has no stationary gain."""


def linearised_along(
    simulator: Simulator, values, states: np.ndarray, inputs: Mapping[str, float], points: int = 16
) -> Linearised:
    """The mean of the linearisations at `points` states of a trajectory (statistical linearisation).

    Parameters
    ----------
    inputs : the mean of each: a rope's length or a vehicle's speed, which a model may multiply by or divide by.
    """
    rows = states[np.isfinite(states).all(axis=1)]
    rows = rows[np.linspace(0, len(rows) - 1, points).astype(int)] if len(rows) else states[:1]
    return simulator.linearise(values, rows, np.array([inputs[u] for u in simulator.source.inputs]))


def kalman_gain(linear: Linearised, step: float, process: np.ndarray, sensor: np.ndarray) -> np.ndarray:
    """Gain that moves the state after a sample by gain @ (recorded - predicted).

    (n, m), or (1 + k, n, m) where the model has delayed states: then also for the states 1 ... k
    samples before, P (F - F K C)'^j C' S^-1 (fixed-lag smoothing; Anderson & Moore 1979, 7.3).

    Parameters
    ----------
    step : seconds between samples; the process noise is held over the whole part of a sample nearest to `HOLD`
        seconds, an eighth at least: forces that change within a sample move position and speed apart.
    process : (w,) standard deviation of each noise of the model; sensor : (m,) of each output.
    """
    A, G, C = linear.without_delay()
    F, Q = _moved(A, G, step, process)
    C = C / sensor[:, None]
    size = _sizes(F, C)
    with np.errstate(all="ignore"):  # hopeless candidates overflow, and have no gain
        F, Q, C = F * size / size[:, None], Q / np.outer(size, size), C * size
    for leak in (1.0, 1 - 1e-4, 1 - 1e-3, 1 - 1e-2):
        try:
            with np.errstate(over="ignore", invalid="ignore"):
                P = solve_discrete_are((leak * F).T, C.T, Q + FLOOR * np.eye(len(F)), np.eye(len(C)))
            gains = _gains(F, P, C, np.linalg.inv(C @ P @ C.T + np.eye(len(C))), linear, step)
            return gains * size[: len(linear.A), None] / sensor
        except (LinAlgError, ValueError):
            continue
    return np.zeros((len(linear.A), len(C)))


def _sizes(F: np.ndarray, C: np.ndarray) -> np.ndarray:
    """(n,) by which states are divided so that millimetres beside kilopascals do no harm (Parlett & Reinsch 1969)."""
    if not np.isfinite(F).all():
        return np.ones(len(F))
    with np.errstate(invalid="ignore"):  # SciPy makes integers of sizes beyond all bounds, which nobody asked for
        _, (size, _) = matrix_balance(F, permute=False, separate=True)
    return size / (np.abs(C * size).max() or 1.0)


def held(step: float) -> tuple[int, float]:
    """How often a random force changes within a sample of `step` seconds, and its size in parts of the stated one.

    Where it changes less often than it would it is smaller, so that its power at low frequencies is the same.
    """
    holds = max(1, round(step / HOLD))
    return (holds, 1.0) if holds <= MOST_HOLDS else (MOST_HOLDS, float(np.sqrt(HOLD * MOST_HOLDS / step)))


def _moved(A, G, step: float, process: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Transition over a sample and the covariance of what the noise adds (Anderson & Moore 1979, 4.4)."""
    n, w = G.shape
    holds, size = held(step)
    block = np.zeros((n + w, n + w))
    block[:n, :n], block[:n, n:] = A * step / holds, G * step / holds
    exact = expm(block)
    F, B = exact[:n, :n], exact[:n, n:] * process * size
    one, Q = B @ B.T, np.zeros((n, n))
    for _ in range(holds):
        Q = F @ Q @ F.T + one
    return np.linalg.matrix_power(F, holds), Q


def _gains(F, P, C, inverse, linear: Linearised, step: float) -> np.ndarray:
    own = len(linear.A)
    now = P @ C.T @ inverse
    lags = linear.lag[linear.late_state >= 0]
    if len(lags) == 0:
        return now[:own]
    back, error, gains = P, (F - F @ now @ C).T, [now[:own]]
    for _ in range(int(np.ceil(lags.max() / step)) + 1):
        back = back @ error
        gains.append((back @ C.T @ inverse)[:own])
    return np.array(gains)
