"""Find the missing physics in four steps: locate, name, prove, say."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache

from symid.discrepancy.locate.audit import audit
from symid.discrepancy.locate.flexible import flexible_fits, flexible_terms
from symid.discrepancy.locate.given import fitted_as_given
from symid.discrepancy.model.dry import with_friction_speeds
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.sizes import sizes_of
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.model.suspects import suspects as suspects_of
from symid.discrepancy.name.error_model import with_error_model
from symid.discrepancy.name.jump import with_likeliest_jumps
from symid.discrepancy.name.search import Search
from symid.discrepancy.prove.evidence import tested
from symid.discrepancy.say.diagnosis import Diagnosis, finding
from symid.discrepancy.say.judge import judge
from symid.discrepancy.say.story import Story
from symid.discrepancy.say.words import words
from symid.discrepancy.task import Part, Task, listed_suspects, check_options, task_of
from symid.estimation.data import Data, segments_of
from symid.estimation.fit import Fit
from symid.estimation.measurement import fits_of, settled, sharpened_filter
from symid.estimation.pieces import free_pieces, joined
from symid.estimation.zero_phase import ZeroPhase
from symid.identification import Solution
from symid.model import Model
from symid.progress import kept_alive
from symid.recording import Recording
from symid.threads import hold_blas_memory, one_blas_thread


@one_blas_thread
@kept_alive("the model as given is fitted for a diagnosis")
def diagnose(
    subject: Model | Solution,
    recording: Recording | None = None,
    *,
    fit_window: Part | None = None,
    held_out: Part | None = None,
    sensor_noise: float | Mapping[str, float] | None = None,
    segment_length: float | None = None,
    driven: bool = True,
    settling: float = 0.0,
    filter: ZeroPhase | None = None,
    start: Mapping[str, float] | None = None,
    suspects: Sequence[Suspect] | None = None,
    threads: int = 2,
    progress: Callable[[str], None] = lambda text: None,
) -> Diagnosis:
    """Compare a model with a recording and say what physics the model leaves out.

    Parameters
    ----------
    threads : of the compiled simulations. progress : called with a line of text now and then.
    subject, recording : a model and what it is compared with; or a Solution of one recording, which
        brings its model, recording, window and values. Algebraic variables are solved for, process noise is the
        noise of `driven`; priors, constraints, boundary conditions and objectives take no part.
    fit_window, held_out : start and end [s], or the label of a split of the recording, whose
        segments have each an initial state of their own; the held-out one is used once, at the end.
    sensor_noise : standard deviation of the sensors, one or by channel; if left out what the recording
        states, or else what its highest frequencies show.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
    driven : whether random forces act at the model's noises besides the recorded inputs.
    settling : seconds that the fit measure leaves out at the start of the fit window.
    filter : what the recorded outputs were low-pass filtered with, forwards and backwards, where that is known;
        the spectra tell it where it is not.
    start : values [SI] of some parameters from which the first fit begins.
    suspects : what may be missing; every law of the library at every place by default.

    Raises
    ------
    DiagnosisError : a window is empty, a channel is missing, or the model cannot be fitted at all.

    Examples
    --------
    >>> case = si.read_case("data/concealed/cases/r01")
    >>> found = si.diagnose(case.model, case.recording, fit_window=(0, 24), held_out=(24, 36),
    ...                     segment_length=4.0, driven=False)                                    # doctest: +SKIP
    >>> found                                                                                    # doctest: +SKIP
    <Diagnosis: missing_physics: coulomb_friction at joint2>
    """
    check_options(sensor_noise, filter, threads)
    named = listed_suspects(suspects)
    hold_blas_memory(threads)
    task = task_of(
        subject,
        recording,
        fit_window,
        start,
        held_out=held_out,
        segment_length=segment_length,
        settling=settling,
        driven=driven,
    )
    pieces = segments_of(task.model, task.recording, task.fit_window, task.segment_length)
    whole = pieces if task.moved else joined(pieces)
    pieces = pieces if task.moved else free_pieces(pieces, len(task.model.states))

    def searched(base: Fit, data: Data) -> Search:
        nothing = Hypothesis((), base, base, data)
        flexible = cache(lambda: next(iter(flexible_fits(base, data, flexible_terms(base, data))), nothing))
        jumps = [c.name for c in base.model.find("friction_speed") if c.name not in given.constants]
        return Search(base, data, pool, flexible, jumps, threads, progress)

    # Locate: what the recording can be trusted for, and what the model as given leaves of it.
    checked = audit(task.model, task.recording, whole, sensor_noise, filter)
    given = task.model
    task = replace(task, model=with_friction_speeds(given, pieces, checked.noise))
    plain = Data(pieces, checked.noise, task.random, checked.rounding).thinned()

    def fits(task: Task, plain: Data, start: dict[str, float]) -> list[tuple[Data, Fit]]:
        window, c = (task.fit_window, task.segment_length), checked
        return fits_of(task.model, task.recording, *window, plain, c.filter, c.inputs, start, c.known, c.stated)

    def settle(fit: Fit, data: Data) -> tuple[Data, Fit]:
        window, sharper = (task.fit_window, task.segment_length), sharpened_filter(fit, data)
        return settled(fit.model, task.recording, *window, plain, sharper, fit.values, checked.stated)

    task, plain, possible = fitted_as_given(task, plain, fits)
    piece_seconds = task.segment_length if task.segment_length != segment_length else None
    possible = [(data, with_likeliest_jumps(given, fit, data)) for data, fit in possible]
    data, fit = possible[0]
    pool = list(suspects_of(task.model, sizes_of(fit, data))) if named is None else named
    progress(f"the model as given is fitted ({fit.iterations} iterations)")

    # Name: the laws that explain it.
    search, found, ranking = with_error_model(possible, searched, settle, progress)

    # Prove: what stands every test.
    evidence = tested(search.settled(found), search, ranking, task, plain)
    progress("tested for a remainder")

    # Say: the verdict, and what a reader should know.
    verdict, effects, equivalent = judge(evidence, search, checked)
    text = words(
        Story(verdict, effects, equivalent, ranking, evidence, checked, search.base, search.data, piece_seconds)
    )
    return finding(verdict, effects, equivalent, ranking, search.base, evidence, checked, text)
