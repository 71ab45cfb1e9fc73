"""The first two steps of a diagnosis, locate and name, under what the audit of a recording says of its measurement."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from symid.discrepancy.locate.audit import Audit, audit, unfiltered
from symid.discrepancy.locate.flexible import flexible_fits, flexible_terms
from symid.discrepancy.locate.given import fitted_as_given, regressed
from symid.discrepancy.model.begun_anew import given_anew
from symid.discrepancy.model.dry import with_friction_speeds
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.levels import with_level_widths
from symid.discrepancy.model.sizes import sizes_of
from symid.discrepancy.model.suspects import Suspect, suspects as suspects_of
from symid.discrepancy.model.switching import with_switching_time
from symid.discrepancy.name.error_model import with_error_model
from symid.discrepancy.name.held import held_as_given
from symid.discrepancy.name.search import Search
from symid.discrepancy.name.trial.jump import with_likeliest_jumps
from symid.discrepancy.prove.certain import unsteady
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError
from symid.estimation.fitting.fit import Fit
from symid.estimation.free_run import free_run
from symid.estimation.measurement import fits_of, inputs_too, settled, sharpened_filter
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.data import Data
from symid.estimation.signals.known_past import with_known_past
from symid.estimation.signals.pieces import free_pieces, joined
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.swings import pace_of
from symid.estimation.signals.windows import segments_of
from symid.model import Model
from symid.recording.signals.between import is_stepped

CLEARER = 0.7
"""No filter was there where a free run of what explains the recording without one leaves less than this part of the
error: 0.001 of a positioning drive whose encoder resolves a millionth of its travel, 0.02 of a free double pendulum
whose swing feigned a mean of 37 samples (tests/discrepancy/recordings/test_fine_sensors.py; draw 109 of "spoilt")."""


@dataclass(frozen=True, eq=False)
class Explained:
    """What explains a recording: the search and what it found, and each suspect alone.

    Attributes
    ----------
    task, audit : under which it was explained. plain : the recording as it is, no filter undone.
    """

    task: Task
    audit: Audit
    plain: Data
    search: Search
    found: Hypothesis
    ranking: list[Hypothesis]

    @property
    def leaves_white_noise(self) -> bool:
        """Whether what was found leaves nothing but noise without a memory."""
        return self.search.data.memory == 0 and self.search.quiet(self.found)


def explained(
    task: Task,
    sensor_noise: float | Mapping[str, float] | None,
    filter: ZeroPhase | None,
    named: Sequence[Suspect] | None,
    progress: Callable[[str], None],
) -> Explained:
    """The laws that explain a recording, with a filter and without where a fine sensor may look like one.

    Parameters
    ----------
    sensor_noise, filter : as for `diagnose`. named : what may be missing, None for every law of the library.

    Raises
    ------
    DiagnosisError : the model cannot be fitted.
    """
    pieces = segments_of(task.model, task.recording, task.fit_window, task.segment_length)
    pieces = with_known_past(pieces, pace_of(pieces))
    whole = pieces if task.moved else joined(pieces)
    checked = audit(task.model, task.recording, whole, sensor_noise, filter)
    pieces = pieces if task.moved else tuple(free_pieces(pieces, len(task.model.states)))

    def under(possible: Audit) -> Explained:
        return _under(possible, task, pieces, named, progress)

    if task.random or not checked.doubtful:  # free runs of random forces tell little
        return under(checked)
    return _clearer(checked, unfiltered(checked, whole), under, progress)


def _clearer(
    filtered: Audit, plain: Audit, under: Callable[[Audit], Explained], progress: Callable[[str], None]
) -> Explained:
    """The laws without a filter if they leave nothing, follow much better, or are all that can be fitted; or with it.

    A filter colours noise: where white noise is all that is left without one, there was none.
    """
    try:
        without = under(plain)
    except DiagnosisError:
        return under(filtered)
    if without.leaves_white_noise:
        return without
    progress("what looks like a fine sensor, or a slow motion, may be filtered; looking again with a filter")
    try:
        with_filter = under(filtered)
    except DiagnosisError:
        return without
    whiter = without.search.data.memory == 0 and with_filter.search.data.memory > 0
    enough = (1.0 if whiter else CLEARER) * _error(with_filter, without.plain)
    return without if _error(without, without.plain) < enough else with_filter


def _error(of: Explained, plain: Data) -> float:
    """Of a free run, in parts of the motion; infinite where that diverges."""
    return float(np.nan_to_num(free_run(of.found.fit, plain).relative, nan=np.inf))


def _under(
    checked: Audit,
    given: Task,
    pieces: tuple[Segment, ...],
    named: Sequence[Suspect] | None,
    progress: Callable[[str], None],
) -> Explained:
    """The laws that explain a recording of which the audit is right."""
    sized = with_level_widths(with_friction_speeds(given.model, pieces, checked.noise), pieces)
    sized = with_switching_time(sized, pieces)
    unstated = [k for k, u in sized.inputs.items() if u.hold == "either"]
    stepped = [k for k in unstated if is_stepped(np.concatenate([e.inputs[k] for e in pieces]))]
    task = replace(given, model=sized.with_holds(**dict.fromkeys(stepped, "zero")))
    plain = Data(pieces, checked.noise, task.random, checked.rounding)
    plain = plain.thinned() if checked.filter is None else plain  # undoing one needs all samples that it made

    def fits(task: Task, plain: Data, start: dict[str, float]) -> list[tuple[Data, Fit]]:
        window, c = (task.fit_window, task.segment_length), checked
        return fits_of(task.model, task.recording, *window, plain, c.filter, c.inputs, start, c.known, c.stated)

    def settle(fit: Fit, data: Data) -> Iterator[tuple[Data, Fit]]:
        window, sharper = (task.fit_window, task.segment_length), sharpened_filter(fit, data)
        found = settled(fit.model, task.recording, *window, plain, sharper, fit.values, checked.stated)
        yield found
        if checked.inputs:
            yield inputs_too(task.recording, *window, plain, checked.filter, *found)

    task, plain, possible = fitted_as_given(task, plain, fits)
    possible = [
        (data, with_likeliest_jumps(given.model, held_as_given(fit, data, unstated), data)) for data, fit in possible
    ]
    data, fit = possible[0]
    pool = list(suspects_of(task.model, sizes_of(fit, data))) if named is None else list(named)
    progress(f"the model as given is fitted ({fit.iterations} iterations)")

    def regression(model: Model) -> dict[str, float]:
        return regressed(replace(task, model=model, start={}), plain)

    def searched(base: Fit, data: Data) -> Search:
        nothing = Hypothesis((), base, base, data)
        flexible = cache(lambda: next(iter(flexible_fits(base, data, flexible_terms(base, data))), nothing))
        widths = [*base.model.find("friction_speed"), *base.model.find("level_width")]
        jumps = [c.name for c in widths if c.name not in given.model.constants]
        return Search(
            base,
            data,
            pool,
            flexible,
            unsteady,
            jumps=jumps,
            unstated=unstated,
            regression=regression,
            progress=progress,
        )

    search, found, ranking = with_error_model(possible, searched, settle, progress)
    if (given_fit := given_anew(found)) is not None:
        progress("the model as given explains more from where that led; looking again")
        search, found, ranking = with_error_model([(found.data, given_fit)], searched, settle, progress)
    return Explained(task, checked, plain, search, found, ranking)
