"""The model as it is given, fitted from nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from symid.errors import DiagnosisError, SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.noise_sizes import likeliest_sizes
from symid.estimation.fitting.unseen_forces import LIKELIER
from symid.estimation.predicting.kalman import linearised_along
from symid.estimation.sensors.whitening import longest_memory
from symid.estimation.signals.data import Data, observed_state
from symid.estimation.signals.segment import FEWEST
from symid.model import Model
from symid.simulation import simulator

FIRST, GROWING = 0.1, 4.0
"""Seconds of each segment, at the pace of a second, that are fitted first, so that free runs find their initial
states, and by what factor they grow: from 1.5 s to 150 s at once, the period of a swing that never dies out was 4 % off
for good (tests/discrepancy/machines/test_other_machines.py)."""
CONFIDENT = 10.0
"""The first process noise moves the outputs by this many sensor noises: the fit then leans on the data."""
LESS_CONFIDENT = (30 * CONFIDENT, 1000 * CONFIDENT)
"""And by so many where fits from there end before they converge: without its controller a standing person falls so fast
that forces a thousandth of those that acted would do (`person` 705 of tests/examination)."""
FEWEST_STEPS = 10
"""Steps in which the first size of a force is looked for. After a single one of Euler it has moved no position yet:
that of a ball on a beam, sampled at 10 Hz, began at 10^13 rad (tests/discrepancy/machines/test_ball_and_beam.py)."""
ELSEWHERE = (1 / 64, 1 / 16, 1 / 4, 4.0, 16.0)
"""Factors of the size of each random force at which a likelihood with several maxima may be higher. Sensors seem to
be perfect at one: at that of an arm twice the log-likelihood was 135 less than with a force a seventeenth as large
(`controlled` 25 of tests/examination)."""


def fit_model(model: Model, data: Data, start: dict[str, float] | None = None, exact: bool = True) -> Fit:
    """Fit `model` with all of its unknowns.

    Parameters
    ----------
    start : SI values of some parameters, and of states that no sensor shows as they are, where segments begin; zero, or
        the middle of the bounds, elsewhere.
    exact : as of `Fitter.fit`.

    Raises
    ------
    DiagnosisError : no start leads to a run that stays finite.
    """
    sim, start = simulator(model), start or {}
    values, initial = _begun(model, data, start)
    fitter = Fitter(model, data)
    if not fitter.driven:
        return _grow(model, data, values, initial, values.keys() <= start.keys(), exact)
    found, problem, smallest = [], None, _equivalent_noise(sim, values, initial, data)
    for confident in (CONFIDENT, 0.2 * CONFIDENT, *LESS_CONFIDENT):
        if confident in LESS_CONFIDENT and found and max(found, key=lambda f: f.loglik2).converged:
            break
        try:
            found.append(fitter.fit(values, initial, confident * smallest, exact=exact))
        except SymidError as error:
            problem = error
    if not found:
        raise DiagnosisError(
            f"model '{model.name}' could not be fitted from any start; give start values. The last "
            f"attempt ended with: {problem}"
        )
    return _with_likeliest_noise(max(found, key=lambda f: f.loglik2), data, exact)


def _with_likeliest_noise(fit: Fit, data: Data, exact: bool) -> Fit:
    """The same fit, or one that ends at another maximum of the likelihood, which is higher."""
    alone = np.eye(len(fit.model.noises), dtype=bool)
    fitter = Fitter.of(fit, data)
    value, process = likeliest_sizes(fitter, fit, [np.where(one, f, 1.0) for one in alone for f in ELSEWHERE])
    if value <= fit.loglik2 + LIKELIER:
        return fit
    try:
        return max(fit, fitter.fit(fit.values, fit.initial, process, exact=exact), key=lambda f: f.loglik2)
    except SymidError:
        return fit


def _grow(model: Model, data: Data, values: dict[str, float], initial: np.ndarray, all_known: bool, exact: bool) -> Fit:
    """Begin with the states alone; parameters that are known so far keep their values until the whole is fitted."""
    longest, length = max(len(e.time) for e in data.segments), FIRST * data.pace / data.segments[0].step
    fixed, fit = tuple(model.parameters), None
    while True:
        rows = int(min(longest, max(FEWEST, length)))
        last = rows == longest and not fixed
        fit = _fit_heads(model, data, values, initial, rows, fixed, fit, exact and last)
        values, initial = fit.values, fit.initial
        if last:
            return fit
        length *= GROWING
        fixed = fixed if all_known and rows < longest else ()


def fit_states(model: Model, data: Data, start: Mapping[str, float]) -> Fit:
    """The initial states that the first samples of each segment show, for parameters [SI] as they are known.

    Raises
    ------
    DiagnosisError : these samples already diverge.
    """
    values, initial = _begun(model, data, start)
    rows = int(max(FEWEST, FIRST * data.pace / data.segments[0].step))
    return _fit_heads(model, data, values, initial, rows, tuple(model.parameters))


def _begun(model: Model, data: Data, start: Mapping[str, float]) -> tuple[dict[str, float], np.ndarray]:
    values = {k: start.get(k, _first(p)) for k, p in model.parameters.items()}
    return values, np.array([observed_state(model, e.recorded[0], start) for e in data.segments])


def _fit_heads(
    model: Model,
    data: Data,
    values,
    initial: np.ndarray,
    rows: int,
    fixed: tuple[str, ...],
    before: Fit | None = None,
    exact: bool = True,
) -> Fit:
    heads = [e.head(rows) for e in data.segments]
    told = longest_memory([e.time for e in heads])  # by so short a beginning
    head = replace(data, segments=tuple(heads), memory=min(data.memory, told))
    return Fitter(model, head, fixed, before).fit(values, initial, np.zeros(len(model.noises)), exact=exact)


def _first(parameter) -> float:
    low, high = parameter.bounds
    if parameter.guess is not None:
        return float(parameter.guess)
    if low <= 0 <= high:
        return 0.0
    return float(0.5 * (low + high)) if np.isfinite(low + high) else float(low if np.isfinite(low) else high)


def _equivalent_noise(sim, values, initial, data: Data) -> np.ndarray:
    """(w,) size of each noise that moves an output by its sensor noise within a fifth of the pace."""
    sample = data.segments[0].step
    steps = max(FEWEST_STEPS, int(0.2 * data.pace / sample))
    step = max(0.2 * data.pace, sample) / steps
    linear = linearised_along(sim, values, initial, data.mean_inputs, points=1)
    A, G, C = linear.without_delay()
    state, moved = np.zeros_like(G), np.zeros((len(C), G.shape[1]))
    for _ in range(steps):
        state = state + step * (A @ state + G)
        moved = np.maximum(moved, np.abs(C @ state))
    return 1.0 / np.maximum((moved / data.sensor_noise[:, None]).max(0), 1e-12)
