"""Find the missing physics: fit, suspect, refit, look for more, judge, prove."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache

from symid.discrepancy.locate.audit import audit
from symid.discrepancy.locate.flexible import flexible_fits, flexible_terms
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.model.suspects import suspects as suspects_of
from symid.discrepancy.name.error_model import with_error_model
from symid.discrepancy.name.search import Search
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.certain import honest, weakest
from symid.discrepancy.prove.halves import survivals, verdicts
from symid.discrepancy.prove.held_out import compare
from symid.discrepancy.prove.nulls import false_alarm_probability, null_maxima
from symid.discrepancy.prove.opponents import collocated, free_runs, with_values
from symid.discrepancy.say.diagnosis import Diagnosis
from symid.discrepancy.say.judge import judge, rivals
from symid.discrepancy.say.words import Story, words
from symid.errors import DiagnosisError
from symid.estimation.data import Data, segments_of
from symid.estimation.fit import Fit
from symid.estimation.measurement import fits_of
from symid.identification import Solution
from symid.model import Model
from symid.recording import Recording
from symid.threads import one_blas_thread


@one_blas_thread
def diagnose(
    subject: Model | Solution,
    recording: Recording | None = None,
    *,
    fit_window: tuple[float, float] | str | None = None,
    held_out: tuple[float, float] | str | None = None,
    sensor_noise: float | Mapping[str, float] | None = None,
    segment_length: float | None = None,
    driven: bool = True,
    settling: float = 0.0,
    start: Mapping[str, float] | None = None,
    suspects: Sequence[Suspect] | None = None,
    threads: int = 2,
    progress: Callable[[str], None] = lambda text: None,
    episode_length: float | None = None,
) -> Diagnosis:
    """Compare a model with a recording and say what physics the model leaves out.

    Parameters
    ----------
    subject, recording : a model and what it is compared with; or a Solution of one recording, which
        brings its model, recording, window and values.
    fit_window, held_out : start and end [s], or the label of a split of the recording, whose
        segments have each an initial state of their own; the held-out one is used once, at the end.
    sensor_noise : standard deviation of the sensors, one or by channel; if left out what the recording
        states, or else what its highest frequencies show.
    segment_length : seconds of one piece with an initial state of its own; None for one piece.
        `episode_length` is its former name.
    driven : whether random forces act at the model's noises besides the recorded inputs.
    settling : seconds that the fit measure leaves out at the start of the fit window.
    start : values [SI] of some parameters from which the first fit begins.
    suspects : what may be missing; every law of the library at every place by default.

    Raises
    ------
    DiagnosisError : a window is empty, a channel is missing, or the model cannot be fitted at all.
    """
    if isinstance(subject, Solution):
        recording, fit_window, start = _of_solution(subject, recording, fit_window, start)
    model = subject.model if isinstance(subject, Solution) else subject
    if recording is None or fit_window is None:
        raise DiagnosisError("diagnose: a model alone is not enough; give the recording and fit_window=(t0, t1)")
    segment_length = episode_length if segment_length is None else segment_length
    segments = segments_of(model, recording, fit_window, segment_length)
    checked = audit(model, recording, segments, sensor_noise)
    plain = Data(segments, checked.noise, driven, checked.rounding).thinned()
    possible = fits_of(
        model, recording, fit_window, segment_length, plain, checked.filter, checked.inputs, dict(start or {})
    )
    progress(f"the model as given is fitted ({possible[0][1].iterations} iterations)")

    def searched(base: Fit, data: Data) -> Search:
        return Search(
            base,
            data,
            list(suspects_of(model) if suspects is None else suspects),
            cache(lambda: flexible_fits(base, data, flexible_terms(base, data))[0]),
            threads,
            progress,
        )

    search, found, ranking = with_error_model(possible, searched, progress)
    base, data, flexible = search.base, search.data, search.flexible
    if _doubtful(found, search) and search.beaten(found):
        found = flexible()
    left = search.remainder(found)
    progress("tested for a remainder")

    white = all(t.locates or t.minus_log10_p <= POLICY.remainder for t in left)
    before, found = found.suspects, honest(found, white, threads)
    left = left if found.suspects == before else search.remainder(found)
    chance = false_alarm_probability(
        weakest(found) if found.suspects else _largest(ranking), null_maxima(search.projection, found.fit)
    )
    if found.suspects and chance is not None and chance > POLICY.chance:
        found = Hypothesis((), base, base, data)
        left = search.remainder(found)
    survived = survivals(found.suspects, found.fit, base, data, white)
    halves = () if white else verdicts(found.suspects, found.fit, base, data, rivals(found, ranking))
    given = [
        base,
        *([with_values(base, subject.values)] if isinstance(subject, Solution) else []),
        *(collocated(base, recording, fit_window) if found.suspects and held_out is not None else []),
    ]
    better = [
        found.fit,
        *(collocated(found.fit, recording, fit_window) if found.suspects and held_out is not None else []),
    ]
    # Segments that were set apart are judged whole, and so are those that were fitted.
    windows = {
        key: plain.with_segments(segments_of(model, recording, w, None if isinstance(w, str) else segment_length))
        for key, w in (("train", fit_window), ("heldout", held_out))
        if w is not None
    }
    runs = free_runs(given, better, windows, settling)
    proof = (
        compare(runs["baseline_heldout"], runs["augmented_heldout"])
        if "heldout" in windows and found.suspects
        else None
    )

    verdict, effects, equivalent = judge(found, search.equivalents(found), left, flexible)
    text = words(
        Story(
            verdict,
            effects,
            equivalent,
            ranking,
            left,
            runs,
            checked,
            survived,
            halves,
            white,
            base.kalman_gain is not None,
            data.filter,
            model,
            proof,
            chance,
        )
    )
    return Diagnosis(
        verdict,
        effects,
        tuple(ranking),
        equivalent,
        base,
        found.fit,
        runs,
        tuple(left),
        text,
        checked,
        survived,
        halves,
        proof,
        chance,
    )


def _doubtful(found: Hypothesis, search: Search) -> bool:
    """Whether something of no list may be behind what was found."""
    return (
        len(found.suspects) > 1 or not found.established or search.remainder(found)[0].minus_log10_p > POLICY.remainder
    )


def _largest(ranking: Sequence[Hypothesis]) -> float:
    return max((h.log_ratio for h in ranking), default=0.0)


def _of_solution(
    solution: Solution,
    recording: Recording | None,
    fit_window: tuple[float, float] | str | None,
    start: Mapping[str, float] | None,
) -> tuple[Recording, tuple[float, float] | str, dict[str, float]]:
    """Recording, window and values that a solution brings where they are not given."""
    problem = solution.problem
    if len(problem.recordings) > 1:
        raise DiagnosisError(
            f"diagnose: the solution has {len(problem.recordings)} recordings; diagnose one of them: "
            "diagnose(solution.model, recording, fit_window=..., start=solution.values)"
        )
    recording = problem.recordings[0] if recording is None else recording
    return recording, fit_window or problem.windows[0] or recording.interval, solution.values | dict(start or {})
