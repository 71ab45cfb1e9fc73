"""Flexible laws at every place: what could be explained there at most, whatever it is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, extended
from symid.discrepancy.model.suspects import Suspect
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.signals.data import Data
from symid.mechanics.missing.unknown_laws import unknown_coupling, unknown_force, unknown_input, unknown_sensor
from symid.mechanics.places import ROLES
from symid.model import Law, Model, Port, Term
from symid.threads import in_threads

MOST_ITERATIONS = 20


def flexible_terms(fit: Fit, data: Data) -> list[Term]:
    """A flexible term at every port, sensor and input, scaled by the motion of the fit."""
    model, signals, terms = fit.model, fitted_signals(fit, data), []
    for role in ROLES:
        ports = [p for p in model.ports.values() if p.role == role]
        scales = {p.at: (_size(along(signals, p.position, model)), _size(along(signals, p.rate, model))) for p in ports}
        law = unknown_force(role, scales, data.span, data.pace)
        terms += [law.at(p.at) for p in ports if _first(model, p)]
        terms += [law.at(p.at) for p in ports for law in _coupling(model, signals, p) if _first(model, p)]
    recorded = np.vstack([e.recorded for e in data.segments])
    scale = {y.at: _size(recorded[:, i]) for i, y in enumerate(model.outputs.values())}
    law = unknown_sensor(scale, data.span, data.pace)
    terms += [law.at(y.at) for y in model.outputs.values() if y.role == "sensor"]
    scale = {
        u.at: _size(np.concatenate([e.inputs[k] for e in data.segments]))
        for k, u in model.inputs.items()
        if u.role == "excitation"
    }
    law = unknown_input(scale, data.span, data.pace)
    return terms + [law.at(place) for place in scale]


def _coupling(model: Model, signals: np.ndarray, port: Port) -> list[Law]:
    """The law of a force at a port that follows the states of other ports; none where there are no others."""
    if port.role == "link":
        return []
    own = port.position.free_symbols | port.rate.free_symbols
    moving = set().union(*(p.position.free_symbols | p.rate.free_symbols for p in model.ports.values()))
    others = {
        x.symbol: _size(signals[:, i])
        for i, x in enumerate(model.states.values())
        if x.symbol in moving and x.symbol not in own
    }
    return [unknown_coupling(port, _size(along(signals, port.rate, model)), others)] if others else []


def _first(model: Model, port: Port) -> bool:
    """Whether no earlier port acts alike, as the first joint does on the first link."""
    alike = [p.name for p in model.ports.values() if (p.into, p.rate) == (port.into, port.rate)]
    return alike[0] == port.name


def _size(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(x**2))) or 1.0


def flexible_fits(base: Fit, data: Data, terms: Sequence[Term]) -> list[Hypothesis]:
    """Each of these terms added to `base` and refitted, best score first."""

    def tried(term: Term) -> Hypothesis | None:
        suspect = Suspect(term, established=False)
        try:
            fitter = Fitter(base.model.with_term(term), data)
            off = suspect.named({q.key: 0.0 for q in term.law.parameters})
            fit = fitter.fit(
                base.values | off, extended(base.initial, fitter.sim), base.process, MOST_ITERATIONS, errors=False
            )
        except SymidError:
            return None
        return Hypothesis((suspect,), fit, base, data)

    return sorted((h for h in in_threads(tried, terms) if h is not None), key=lambda h: -h.score)
