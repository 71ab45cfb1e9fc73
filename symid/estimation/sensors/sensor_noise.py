"""How much white noise a sensor has, told from its recording."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

import numpy as np

from symid.estimation.sensors.zero_phase import ZeroPhase

ORDER = 6
"""Differences of this order leave noise and hardly any motion."""


def white_noise(pieces: Sequence[np.ndarray]) -> float:
    """Rms of white noise, from differences of an order that motion hardly reaches.

    The squared binomial coefficients of order k add up to (2k)!/(k!)^2 (Anderson 1971, 3.4).
    """
    differences = [np.diff(x, ORDER) for x in pieces if len(x) > ORDER]
    power = np.mean(np.concatenate(differences) ** 2) / comb(2 * ORDER, ORDER)
    return float(np.sqrt(max(power, 1e-12 * np.mean(np.concatenate(pieces) ** 2)))) or 1e-9


def noise_before(pieces: Sequence[np.ndarray], step: float, filter: ZeroPhase) -> float:
    """Rms of white noise before a filter that left `pieces` (N,), from what of them can be undone."""
    ratio = filter.ratio(step)
    return white_noise([filter.undone(x, step, ratio)[0][::ratio] for x in pieces]) * np.sqrt(ratio)
