"""Where a suspect that follows a clock would act: forecasts over a grid of its moments or frequencies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import HIGHEST_FREQUENCY, Suspect
from symid.discrepancy.name.trial.comb import comb
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import fitted_path
from symid.estimation.predicting.kalman import linearised_along
from symid.estimation.signals.data import Data
from symid.model import Model
from symid.simulation import Simulator, simulator

DECAYED, DRIFTS = 5.0, 0.1
"""A motion forgets how it began, and answers steadily to a clock, where all that is not a drift dies out over it by so
many powers of e; what changes by less than this part over it drifts, as the angle of a shaft does."""


def scan(projection: Projection, suspect: Suspect, model: Model) -> list[tuple[float, dict[str, float]]]:
    """Forecasts over the grid of the scanned parameter, best first, with start values."""
    sim, found = simulator(model), []
    strength = suspect.strength.key
    segments, pace = projection.data.segments, projection.data.pace
    if projection.data.driven and suspect.scanned.clock == "start":
        grid = slide(projection, suspect, sim)
    elif suspect.scanned.clock == "frequency":
        if projection.data.driven or _forgets(projection):
            grid = sweep(projection, suspect, sim)
        else:
            grid = comb(projection, suspect, sim, min(HIGHEST_FREQUENCY / pace, 0.4 / segments[0].step))
    else:
        grid = suspect.grid(projection.data)
    for values in grid:
        quadratures = suspect.quadratures(values)
        columns = [projection.response(suspect, sim, v) for v in quadratures]
        if any(c is None for c in columns):
            continue
        gain, c = projection.forecast(np.hstack(columns))
        if len(c) == 2:
            turned = {strength: float(np.hypot(*c)), suspect.phase: float(np.arctan2(c[1], c[0]))}
        else:
            turned = {strength: suspect.strength.null + float(c[0])}
        found.append((gain, values | turned))
    low, high = suspect.strength.bounds
    found = [(g, v) for g, v in found if low <= v[strength] <= high]
    return sorted(found, key=lambda f: -f[0])


def promising(known: Sequence[Hypothesis], best: Hypothesis, most: float) -> list[Hypothesis]:
    """Those that promise enough of `most` beside `best` at the moment or frequency of their fits, at any phase."""
    least = max(POLICY.worth_refitting, POLICY.beam_share * most)
    beside = Projection(best.fit, best.data) if known else None
    return [h for h in known if _promise(beside, h) > least]


def _promise(projection: Projection, found: Hypothesis) -> float:
    suspect, strength = found.suspect, found.suspect.strength
    values = suspect.keyed(found.fit.values)
    sim = simulator(projection.fit.model.with_term(suspect.term))
    columns = [
        projection.response(suspect, sim, v | {strength.key: strength.null}) for v in suspect.quadratures(values)
    ]
    return 0.0 if any(c is None for c in columns) else projection.score(np.hstack(columns))[0]


def _forgets(projection: Projection) -> bool:
    """Whether a motion in one piece is for the most part a steady answer to what acts on it."""
    fit, segments = projection.fit, projection.data.segments
    if len(segments) > 1:
        return False
    p = np.array([fit.values[k] for k in fit.simulator.parameters])
    A, *_ = linearised_along(
        fit.simulator, p, fitted_path(fit, projection.data), projection.data.mean_inputs
    ).without_delay()
    rates = np.linalg.eigvals(A) * float(segments[0].time[-1] - segments[0].time[0])
    return bool(np.all((rates.real < -DECAYED) | (np.abs(rates) < DRIFTS)))


def slide(projection: Projection, suspect: Suspect, sim: Simulator, keep: int = 4) -> list[dict[str, float]]:
    """The best starts of an event: its response is computed once per shape and slid over the innovations.

    A loop that is nearly linear and does not change answers alike at all times; what this picks
    is scored exactly afterwards.
    """
    (t0, t1), kernels, found = projection.data.span, [], []
    step, pace = projection.data.segments[0].step, projection.data.pace
    for values in suspect.shapes():
        middle = 0.5 * (t0 + t1)
        column = projection.response(suspect, sim, values | {suspect.scanned.key: middle})
        if column is None:
            continue
        first = int((middle - t0) / step) - 1
        kernels.append((values, column.reshape(-1, projection.outputs)[first : first + int(10 * pace / step)]))

    def gains(rest: np.ndarray) -> list[np.ndarray]:
        return [_slid(rest.reshape(-1, projection.outputs), kernel) for _, kernel in kernels]

    if kernels:
        projection.scans.append(lambda rest: np.array([max(gain.max() for gain in gains(one)) for one in rest.T]))
    for (values, _), gain in zip(kernels, gains(projection.rest), strict=True):
        for k in _peaks(gain, int(0.5 * pace / step), keep):
            found.append((gain[k], values | {suspect.scanned.key: float(t0 + (k + 1) * step)}))
    return [v for _, v in sorted(found, key=lambda f: -f[0])[: 2 * keep]]


def _slid(rest: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Gain of twice the log-likelihood that is forecast for a response (k, m) which begins at each sample of (N, m)."""
    size = next_fast_len(len(rest) + len(kernel) - 1, real=True)
    convolved = irfft(rfft(rest, size, axis=0) * rfft(kernel[::-1], size, axis=0), size, axis=0)
    score = convolved[len(kernel) - 1 :][: len(rest)].sum(axis=1)
    return score**2 / ((kernel**2).sum() + 1e-300)


def sweep(projection: Projection, suspect: Suspect, sim: Simulator, keep: int = 6) -> list[dict[str, float]]:
    """The best frequencies: the response is known from a few and interpolated, innovations by FFT."""
    outputs, step, pace = projection.outputs, projection.data.segments[0].step, projection.data.pace
    n = len(projection.rest) // outputs
    time = np.arange(n) * step
    known = np.geomspace(0.05, HIGHEST_FREQUENCY, 24) / pace
    answers = []
    for f in known:
        column = projection.response(
            suspect, sim, suspect.starts()[0] | {suspect.scanned.key: float(f), suspect.phase: 0.0}
        )
        if column is None:
            return []
        late = slice(n // 5, None)
        clock = 2 * np.pi * f * time
        basis = np.column_stack([np.cos(clock), np.sin(clock), np.ones(n), time])[late]
        c, *_ = np.linalg.lstsq(basis, column.reshape(n, outputs)[late], rcond=None)
        answers.append(c[0] - 1j * c[1])
    size = 4 * n
    f = np.fft.rfftfreq(size, step)
    use = (f > 1.0 / time[-1]) & (f < HIGHEST_FREQUENCY / pace)
    G = np.column_stack(
        [
            np.interp(f[use], known, [a[o].real for a in answers])
            + 1j * np.interp(f[use], known, [a[o].imag for a in answers])
            for o in range(outputs)
        ]
    )

    def gains(rest: np.ndarray) -> np.ndarray:
        spectrum = np.fft.rfft(rest.reshape(n, outputs), size, axis=0)[use]
        return 2 * np.abs((G.conj() * spectrum).sum(1)) ** 2 / (n * (np.abs(G) ** 2).sum(1) + 1e-300)

    projection.scans.append(lambda rest: np.array([gains(one).max() for one in rest.T]))
    return [
        suspect.starts()[0] | {suspect.scanned.key: float(f[use][k])} for k in _peaks(gains(projection.rest), 6, keep)
    ]


def _peaks(values: np.ndarray, apart: int, keep: int) -> list[int]:
    """Indices of the largest values that are at least `apart` from each other."""
    values, found = values.copy(), []
    for _ in range(keep):
        k = int(np.argmax(values))
        if not values[k] > 0:
            break
        found.append(k)
        values[max(0, k - apart) : k + apart + 1] = 0
    return found


def moment_profile(fit: Fit, data: Data, name: str, within: tuple[float, float], spacing: float):
    """(K,) moments [s] of a lasting change and (K,) twice the log-likelihood at each, all else as fitted.

    Parameters
    ----------
    name : of the parameter that is the moment. within, spacing : of the moments [s].
    """
    t0, t1 = data.span
    fitter = Fitter.of(fit, data)
    at = fitter.sim.parameters.index(name)
    p = np.array([fit.values[k] for k in fitter.sim.parameters])
    moments, values = np.arange(max(t0 + spacing, within[0]), min(t1 - spacing, within[1]), spacing), []
    for moment in moments:
        p[at] = moment
        values.append(fitter.evaluate(p, fit.initial, fit.kalman_gain))
    return moments, np.array(values)
