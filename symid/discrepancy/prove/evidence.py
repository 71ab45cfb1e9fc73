"""What speaks for a finding and against it: its errors, chance, either half of the recording, held-out data."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.model.hypothesis import Hypothesis, is_met
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.search import Search
from symid.discrepancy.name.trial.jump import with_jumps_of
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.between import otherwise, widened
from symid.discrepancy.prove.certain import beyond_chance, far_beyond_chance, honest, weakest
from symid.discrepancy.prove.elsewhere import elsewhere
from symid.discrepancy.prove.halves import HalfVerdict, Survival, survivals, verdicts
from symid.discrepancy.prove.held_out import Proof, compare, compare_predictions
from symid.discrepancy.prove.nameless import Nameless, improved, nameless
from symid.discrepancy.prove.nulls import false_alarm_probability, largest, null_maxima
from symid.discrepancy.prove.opponents import free_runs, output_error_fit, with_values
from symid.discrepancy.prove.short_of_price import with_one_more
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.sensitive import lost
from symid.estimation.free_run import FreeRun
from symid.estimation.measurement import away_from_ends, of_window, restored
from symid.estimation.prediction import predictions
from symid.estimation.signals.data import Data
from symid.estimation.signals.known_past import with_known_past
from symid.estimation.signals.pieces import free_pieces
from symid.estimation.signals.windows import segments_of
from symid.threads import in_threads


@dataclass(frozen=True, eq=False)
class Tested:
    """What the tests in the fitted window left of a finding.

    Attributes
    ----------
    found : what the tests left of it.
    otherwise : about as likely, with inputs that do something else between their samples and other values.
    left : tests for something left over, the least probable first. white : whether what is left is random.
    chance : probability that chance makes as much, None where unknown.
    paid : the suspect that only the held-out data made believed; None without one.
    """

    found: Hypothesis
    otherwise: Hypothesis | None
    left: Sequence[Test]
    white: bool
    chance: float | None
    paid: Suspect | None

    @property
    def nameless(self) -> bool:
        """Whether something acts that the laws with names do not explain."""
        return bool(self.left and self.left[0].minus_log10_p > POLICY.remainder) or not self.found.established


@dataclass(frozen=True, eq=False)
class Evidence(Tested):
    """What became of a finding when it was put to every test.

    Attributes
    ----------
    survived : each lasting effect on two halves. halves : what either half alone says, if what is left is not random.
    unnamed : what acts and has no name. final : the improved model, with the names or with a flexible law.
    elsewhere : what only the held-out data show.
    runs : free simulations by ``baseline_train``, ``augmented_heldout`` and so on. proof : of the held-out data.
    """

    survived: tuple[Survival, ...]
    halves: tuple[HalfVerdict, ...]
    runs: dict[str, FreeRun]
    proof: Proof | None
    unnamed: Nameless
    final: Fit
    elsewhere: Test | None = None

    @property
    def by_chance(self) -> bool:
        """Whether chance may have made what was found, and the held-out data speak against it."""
        likely = self.chance is not None and self.chance > POLICY.refuted
        return likely and self.proof is not None and self.proof.margin <= 0 and not self.nameless


def tested(found: Hypothesis, search: Search) -> Tested:
    """Put a finding to the tests in the fitted window; effects that do not stand them are left out."""
    left = search.remainder(found)
    white = all(t.locates or t.minus_log10_p <= POLICY.remainder for t in left)
    before, found = found.suspects, honest(found, white)
    best = float(largest(search.projection, search.projection.rest[:, None])[0])
    found, chance = beyond_chance(found, null_maxima(search.projection, found.fit), best, white)
    if not found.suspects and white and search.quiet(found):
        found, chance = far_beyond_chance(search, best)
    if found.suspects != before:
        left = search.remainder(found)
    return Tested(*_widened(found, search), left, white, chance, paid=None)


def _widened(found: Hypothesis, search: Search) -> tuple[Hypothesis, Hypothesis | None]:
    """`found` with errors that reach to what is about as likely with other inputs between their samples, and that."""
    other = otherwise(found, search.unstated)
    return (found if other is None else widened(found, other)), other


def with_held_out(by: Tested, search: Search, task: Task) -> Tested:
    """What stood the tests, or that with one suspect more of which the held-out data pay the rest of the price."""
    held = None if by.nameless or not by.white else _held_out(task, search.data)
    more = by.found if held is None else with_one_more(by.found, search, held)
    if more is by.found:
        return by
    more = honest(more, by.white)  # the held-out data, not chance in the fitted window, decide whether it stays
    chance = false_alarm_probability(weakest(more), null_maxima(search.projection, more.fit))
    return Tested(*_widened(more, search), search.remainder(more), by.white, chance, paid=more.suspect)


def _held_out(task: Task, data: Data) -> Data | None:
    """The held-out data under the error model of `data`; None without such, or if a filter is undone in too few."""
    if task.held_out is None:
        return None
    try:
        return of_window(task.model, task.recording, task.held_out, task.segment_length, data)
    except DiagnosisError:
        return None


def evidence_of(by: Tested, search: Search, ranking: Sequence[Hypothesis], task: Task, plain: Data) -> Evidence:
    """What the halves of the recording and its held-out data say of what stood the tests.

    Parameters
    ----------
    ranking : each suspect alone, best first. plain : the recording as it is, of which errors are told.
    """
    data, found = search.data, by.found
    base = with_jumps_of(found.fit, search.base, search.jumps)
    windows = _windows(task, plain, data)
    unnamed = nameless(found, data, windows.get("heldout"), search.progress) if by.nameless else Nameless()
    final = improved(found, unnamed) if unnamed.fits and not near_noise(found, data) else found.fit
    runs = _runs(final, base, task, windows, refitted=final is found.fit)
    return Evidence(
        **vars(by),
        survived=survivals(found.suspects, found.fit, base, data, by.white),
        halves=() if by.white else verdicts(found.suspects, found.fit, base, data, rivals(found, ranking)),
        runs=runs,
        proof=_proof(final, base, task, data, runs, looks=1 + unnamed.refuted + (by.paid is not None)),
        unnamed=unnamed,
        final=final,
        elsewhere=None if by.nameless else _elsewhere(found, search, windows, task),
    )


def _elsewhere(found: Hypothesis, search: Search, windows: dict[str, Data], task: Task) -> Test | None:
    """What only the held-out data show, under the error model of the search and cut as its data, however given."""
    if "heldout" not in windows:
        return None
    held = windows["heldout"].remembering(search.data.memory)
    held = held if task.moved else held.with_segments(free_pieces(held.segments, len(task.model.states)))
    return elsewhere(found, search.jumps, held)


def _proof(final: Fit, base: Fit, task: Task, data: Data, runs: dict[str, FreeRun], looks: int = 1) -> Proof | None:
    """What the held-out data say of the improved model; None without such data, or where nothing was improved.

    looks : of so many models the held-out data chose the improved one (Bonferroni).
    """
    if task.held_out is None or final is base:
        return None
    proof = compare(runs["baseline_heldout"], runs["augmented_heldout"])
    held = None if base.kalman_gain is None else _held_out(task, data)
    if held is not None:
        with suppress(DiagnosisError):  # one of the two follows these data from no state
            proof = compare_predictions(predictions(base, held), predictions(final, held), proof)
    return replace(proof, probability=max(1 - looks * (1 - proof.probability), 0.0))


def near_noise(found: Hypothesis, data: Data) -> bool:
    """Whether laws with names leave little more of a free motion than sensors do: as much again, in power, at most.

    Splines that follow such a rest in the fitted window need not do so elsewhere. Where sensors leave no more
    of a motion than noise it says nothing: a harvester's voltage, filtered far below its resonance, hid 0 +- 20 times
    the excitation.
    """
    if data.driven or not (found.suspects and found.established):
        return False
    return is_met(found.fit, data, POLICY.sensors) and not lost(found.fit, data)


def rivals(found: Hypothesis, ranking: Sequence[Hypothesis]) -> list:
    """The best named suspects that were not chosen."""
    taken = {s.term for s in found.suspects}
    return [c.suspect for c in ranking if c.suspect.established and c.suspect.term not in taken][
        : POLICY.rivals_on_halves
    ]


def _windows(task: Task, plain: Data, data: Data) -> dict[str, Data]:
    """The windows in which errors are told: segments that were set apart are judged whole, fitted ones as fitted.

    A filter that was undone in `data` is undone there, too, at all samples: what it left of each swing is no error.
    """
    recording = task.recording if data.filter is None else restored(task.model, task.recording, data)
    windows = {"train": task.fit_window, "heldout": task.held_out}
    found = {
        key: with_known_past(
            segments_of(task.model, recording, w, None if isinstance(w, str) else task.segment_length), plain.pace
        )
        for key, w in windows.items()
        if w is not None
    }
    if data.filter is not None:
        found = {key: away_from_ends(pieces, recording, data.filter) for key, pieces in found.items()}
    return {key: plain.with_segments(pieces) for key, pieces in found.items()}


def _runs(final: Fit, base: Fit, task: Task, windows: dict[str, Data], refitted: bool) -> dict[str, FreeRun]:
    """Free runs of the strongest fits of the model as given and of the improved one.

    `refitted` says whether the latter may be fitted by free runs, too: one with many unknowns would follow the random
    forces of the fitted window.
    """
    given, better = [base], [final]
    if task.values:
        given.append(with_values(base, task.values))
    if final is not base and task.held_out is not None:
        fits = in_threads(lambda fit: output_error_fit(fit, windows["train"]), [base, *[final] * refitted])
        given += fits[0]
        better += fits[1] if refitted else []
    return free_runs(given, better, windows, task.settling)
