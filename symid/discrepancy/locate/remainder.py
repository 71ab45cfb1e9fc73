"""Is anything systematic left? Flexible laws at every place, and the whiteness of the innovations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import gammaln, hyperu

from symid.discrepancy.locate.chance import Chance, excess
from symid.discrepancy.locate.fine import followed
from symid.discrepancy.locate.flexible import flexible_terms
from symid.discrepancy.locate.modulation import PARTS, modulated
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import extended, padded
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data
from symid.model import Term
from symid.simulation import Simulator, simulator

WHITENESS_LAGS = 25
"""So many lags of the innovations' correlation enter the test of whiteness."""

_WHAT = {
    "unknown_force": "a force that depends on position, speed, the past or time",
    "unknown_coupling": "a force that depends on other states",
    "unknown_sensor_error": "a distortion of what the sensor shows",
    "unknown_input_error": "an excitation other than the recorded one",
}
_FLOW = "a flow that depends on the state, the past or time"


@dataclass(frozen=True)
class Test:
    """One test for something left over.

    Attributes
    ----------
    place : where it would act. what : in words. log_ratio : growth of twice the log-likelihood, or the
    statistic. size : its degrees of freedom. tried : the largest of so many.
    minus_log10_p : -log10 of the probability by chance.
    """

    place: str
    what: str
    log_ratio: float
    size: int
    locates: bool = True
    tried: int = 1

    @property
    def minus_log10_p(self) -> float:
        # Upper tail of chi-square by Tricomi's function (Abramowitz & Stegun 1972, 13.6.28), which never underflows.
        a, x = self.size / 2, max(self.log_ratio, 0.0) / 2
        log_p = -x + np.log(hyperu(1 - a, 1 - a, x)) - gammaln(a) if x > 0 else 0.0
        return max(0.0, float(-log_p / np.log(10) - np.log10(self.tried)))


def remainder(fit: Fit, data: Data) -> list[Test]:
    """All tests, the least probable first."""
    projection, found = Projection(fit, data), []
    chance = Chance(projection)
    for term in flexible_terms(fit, data):
        try:
            sim = simulator(fit.model.with_term(term))
        except SymidError:
            continue
        columns = _columns(projection, sim, term)
        if columns is not None:
            gain, size = chance.scored(columns)
            what = _FLOW if term.law.acts_on == "balance" else _WHAT[term.name]
            found.append(Test(term.location, what, gain, size))
    found += [
        Test(place, "a stiffness or damping that comes and goes", gain, PARTS, tried=tried)
        for place, gain, tried in modulated(projection)
    ]
    outputs = list(fit.model.outputs.values())
    found += [
        Test(outputs[o].at, "a force that changes within a small part of the motion", gain, size, False, tried)
        for o, gain, size, tried in followed(projection, chance)
    ]
    for o, y in enumerate(outputs):
        statistic = _ljung_box(projection, projection.rest, o)
        statistic /= excess(np.array([_ljung_box(projection, r, o) for r in chance.rounded.T]), WHITENESS_LAGS)
        found.append(
            Test(y.at, "errors of prediction that follow from earlier ones", statistic, WHITENESS_LAGS, locates=False)
        )
    return sorted(found, key=lambda t: -round(t.minus_log10_p, 1))


def located(left: Sequence[Test]) -> Test:
    """The test that tells where a remainder acts: whiteness is a good alarm and a poor locator."""
    places = [t for t in left if t.locates and t.minus_log10_p > POLICY.located]
    return places[0] if places else left[0]


def _columns(projection: Projection, sim: Simulator, term: Term) -> np.ndarray | None:
    names = [term.parameter_name(q.key) for q in term.law.parameters]
    values, out = projection.fit.values | dict.fromkeys(names, 0.0), []
    for e, x0 in zip(projection.data.segments, extended(projection.fit.initial, sim), strict=True):
        t = e.simulate(
            sim,
            values,
            x0,
            padded(projection.fit.kalman_gain, sim),
            sensitivity=names,
            keep="outputs",
            **projection.steps,
        )
        if t.diverged:
            return None
        out.append(t.dy)
    return projection.whiten(out)


def _ljung_box(projection: Projection, rest: np.ndarray, output: int) -> float:
    """Ljung-Box (1978) statistic of one output over all segments, of (N m,) white errors that are left of a fit.

    What the unknowns explain of white errors correlates the rest: each segment's initial states alone make those of a
    short one follow from earlier ones. That is known beforehand and taken out. Errors that are larger at times make
    correlations larger (Francq, Roy & Zakoian 2004), each as much as their squares follow one another.
    """
    total, by_fit, pairs, squares = np.zeros((4, WHITENESS_LAGS))
    count, power, explained = 0, 0.0, 0.0
    ends = np.cumsum([e.recorded.size for e in projection.data.segments])[:-1]
    for left, own in zip(np.split(rest, ends), np.split(projection.own, ends), strict=True):
        left, own = left[output :: projection.outputs], own[output :: projection.outputs]
        count, power, explained = count + len(left), power + left @ left, explained + np.sum(own**2)
        for k in range(1, min(WHITENESS_LAGS, len(left) - 1) + 1):
            total[k - 1] += left[k:] @ left[:-k]
            by_fit[k - 1] -= np.sum(own[k:] * own[:-k])
            pairs[k - 1] += len(left) - k
            squares[k - 1] += left[k:] ** 2 @ left[:-k] ** 2
    if power == 0 or explained >= count:
        return 0.0
    r = total / power - by_fit / (count - explained)
    spread = np.maximum(squares / (power / count) ** 2, pairs)  # where there is no pair r is 0
    return count * (count + 2) * float(np.sum(r**2 / np.maximum(spread, 1)))
