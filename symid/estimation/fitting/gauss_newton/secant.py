"""What the products of slopes leave out of the curvature, learned from how the slope changed along each step.

Where a model is wrong its innovations are not white, and their second derivatives are not small beside the products
of their slopes: the size of a noise then overshoots, again and again. The correction is the structured secant update
of NL2SOL (Dennis, Gay & Welsch 1981).
"""

from __future__ import annotations

import numpy as np

CONVEX = 1e-9
"""The least eigenvalue of a convex matrix with a unit diagonal: rounding leaves less."""


class Secant:
    """A correction (k, k) of the matrix of normal equations in their first k unknowns."""

    def __init__(self, size: int):
        self.left_out = np.zeros((size, size))

    def learn(self, step: np.ndarray, before: tuple, after: tuple) -> None:
        """From a `step` (u,) between two points with these normal equations: (u, u), (u,) and more."""
        k = len(self.left_out)
        own, change = step[:k], (before[1] - after[1])[:k]
        along = float(own @ change)
        if not along > 0:
            return
        missed = change - (after[0] @ step)[:k]
        with np.errstate(over="ignore", invalid="ignore"):  # where a run nearly diverges nothing is learned
            known = self.left_out @ own
            kept = self.left_out * min(1.0, abs(float(own @ missed)) / max(abs(float(own @ known)), 1e-300))
            rest = missed - kept @ own
            kept += (np.outer(rest, change) + np.outer(change, rest)) / along
            kept -= float(rest @ own) * np.outer(change, change) / along / along
        self.left_out = kept if np.isfinite(kept).all() else self.left_out

    def corrected(self, system: tuple) -> tuple:
        """The normal equations with what was learned, where they stay convex with it."""
        H, g, q = system
        whole, k = H.copy(), len(self.left_out)
        whole[:k, :k] += self.left_out
        return (whole, g, q) if is_convex(whole, H) else system


def is_convex(matrix: np.ndarray, products: np.ndarray) -> bool:
    """Whether a matrix of normal equations is, in units in which the one made of products has a unit diagonal."""
    size = np.sqrt(np.maximum(np.diag(products), 1e-300))
    with np.errstate(over="ignore", invalid="ignore"):
        scaled = matrix / np.outer(size, size)
    return bool(np.isfinite(scaled).all() and np.linalg.eigvalsh(scaled)[0] > CONVEX)
