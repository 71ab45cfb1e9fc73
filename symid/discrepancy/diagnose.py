"""Find the missing physics: fit, suspect, refit, look for more, judge, prove."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from symid.discrepancy.audit import audit
from symid.discrepancy.baseline import fit_baseline
from symid.discrepancy.bias import unbiased
from symid.discrepancy.data import Data, episodes_of
from symid.discrepancy.diagnosis import Diagnosis, Effect
from symid.discrepancy.fit import Fit, Fitter
from symid.discrepancy.flexible import flexible_fits, flexible_terms
from symid.discrepancy.freerun import FreeRun, free_run
from symid.discrepancy.halves import survivals
from symid.discrepancy.mechanism import explain_mechanism
from symid.discrepancy.remainder import Test, remainder
from symid.discrepancy.robust import with_robust_errors
from symid.discrepancy.screen import extended
from symid.discrepancy.search import LIGHT, Candidate, explore, moment_profile, price
from symid.discrepancy.suspects import Suspect, established_suspects
from symid.discrepancy.words import Story, sentence, words
from symid.errors import DiagnosisError, SymidError
from symid.identification import Solution
from symid.model import Model
from symid.recording import Recording
from symid.simulation import simulator
from symid.threads import one_blas_thread

ACCEPT = 10.0
"""A suspect is accepted when its score, the likelihood gain beyond BIC, exceeds this."""
DOUBT = 10.0
"""A hypothesis must beat what established suspects reach by this much to make the finding unexplained."""
BEYOND = 25.0
"""A hypothesis on top of an established suspect, or a third effect, is accepted only from this score on."""
REMAINDER = 4.5
"""-log10 of the probability by chance from which a remainder counts as systematic."""
QUIET = 1.5
"""Below this nothing is left that another pair of suspects could explain better."""
EQUIVALENT = 12.0
UNSURE = 2.0
"""An effect that is not this many honest standard errors from nothing is left out."""
FAR = 5.0
"""Errors so many times the sensors' noise are not explained by whatever acts at one place alone."""
MOST_EFFECTS = {True: 3, False: 6}
"""So many effects are looked for, with random forces and without. Three beside random forces are more likely one of no list."""
RIVALS = 5
BEAM = 3
RIVAL_SHARE = 0.3


@dataclass(frozen=True, eq=False)
class Explanation:
    """Suspects that were added together, and their fit."""

    suspects: tuple[Suspect, ...]
    fit: Fit
    score: float

    @property
    def established(self) -> bool:
        return all(s.established for s in self.suspects)


@one_blas_thread
def diagnose(subject: Model | Solution, recording: Recording | None = None, *,
             fit_window: tuple[float, float] | str | None = None, held_out: tuple[float, float] | str | None = None, sensor_noise: float | Mapping[str, float] | None = None,
             episode_length: float | None = None, driven: bool = True, settling: float = 0.0,
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
    episode_length : seconds of one piece with an initial state of its own; None for one piece.
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
    episodes = episodes_of(model, recording, fit_window, episode_length)
    checked = audit(model, recording, episodes, sensor_noise)
    data = Data(episodes, checked.noise, driven, checked.rounding, checked.weight(episodes[0].step)).thinned()
    base = fit_baseline(model, data, dict(start or {}))
    progress(f"the model as given is fitted ({base.iterations} iterations)")
    pool = list(established_suspects(model) if suspects is None else suspects)
    anything = cache(lambda: _anything(base, data))
    if mechanism:
        *parts, ranking = explain_mechanism(base, data, pool, threads, progress)
        found = Explanation(*parts)
        anything = cache(lambda: _anything(found.fit, data))
    else:
        found, ranking = _explain(base, data, pool, anything, threads, progress)
    found = _polished(found, data)
    left = remainder(found.fit, data)
    progress("tested for a remainder")
    if not mechanism and (len(found.suspects) > 1 or not found.established or left[0].surprise > REMAINDER) and _beaten(found, anything(), data):
        found, left = anything(), remainder(anything().fit, data)
    white = not checked.filtered and all(t.locates or t.surprise <= REMAINDER for t in left)
    if not white:
        steady = _steady(found, base, data)
        if steady is not None:
            found, left = steady, remainder(steady.fit, data)
        found = replace(found, fit=with_robust_errors(found.fit, data))
        sure = _sure(found, base, data)
        if sure is not found:
            found, left = sure, remainder(sure.fit, data)
    elif found.established:
        names = [s.term.parameter_name(q.key) for s in found.suspects for q in s.law.parameters]
        found = replace(found, fit=unbiased(found.fit, data, names, threads))
    verdict, effects, equivalent = _judge(found, ranking, left, base, data, anything)
    survived = survivals(found.suspects, found.fit, base, data, white)
    runs = {"baseline_train": free_run(base, data, settling), "augmented_train": free_run(found.fit, data, settling)}
    if held_out is not None:
        # Segments that were set apart are judged whole.
        later = data.with_episodes(episodes_of(model, recording, held_out, None if isinstance(held_out, str) else episode_length))
        runs |= {"baseline_heldout": free_run(base, later), "augmented_heldout": free_run(found.fit, later)}
    text = words(Story(verdict, effects, equivalent, ranking, left, runs, checked, survived, white, base.gain is not None, data.weight))
    return Diagnosis(verdict, effects, tuple(ranking), equivalent, base, found.fit, runs, tuple(left), text, checked, survived)


def _of_solution(solution: Solution, recording, fit_window, start):
    """Recording, window and values that a solution brings where they are not given."""
    problem = solution.problem
    if len(problem.recordings) > 1:
        raise DiagnosisError(f"diagnose: the solution has {len(problem.recordings)} recordings; diagnose one of them: "
                             "diagnose(solution.model, recording, fit_window=..., start=solution.values)")
    recording = problem.recordings[0] if recording is None else recording
    return recording, fit_window or problem.windows[0] or recording.interval, solution.values | dict(start or {})


# ---- explaining ------------------------------------------------------------------------------
def _explain(base: Fit, data: Data, pool: list[Suspect], anything: Callable[[], Explanation], threads: int, progress) -> tuple[Explanation, list[Candidate]]:
    """The best explanation by one or several suspects, and the ranking of single ones."""
    single = explore(base, data, pool, threads=threads, progress=progress)
    best = Explanation((), base, 0.0)
    alone = _preferred([Explanation((c.suspect,), c.fit, c.score) for c in single])
    if alone is None or alone.score < ACCEPT:
        return best, single
    best = alone
    while len(best.suspects) < MOST_EFFECTS[base.gain is not None]:
        if len(best.suspects) > 1 and (not best.established and _enough(best, data) or _beaten(best, anything(), data)):
            break
        progress(f"found {', '.join(str(s.term) for s in best.suspects)}; looking for more")
        more = _extended(best, data, pool, threads, progress)
        if more is None:
            break
        more = _reexamined(more, single, base, data)
        if len(best.suspects) == 1 and not _beaten(more, anything(), data) and remainder(more.fit, data)[0].surprise > QUIET:
            more = _reexamined(_beam(more, best, single, data, pool, threads, progress), single, base, data)
        best = more
    hypothesis = _preferred([Explanation((c.suspect,), c.fit, c.score) for c in single if not c.suspect.established])
    if hypothesis is not None and best.established and hypothesis.score > best.score + DOUBT:
        best = hypothesis
    return best, single


def _anything(base: Fit, data: Data) -> Explanation:
    """The best flexible law at one place: whatever acts there, named or not."""
    best = flexible_fits(base, data, flexible_terms(base, data))[0]
    return Explanation((best.suspect,), best.fit, best.score)


def _beaten(found: Explanation, anything: Explanation, data: Data) -> bool:
    """Whether a flexible law at one place explains more than all that has a name: what acts there is in no list."""
    return _enough(anything, data) and anything.score > max(found.score, 0.0) + DOUBT


def _enough(found: Explanation, data: Data) -> bool:
    """Whether what it leaves of a free motion is not far above the sensors' noise: else more than one thing is missing."""
    rms = np.sqrt(np.mean(np.vstack(found.fit.surprise) ** 2, axis=0))
    return found.fit.gain is not None or bool(np.all(rms < FAR * data.sensor_noise))


def _polished(found: Explanation, data: Data) -> Explanation:
    """The same explanation fitted until nothing moves."""
    if not found.suspects:
        return found
    fit = Fitter(found.fit.model, data).again(found.fit)
    return Explanation(found.suspects, fit, found.score + fit.loglik2 - found.fit.loglik2)


def _steady(found: Explanation, base: Fit, data: Data) -> Explanation | None:
    """The explanation without oscillations that one half of the data contradicts: what is no sine keeps no frequency."""
    fickle = {(v.name, v.location) for v in survivals([s for s in found.suspects if s.phase], found.fit, base, data, white=False, others=found.suspects) if v.reason}
    kept = [s for s in found.suspects if (s.term.name, s.term.location) not in fickle]
    if not kept or len(kept) == len(found.suspects):
        return None
    less = _fit_with(kept, found.fit, base, data)
    return None if less is None else _polished(less, data)


def _sure(found: Explanation, base: Fit, data: Data) -> Explanation:
    """The explanation without effects that could as well be nothing, the least certain dropped first; one at least is kept."""
    while len(found.suspects) > 1:
        doubtful = min(found.suspects, key=lambda s: _certainty(s, found.fit))
        if _certainty(doubtful, found.fit) > UNSURE:
            break
        less = _fit_with([s for s in found.suspects if s is not doubtful], found.fit, base, data)
        if less is None:
            break
        less = _polished(less, data)
        found = replace(less, fit=with_robust_errors(less.fit, data))
    return found


def _certainty(suspect: Suspect, fit: Fit) -> float:
    """Standard errors between the suspect and nothing; infinite where no value of it means nothing."""
    nulls = {suspect.term.parameter_name(q.key): q.null for q in suspect.law.parameters if q.null is not None}
    return max((abs(fit.values[k] - null) / fit.errors[k] for k, null in nulls.items() if fit.errors.get(k)), default=np.inf)


def _preferred(found: list[Explanation]) -> Explanation | None:
    """The best established explanation, or a hypothesis that beats it beyond doubt."""
    found = sorted(found, key=lambda e: -e.score)
    named = next((e for e in found if e.established), None)
    if not found or named is None:
        return found[0] if found else None
    return found[0] if found[0].score > named.score + DOUBT else named


def _extended(best: Explanation, data: Data, pool, threads, progress) -> Explanation | None:
    """`best` with one more suspect, if one is accepted."""
    others = [s for s in pool if s.term not in {t.term for t in best.suspects}]
    found = explore(best.fit, data, others, effort=LIGHT, threads=threads, progress=progress)
    more = [Explanation((*best.suspects, c.suspect), c.fit, best.score + c.score) for c in found
            if c.score > (ACCEPT if c.suspect.established and len(best.suspects) == 1 else BEYOND)]
    return _preferred(more)


def _beam(pair: Explanation, best: Explanation, single: list[Candidate], data: Data, pool, threads, progress) -> Explanation:
    """The best pair that begins with any of the good single suspects: the best single one may belong to none."""
    rivals = [c for c in single if c.suspect.established and c.suspect != best.suspects[0]
              and c.score > max(ACCEPT, RIVAL_SHARE * best.score)][:BEAM]
    pairs = [pair]
    for c in rivals:
        progress(f"looking for what would complete {c.suspect.term}")
        pairs.append(_extended(Explanation((c.suspect,), c.fit, c.score), data, pool, threads, progress))
    return _preferred([p for p in pairs if p is not None])


def _reexamined(both: Explanation, single: list[Candidate], base: Fit, data: Data) -> Explanation:
    """The other good single suspects are tried in the place of the first: greedy choices mislead."""
    first, kept = both.suspects[0], list(both.suspects[1:])
    alone = _fit_with(kept, both.fit, base, data)
    tried = [alone] if alone is not None else []
    taken = {s.term for s in both.suspects}
    for c in [c for c in single if c.suspect.term not in taken and c.suspect.established == first.established][:RIVALS]:
        near = both.fit.values | {k: v for k, v in c.fit.values.items() if k not in both.fit.values}
        other = _fit_with([c.suspect, *kept], both.fit, base, data, near)
        tried += [other] if other is not None else []
    best = max(tried, key=lambda e: e.score, default=both)
    return best if best.score > both.score + 1.0 else both


def _fit_with(suspects: list[Suspect], near: Fit, base: Fit, data: Data, values: dict | None = None) -> Explanation | None:
    """The base model with exactly these suspects, started from values that a larger model had."""
    model = base.model
    for s in suspects:
        model = model.with_term(s.term)
    sim = simulator(model)
    try:
        fit = Fitter(model, data).fit({k: (values or near.values)[k] for k in sim.parameters}, extended(base.initial, sim), near.process)
    except SymidError:
        return None
    return Explanation(tuple(suspects), fit, fit.loglik2 - base.loglik2 - price(suspects, data, base, fit))


# ---- judging ---------------------------------------------------------------------------------
def _judge(found: Explanation, ranking: list[Candidate], left: list[Test], base: Fit, data: Data, anything: Callable[[], Explanation]):
    """Verdict, effects and equivalent candidates."""
    effects = tuple(_effect(s, found, base, data) for s in found.suspects)
    rest = _located(left) if left and left[0].surprise > REMAINDER else None
    first = found.suspects[0] if len(found.suspects) == 1 else None
    equivalent = tuple(c for c in ranking if first is not None and c.suspect.established and c.suspect.term != first.term
                       and c.score > found.score - EQUIVALENT)
    if not found.suspects and rest is None:
        return "adequate", (), ()
    if rest is not None and not found.suspects:
        return "unexplained", (Effect("unknown", rest.place, {}, None, rest.gain, rest.what),), ()
    if not found.established:
        odd = next(s for s in found.suspects if not s.established)
        effects = tuple(sorted(effects, key=lambda e: (e.name, e.location) != (odd.term.name, odd.term.location)))
        return "unexplained", effects, ()
    if rest is not None or base.gain is not None and len(effects) == MOST_EFFECTS[True]:
        what = rest.what if rest else "what only three of the known effects together imitate"
        votes = [anything().suspects[0].term.location, effects[0].location, *([rest.place] if rest else [])]
        place = max(votes, key=votes.count)
        return "unexplained", (Effect("unknown", place, {}, None, rest.gain if rest else found.score, what), *effects), equivalent
    return "missing_physics", effects, equivalent


def _located(left: list[Test]) -> Test:
    """The test that tells where a remainder acts: whiteness is a good alarm and a poor locator."""
    places = [t for t in left if t.locates and t.surprise > 2.0]
    return places[0] if places else left[0]


def _moment(fit: Fit, data: Data, name: str, error: float) -> tuple[float, float]:
    """Mean and deviation of a moment under its likelihood, which has many peaks."""
    at = fit.values[name]
    moments, values = moment_profile(fit, data, name, (at - 4.0, at + 4.0), 0.1)
    weight = np.exp(0.5 * (values - values.max()))
    mean = float(np.sum(weight * moments) / weight.sum())
    return mean, float(np.hypot(error, np.sqrt(np.sum(weight * (moments - mean) ** 2) / weight.sum())))


def _effect(suspect: Suspect, found: Explanation, base: Fit, data: Data) -> Effect:
    fit, term = found.fit, suspect.term
    parameters = {q.key: (fit.values[term.parameter_name(q.key)], fit.errors[term.parameter_name(q.key)])
                  for q in suspect.law.parameters if term.parameter_name(q.key) in fit.errors}
    window = None
    if "start_s" in parameters:
        begin = parameters["start_s"][0]
        window = (begin, begin + parameters.get("duration_s", (0.5, 0.0))[0])
    elif "time_s" in parameters:
        at, error = _moment(fit, data, term.parameter_name("time_s"), parameters["time_s"][1])
        parameters["time_s"] = (at, error)
        window = (at - min(2 * error, 3.0), at + min(2 * error, 3.0))
    gain = fit.loglik2 - base.loglik2
    return Effect(term.name, term.location, parameters, window, gain, sentence(suspect, parameters))
