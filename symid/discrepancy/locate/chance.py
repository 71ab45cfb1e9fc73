"""How large a test comes out where nothing is left, in a recording like this one."""

from __future__ import annotations

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data

ROUNDINGS = 12
"""So often the rounding of encoders is simulated."""
WHITENING = 0.6
"""Noise of this part of an encoder's step makes its rounding errors random (Widrow 1961)."""
SIGNS = 48
"""So often the errors are given random signs: their mean spreads by a seventh of what one test does."""


class Chance:
    """What chance makes of a test: errors that are larger at times, and encoders that round.

    Errors keep their sizes and are given random signs (wild bootstrap; Liu 1988): a marker moves on the skin most
    where the body does, and then force and sensor seem to follow the motion.

    Attributes
    ----------
    rounded : (N m, k) what encoders leave that show the fitted motion and nothing else, k = 0 where they hardly round.
    signed : (N m, `SIGNS`) what is left, each sample with a random sign.
    """

    def __init__(self, projection: Projection):
        self.projection, data = projection, projection.data
        nulls = [projection.whiten([s[:, :, None] for s in null])[:, 0] for null in _rounded(projection.fit, data)]
        self.rounded = projection.project(np.column_stack(nulls)) if nulls else np.empty((len(projection.rest), 0))
        rng, samples = np.random.default_rng(0), len(projection.rest) // projection.outputs
        signs = rng.choice((-1.0, 1.0), (samples, SIGNS)).repeat(projection.outputs, axis=0)
        self.signed = projection.project(projection.rest[:, None] * signs)

    def scored(self, columns: np.ndarray) -> tuple[float, int]:
        """Forecast gain of twice the log-likelihood for (N m, q) columns, in parts of what chance makes of it beyond
        chi-square, and how many of them count."""
        rests = np.column_stack([self.projection.rest, self.rounded, self.signed])
        gains, coefficients = self.projection.scores(columns, rests)
        size, first = int(np.count_nonzero(coefficients[:, 0])), 1 + self.rounded.shape[1]
        return float(gains[0]) / max(excess(gains[1:first], size), excess(gains[first:], size)), size


def excess(nulls: np.ndarray, size: int) -> float:
    """How many times larger than chi-square of `size` degrees chance makes a statistic, by (k,) `nulls`; 1 without."""
    return max(1.0, float(np.mean(nulls)) / max(size, 1)) if len(nulls) else 1.0


def _rounded(fit: Fit, data: Data) -> list[list[np.ndarray]]:
    """Surprises of encoders that show the fitted motion and nothing else; none where steps are small beside the noise.

    Where an encoder hardly jitters, its rounding errors follow each other in slow motion.
    """
    step = data.rounding
    if fit.kalman_gain is not None or not np.any(step):
        return []
    jitters = [
        np.sqrt(np.maximum(np.diag(fit.covariance) * size**2 - step**2 / 12, 0.0)) for size in fit.whitening.sizes
    ]
    if np.all(np.array(jitters) > WHITENING * step):
        return []
    found = []
    for seed in range(ROUNDINGS):
        rng, safe, null = np.random.default_rng(seed), np.where(step > 0, step, 1.0), []
        offset = rng.uniform(0, 1, len(step)) * step
        for e, s, jitter in zip(data.segments, fit.innovations, jitters, strict=True):
            shown = e.recorded - s + offset
            noisy = shown + jitter * rng.standard_normal(s.shape)
            null.append(np.where(step > 0, np.round(noisy / safe) * safe, noisy) - shown)
        found.append(null)
    return found
