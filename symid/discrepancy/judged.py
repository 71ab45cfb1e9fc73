"""Locate, name and prove under one reading of a recording: what explains it, and the verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from symid.discrepancy.explained import Explained, explained
from symid.discrepancy.model.hypothesis import Hypothesis, is_met
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.prove.evidence import Evidence, Tested, evidence_of, tested, with_held_out
from symid.discrepancy.say.diagnosis import Effect
from symid.discrepancy.say.judge import judge
from symid.discrepancy.task import Task
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.noise_sizes import input_noise
from symid.estimation.fitting.sensitive import MOST_GROWTH, largest_growth
from symid.estimation.measurement import of_window
from symid.estimation.sensors.zero_phase import ZeroPhase


@dataclass(frozen=True, eq=False)
class _Found:
    """What explains a recording, and what of it stands the tests in the fitted window."""

    by: Explained
    tested: Tested

    @property
    def loglik2(self) -> float:
        """Twice the log-likelihood, with a flexible law in the place of what has no name."""
        found = self.tested.found.fit.loglik2
        return max(found, self.by.search.flexible().fit.loglik2) if self.tested.nameless else found

    @property
    def asks_for_noise(self) -> bool:
        """Whether noise of inputs may be what has no name: where one law leaves nothing but white noise it is not."""
        search, found = self.by.search, self.tested.found
        if not self.tested.nameless or search.data.memory or len(found.suspects) != 1:
            return self.tested.nameless
        return found.suspects == search.flexible().suspects or not search.quiet(found)


@dataclass(frozen=True, eq=False)
class Judged:
    """What explains a recording, what stands every test, and what follows from both."""

    by: Explained
    evidence: Evidence
    verdict: str
    effects: tuple[Effect, ...]
    equivalent: tuple[Hypothesis, ...]


def judged(
    task: Task,
    sensor_noise: float | Mapping[str, float] | None,
    filter: ZeroPhase | None,
    named: Sequence[Suspect] | None,
    progress: Callable[[str], None],
) -> Judged:
    """The verdict on the model of `task`; or, where laws do not explain the recording, as if its inputs had noise.

    White noise of an input moves a mechanism as random forces do, and no law names it. It is believed where nothing is
    left beside it, and where it is likelier than what laws, or a flexible one, make of what it does; or where laws hold
    in pieces alone that each begin in a state of their own: of a ball on a beam, in pieces of 2 s, two lags of a second
    that left of the beam's angle next to nothing.

    Parameters
    ----------
    sensor_noise, filter : as for `diagnose`. named : what may be missing, None for every law of the library.
    """

    def found_in(task: Task) -> _Found:
        # Locate and name: what the model as given leaves of the recording, and the laws that explain it.
        by = explained(task, sensor_noise, filter, named, progress)
        stood = tested(by.search.settled(by.found), by.search)
        return _Found(by, with_held_out(stood, by.search, by.task))

    def proved(found: _Found) -> Judged:
        # Prove: what stands every test.
        by, search = found.by, found.by.search
        evidence = evidence_of(found.tested, search, by.ranking, by.task, by.plain)
        if evidence.by_chance and search.explained(search.nothing):
            return proved(_Found(by, tested(search.nothing, search)))
        progress("tested for a remainder")
        return Judged(by, evidence, *judge(evidence, search, by.audit))

    found = found_in(task)
    astray = _holds_in_pieces_alone(found, task)
    noisy = _with_input_noise(found, astray, task, found_in, progress) if astray or found.asks_for_noise else None
    if noisy is not None and ((answer := proved(noisy)).verdict != "unexplained" or astray):
        return answer
    return proved(found)


def _with_input_noise(
    found: _Found, astray: bool, task: Task, found_in: Callable[[Task], _Found], progress: Callable[[str], None]
) -> _Found | None:
    """What is found as if the inputs had noise; None where that is less likely, where something is left beside it, or
    where an input would have more noise than it ever moved.

    astray : whether what was found holds in pieces alone, so that the whole recording refutes it.
    """
    try:
        if task.with_input_noise is None:
            return None
        progress("whether the recorded inputs have noise")
        start = {} if astray else _begun(found.tested.found)
        noisy = found_in(replace(task.with_input_noise, start={**task.start, **start})) if start is not None else None
    except SymidError:
        return None  # what was found already is not lost by what was tried beside it
    if noisy is None or astray:
        return noisy
    likelier = not noisy.tested.nameless and noisy.loglik2 > found.loglik2
    return noisy if likelier and _may_be_noise(noisy) else None


def _may_be_noise(noisy: _Found) -> bool:
    """Whether each input that changes has less noise than that: what hides an input altogether is no noise of it."""
    data = noisy.by.search.data
    sizes = input_noise(noisy.tested.found.fit, data)
    inputs = {
        u.channel: np.std(np.concatenate([e.inputs[name] for e in data.segments]))
        for name, u in noisy.by.task.model.inputs.items()
    }
    return all(sizes[channel] <= changes or changes == 0 for channel, changes in inputs.items())


def _holds_in_pieces_alone(found: _Found, task: Task) -> bool:
    """Whether a motion was cut in pieces, and what was found in them does not hold as long as it was recorded.

    Where small differences become large nothing holds so long, and the whole refutes nothing: those of the model as
    given, or of the improved one, since a balanced machine may be taken for a steady one where a force is left out.
    """
    search, fit = found.by.search, found.tested.found.fit
    if not found.tested.found.suspects or found.by.task.segment_length == task.segment_length:
        return False
    begins = [e.time[0] for e in search.data.segments]
    try:
        whole = of_window(fit.model, task.recording, task.fit_window, task.segment_length, search.data)
        rows = [max(int(np.searchsorted(begins, e.time[0], side="right")) - 1, 0) for e in whole.segments]
        if any(largest_growth(replace(f, initial=f.initial[rows]), whole) > MOST_GROWTH for f in (search.base, fit)):
            return False
    except SymidError:
        return False
    try:
        return not is_met(Fitter.of(fit, whole).again(replace(fit, initial=fit.initial[rows])), whole)
    except SymidError:
        return True


def _begun(found: Hypothesis) -> dict[str, float] | None:
    """Its parameters [SI] where the inputs have noise; None where that is no likelier, so that they have none."""
    fit = found.fit
    noisy = fit_model(fit.model.with_input_noise(), replace(found.data, driven=True), fit.values, exact=False)
    return {k: noisy.values[k] for k in found.base.model.parameters} if noisy.loglik2 > fit.loglik2 else None
