"""Is anything systematic left? Flexible laws at every place, and the whiteness of the surprises."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from symid.discrepancy.data import Data
from symid.discrepancy.fit import Fit
from symid.discrepancy.flexible import flexible_terms
from symid.discrepancy.screen import Screen, extended, padded
from symid.errors import SymidError
from symid.model import Term
from symid.simulation import Simulator, simulator

WHITENESS_LAGS = 25
"""So many lags of the surprises' correlation enter the test of whiteness."""

_WHAT = {"unknown_force": "a force that depends on position, speed, the past or time",
         "unknown_sensor_error": "a distortion of what the sensor shows",
         "unknown_input_error": "an excitation other than the recorded one"}


@dataclass(frozen=True)
class Test:
    """One test for something left over.

    Attributes
    ----------
    place : where it would act. what : in words. gain : growth of twice the log-likelihood, or the
    statistic. size : its degrees of freedom. surprise : -log10 of the probability by chance.
    """

    place: str
    what: str
    gain: float
    size: int
    locates: bool = True

    @property
    def surprise(self) -> float:
        return float(-chi2.logsf(self.gain, self.size) / np.log(10))


def remainder(fit: Fit, data: Data) -> list[Test]:
    """All tests, the most surprising first."""
    screen, found = Screen(fit, data), []
    for term in flexible_terms(fit, data):
        try:
            sim = simulator(fit.model.with_term(term))
        except SymidError:
            continue
        columns = _columns(screen, sim, term)
        if columns is not None:
            gain, coefficients = screen.score(columns)
            found.append(Test(term.location, _WHAT[term.name], gain, int(np.count_nonzero(coefficients))))
    found += [_whiteness(screen, fit, o, name) for o, name in enumerate(fit.model.outputs)]
    return sorted(found, key=lambda t: -round(t.surprise, 1))


def _columns(screen: Screen, sim: Simulator, term: Term) -> np.ndarray | None:
    names = [term.parameter_name(q.key) for q in term.law.parameters]
    values, out = screen.fit.values | dict.fromkeys(names, 0.0), []
    for e, x0 in zip(screen.data.episodes, extended(screen.fit.initial, sim), strict=True):
        t = sim.simulate(values, x0, e.time, e.inputs, substeps=screen.substeps, gain=padded(screen.fit.gain, sim),
                         recorded=e.recorded, sensitivity=names, keep="outputs")
        if t.diverged:
            return None
        out.append(screen.whiten(t.dy))
    return np.vstack(out)


def _whiteness(screen: Screen, fit: Fit, output: int, name: str) -> Test:
    """Ljung-Box (1978) statistic of one output's surprises over all episodes."""
    total, count = np.zeros(WHITENESS_LAGS), 0
    power = 0.0
    for s in fit.surprise:
        e = (s @ screen.white.T)[:, output]
        count += len(e)
        power += e @ e
        total += [e[k:] @ e[:-k] for k in range(1, WHITENESS_LAGS + 1)]
    r = total / power
    lags = np.arange(1, WHITENESS_LAGS + 1)
    statistic = count * (count + 2) * float(np.sum(r**2 / (count - lags)))
    return Test(fit.model.outputs[name].at, "surprises that follow from earlier ones", statistic, WHITENESS_LAGS,
                locates=False)
