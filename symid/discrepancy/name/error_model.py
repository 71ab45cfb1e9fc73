"""Which error model belongs to a recording: what was filtered, and how noise is correlated in time.

What is missing in a model colours its innovations, too. So noise that is not white, of the sensors or of random forces,
competes with what may be missing: it is believed at once where it explains more than any one suspect or flexible law
does, and more than one of them and the colour that it leaves. Else the search comes first, with white innovations.
Colour that outlasts the best explanation is then taken for noise, unless a flexible law explains more than both, and
the search begins anew with noise that is as correlated.

A filter's cutoff hangs on what is missing, too: the suspect that explains most may move it before noise is given a
memory, under which it keeps its value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import reduce
from math import inf

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis
from symid.discrepancy.name.colour import coloured, each_coloured, gain, in_words
from symid.discrepancy.name.equivalents import equivalents
from symid.discrepancy.name.held import unheld
from symid.discrepancy.name.search import Search
from symid.discrepancy.name.trial.explore import by_score
from symid.discrepancy.name.trial.jump import with_jumps_again, with_jumps_of
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.between_samples import holds_of
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.correlated import begun_correlated, is_correlated
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.measurement import has_settled
from symid.estimation.signals.data import Data
from symid.model.variants import CORRELATION_TIME
from symid.threads import in_threads

Settle = Callable[[Fit, Data], Iterator[tuple[Data, Fit]]]

FEW = 3
"""So many suspects tell which of two ways to undo a filter is right: these differ by far less than models do. So many
may be likeliest beside noise with a memory, which differs from suspect to suspect by far less than it explains."""
MOST_ROUNDS = 3
"""So often a search begins anew since inputs are likelier to do something else between their samples: each may end in
what the one before began from."""


def with_error_model(
    possible: list[tuple[Data, Fit]],
    searched: Callable[[Fit, Data], Search],
    settle: Settle,
    progress: Callable[[str], None],
) -> tuple[Search, Hypothesis, list[Hypothesis]]:
    """The search under the error model that belongs to the recording, what it found, and each suspect alone.

    Parameters
    ----------
    possible : what may have been measured, and the fit of the model as given to it.
    searched : makes a search. settle : undoes a filter anew with the cutoff that a fit likes, and refits its model;
        what else may have been measured comes after.
    """
    search = _likeliest(_of_settled([searched(base, data) for data, base in possible], searched, settle, progress))
    search = _with_colour(search, searched, progress)
    found, ranking = search.run()
    for _ in range(MOST_ROUNDS):
        if holds_of(found.fit, search.base) == holds_of(search.base, search.base):
            break
        progress("inputs are likelier to do something else between their samples; looking again")
        search.known = search.known or search.single  # other inputs between samples change little of what else is known
        search, found, ranking = _again(search, found, search.data, found.fit, searched)
    if not has_settled(found.fit, search.data):
        progress("with what was found the cutoff of the filter moves; looking again")
        try:
            anew = next(settle(found.fit, search.data))
            search, found, ranking = _again(search, found, *anew, searched, to_end=True)
        except SymidError:  # the cutoff stays where it was, and the search that ended there goes on
            found, ranking = search.run(to_end=True)
    data, explained = coloured(found.fit, search.data)
    more = gain(data, explained, search.data, found.fit)
    if explained is found.fit or found.evidence(1.0) + more < search.flexible().evidence(1.0):
        return search, found, ranking
    progress(f"{in_words(explained, data)}; looking again")
    try:
        return _again(search, found, data, unheld(explained, data, search.unstated), searched)
    except SymidError:  # what was found before is not lost
        return search, found, ranking


def _with_colour(search: Search, searched: Callable[[Fit, Data], Search], progress: Callable[[str], None]) -> Search:
    """A search under noise that is not white, where that explains more than any one suspect does; else the same.

    A long memory takes up what a law with one unknown explains, and fits under it need not find that law again. Where
    the likeliest suspect and what it leaves to noise explain more than noise does alone, the search goes on from both.
    """
    most = search.most_of_one()
    if most == inf:
        return search
    data, base = coloured(search.base, search.data)
    alone = gain(data, base, search.data, search.base)
    if alone <= most:
        return search
    beside = _beside_colour(search)
    best = max(beside, key=beside.__getitem__, default=None)
    if best is not None and beside[best] > alone:
        progress(f"beside {best.suspect.term} {in_words(best.fit, best.data)}; going on")
        with suppress(SymidError):  # under noise as it is without a suspect the search goes on all the same
            return _going_on(search, [best, *(h for h in beside if h is not best)], best.data, searched)
    progress(f"{in_words(base, data)}; looking again")
    return searched(unheld(base, data, search.unstated), data)


def _beside_colour(search: Search) -> dict[Hypothesis, float]:
    """The likeliest suspects alone with the noise that each leaves, and the value of both together."""
    few = search.single[:FEW]
    made = each_coloured([h.fit for h in few], search.data)
    return {
        replace(h, fit=fit, data=data): search.value(h, 1.0) + gain(data, fit, search.data, h.fit)
        for h, (data, fit) in zip(few, made, strict=True)
    }


def _going_on(search: Search, known: list[Hypothesis], data: Data, searched: Callable[[Fit, Data], Search]) -> Search:
    """A search under the error model of `data` that goes on from what is known, most believed first.

    Anew from nothing where the best is not worth its price there: the model as given may have found a likelier fit from
    the values of that.
    """
    first, *others = known
    again = searched(_refitted(search.base, first.fit, data), data)
    best = with_jumps_again(replace(first, base=again.base, data=data), again.jumps)
    if not again.worth(best, again.nothing):
        return again

    def refitted(h: Hypothesis) -> Hypothesis | None:
        return hypothesis(h.suspects, _begun_as(first.fit, h.fit), again.base, data, again.base.values)

    found = in_threads(refitted, others)
    known = [best, *by_score([h for h in found if h is not None])]
    lead = reduce(again.better, known)
    again.known = [lead, *(h for h in known if h is not lead)]
    again.tried, again.clocks = list(again.known), search.clocks
    return again


def _begun_as(other: Fit, fit: Fit) -> Fit:
    """The fit with the states with which `other` begins, where another cutoff cut free motion into other pieces."""
    if len(fit.initial) == len(other.initial):
        return fit
    begins = dict(zip(other.simulator.states, other.initial.T, strict=True))
    nothing = np.zeros(len(other.initial))
    return replace(fit, initial=np.column_stack([begins.get(s, nothing) for s in fit.simulator.states]))


def _again(
    search: Search,
    found: Hypothesis,
    data: Data,
    explained: Fit,
    searched: Callable[[Fit, Data], Search],
    to_end: bool = False,
) -> tuple[Search, Hypothesis, list[Hypothesis]]:
    """A search under the error model of `data`, and the best of what it finds and what explained as much before.

    Noise with a memory may take up so much of what is missing that a search which begins anew goes astray. One that
    went on from what was known goes on from what it found.
    """
    likes = equivalents(found, search.tried)
    if search.known and found.suspects:
        known = [replace(found, fit=explained), *(h for h in search.known if h.suspects != found.suspects)]
        again = _going_on(search, known, data, searched)
        return again, *again.run(to_end)
    led = _leading(search)
    search = searched(_refitted(search.base, explained, data), data)
    kept = Hypothesis(found.suspects, explained, search.base, data)
    search.met = search.together([(h.suspects, h.fit.values) for h in led], kept)
    again, ranking = search.run(to_end)
    known = [kept, *search.together([(h.suspects, h.fit.values) for h in likes], kept)]
    search.tried += known
    return search, reduce(search.better, known, again), ranking


def _leading(search: Search) -> list[Hypothesis]:
    """The suspects that explained most alone: a fit under another error model need not find the way to them again."""
    most = max((h.log_ratio for h in search.single), default=0.0)
    return [h for h in search.single if h.log_ratio > POLICY.beam_share * most][: POLICY.rivals]


def _of_settled(
    searches: list[Search], searched: Callable[[Fit, Data], Search], settle: Settle, progress: Callable[[str], None]
) -> list[Search]:
    """The searches with the cutoff that the suspect likes that explains most of the first data.

    A model that lacks a delay liked a cutoff of half, and then data that were measured otherwise. The suspect goes on
    from its fit there: from the model as given, whose random forces grew without bound, a delay of 0.1 s was not found
    again (draw 724 of "person").
    """
    first = searches[0]
    one = first.of_one
    if has_settled(one.fit, first.data):
        return searches
    progress("with one suspect the cutoff of the filter moves; looking again")

    def anew(data: Data, fit: Fit) -> Search:
        search = searched(_refitted(first.base, fit, data), data)
        search.met = [Hypothesis(one.suspects, fit, search.base, data)] if one.suspects else []
        return search

    try:
        return [anew(data, fit) for data, fit in settle(one.fit, first.data)]
    except SymidError:  # where the model with it cannot be begun anew the cutoff stays where it was
        return searches


def _likeliest(searches: list[Search]) -> Search:
    """The one whose data the model fits best, with whatever single suspect it lacks.

    Of all suspects those that explain most of the first data are tried on the others. The model as given may have made
    inputs look held that are not.
    """
    first, *others = searches
    if not others:
        return first
    best = [h.suspect for h in first.states_alone[:FEW]]
    found = [first.states_alone, *(s.alone(best) for s in others)]
    best_of = [
        max((h.fit for h in [s.nothing, *tried]), key=_loglik2) for s, tried in zip(searches, found, strict=True)
    ]
    most = [unheld(fit, s.data, s.unstated).loglik2 for s, fit in zip(searches, best_of, strict=True)]
    return searches[most.index(max(most))]


def _refitted(base: Fit, explained: Fit, data: Data) -> Fit:
    """The model as given under another error model, from its own values or from those that go with what was found; from
    nothing where both diverge.

    Its inputs do between their samples what they do there, its random forces are as correlated, and dry friction sets
    in as abruptly: what was found loses what it explains where it is refitted with another jump.
    """
    base = replace(base, model=base.model.with_holds(**holds_of(explained, base)))
    base = with_jumps_of(explained, base, list(base.model.constants))
    if is_correlated(explained) and not is_correlated(base):
        base = begun_correlated(base, data, explained.values[CORRELATION_TIME])
    kept = [explained.simulator.states.index(s) for s in base.simulator.states]
    begins = explained.initial[:, kept]
    near = replace(
        base,
        values={k: explained.values[k] for k in base.values},
        initial=begins,
        process=explained.process,
        kalman_gain=None,
    )
    if len(base.initial) != len(begins):  # another cutoff cuts free motion into other pieces
        base = replace(base, initial=begins)

    def begun_at(start: Fit) -> Fit | None:
        try:
            return Fitter(base.model, data).again(start)
        except SymidError:
            return None  # these values need not hold the model together without what was found, or under other noise

    fits = [fit for fit in in_threads(begun_at, [base, near]) if fit is not None]
    return max(fits, key=_loglik2) if fits else fit_model(base.model, data, base.values, exact=False)


def _loglik2(fit: Fit) -> float:
    return fit.loglik2
