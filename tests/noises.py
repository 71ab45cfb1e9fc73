"""Noise that remembers, for tests."""

import numpy as np
from scipy.signal import lfilter


def autoregressive(rng: np.random.Generator, n: int, memory: float, outputs: int = 2) -> np.ndarray:
    """(n, outputs) noise of which each sample keeps the part `memory` of the one before it."""
    return lfilter([1.0], [1.0, -memory], rng.standard_normal((n, outputs)), axis=0)
