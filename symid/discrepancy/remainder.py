"""Is anything systematic left? Flexible laws at every place, and the whiteness of the surprises."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from symid.discrepancy.data import Data
from symid.discrepancy.fit import Fit
from symid.discrepancy.screen import Screen, extended, padded
from symid.errors import SymidError
from symid.mechanics.unknown_laws import unknown_force, unknown_sensor
from symid.model import Model, Term
from symid.simulation import Simulator, simulator

WHITENESS_LAGS = 25
"""So many lags of the surprises' correlation enter the test of whiteness."""


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
    for term, what in _flexible(fit, data):
        try:
            sim = simulator(fit.model.with_term(term))
        except SymidError:
            continue
        columns = _columns(screen, sim, term)
        if columns is not None:
            gain, _ = screen.score(columns)
            found.append(Test(term.location, what, gain, columns.shape[1]))
    found += [_whiteness(screen, fit, o, name) for o, name in enumerate(fit.model.outputs)]
    return sorted(found, key=lambda t: -round(t.surprise, 1))


def _flexible(fit: Fit, data: Data) -> list[tuple[Term, str]]:
    """Flexible terms at every port and sensor, scaled by the motion of the fit."""
    sim, model = simulator(fit.model), fit.model
    runs = [sim.simulate(fit.values, x0, e.time, e.inputs, gain=fit.gain, recorded=e.recorded)
            for e, x0 in zip(data.episodes, fit.initial, strict=True)]
    path, terms = np.vstack([t.x for t in runs]), []
    for role in ("joint", "link"):
        ports = [p for p in model.ports.values() if p.role == role]
        scales = {p.at: (_rms(model, p.position, path), _rms(model, p.rate, path)) for p in ports}
        law = unknown_force(role, scales, data.span)
        terms += [(law.at(p.at), "a force that depends on position, speed, the past or time") for p in ports]
    sensors = [y for y in model.outputs.values() if y.role == "sensor"]
    scale = {y.at: float(np.sqrt(np.mean(np.vstack([e.recorded for e in data.episodes])[:, i] ** 2)))
             for i, y in enumerate(model.outputs.values())}
    law = unknown_sensor(scale)
    return terms + [(law.at(y.at), "a distortion of what the sensor shows") for y in sensors]


def _rms(model: Model, expr, path: np.ndarray) -> float:
    """Root mean square of a linear expression of the states along a path."""
    total = np.zeros(len(path))
    for i, s in enumerate(model.states.values()):
        total += float(expr.coeff(s.symbol)) * path[:, i]
    return float(np.sqrt(np.mean(total**2))) or 1.0


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
