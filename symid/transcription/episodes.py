"""Episodes: repetitions of one recording that share the parameters, each with its own process noise.

Wang & van den Bogert (2020): an unstable controller cannot follow several differently disturbed
copies of the same motion, so that it cannot win the identification.

One random draw also moves the parameters, by chance: to first order with the noise itself, to second order
with its spectrum and with what its signals have in common. Orthogonal random-phase multisines (Dobrowiecki,
Schoukens & Guillaume 2006) have none of this by chance: their spectrum is flat, they sum to zero over
the episodes, and they are orthogonal. On the article's recording, three episodes, the gains then scatter over
draws a sixth to a seventh as much as with uniform noise, around the same means.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from symid import checked
from symid.checked import nearest
from symid.errors import TranscriptionError
from symid.model import Model

DISTRIBUTIONS = ("multisine", "uniform", "gaussian")
MOST_EPISODES = 1000
"""More are a slip of the keyboard: each is a copy of the whole motion."""


@dataclass(frozen=True)
class Episodes:
    """How many episodes there are, and how the process noise of each is drawn.

    ``Episodes(3, torque=0.25)`` gives every Noise with "torque" in its name the amplitude
    0.25 [in the noise's unit]; ``Episodes(3, amplitude=0.25)`` all noises.

    Parameters
    ----------
    count : number of episodes; 1 is deterministic, without noise.
    amplitude : half width (uniform) or standard deviation (gaussian) of every noise; a multisine
        has the power of the uniform noise, so a standard deviation of amplitude/sqrt(3).
    by_word : amplitudes by a word, ``torque=0.25``: of the noises that have it in their name.
    seed : of the draws.
    distribution : "multisine", "uniform" (as in the authors' result files; independent), or
        "gaussian" (as in the article; independent).
    shared_initial_state : whether all episodes start in the same free state (as in the
        authors' files) or each in its own.

    Raises
    ------
    TranscriptionError : no whole count from 1 on, a negative amplitude, or a distribution that is not known.

    Examples
    --------
    >>> si.Identification(model, recording, episodes=Episodes(3, push=0.2, seed=1)).episodes.count
    3
    """

    count: int = 1
    amplitude: float = 0.0
    seed: int = 0
    distribution: str = "multisine"
    shared_initial_state: bool = True
    by_word: dict[str, float] = field(default_factory=dict)

    def __init__(
        self,
        count: int = 1,
        *,
        amplitude: float = 0.0,
        seed: int = 0,
        distribution: str = "multisine",
        shared_initial_state: bool = True,
        **by_word: float,
    ):
        checked.whole(count, "episodes: the count", TranscriptionError, least=1, most=MOST_EPISODES)
        checked.whole(seed, "episodes: the seed", TranscriptionError)
        checked.flag(shared_initial_state, "episodes: shared_initial_state", TranscriptionError)
        if not isinstance(distribution, str) or distribution not in DISTRIBUTIONS:
            raise TranscriptionError(f"episodes: no distribution '{distribution}'; known: {', '.join(DISTRIBUTIONS)}")
        for word, value in {"amplitude": amplitude, **by_word}.items():
            checked.number(value, f"episodes: {word}", TranscriptionError)
            if not (np.isfinite(value) and value >= 0):
                raise TranscriptionError(f"episodes: {word}={value} must be a finite amplitude of at least 0")
        for name, given in (
            ("count", int(count)),
            ("amplitude", float(amplitude)),
            ("seed", int(seed)),
            ("distribution", distribution),
            ("shared_initial_state", shared_initial_state),
            ("by_word", dict(by_word)),
        ):
            object.__setattr__(self, name, given)

    def amplitudes(self, model: Model) -> np.ndarray:
        """(noises,) amplitude of each Noise of `model`; TranscriptionError where a word fits none.

        Parameters
        ----------
        model : whose noises are meant.

        Raises
        ------
        TranscriptionError : a word fits no Noise, or several episodes would have no noise.
        """
        values = np.full(len(model.noises), self.amplitude)
        for word, value in self.by_word.items():
            hits = [i for i, name in enumerate(model.noises) if word in name]
            if not hits:
                raise TranscriptionError(
                    f"episodes: no noise of model '{model.name}' has '{word}' in its name; "
                    + nearest(word, model.noises)
                )
            values[hits] = value
        if self.count > 1 and not values.any():
            raise TranscriptionError(
                f"episodes: {self.count} episodes without any noise would be {self.count} times the same; give an "
                f"amplitude, for instance Episodes({self.count}, torque=0.25) "
                f"(noises: {', '.join(model.noises) or 'none'})"
            )
        return values

    def draw(self, model: Model, intervals: int) -> list[np.ndarray]:
        """Per episode (intervals, noises): the noise, constant over each interval."""
        amplitudes = self.amplitudes(model)
        if self.count == 1:
            return [np.zeros((intervals, len(amplitudes)))]
        if self.distribution == "multisine":
            return list(amplitudes / np.sqrt(3) * _multisines(self.count, intervals, len(amplitudes), self.seed))
        streams = [np.random.default_rng(s) for s in np.random.SeedSequence(self.seed).spawn(self.count)]
        shape = (intervals, len(amplitudes))
        if self.distribution == "uniform":
            return [amplitudes * r.uniform(-1, 1, shape) for r in streams]
        return [amplitudes * r.standard_normal(shape) for r in streams]


def _multisines(episodes: int, intervals: int, noises: int, seed: int) -> np.ndarray:
    """(episodes, intervals, noises) random-phase multisines of standard deviation 1 that are orthogonal.

    From episode to episode the phase of noise j turns by a whole multiple of 2 pi / episodes, other than zero,
    so that the episodes sum to zero. Noises of different multiples are orthogonal over the episodes. There are
    episodes - 1 of them; noises that have the same one turn against each other from line to line of the spectrum.

    The lines lie half way between the multiples of 1 / window: these would leave out the mean, and with it most of
    what white noise does to a slow mode, whereas the mean of these varies from draw to draw as that of white noise.
    """
    count = intervals // 2
    rng, line, noise = np.random.default_rng(seed), np.arange(count), np.arange(noises)
    multiple, group = 1 + noise % (episodes - 1), noise // (episodes - 1)
    together = group.max(initial=0) + 1
    blocks = rng.uniform(0, 2 * np.pi, (-(-count // together), noises))
    phase = np.repeat(blocks, together, axis=0)[:count] + rng.uniform(0, 2 * np.pi, (count, 1))
    phase += 2 * np.pi / together * np.outer(line % together, group)
    turns = 2 * np.pi / episodes * np.multiply.outer(np.arange(episodes), multiple)
    lines = np.sqrt(2 / count) * np.exp(1j * (phase + turns[:, None]))
    half_a_line = np.exp(1j * np.pi / intervals * np.arange(intervals))
    signals: np.ndarray = half_a_line[:, None] * np.fft.ifft(lines, intervals, axis=1, norm="forward")
    return signals.real
