"""Bounds and first guesses of the free parameters, in SI units."""

from __future__ import annotations

import numpy as np

from symid.transcription import Transcription
from symid.transcription.guesses import guesses as declared


def parameter_bounds(t: Transcription) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper bounds (free parameters,)."""
    first, scale = t.layout.offsets[-1], t.layout.parameter_scale
    return t.program.lower[first:] * scale, t.program.upper[first:] * scale


def guesses(t: Transcription) -> np.ndarray:
    """(free parameters,) the declared guess, else the middle of finite bounds, else the bound next to zero."""
    return declared(t.model, t.layout)
