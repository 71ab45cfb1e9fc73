"""How abruptly dry friction sets in, told by the recording: before friction is looked for, or once it is found."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from math import log

import numpy as np
from scipy.optimize import minimize_scalar

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.dry import PARTS, WIDER, widths
from symid.discrepancy.model.hypothesis import Hypothesis, polished, refit
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data
from symid.mechanics.missing.terms import LIBRARY
from symid.model import Constant, Model
from symid.simulation import simulator

FINER = 1.7, 1.3, 1.15
"""Factors by which neighbours of the best width are tried, one after the other: it ends within a tenth."""
COARSE, SHARP = 10.0, 0.003
"""Factor between the widths that are fitted first once friction is found, and the part of itself to which the best is
found then: where a sensor is very good a few percent leave an error that can be seen."""
NEARBY = 1.5
"""Factor at which a likelihood that rises from the width that was made shows it, to a wider one or a sharper."""
ITERATIONS = 10
"""Of a fit with another width."""


def with_likeliest_jumps(given: Model, fit: Fit, data: Data) -> Fit:
    """The same fit of a model whose dry friction sets in as abruptly as its innovations like best.

    Only where random forces act: each sample then corrects the path along which friction is tried (Rao's score;
    1948). A wider jump than the sharpest must be worth an unknown.

    Parameters
    ----------
    given : the model as its user stated it; the friction speeds that it states keep their values.
    """
    made = [c for c in fit.model.find("friction_speed") if c.name not in given.constants]
    if fit.kalman_gain is None or not made:
        return fit
    projection = Projection(fit, data)
    return replace(fit, model=fit.model.with_constants(**{c.name: _likeliest(c, projection) for c in made}))


def _likeliest(width: Constant, projection: Projection) -> float:
    """The value of one friction speed, [m/s] or [rad/s], by the score of dry friction at its joint."""
    model, data = projection.fit.model, projection.data
    suspect = Suspect(LIBRARY["coulomb_friction"].at(width.at))
    port = next(p for p in model.ports.values() if p.at == width.at and p.role == "joint")

    @cache
    def score(speed: float) -> float:
        tried = model.with_constants(**{width.name: speed}).with_term(suspect.term)
        columns = projection.response(suspect, simulator(tried), {"torque_Nm": 0.0})
        return 0.0 if columns is None else projection.score(columns)[0]

    sharp, *wider = widths(model, port, data.segments, data.sensor_noise)
    best = max([sharp, *wider], key=score)
    for factor in FINER if best != sharp else ():
        best = max([best / factor, best, best * factor], key=score)
    return best if score(best) > score(sharp) + POLICY.accept else sharp


def with_fitted_jumps(found: Hypothesis, made: Sequence[str], known: Model) -> Hypothesis:
    """The same suspects with dry friction that sets in as abruptly as the recording likes best, of a free motion.

    Another jump than the one that was made must be worth an unknown.

    Parameters
    ----------
    made : the friction speeds that nobody stated. known : those count on which this model does not yet depend.
    """
    if found.fit.kalman_gain is not None:
        return found
    model = found.fit.model
    for name in (n for n in made if model[n].symbol in _symbols(model) - _symbols(known)):
        found = _with_fitted_jump(found, name)
    return found


def with_jumps_of(fit: Fit, base: Fit, made: Sequence[str]) -> Fit:
    """`base` with dry friction that sets in as in the model of `fit`: itself, where it does."""
    other = {n: fit.model.constants[n].value for n in made}
    if all(base.model.constants[n].value == v for n, v in other.items()):
        return base
    return replace(base, model=base.model.with_constants(**other))


def _with_fitted_jump(found: Hypothesis, name: str) -> Hypothesis:
    model, data, tried = found.base.model, found.data, [found]
    sharp = model.constants[name].value
    port = next(p for p in model.ports.values() if p.at == model[name].at and p.role == "joint")
    *_, widest = widths(model, port, data.segments, data.sensor_noise)

    @cache
    def fitted(width: float) -> Hypothesis | None:
        # What the sharpest jump was fitted to may be wrong values of all else, which a wider one leads away from.
        near = replace(max(tried, key=lambda h: h.log_ratio).fit, substeps=1)
        base = replace(found.base, model=model.with_constants(**{name: width}))
        fit = refit(found.suspects, near, base, data, iterations=ITERATIONS)
        if fit is None:
            return None
        tried.append(Hypothesis(found.suspects, fit, base, data))
        return tried[-1]

    def score(width: float) -> float:
        other = fitted(width)
        return -np.inf if other is None else other.log_ratio

    best, width = sharp, widest
    while width > sharp:  # from wide to sharp: sharp corners ask for short steps of the integrator
        value, before = score(width), found.log_ratio if best == sharp else score(best)
        if best != sharp and value < before:
            break
        best, width = (width if value > before else best), width / COARSE
    least = sharp
    if best == sharp and score(NEARBY * sharp) > found.log_ratio:  # it may lie before the last that was wider
        best = NEARBY * sharp
    elif best == sharp and score(sharp / NEARBY) > found.log_ratio:  # or sensors, many samples together, see more
        best, least = sharp / NEARBY, PARTS[0] * widest / WIDER[-1]  # that part of the usual speed
    if best == sharp:
        return found
    ends = log(max(best / COARSE, least)), log(min(best * COARSE, widest))
    options = {"xatol": SHARP}
    found_at = minimize_scalar(lambda w: -score(float(np.exp(w))), bounds=ends, method="bounded", options=options).x
    best = max((float(np.exp(w)) for w in (found_at, _vertex(score, float(found_at)))), key=score)
    price = POLICY.accept + log(max(found.share * data.samples, 2.0))
    wider = fitted(best)
    return polished(wider) if wider is not None and found.share * (score(best) - found.log_ratio) > price else found


def _vertex(score: Callable[[float], float], at: float) -> float:
    """Logarithm of the width at which the parabola through `score` at and beside a logarithm is highest.

    Of a likelihood it is exact to far less than the distance of its three points.
    """
    below, here, above = (score(float(np.exp(at + d))) for d in (-SHARP, 0.0, SHARP))
    bend = below - 2 * here + above
    return at - SHARP * (above - below) / (2 * bend) if bend < 0 and abs(above - below) < -4 * bend else at


def _symbols(model: Model) -> set:
    return set().union(*(e.free_symbols for e in model.residual()))
