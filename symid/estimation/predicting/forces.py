"""What random forces do between two samples of a linear model, and how much of it the samples show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from symid.model import WHITE, Model

HOLD, MOST_HOLDS = 0.01, 8
"""Random forces last about this long [s], or this part of a sample: shorter ones within a sample look all alike."""


@dataclass(frozen=True)
class Forces:
    """Random forces between samples.

    Attributes
    ----------
    step : seconds between samples.
    white : whether they change all the time; else they are held, as `held` says.
    parts : of a sample, for which their work is wanted, too.
    banded : whether nothing faster than half the sampling rate is left in what was sampled.
    """

    step: float
    white: bool = False
    parts: int = 1
    banded: bool = False

    def moved(self, A: np.ndarray, G: np.ndarray, process: np.ndarray) -> tuple[np.ndarray, ...]:
        """Transition over a sample and the covariance of what forces add, and both of one of the parts of it.

        Forces that change within a sample move position and speed apart. What they do faster than half the sampling
        rate folds back below it, and so doubles what a mass does at that rate; forces that are held over the sample do
        nothing there. Where a filter is undone nothing folds back: the mean of both has, at that rate, what is there.
        With the double a leg's centre of mass lay elsewhere (draw 724 of "person", filtered at 4 Hz).

        Parameters
        ----------
        A, G, process : (..., n, n), (..., n, w), and (..., w) standard deviations.

        Returns
        -------
        (..., n, n) each (Anderson & Moore 1979, 4.4).
        """
        stated, size = held(self.step, self.white)
        inside = -(-stated // self.parts)  # in each part as often, and as strong in all
        size *= float(np.sqrt(inside * self.parts / stated))
        with np.errstate(over="ignore", invalid="ignore"):  # of a trial that grows without end
            part = _repeated(*_over(A, G * size, self.step / (inside * self.parts), process), inside)
            F, Q = _repeated(*part, self.parts)
            if self.banded:
                _, whole = _over(A, G * size / np.sqrt(inside * self.parts), self.step, process)
                Q = (Q + whole) / 2
        return F, Q, *part


def is_white(model: Model) -> bool:
    """Whether the random forces of a model are white, as of `held`."""
    return any(w.hold == WHITE for w in model.noises.values())


def held(step: float, white: bool = False) -> tuple[int, float]:
    """How often a random force changes within a sample of `step` seconds, and its size in parts of the stated one.

    It is held over the whole part of a sample nearest to `HOLD` seconds, an eighth at least; one that is `white`, over
    an eighth. Where it changes more or less often than it would it is larger or smaller, so that its power at low
    frequencies is the same.
    """
    holds = max(1, round(step / HOLD))
    if not white and holds <= MOST_HOLDS:
        return holds, 1.0
    return MOST_HOLDS, float(np.sqrt(MOST_HOLDS / holds if holds <= MOST_HOLDS else HOLD * MOST_HOLDS / step))


def _over(A: np.ndarray, G: np.ndarray, step: float, process: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Transition over a step and the covariance of what forces add that are held over it."""
    n, w = G.shape[-2:]
    block = np.zeros((*A.shape[:-2], n + w, n + w))
    block[..., :n, :n], block[..., :n, n:] = A * step, G * step
    exact = expm(block)
    B = exact[..., :n, n:] * process[..., None, :]
    return exact[..., :n, :n], B @ B.swapaxes(-1, -2)


def _repeated(F: np.ndarray, Q: np.ndarray, times: int) -> tuple[np.ndarray, np.ndarray]:
    """Transition and covariance over so many times what they are given for."""
    total = Q
    for _ in range(times - 1):
        total = F @ total @ F.swapaxes(-1, -2) + Q
    return np.linalg.matrix_power(F, times), total
