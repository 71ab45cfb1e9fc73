"""Locate: the torque that a model lacks, per equation and over time, by smoothing what it leaves.

The error of a fitted model's free run obeys the model linearised along that run, driven by what
is missing. With the missing torque as a random walk, a Kalman filter and the smoother of Bryson and Frazier, as
modified by Bierman (1973), give it with its standard error.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import comb

import numpy as np
from scipy.linalg import expm

from symid.estimation.fitting.fit import Fit
from symid.estimation.free_run import FreeRun
from symid.estimation.predicting.kalman import linearised_along
from symid.model import Model, Noise
from symid.model.variants import correlated

WANDERS = (0.03, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
"""Sizes of the random walk that are tried, in torques that move an output by its error, per root of the pace."""
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
    linear = linearised_along(sim, fit.values, _states(model, run, step), run.mean_inputs, TURNING)
    A, G, C = linear.without_delay()
    residual = run.recorded - run.simulated
    size = _moving(A, G, C, residual, run.pace)
    ends = np.cumsum(run.lengths)
    pieces = list(zip([0, *ends[:-1]], ends, strict=True))
    noise = _sensor_noise(run.recorded)
    torque, variance = _most_likely(A, G * size, C, residual, step, noise, pieces, run.pace)
    error = np.sqrt(variance)
    size = size * [_sign(model, w) for w in model.noises.values()]
    return tuple(
        Latent(w.at or name, w.unit, run.time, torque[:, i] * size[i], error[:, i] * abs(size[i]))
        for i, (name, w) in enumerate(model.noises.items())
    )


def _most_likely(A, G, C, residual, step, noise, pieces, pace: float):
    """Torques (N, w) and their variances, with the size of the walk that makes the error most likely."""
    n, w = G.shape
    H, R = np.hstack([C, np.zeros((len(C), w))]), np.diag(noise**2)
    spread = 10 * max(np.sqrt(np.mean(residual**2)), noise.max())
    start = np.diag([spread] * n + [1.0] * w) ** 2
    longest = max(end - begin for begin, end in pieces)
    best = None
    for wander in WANDERS:
        F, Q = _walk(A, G, step, wander / np.sqrt(pace))
        steps = _covariances(F, Q, H, R, start, longest)
        value, before, after = _filtered(F, H, residual, pieces, steps)
        if best is None or value > best[0]:
            best = value, F, before, after, steps
    x, variance = _smoothed(best[1], H, residual, *best[2:4], pieces, best[4])
    return x[:, n:], variance[:, n:]


def _sign(model: Model, noise: Noise) -> float:
    """-1 for a noise that enters the balances against the force at its joint."""
    port = next((p for p in model.ports.values() if p.at == noise.at and p.role == "joint"), None)
    if port is None:
        return 1.0
    equation, into = next(iter(port.into.items()))
    force = model[own].symbol if (own := correlated(str(noise.symbol))) in model.states else noise.symbol
    return float(np.sign(float(model[equation].expr.coeff(force) * into))) or 1.0


def _sensor_noise(recorded: np.ndarray) -> np.ndarray:
    """(m,) rms of white noise, from differences of an order that motion hardly reaches.

    The squared binomial coefficients of order k add up to (2k)!/(k!)^2 (Anderson 1971, 3.4).
    """
    power = np.mean(np.diff(recorded, _ORDER, axis=0) ** 2, axis=0) / comb(2 * _ORDER, _ORDER)
    return np.sqrt(np.maximum(power, 1e-6 * np.mean(recorded**2, axis=0)) + 1e-300)


def _states(model: Model, run: FreeRun, step: float) -> np.ndarray:
    """States along the run: what outputs show, and their slopes for rates; zero for others."""
    shown = {str(y.expr): run.simulated[:, i] for i, y in enumerate(model.outputs.values())}
    rates = model.rates()
    return np.column_stack(
        [
            shown[s]
            if s in shown
            else np.gradient(shown[rates[s]], step)
            if rates.get(s) in shown
            else np.zeros(len(run.time))
            for s in model.states
        ]
    )


def _moving(A, G, C, residual, pace: float) -> np.ndarray:
    """(w,) size of each torque that, held for the pace of the motion, moves an output by its error."""
    n = len(A)
    block = np.zeros((n + G.shape[1],) * 2)
    block[:n, :n], block[:n, n:] = A, G
    moved = np.abs(C @ expm(block * pace)[:n, n:]) / np.maximum(np.sqrt(np.mean(residual**2, axis=0)), 1e-12)[:, None]
    return 1.0 / np.maximum(moved.max(0), 1e-12)


def _walk(A, G, step: float, wander: float) -> tuple[np.ndarray, np.ndarray]:
    """Transition and process covariance of state and torque over one sample, the torque a random walk."""
    n, w = G.shape
    block = np.zeros((n + w, n + w))
    block[:n, :n], block[:n, n:] = A * step, G * step
    Q = np.zeros_like(block)
    Q[n:, n:] = np.eye(w) * wander**2 * step
    return expm(block), Q


def _covariances(F, Q, H, R, P, longest: int):
    """Before and after each sample, with gain and covariance of the innovations, until they repeat."""
    found, eye = [], np.eye(len(F))
    for k in range(longest):
        P = F @ P @ F.T + Q if k else P
        S = H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        after = (eye - K @ H) @ P @ (eye - K @ H).T + K @ R @ K.T  # Joseph's form stays positive
        found.append((P, after, K, S))
        if k and np.allclose(P, found[-2][0], rtol=1e-7, atol=0):
            break
        P = after
    return found


def _filtered(F, H, residual, pieces, steps):
    """Log-likelihood, and states before and after each sample."""
    before, after, value = np.zeros((len(residual), len(F))), np.zeros((len(residual), len(F))), 0.0
    inverse = [(np.linalg.inv(S), np.linalg.slogdet(S)[1]) for *_, S in steps]
    for begin, end in pieces:
        x = np.zeros(len(F))
        for k in range(begin, end):
            i = min(k - begin, len(steps) - 1)
            x = F @ x if k > begin else x
            e = residual[k] - H @ x
            value -= 0.5 * (e @ inverse[i][0] @ e + inverse[i][1])
            before[k] = x
            after[k] = x = x + steps[i][2] @ e
    return value, before, after


def _smoothed(F, H, residual, before, after, pieces, steps):
    """States and their variances given all samples of the piece, by the adjoint (Bierman 1973).

    It inverts covariances of what is seen only: those of states are nearly singular where a delay is among them.
    """
    x, variance, eye = after.copy(), np.empty_like(after), np.eye(len(F))
    seen = [np.linalg.solve(S, H).T for *_, S in steps]
    passed = [eye - K @ H for _, _, K, _ in steps]
    for begin, end in pieces:
        pull, tight = np.zeros(len(F)), np.zeros_like(F)
        for k in range(end - 1, begin - 1, -1):
            i = min(k - begin, len(steps) - 1)
            P = steps[i][1]
            x[k] -= P @ pull
            variance[k] = np.diag(P) - np.einsum("ij,jk,ki->i", P, tight, P)
            pull = F.T @ (passed[i].T @ pull - seen[i] @ (residual[k] - H @ before[k]))
            tight = F.T @ (passed[i].T @ tight @ passed[i] + seen[i] @ H) @ F
    return x, np.maximum(variance, 0.0)
