"""The experiment that would tell equivalent answers apart, and the likelihood ratio that is to be expected from it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from symid.discrepancy.design.changes import DRIVEN, FREE, Design
from symid.discrepancy.design.simulated import as_recording, course, simulated
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.recording import Recording

DRAWS = 3
"""Recordings that are simulated of the best experiment, for the mean of their likelihood ratios."""
ITERATIONS = 15
MARGIN, LONGEST = 2.0, 8.0
"""An experiment that is too short is made so many times as long as its ratio asks for, and at most so many times."""
SPLITS = 2.0
"""An experiment splits two answers where the ratio is so many times that from which on they are told apart."""


@dataclass(frozen=True, eq=False)
class Experiment:
    """An experiment that tells the finding from a rival.

    Attributes
    ----------
    design : what to do. finding, rival : the two answers. data : what was recorded, whose inputs and sensors it takes.
    log_ratios : growth of twice the log-likelihood that is to be expected, if the finding is true and if the rival is;
        NaN where no experiment shows it, because the other law can be as good as nothing. log_ratio : the smaller one.
    duration : seconds of the recording.
    """

    design: Design
    finding: Hypothesis
    rival: Hypothesis
    data: Data
    log_ratios: tuple[float, float]

    @property
    def log_ratio(self) -> float:
        return float(np.nanmin(self.log_ratios))

    @property
    def splits(self) -> bool:
        """Whether the recording would tell the answers apart."""
        return self.log_ratio > SPLITS * POLICY.equivalent

    @property
    def duration(self) -> float:
        return float(course(self.data, self.design)[0][-1])

    def simulated(self, truth: Hypothesis, seed: int) -> Data | None:
        """What would be recorded if `truth`, one of the two, were true; None where the motion leaves all bounds."""
        return simulated(truth, self.data, self.design, seed)

    def recording(self, truth: Hypothesis, seed: int) -> Recording:
        """The same as a Recording.

        Raises
        ------
        SymidError : the motion leaves all bounds.
        """
        data = self.simulated(truth, seed)
        if data is None:
            raise SymidError(f"the motion of '{truth.fit.model.name}' leaves all bounds with {self.design.words}")
        return as_recording(data.segments, truth.fit.model, data.sensor_noise, self.design.words)

    def __str__(self) -> str:
        return f"{self.design.words}: twice the log-likelihood ratio {self.log_ratio:.0f}"


def experiments(
    finding: Hypothesis, rival: Hypothesis, data: Data, progress: Callable[[str], None] = lambda text: None
) -> list[Experiment]:
    """Experiments that would tell two answers apart, the easiest that splits them first, then by ratio.

    Each is simulated with either answer as the truth, and both models are fitted to the simulated recordings; the best
    one several times. Where none splits them the best one is made as long as it takes.
    """
    plain = replace(data, filter=None, memory=0)

    def tried(design: Design, seeds: Sequence[int]) -> list[Experiment]:
        ratios = [
            expected_ratio(truth, other, plain, design, seeds) for truth, other in ((finding, rival), (rival, finding))
        ]
        if None in ratios:
            return []
        progress(f"{design.words}: {min(ratios):.0f}")
        return [Experiment(design, finding, rival, plain, (ratios[0], ratios[1]))]

    found = [e for design in (DRIVEN if data.inputs_change else FREE) for e in tried(design, range(1))]
    if not found:
        return []
    # A law that the other one holds as a special case is never told from it where it is true, however long it takes.
    hopeless = [LONGEST * max(e.log_ratios[d] for e in found) < SPLITS * POLICY.equivalent for d in (0, 1)]
    if any(hopeless) and not all(hopeless):
        found = [_without(e, hopeless) for e in found]
    best = min(found, key=_preference)
    draws = range(1, 1 + DRAWS)
    again = tried(best.design, draws) if best.splits else []
    if not (again and _without(again[0], hopeless).splits):
        again += tried(_longer(again[0] if again else best), draws)
    again = [_without(e, hopeless) for e in again] if not all(hopeless) else again
    others = [e for e in found if all(e.design is not a.design for a in again)]
    return sorted(others + again, key=_preference)


def _without(e: Experiment, hopeless: Sequence[bool]) -> Experiment:
    """The experiment judged by the ratios that can be anything, if one can."""
    if all(hopeless):
        return e
    first, second = (np.nan if h else r for r, h in zip(e.log_ratios, hopeless, strict=True))
    return replace(e, log_ratios=(first, second))


def _longer(e: Experiment) -> Design:
    """The same for so long, or so often from the same start, that it should split: a ratio grows with the samples."""
    factor = int(np.clip(np.ceil(MARGIN * SPLITS * POLICY.equivalent / max(e.log_ratio, 1.0)), 2, LONGEST))
    if not e.data.inputs_change:
        words = "recordings from the same start" if e.design.repeats > 1 else f"recordings, each with {e.design.words}"
        times = e.design.repeats * factor
        return replace(e.design, words=f"{times} {words}", repeats=times, effort=5)
    alone, times = e.design.longer > 1, e.design.longer * factor
    words = f"a recording {times:.0f} times as long" if alone else f"{e.design.words}, {factor} times as long"
    return replace(e.design, words=words, longer=times, effort=5)


def _preference(e: Experiment) -> tuple:
    return (not e.splits, e.design.effort if e.splits else 0, -e.log_ratio)


def expected_ratio(
    truth: Hypothesis, other: Hypothesis, data: Data, design: Design, seeds: Sequence[int]
) -> float | None:
    """Mean growth of twice the log-likelihood from `other` to `truth`, both fitted to recordings of the truth."""
    ratios = [likelihood_ratio(truth, other, simulated(truth, data, design, seed)) for seed in seeds]
    known = [r for r in ratios if r is not None]
    return float(np.mean(known)) if known else None


def likelihood_ratio(truth: Hypothesis, other: Hypothesis, recorded: Data | None) -> float | None:
    """Growth of twice the log-likelihood from `other` to `truth`, both fitted; None where one cannot be."""
    if recorded is None:
        return None
    fits = [_refitted(h.fit, recorded) for h in (truth, other)]
    return None if None in fits else fits[0].loglik2 - fits[1].loglik2


def _refitted(fit: Fit, recorded: Data) -> Fit | None:
    states = list(fit.model.states)
    shown = {str(y.expr): i for i, y in enumerate(fit.model.outputs.values())}
    rates = fit.model.rates()
    start = np.zeros((len(recorded.segments), len(states)))
    for x0, s in zip(start, recorded.segments, strict=True):
        for j, name in enumerate(states):
            of = name if name in shown else rates.get(name)
            if of in shown:
                y = s.recorded[:8, shown[of]]
                slope, level = np.polyfit(s.time[:8] - s.time[0], y, 1)
                x0[j] = level if of == name else slope
    try:
        return Fitter(fit.model, recorded).fit(fit.values, start, fit.process, ITERATIONS, errors=False)
    except SymidError:
        return None
