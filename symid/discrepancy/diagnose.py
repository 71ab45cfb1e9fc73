"""Find the missing physics: fit, suspect, refit, look for more, judge, prove."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from symid.discrepancy.locate.audit import audit
from symid.discrepancy.locate.flexible import flexible_fits, flexible_terms
from symid.discrepancy.locate.remainder import REMAINDER, remainder
from symid.discrepancy.model.hypothesis import MOST_EFFECTS, Candidate, Hypothesis, fit_with, polished
from symid.discrepancy.model.suspects import Suspect, established_suspects
from symid.discrepancy.name.mechanism import explain_mechanism
from symid.discrepancy.name.search import LIGHT, explore
from symid.discrepancy.prove.certain import steady, sure
from symid.discrepancy.prove.halves import survivals, verdicts
from symid.discrepancy.say.diagnosis import Diagnosis
from symid.discrepancy.say.judge import judge, rivals
from symid.discrepancy.say.words import Story, words
from symid.errors import DiagnosisError
from symid.estimation.bias import unbiased
from symid.estimation.cold_start import fit_model
from symid.estimation.data import Data, segments_of
from symid.estimation.fit import Fit
from symid.estimation.free_run import free_run
from symid.estimation.robust_errors import with_robust_errors
from symid.identification import Solution
from symid.model import Model
from symid.recording import Recording
from symid.threads import one_blas_thread

ACCEPT = 10.0
"""A suspect is accepted when its score, the log-likelihood ratio beyond BIC, exceeds this."""
DOUBT = 10.0
"""A hypothesis must beat what established suspects reach by this much to make the finding unexplained."""
BEYOND = 25.0
"""A hypothesis on top of an established suspect, or a third effect, is accepted only from this score on."""
QUIET = 1.5
"""Below this nothing is left that another pair of suspects could explain better."""
FAR = 5.0
"""Errors so many times the sensors' noise are not explained by whatever acts at one place alone."""
RIVALS = 5
BEAM = 3
RIVAL_SHARE = 0.3


@one_blas_thread
def diagnose(subject: Model | Solution, recording: Recording | None = None, *,
             fit_window: tuple[float, float] | str | None = None, held_out: tuple[float, float] | str | None = None,
             sensor_noise: float | Mapping[str, float] | None = None,
             segment_length: float | None = None, driven: bool = True, settling: float = 0.0,
             start: Mapping[str, float] | None = None, suspects: Sequence[Suspect] | None = None, mechanism: bool = False,
             threads: int = 2, progress: Callable[[str], None] = lambda text: None) -> Diagnosis:
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
    driven : whether random forces act at the model's noises besides the recorded inputs.
    settling : seconds that the fit measure leaves out at the start of the fit window.
    start : values [SI] of some parameters from which the first fit begins.
    suspects : what may be missing; every law of the library at every place by default.
    mechanism : whether several laws are to be expected at once, as in any real mechanism.

    Raises
    ------
    DiagnosisError : a window is empty, a channel is missing, or the model cannot be fitted at all.
    """
    if isinstance(subject, Solution):
        recording, fit_window, start = _of_solution(subject, recording, fit_window, start)
    model = subject.model if isinstance(subject, Solution) else subject
    if recording is None or fit_window is None:
        raise DiagnosisError("diagnose: a model alone is not enough; give the recording and fit_window=(t0, t1)")
    segments = segments_of(model, recording, fit_window, segment_length)
    checked = audit(model, recording, segments, sensor_noise)
    data = Data(segments, checked.noise, driven, checked.rounding, checked.weight(segments[0].step)).thinned()
    base = fit_model(model, data, dict(start or {}))
    progress(f"the model as given is fitted ({base.iterations} iterations)")
    pool = list(established_suspects(model) if suspects is None else suspects)
    flexible = cache(lambda: _flexible(base, data))
    if mechanism:
        *parts, ranking = explain_mechanism(base, data, pool, threads, progress)
        found = Hypothesis(*parts)
        flexible = cache(lambda: _flexible(found.fit, data))
    else:
        found, ranking = _explain(base, data, pool, flexible, threads, progress)
    found = polished(found, data)
    left = remainder(found.fit, data)
    progress("tested for a remainder")
    doubtful = len(found.suspects) > 1 or not found.established or left[0].minus_log10_p > REMAINDER
    if not mechanism and doubtful and _beaten(found, flexible(), data):
        found, left = flexible(), remainder(flexible().fit, data)
    white = not checked.filtered and all(t.locates or t.minus_log10_p <= REMAINDER for t in left)
    if not white:
        kept = steady(found, base, data)
        if kept is not None:
            found, left = kept, remainder(kept.fit, data)
        found = replace(found, fit=with_robust_errors(found.fit, data))
        kept = sure(found, base, data)
        if kept is not found:
            found, left = kept, remainder(kept.fit, data)
    elif found.established:
        names = [s.term.parameter_name(q.key) for s in found.suspects for q in s.law.parameters]
        found = replace(found, fit=unbiased(found.fit, data, names, threads))
    verdict, effects, equivalent = judge(found, ranking, left, base, data, flexible)
    survived = survivals(found.suspects, found.fit, base, data, white)
    halves = () if white else verdicts(found.suspects, found.fit, base, data, rivals(found, ranking))
    runs = {"baseline_train": free_run(base, data, settling), "augmented_train": free_run(found.fit, data, settling)}
    if held_out is not None:
        # Segments that were set apart are judged whole.
        later = data.with_segments(segments_of(model, recording, held_out, None if isinstance(held_out, str) else segment_length))
        runs |= {"baseline_heldout": free_run(base, later), "augmented_heldout": free_run(found.fit, later)}
    text = words(Story(verdict, effects, equivalent, ranking, left, runs, checked, survived, halves, white,
                       base.kalman_gain is not None, data.weight))
    return Diagnosis(verdict, effects, tuple(ranking), equivalent, base, found.fit, runs, tuple(left), text, checked, survived, halves)


def _of_solution(solution: Solution, recording, fit_window, start):
    """Recording, window and values that a solution brings where they are not given."""
    problem = solution.problem
    if len(problem.recordings) > 1:
        raise DiagnosisError(f"diagnose: the solution has {len(problem.recordings)} recordings; diagnose one of them: "
                             "diagnose(solution.model, recording, fit_window=..., start=solution.values)")
    recording = problem.recordings[0] if recording is None else recording
    return recording, fit_window or problem.windows[0] or recording.interval, solution.values | dict(start or {})


# ---- explaining ------------------------------------------------------------------------------
def _explain(base: Fit, data: Data, pool: list[Suspect], flexible: Callable[[], Hypothesis], threads: int,
             progress) -> tuple[Hypothesis, list[Candidate]]:
    """The best explanation by one or several suspects, and the ranking of single ones."""
    single = explore(base, data, pool, threads=threads, progress=progress)
    best = Hypothesis((), base, 0.0)
    alone = _preferred([Hypothesis((c.suspect,), c.fit, c.score) for c in single])
    if alone is None or alone.score < ACCEPT:
        return best, single
    best = alone
    while len(best.suspects) < MOST_EFFECTS[base.kalman_gain is not None]:
        if len(best.suspects) > 1 and (not best.established and _enough(best, data) or _beaten(best, flexible(), data)):
            break
        progress(f"found {', '.join(str(s.term) for s in best.suspects)}; looking for more")
        more = _extended(best, data, pool, threads, progress)
        if more is None:
            break
        more = _reexamined(more, single, base, data)
        if len(best.suspects) == 1 and not _beaten(more, flexible(), data) and remainder(more.fit, data)[0].minus_log10_p > QUIET:
            more = _reexamined(_beam(more, best, single, data, pool, threads, progress), single, base, data)
        best = more
    hypothesis = _preferred([Hypothesis((c.suspect,), c.fit, c.score) for c in single if not c.suspect.established])
    if hypothesis is not None and best.established and hypothesis.score > best.score + DOUBT:
        best = hypothesis
    return best, single


def _flexible(base: Fit, data: Data) -> Hypothesis:
    """The best flexible law at one place: whatever acts there, named or not."""
    best = flexible_fits(base, data, flexible_terms(base, data))[0]
    return Hypothesis((best.suspect,), best.fit, best.score)


def _beaten(found: Hypothesis, flexible: Hypothesis, data: Data) -> bool:
    """Whether a flexible law at one place explains more than all that has a name: what acts there is in no list."""
    return _enough(flexible, data) and flexible.score > max(found.score, 0.0) + DOUBT


def _enough(found: Hypothesis, data: Data) -> bool:
    """Whether what it leaves of a free motion is not far above the sensors' noise: else more than one thing is missing."""
    rms = np.sqrt(np.mean(np.vstack(found.fit.innovations) ** 2, axis=0))
    return found.fit.kalman_gain is not None or bool(np.all(rms < FAR * data.sensor_noise))


def _preferred(found: list[Hypothesis]) -> Hypothesis | None:
    """The best established explanation, or a hypothesis that beats it beyond doubt."""
    found = sorted(found, key=lambda e: -e.score)
    named = next((e for e in found if e.established), None)
    if not found or named is None:
        return found[0] if found else None
    return found[0] if found[0].score > named.score + DOUBT else named


def _extended(best: Hypothesis, data: Data, pool, threads, progress) -> Hypothesis | None:
    """`best` with one more suspect, if one is accepted."""
    others = [s for s in pool if s.term not in {t.term for t in best.suspects}]
    found = explore(best.fit, data, others, effort=LIGHT, threads=threads, progress=progress)
    more = [Hypothesis((*best.suspects, c.suspect), c.fit, best.score + c.score) for c in found
            if c.score > (ACCEPT if c.suspect.established and len(best.suspects) == 1 else BEYOND)]
    return _preferred(more)


def _beam(pair: Hypothesis, best: Hypothesis, single: list[Candidate], data: Data, pool, threads, progress) -> Hypothesis:
    """The best pair that begins with any of the good single suspects: the best single one may belong to none."""
    rivals = [c for c in single if c.suspect.established and c.suspect != best.suspects[0]
              and c.score > max(ACCEPT, RIVAL_SHARE * best.score)][:BEAM]
    pairs = [pair]
    for c in rivals:
        progress(f"looking for what would complete {c.suspect.term}")
        pairs.append(_extended(Hypothesis((c.suspect,), c.fit, c.score), data, pool, threads, progress))
    return _preferred([p for p in pairs if p is not None])


def _reexamined(found: Hypothesis, single: list[Candidate], base: Fit, data: Data) -> Hypothesis:
    """Earlier suspects are left out in turn, and other good single ones tried in the place of the first: greedy choices mislead."""
    first, kept = found.suspects[0], list(found.suspects[1:])
    tried = [fit_with([s for s in found.suspects if s is not earlier], found.fit, base, data) for earlier in found.suspects[:-1]]
    taken = {s.term for s in found.suspects}
    for c in [c for c in single if c.suspect.term not in taken and c.suspect.established == first.established][:RIVALS]:
        near = found.fit.values | {k: v for k, v in c.fit.values.items() if k not in found.fit.values}
        tried.append(fit_with([c.suspect, *kept], found.fit, base, data, near))
    best = max((e for e in tried if e is not None), key=lambda e: e.score, default=found)
    return best if best.score > found.score + 1.0 else found
