"""From what was found and what is left to a verdict, its effects and their likes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.remainder import Test, located
from symid.discrepancy.model.families import LOSSES
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.equivalents import equivalents
from symid.discrepancy.name.search import Search
from symid.discrepancy.name.trial.scan import moment_profile
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.certain import certainty
from symid.discrepancy.prove.evidence import Evidence, near_noise
from symid.discrepancy.say.diagnosis import Effect
from symid.discrepancy.say.names import sentence, values_of
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.sensitive import MOST_GROWTH, largest_growth
from symid.estimation.signals.data import Data


def judge(evidence: Evidence, search: Search, audit: Audit):
    """Verdict, effects and equivalent hypotheses."""
    found, left, flexible = evidence.found, evidence.left, search.flexible
    likes = equivalents(found, search.tried)
    effects = tuple(_effect(s, found) for s in found.suspects)
    rest = located(left) if left and left[0].minus_log10_p > POLICY.remainder else None
    rest = None if _may_be_the_sensors(evidence, audit, search) else rest
    equivalent = tuple(likes)
    if rest is None and found.established and evidence.elsewhere is not None:
        return "unexplained", (_unnamed(evidence.elsewhere), *effects), equivalent
    if not found.suspects and rest is None:
        return "adequate", (), ()
    if rest is not None and not found.suspects:
        return "unexplained", (_unnamed(rest),), ()
    told = tuple(_as_survived(e, evidence, s) for e, s in zip(effects, found.suspects, strict=True))
    if not found.established:
        unestablished = next(s for s in found.suspects if not found.is_named(s))
        key = (unestablished.term.name, unestablished.term.location)
        effects = tuple(sorted(told, key=lambda e: (e.name, e.location) != key))
        place = unestablished.term.location if rest is None else _voted(flexible(), effects[0], rest)
        unknown = () if place == unestablished.term.location else (_unknown(place, left, rest, found),)
        return "unexplained", (*unknown, *effects), equivalent
    if rest is not None:
        unknown = _unknown(_voted(flexible(), effects[0], rest), left, rest, found)
        return "unexplained", (unknown, *told), equivalent
    if _runs_away(evidence, search):
        return "unexplained", tuple(replace(e, established=False) for e in effects), equivalent
    return "missing_physics", effects, equivalent


def _runs_away(evidence: Evidence, search: Search) -> bool:
    """Whether the improved model diverges on held-out data that the model as given follows to their end.

    What was found then is no name for what acts. Of a balanced machine, whose small differences grow by themselves, it
    says nothing: the right model of it falls, and one that is taken for steady does not.
    """
    before, after = (evidence.runs.get(f"{model}_heldout") for model in ("baseline", "augmented"))
    if before is None or after is None or not np.isfinite(before.relative) or np.isfinite(after.relative):
        return False
    return largest_growth(evidence.final, search.data) <= MOST_GROWTH


def _unnamed(test: Test) -> Effect:
    return Effect("unknown", test.place, {}, None, test.log_ratio, test.what, established=False)


def _as_survived(effect: Effect, evidence: Evidence, suspect: Suspect) -> Effect:
    """The effect, not established where it may only imitate the rest.

    That is where the halves of the recording contradict it or its held-out part does not confirm what was found, where
    its size could be nothing or surprises as much as a law without a name does, or where as many laws as a search takes
    leave something: what has no law looks like them. Losses are not in doubt for that, since something takes the
    energy.
    """
    found = evidence.found
    fallen = {(v.name, v.location) for v in evidence.survived if v.reason}
    one_of_few = len(found.suspects) < POLICY.most_effects or effect.name in LOSSES
    sure = suspect.scanned is not None or certainty(suspect, found.fit) > POLICY.sure  # a push has one of many sizes
    sized = sure and found.surprise(suspect) <= POLICY.doubt
    proved = evidence.proof is None or evidence.proof.confirmed
    kept = (effect.name, effect.location) not in fallen and sized and one_of_few and proved
    return replace(effect, established=effect.established and kept)


def _may_be_the_sensors(evidence: Evidence, audit: Audit, search: Search) -> bool:
    """Whether a rest beside a finding that helps is less than the noise of sensors that nobody stated.

    What the halves of the recording contradict imitates something, and the rest is what it leaves of that.
    """
    stands = not any(v.reason for v in evidence.survived)
    return _helps(evidence) and stands and not audit.stated.all() and near_noise(evidence.found, search.data)


def _helps(evidence: Evidence) -> bool:
    """Whether held-out errors fall by what was found; so it is taken where no data were held out."""
    return evidence.proof is None or evidence.proof.margin > 0


def _voted(flexible: Hypothesis, effect: Effect, rest: Test | None) -> str:
    """Where most of what tells it say that the unknown acts; where they all differ, what a flexible law says."""
    votes = [*(s.term.location for s in flexible.suspects[:1]), effect.location, *([rest.place] if rest else [])]
    return max(votes, key=votes.count)


def _unknown(place: str, left: Sequence[Test], rest: Test | None, found: Hypothesis) -> Effect:
    seen = next((t for t in left if t.locates and t.place == place), rest)
    what = seen.what if rest else "something that only several of the known effects together imitate"
    return Effect("unknown", place, {}, None, rest.log_ratio if rest else found.score, what, established=False)


def _moment(fit: Fit, data: Data, name: str, error: float) -> tuple[float, float]:
    """Mean and deviation of a moment under its likelihood, which has many peaks."""
    at = fit.values[name]
    moments, values = moment_profile(fit, data, name, (at - 4.0 * data.pace, at + 4.0 * data.pace), 0.1 * data.pace)
    weight = np.exp(0.5 * (values - values.max()))
    mean = float(np.sum(weight * moments) / weight.sum())
    return mean, float(np.hypot(error, np.sqrt(np.sum(weight * (moments - mean) ** 2) / weight.sum())))


def _effect(suspect: Suspect, found: Hypothesis) -> Effect:
    fit, term = found.fit, suspect.term
    parameters = values_of(suspect, fit)
    window, start, moment = None, suspect.clock("start"), suspect.clock("moment")
    if start in parameters:
        begin = parameters[start][0]
        window = (begin, begin + parameters.get(suspect.clock("duration"), (0.5, 0.0))[0])
    elif moment in parameters:
        at, error = _moment(fit, found.data, term.parameter_name(moment), parameters[moment][1])
        parameters[moment] = (at, error)
        wide = min(2 * error, 3.0 * found.data.pace)
        window = (at - wide, at + wide)
    return Effect(
        term.name,
        term.location,
        parameters,
        window,
        found.log_ratio,
        sentence(suspect, parameters, fit.model),
        found.is_named(suspect),
    )
