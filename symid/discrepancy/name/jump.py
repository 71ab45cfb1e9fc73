"""How abruptly dry friction sets in, told by the recording before friction is looked for."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.dry import weights_of, widths
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.mechanics.terms import LIBRARY
from symid.model import Constant, Model
from symid.simulation import simulator

FINER = 1.7, 1.3, 1.15
"""Factors by which neighbours of the best width are tried, one after the other: it ends within a tenth."""


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

    sharp, *wider = widths(data.segments, weights_of(model, port), data.sensor_noise)
    best = max([sharp, *wider], key=score)
    for factor in FINER if best != sharp else ():
        best = max([best / factor, best, best * factor], key=score)
    return best if score(best) > score(sharp) + POLICY.accept else sharp
