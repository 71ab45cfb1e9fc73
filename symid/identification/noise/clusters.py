"""Errors of which no more is known than that they are independent from recording to recording."""

from __future__ import annotations

import numpy as np

from symid.identification.noise.residual import Errors

FEWEST_CLUSTERS = 5
"""Recordings whose spread says something: the variance of q numbers has q - 1 degrees of freedom."""


def clustered(errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (q, q) of the parameters, and (recordings, m) standard deviations of the noise [SI] (Liang & Zeger
    1986).

    Each recording's error is made as large as its noise by (1 - H)^(-1/2) (Bell & McCaffrey 2002). A
    parameter of one recording alone has no other to be compared with.
    """
    total = 0.0
    for r, g in zip(errors, influences, strict=True):
        root = np.sqrt(r.weights)[:, None]
        basis = (r.shared * root).reshape(-1, r.shared.shape[2])
        squares, directions = np.linalg.eigh(basis.T @ basis)
        kept = (squares > 1e-12) & (squares < 1 - 1e-6)
        basis, squares = basis @ directions[:, kept], squares[kept]
        error = (r.error * root[:, 0]).ravel()
        error = error + basis @ ((1 / np.sqrt(1 - squares) - 1) / squares * (basis.T @ error))
        pull = np.divide(g, root, out=np.zeros_like(g), where=root > 0).reshape(-1, g.shape[2]).T @ error
        total = total + np.outer(pull, pull)
    return total, np.array([r.deviation for r in errors])
