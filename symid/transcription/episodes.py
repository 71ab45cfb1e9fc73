"""Episodes: repetitions of one recording that share the parameters, each with its own process noise.

Wang & van den Bogert (2020): an unstable controller cannot follow several differently disturbed
copies of the same motion, so that it cannot win the identification.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from symid.errors import TranscriptionError
from symid.model import Model, nearest


@dataclass(frozen=True)
class Episodes:
    """How many episodes there are, and how the process noise of each is drawn.

    ``Episodes(3, torque=0.25)`` gives every Noise with "torque" in its name the amplitude
    0.25 [in the noise's unit]; ``Episodes(3, amplitude=0.25)`` all noises.

    Parameters
    ----------
    count : number of episodes; 1 is deterministic, without noise.
    amplitude : half width (uniform) or standard deviation (gaussian) of every noise.
    seed : of the draws. The noise of an episode does not depend on how many there are.
    distribution : "uniform", as in the authors' result files, or "gaussian", as in the article.
    shared_initial_state : whether all episodes start in the same free state (as in the
        authors' files) or each in its own.
    """

    count: int = 1
    amplitude: float = 0.0
    seed: int = 0
    distribution: str = "uniform"
    shared_initial_state: bool = True
    by_word: dict[str, float] = field(default_factory=dict)

    def __init__(self, count: int = 1, *, amplitude: float = 0.0, seed: int = 0, distribution: str = "uniform",
                 shared_initial_state: bool = True, **by_word: float):
        if int(count) != count or count < 1:
            raise TranscriptionError(f"episodes: the count must be a whole number of at least 1, not {count}")
        if distribution not in ("uniform", "gaussian"):
            raise TranscriptionError(f"episodes: no distribution '{distribution}'; known: uniform, gaussian")
        for word, value in {"amplitude": amplitude, **by_word}.items():
            if not (np.isfinite(value) and value >= 0):
                raise TranscriptionError(f"episodes: {word}={value} must be a finite amplitude of at least 0")
        for name, value in (("count", int(count)), ("amplitude", float(amplitude)), ("seed", int(seed)),
                            ("distribution", distribution), ("shared_initial_state", shared_initial_state),
                            ("by_word", dict(by_word))):
            object.__setattr__(self, name, value)

    def amplitudes(self, model: Model) -> np.ndarray:
        """(noises,) amplitude of each Noise of `model`; TranscriptionError where a word fits none."""
        values = np.full(len(model.noises), self.amplitude)
        for word, value in self.by_word.items():
            hits = [i for i, name in enumerate(model.noises) if word in name]
            if not hits:
                raise TranscriptionError(f"episodes: no noise of model '{model.name}' has '{word}' in its name; "
                                         + nearest(word, model.noises))
            values[hits] = value
        if self.count > 1 and not values.any():
            raise TranscriptionError(
                f"episodes: {self.count} episodes without any noise would be {self.count} times the same; give an "
                f"amplitude, for instance Episodes({self.count}, torque=0.25) (noises: {', '.join(model.noises) or 'none'})")
        return values

    def draw(self, model: Model, intervals: int) -> list[np.ndarray]:
        """Per episode (intervals, noises): the noise, constant over each interval."""
        amplitudes = self.amplitudes(model)
        if self.count == 1:
            return [np.zeros((intervals, len(amplitudes)))]
        streams = [np.random.default_rng(s) for s in np.random.SeedSequence(self.seed).spawn(self.count)]
        shape = (intervals, len(amplitudes))
        if self.distribution == "uniform":
            return [amplitudes * r.uniform(-1, 1, shape) for r in streams]
        return [amplitudes * r.standard_normal(shape) for r in streams]
