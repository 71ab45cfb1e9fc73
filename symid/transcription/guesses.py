"""First guesses of unknowns from their declarations."""

from __future__ import annotations

import numpy as np

from symid.model import Model
from symid.transcription.layout import Layout


def first_guess(bounds: np.ndarray) -> np.ndarray:
    """(n,) the middle of finite bounds (n, 2), else the point of the interval next to zero."""
    lower, upper = bounds.T
    with np.errstate(invalid="ignore"):
        return np.where(np.isfinite(lower) & np.isfinite(upper), 0.5 * (lower + upper), np.clip(0.0, lower, upper))


def guesses(model: Model, layout: Layout) -> np.ndarray:
    """(free parameters,) SI, as `parameter_guesses`."""
    values = np.zeros(len(layout.parameter_names))
    values[layout.parameter_index] = parameter_guesses(model)
    return values


def parameter_guesses(model: Model, small: bool = False) -> np.ndarray:
    """(q,) the declared guess of each parameter, else the first guess of its bounds, or what is `small` within them."""
    parts = list(model.parameters.values())
    bounds = np.array([p.bounds for p in parts], dtype=float).reshape(-1, 2)
    found = np.clip(0.0, *bounds.T) if small else first_guess(bounds)
    return np.array([g if p.guess is None else p.guess for p, g in zip(parts, found, strict=True)], dtype=float)
