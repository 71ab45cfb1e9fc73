"""Effects that the recording itself takes back: oscillations that one half contradicts, sizes that could be nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.search import Search
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.halves import survivals
from symid.discrepancy.prove.nulls import false_alarm_probability, null_maxima
from symid.estimation.fitting.bias import unbiased
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.robust_errors import with_robust_errors


def honest(found: Hypothesis, white: bool) -> Hypothesis:
    """The hypothesis with errors that do not believe in white innovations, without what these errors take back."""
    if white:
        names = (
            [s.term.parameter_name(q.key) for s in found.suspects for q in s.law.parameters]
            if found.established
            else []
        )
        return replace(found, fit=unbiased(found.fit, found.data, names))
    kept = steady(found) or found
    return sure(replace(kept, fit=with_robust_errors(kept.fit, kept.data)))


def unsteady(found: Hypothesis) -> list[Suspect]:
    """Oscillations that one half of the data contradicts: what is no sine keeps no frequency."""
    sines = [s for s in found.suspects if s.phase]
    survived = survivals(sines, found.fit, found.base, found.data, white=False, others=found.suspects)
    fickle = {(v.name, v.location) for v in survived if v.reason}
    return [s for s in sines if (s.term.name, s.term.location) in fickle]


def steady(found: Hypothesis) -> Hypothesis | None:
    """The hypothesis without oscillations that one half of the data contradicts; None where it contradicts none."""
    gone = unsteady(found)
    kept = [s for s in found.suspects if s not in gone]
    if not kept or not gone:
        return None
    less = hypothesis(kept, found.fit, found.base, found.data)
    return None if less is None else polished(less)


def sure(found: Hypothesis) -> Hypothesis:
    """The hypothesis without effects that could as well be nothing, the least certain dropped first; one stays.

    One whose size is uncertain since another unknown can make up for it, as the gain of a sensor for every force, is
    not nothing where its evidence is lost without it.
    """
    kept: list[Suspect] = []
    while len(found.suspects) > max(1, len(kept)):
        doubtful = min((s for s in found.suspects if s not in kept), key=lambda s: certainty(s, found.fit))
        if certainty(doubtful, found.fit) > POLICY.sure:
            break
        less = _without([s for s in found.suspects if s is not doubtful], found, white=False)
        if less is None:
            break
        if found.score - less.evidence(found.share) > POLICY.equivalent:
            kept.append(doubtful)
        else:
            found = less
    return found


def beyond_chance(found: Hypothesis, maxima: np.ndarray, best: float, white: bool) -> tuple[Hypothesis, float | None]:
    """The hypothesis without effects that chance alone makes, the weakest dropped first; and the probability of that.

    Parameters
    ----------
    maxima : of the log-likelihood ratios that chance makes. best : the largest that the recording gives to any one
        suspect, forecast as `maxima` are: where nothing is found the probability is that of it.
    """
    while found.suspects:
        # Honest errors count independent samples only, the maxima count all: the same units are compared.
        share = 1.0 if white else found.share
        chance = false_alarm_probability(weakest(found, share), maxima)
        if chance is None or chance <= POLICY.chance:
            return found, chance
        doubtful = min(found.suspects, key=lambda s: certainty(s, found.fit))
        less = _without([s for s in found.suspects if s is not doubtful], found, white)
        if less is None:
            return found, chance
        lost = false_alarm_probability(share * (found.log_ratio - less.log_ratio), maxima)
        if lost is not None and lost <= POLICY.chance:
            return found, lost
        found = less
    return found, false_alarm_probability(best, maxima)


def far_beyond_chance(search: Search, best: float) -> tuple[Hypothesis, float | None]:
    """Nothing, or the best suspect alone where chance hardly ever makes as much; and the probability of that.

    The price of a suspect counts a moment or a frequency by the samples (BIC), and again by how seldom clocks are: a
    push that chance makes once in a million recordings did not pay for itself. What chance makes is asked of what the
    suspect leaves, since an event is as large when its block has another sign.

    Parameters
    ----------
    best : the largest log-likelihood ratio that the recording gives to any one suspect, forecast.
    """
    nothing = search.nothing
    one = search.single[0] if search.single else nothing
    maxima = null_maxima(search.projection, one.fit)
    chance = false_alarm_probability(min(best, one.log_ratio), maxima)
    pays = one.established and one.score > max(one.belief() - POLICY.odds["clock"], 0.0) and not search.unsteady(one)
    if chance is None or chance > POLICY.certain or not pays:
        return nothing, false_alarm_probability(best, maxima)
    return polished(one), chance


def _without(kept: Sequence[Suspect], found: Hypothesis, white: bool) -> Hypothesis | None:
    """The hypothesis of these suspects alone, with honest errors; None where it cannot be fitted."""
    if not kept:
        return Hypothesis((), found.base, found.base, found.data)
    less = hypothesis(kept, found.fit, found.base, found.data)
    if less is None:
        return None
    less = polished(less)
    return less if white else replace(less, fit=with_robust_errors(less.fit, less.data))


def certainty(suspect: Suspect, fit: Fit) -> float:
    """Standard errors between the suspect and nothing; infinite where no value of it means nothing."""
    nulls = {suspect.term.parameter_name(q.key): q.null for q in suspect.law.parameters if q.null is not None}
    return max(
        (abs(fit.values[k] - null) / fit.errors[k] for k, null in nulls.items() if fit.errors.get(k)), default=np.inf
    )


def weakest(found: Hypothesis, share: float = 1.0) -> float:
    """Log-likelihood ratio of the least certain effect to nothing; of all where no value of an effect means nothing.

    share : of the samples for which the standard errors count.
    """
    return min((min(_ratio(s, found, share), found.log_ratio) for s in found.suspects), default=0.0)


def _ratio(suspect: Suspect, found: Hypothesis, share: float) -> float:
    """Log-likelihood ratio of one effect to nothing, by its standard errors.

    For a moment or a frequency it is what is lost without the effect: a short push with a high peak and a longer one
    with a lower peak are alike, so that its peak is uncertain where the push is certain.
    """
    if suspect.scanned is None:
        return certainty(suspect, found.fit) ** 2 / share
    rest = [s for s in found.suspects if s is not suspect]
    less = hypothesis(rest, found.fit, found.base, found.data) if rest else None
    return found.log_ratio - (less.log_ratio if less else 0.0)
