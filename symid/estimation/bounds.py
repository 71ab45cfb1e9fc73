"""Bounds and first guesses of the free parameters, in SI units."""

from __future__ import annotations

import numpy as np

from symid.transcription import Transcription


def parameter_bounds(t: Transcription) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper bounds (free parameters,)."""
    first, scale = t.layout.offsets[-1], t.layout.parameter_scale
    return t.program.lower[first:] * scale, t.program.upper[first:] * scale


def guesses(t: Transcription) -> np.ndarray:
    """(free parameters,) the declared guess, else the middle of finite bounds, else the bound next to zero."""
    lower, upper = parameter_bounds(t)
    with np.errstate(invalid="ignore"):    # bounds at minus and plus infinity have no middle, and none is taken
        middle = np.where(np.isfinite(lower) & np.isfinite(upper), 0.5 * (lower + upper), np.clip(0.0, lower, upper))
    for p, columns in zip(t.model.parameters.values(), t.layout.parameter_index.T, strict=True):
        if p.guess is not None:
            middle[columns] = p.guess
    return middle
