"""Try suspects on top of a fitted model: forecast all, refit the promising ones completely."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.begun_anew import Regression, begun_anew, nowhere
from symid.discrepancy.model.families import is_alike
from symid.discrepancy.model.hypothesis import Hypothesis, is_met
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.trial.candidate import KEPT, begin, continued, converged_from, refit_from
from symid.discrepancy.name.trial.short_pieces import ShortPieces
from symid.discrepancy.name.trial.starts import Start, starts_of
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data
from symid.threads import in_threads

BEYOND = 3.0
"""A slope at zero may see but a third of what a delay, a lag or an integral explains."""


def explore(
    fit: Fit,
    data: Data,
    suspects: Sequence[Suspect],
    *,
    later: bool = False,
    least: float = 0.0,
    projection: Projection | None = None,
    known: dict[Suspect, list[Start]] | None = None,
    jumps: Sequence[str] = (),
    regression: Regression = nowhere,
    progress: Callable[[str], None] = lambda text: None,
) -> list[Hypothesis]:
    """Each suspect alone on top of `fit`, best score first; `later` tries fewer, on top of what was found.

    least : log-likelihood ratio below which a suspect is of no use; those that promise too little of it are not fitted.
    known : starts of suspects that were explored on top of this fit before; those of others are added.
    jumps : friction speeds of the model that nobody stated. regression : where fits from nothing begin, too.
    """
    projection = projection or Projection(fit, data)
    refitted, converged = (
        (POLICY.refitted_later, POLICY.converged_later) if later else (POLICY.refitted, POLICY.converged)
    )
    known = {} if known is None else known
    new = [s for s in suspects if s not in known]
    known |= zip(new, in_threads(lambda s: starts_of(fit, data, projection, s), new), strict=True)
    starts = [known[s] for s in suspects if known[s]]
    reach = _reaches(starts)
    starts.sort(key=lambda s: -reach[s[0].suspect])
    promising = [s for s in starts if reach[s[0].suspect] > POLICY.worth_refitting]
    chosen = (promising if len(promising) > POLICY.always_refitted else starts[: POLICY.always_refitted])[:refitted]
    chosen = [s for s in chosen if least <= 0 or reach[s[0].suspect] > KEPT * least]
    progress(f"{len(chosen)} of {len(starts)} suspects are worth a full fit")

    def begun(several: Sequence[list[Start]]) -> list[Hypothesis]:
        return [c for c in in_threads(lambda s: begin(fit, data, s), several) if c is not None]

    first = begun(chosen[: POLICY.always_refitted])
    # Where the model is far off, fits explain far more than any forecast, which counts in parts of its error.
    best = min(max((c.log_ratio for c in first), default=0.0), max(reach.values(), default=0.0))
    worth = [s for s in chosen[POLICY.always_refitted :] if reach[s[0].suspect] > POLICY.beam_share * best]
    first += begun(worth)
    unseen = _unseen(starts, first)
    first += begun(unseen)
    afresh = in_threads(lambda s: refit_from(fit, data, s[-1]), _misled(chosen, first))
    first += [c for c in afresh if c is not None]
    tried = [*chosen[: POLICY.always_refitted], *worth, *unseen]
    short = ShortPieces(fit, data, jumps)
    first += _eased(tried, first, short)
    first = list({c.suspect: c for c in sorted(first, key=lambda c: c.log_ratio)}.values())
    first.sort(key=lambda c: -c.log_ratio)
    others = {
        s[0].suspect: [t for t in s[1:] if t.forecast > KEPT * s[0].forecast and not t.afresh][:2] for s in starts
    }

    def converging(begun: Sequence[Hypothesis]) -> list[Hypothesis]:
        return in_threads(lambda c: converged_from(fit, data, c, others[c.suspect], short), begun)

    good = [c for c in first[:converged] if c.log_ratio > POLICY.beam_share * first[0].log_ratio - POLICY.near]
    rest = first[len(good) :]
    found = converging(good)
    found += converging(begun(_unseen(starts, [*first, *found])))
    near = least_near(found)
    close = [c for c in rest if c.log_ratio > near and not c.fit.converged]
    found += converging(close) + [c for c in rest if c not in close]
    found = found if later else _from_nothing(found, fit, data, starts, regression)
    return by_score(exact_where_leading(found, least_near(found)))


def _from_nothing(
    found: list[Hypothesis], fit: Fit, data: Data, starts: Sequence[list[Start]], regression: Regression
) -> list[Hypothesis]:
    """The same, where none meets a free motion with those that explain most fitted as if nothing were known.

    A motor that drives a load by a shaft lacked dry friction at the load, took nearly all inertia for the motor's, and
    then the friction for it, too (tests/discrepancy/machines/test_from_nothing.py). Only laws with one unknown: they
    tell the place, from where others of their family begin, and find their size from anywhere.

    All of them where the model as given ends at a bound, from where each may be misled: one whose amplifier lags took
    five times its gain for that, and then two delays (tests/discrepancy/machines/test_at_a_bound.py). Once one meets
    the motion no more are fitted so: the others are tried with its values, in its place.
    """
    simple = sorted((h for h in found if _is_simple(h.suspect)), key=lambda h: -h.log_ratio)
    first = simple[: POLICY.converged]
    if fit.kalman_gain is not None or any(is_met(h.fit, data, POLICY.sensors) for h in first):
        return found
    if fit.at_bounds:
        known = {h.suspect for h in simple}
        others = [s for s in starts if _is_simple(s[0].suspect) and s[0].suspect.established]
        others = [s for s in others if s[0].suspect not in known][: POLICY.refitted]
        begun = in_threads(lambda s: begin(fit, data, s), others)
        first = [*simple, *(h for h in begun if h is not None)]
    anew: list[Hypothesis] = []
    while first[len(anew) :] and not any(is_met(h.fit, data, POLICY.sensors) for h in anew):
        some = first[len(anew) : len(anew) + POLICY.converged]
        anew += in_threads(lambda h: begun_anew(h, regression), some)
    return anew + first[len(anew) :] + [h for h in found if h not in first]


def _is_simple(suspect: Suspect) -> bool:
    return suspect.size == 1 and suspect.scanned is None


def least_near(found: Sequence[Hypothesis]) -> float:
    """The log-likelihood ratio from which on one may turn out to be better than the best of those found so far."""
    return max(max((h.log_ratio for h in found), default=0.0) * (1 - POLICY.near_share) - POLICY.near, 0.0)


def exact_where_leading(found: Sequence[Hypothesis], near: float) -> list[Hypothesis]:
    """The same, of which those that may turn out to be the best are fitted on with exact steps (see `Fitter.fit`).

    One that diverges with exact steps is none: a positioner whose sensor remembers its noise had one.

    near : the log-likelihood ratio from which on they may.
    """
    leading = [h for h in found if h.log_ratio > near]
    exact = in_threads(lambda h: continued(h.data, h, exact=True), leading)
    return [h for h in exact if h is not None] + [h for h in found if h not in leading]


def _reaches(starts: Sequence[list[Start]]) -> dict[Suspect, float]:
    """What each suspect may come to explain from the best of its starts.

    A law that cannot be simulated where it is switched off, as a lag, is while it is small what others of its family
    are: it may explain as much as they.
    """
    own = {s[0].suspect: max(t.forecast for t in s) * (BEYOND if s[0].suspect.bypasses else 1.0) for s in starts}
    return {
        s[0].suspect: max(
            [own[s[0].suspect], *(v for o, v in own.items() if _begins_finite(s) and is_alike(o, s[0].suspect))]
        )
        for s in starts
    }


def _begins_finite(starts: list[Start]) -> bool:
    q = starts[0].suspect.strength
    return q is not None and all(s.values[q.key] != q.null for s in starts)


def _unseen(starts: Sequence[list[Start]], first: Sequence[Hypothesis]) -> list[list[Start]]:
    """Those alike to one that explains much, which were not fitted since they promise little.

    A slope at zero sees too little of delays and lags. Of other laws it sees little where the model is far off: there
    the one that leads explains far more than it promised, and the simplest of its family may explain as much.
    """
    best = max((c.log_ratio for c in first), default=0.0)
    leading = [c for c in first if c.log_ratio > max(POLICY.beam_share * best, POLICY.worth_refitting)]
    beyond = [c.suspect for c in leading if c.forecast < KEPT * c.log_ratio]
    fitted = {c.suspect for c in first}
    return [
        s
        for s in starts
        if s[0].suspect not in fitted
        and any(is_alike(s[0].suspect, c) for c in ([c.suspect for c in leading] if s[0].suspect.bypasses else beyond))
    ]


def _misled(chosen: Sequence[list[Start]], first: Sequence[Hypothesis]) -> list[list[Start]]:
    """Those that promise more than all suspects explain, and whose own fits kept little of it.

    Values that a wrong model liked may lead away from what it lacks.
    """
    best = max((c.log_ratio for c in first), default=0.0)
    own = {c.suspect: c.log_ratio for c in first}
    return [
        s
        for s in chosen
        if s[-1].afresh
        and s[0].forecast > max(best, POLICY.worth_refitting)
        and own.get(s[0].suspect, 0.0) <= KEPT * s[0].forecast
    ]


def _eased(tried: Sequence[list[Start]], first: Sequence[Hypothesis], short: ShortPieces) -> list[Hypothesis]:
    """Those that went astray in a motion that cannot be followed for long, by way of short pieces.

    One that has not converged, but explains what it promised, is on its way.
    """
    kept = {c.suspect for c in first if c.fit.converged or c.log_ratio > KEPT * c.forecast}
    astray = [s[0] for s in tried if s[0].suspect.scanned is None and s[0].suspect not in kept]
    found = in_threads(lambda s: short.fitted(s.suspect, s.values, s.forecast), astray)
    return [c for c in found if c is not None]


def by_score(found: Sequence[Hypothesis]) -> list[Hypothesis]:
    """Best first, all judged by the samples that the one with the least error lets count."""
    share = max(found, key=lambda c: c.log_ratio).share if found else 1.0
    return sorted(found, key=lambda c: -c.evidence(share))
