"""A function of a nonlinear program that writes its values where they are wanted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Filling:
    """The values of a sparse matrix, as a new array where it is called; a solver has its own array filled.

    Parameters
    ----------
    size : of the array.
    fill : (out, ...) writes the values into out, shape (size,), whatever it holds.
    """

    size: int
    fill: Callable[..., None]

    def __call__(self, *arguments) -> np.ndarray:
        out = np.empty(self.size)
        self.fill(out, *arguments)
        return out
