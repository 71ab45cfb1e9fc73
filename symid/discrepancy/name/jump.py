"""How abruptly dry friction sets in, told by the recording before friction is looked for."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.dry import MEANING, weights_of, widths
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.mechanics.terms import LIBRARY
from symid.model import Constant
from symid.simulation import simulator

FINER = 1.7, 1.3, 1.15
"""Factors by which neighbours of the best width are tried, one after the other: it ends within a tenth."""


def with_likeliest_jumps(fit: Fit, data: Data) -> Fit:
    """The same fit of a model whose dry friction sets in as abruptly as its innovations like best.

    Only where random forces act: each sample then corrects the path along which friction is tried (Rao's score;
    1948). A wider jump than the sharpest must be worth an unknown.
    """
    made = [c for c in fit.model.find("friction_speed") if c.meaning == MEANING]
    if fit.kalman_gain is None or not made:
        return fit
    projection, model = Projection(fit, data), fit.model
    for width in made:
        suspect = Suspect(LIBRARY["coulomb_friction"].at(width.at))
        port = next(p for p in model.ports.values() if p.at == width.at and p.role == "joint")

        @cache
        def score(w: float, width: Constant = width, suspect: Suspect = suspect) -> float:
            tried = fit.model.with_constants(**{width.name: w}).with_term(suspect.term)
            columns = projection.response(suspect, simulator(tried), {"torque_Nm": 0.0})
            return 0.0 if columns is None else projection.score(columns)[0]

        sharp, *wider = widths(data.segments, weights_of(model, port), data.sensor_noise)
        best = max([sharp, *wider], key=score)
        for factor in FINER if best != sharp else ():
            best = max([best / factor, best, best * factor], key=score)
        if score(best) > score(sharp) + POLICY.accept:
            model = model.with_constants(**{width.name: best})
    return replace(fit, model=model)
