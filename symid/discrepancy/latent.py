"""Locate: the torque that a model lacks, per equation and over time, by smoothing what it leaves.

The error of a fitted model's free run obeys the model linearised along that run, driven by what
is missing. With the missing torque as a random walk, a Kalman filter and the smoother of Rauch,
Tung & Striebel (1965) give it with its standard error.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

import numpy as np
from scipy.linalg import expm

from symid.discrepancy.fit import Fit
from symid.discrepancy.freerun import FreeRun
from symid.discrepancy.gain import linearised_along
from symid.model import Model, Noise

PACES = (0.03, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
"""Rates of the random walk that are tried, in torques that move an output by its error, per root second."""
_ORDER = 6
TURNING = 40
"""The linearisation is the mean over so many states of the run."""


@dataclass(frozen=True, eq=False)
class Latent:
    """Missing torque at one place: estimate and standard error over time, (N,) each [`unit`]."""

    place: str
    unit: str
    time: np.ndarray
    torque: np.ndarray
    error: np.ndarray


def latent_torques(fit: Fit, run: FreeRun) -> tuple[Latent, ...]:
    """What is missing at each of the model's process noises, which stand where forces act.

    Parameters
    ----------
    run : the fitted model's free run on the window that it was fitted to. The sensors' noise is read off it.
    """
    model: Model = fit.model
    if not model.noises:
        return ()
    sim = fit.simulator
    step = float(np.median(np.diff(run.time)))
    linear = linearised_along(sim, np.array([fit.values[k] for k in sim.parameters]), _states(model, run, step), TURNING)
    A, G, C = linear.without_delay()
    residual = run.recorded - run.simulated
    size = _moving(A, G, C, residual)
    lengths = [len(s) for s in fit.surprise]
    starts = np.cumsum([0, *lengths[:-1]]) if sum(lengths) == len(run.time) else np.zeros(1, dtype=int)
    noise = _sensor_noise(run.recorded)
    _, torque, error = max((_smoothed(A, G * size, C, residual, step, noise, pace, starts) for pace in PACES),
                           key=lambda found: found[0])
    size = size * [_sign(model, w) for w in model.noises.values()]
    return tuple(Latent(w.at or name, w.unit, run.time, torque[:, i] * size[i], error[:, i] * abs(size[i]))
                 for i, (name, w) in enumerate(model.noises.items()))


def _sign(model: Model, noise: Noise) -> float:
    """-1 for a noise that enters the balances against the force at its joint."""
    port = next((p for p in model.ports.values() if p.at == noise.at and p.role == "joint"), None)
    if port is None:
        return 1.0
    equation, into = next(iter(port.into.items()))
    return float(np.sign(float(model[equation].expr.coeff(noise.symbol) * into))) or 1.0


def _sensor_noise(recorded: np.ndarray) -> np.ndarray:
    """(m,) rms of white noise, from differences of an order that motion hardly reaches.

    The squared binomial coefficients of order k add up to (2k)!/(k!)^2 (Anderson 1971, 3.4).
    """
    power = np.mean(np.diff(recorded, _ORDER, axis=0) ** 2, axis=0) / comb(2 * _ORDER, _ORDER)
    return np.sqrt(np.maximum(power, 1e-18 + 1e-6 * np.mean(recorded**2, axis=0)))


def _states(model: Model, run: FreeRun, step: float) -> np.ndarray:
    """States along the run: what outputs show, and their slopes for rates; zero for others."""
    shown = {str(y.expr): run.simulated[:, i] for i, y in enumerate(model.outputs.values())}
    rates = model.rates()
    return np.column_stack([shown[s] if s in shown else np.gradient(shown[rates[s]], step) if rates.get(s) in shown
                            else np.zeros(len(run.time)) for s in model.states])


def _moving(A, G, C, residual) -> np.ndarray:
    """(w,) size of each torque that, held for a second, moves an output by its error."""
    n = len(A)
    block = np.zeros((n + G.shape[1],) * 2)
    block[:n, :n], block[:n, n:] = A, G
    moved = np.abs(C @ expm(block)[:n, n:]) / np.maximum(np.sqrt(np.mean(residual**2, axis=0)), 1e-12)[:, None]
    return 1.0 / np.maximum(moved.max(0), 1e-12)


def _smoothed(A, G, C, residual, step, noise, pace, starts):
    """Log-likelihood, torque (N, w) and standard error (N, w)."""
    n, w, N = len(A), G.shape[1], len(residual)
    block = np.zeros((n + w, n + w))
    block[:n, :n], block[:n, n:] = A * step, G * step
    F = expm(block)
    Q = np.zeros_like(F)
    Q[n:, n:] = np.eye(w) * pace**2 * step
    H, R = np.hstack([C, np.zeros((len(C), w))]), np.diag(noise**2)
    spread = np.maximum(np.sqrt(np.mean(residual**2)), noise.max())
    P0 = np.diag([*(10 * spread for _ in range(n)), *(1.0 for _ in range(w))]) ** 2
    x, P, value = np.zeros(n + w), P0, 0.0
    before_x, before_P, after_x, after_P = (np.empty((N, *s)) for s in ((n + w,), (n + w, n + w)) * 2)
    begins = set(starts.tolist())
    for k in range(N):
        x, P = (np.zeros(n + w), P0) if k in begins else (F @ x, F @ P @ F.T + Q)
        before_x[k], before_P[k] = x, P
        S = H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        e = residual[k] - H @ x
        value -= 0.5 * (e @ np.linalg.solve(S, e) + np.linalg.slogdet(S)[1])
        rest = np.eye(n + w) - K @ H
        x, P = x + K @ e, rest @ P @ rest.T + K @ R @ K.T   # Joseph's form stays positive
        after_x[k], after_P[k] = x, P
    for k in range(N - 2, -1, -1):
        if k + 1 in begins:
            continue
        back = np.linalg.solve(before_P[k + 1], F @ after_P[k]).T
        after_x[k] += back @ (after_x[k + 1] - before_x[k + 1])
        after_P[k] += back @ (after_P[k + 1] - before_P[k + 1]) @ back.T
    variance = np.diagonal(after_P, axis1=1, axis2=2)[:, n:]
    return value, after_x[:, n:], np.sqrt(np.maximum(variance, 0.0))
