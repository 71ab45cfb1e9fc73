"""Find the missing physics in four steps: locate, name, prove, say."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from symid.discrepancy.judged import judged
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.say.diagnosis import Diagnosis, finding
from symid.discrepancy.say.story import Story
from symid.discrepancy.say.words import words
from symid.discrepancy.task import Part, check_options, listed_suspects, task_of
from symid.estimation.fitting.noise_sizes import input_noise
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.identification import Solution
from symid.model import Model
from symid.progress import kept_alive
from symid.recording import Recording
from symid.threads import hold_blas_memory, one_blas_thread, threads_of


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
    subject, recording : a model and what it is compared with; or a Solution of one recording, which
        brings its model, recording, window and values. Algebraic variables are solved for, process noise is the
        noise of `driven`; priors, constraints, boundary conditions and objectives take no part.
    fit_window, held_out : start and end [s], or the label of a split of the recording, whose
        segments have each an initial state of their own; the held-out one is used at the end, to prove what was found
        and to decide on one law more of which the fitted window leaves too little evidence.
    sensor_noise : standard deviation of the sensors, one or by channel; if left out what the recording
        states, or else what its highest frequencies show.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
    driven : whether random forces act at the model's noises besides the recorded inputs.
    settling : seconds that the fit measure leaves out at the start of the fit window.
    filter : what the recorded outputs were low-pass filtered with, forwards and backwards, where that is known;
        the spectra tell it where it is not.
    start : values [SI] of some parameters from which the first fit begins.
    suspects : what may be missing; every law of the library at every place by default.
    threads : in which fits that do not hang on each other are made; the result is the same for any number.
    progress : called with a line of text now and then.

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

    with threads_of(threads):
        # Locate, name and prove.
        found = judged(task, sensor_noise, filter, named, progress)

    # Say: what a reader should know.
    by, search, evidence = found.by, found.by.search, found.evidence
    pieces = by.task.segment_length if by.task.segment_length != segment_length else None
    noise = input_noise(evidence.found.fit, search.data) if by.task.noisy_inputs else {}
    verdict, effects, equivalent, ranking = found.verdict, found.effects, found.equivalent, by.ranking
    text = words(
        Story(verdict, effects, equivalent, ranking, evidence, by.audit, search.base, search.data, pieces, noise)
    )
    return finding(verdict, effects, equivalent, ranking, search.base, evidence, by.audit, text)
