"""Standard errors that do not believe in white innovations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data

BLOCK = 3.0
"""Seconds of a block of one long segment at the pace of a second: longer than errors remember in all recordings at
hand."""
FEWEST_BLOCKS = 8


def with_robust_errors(fit: Fit, data: Data) -> Fit:
    """The same fit with errors from the scatter of its scores over blocks, where those are larger.

    An estimate moves by the sum over time of influence times innovation. Sums over blocks are nearly
    independent even where neighbouring innovations are not (White 1980; Liang & Zeger 1986): their
    squares add up to the variance. Blocks are segments, or stretches of a long one.
    """
    fitter = Fitter.of(fit, data)
    runs = fitter.ended(fit)
    if runs is None or not fitter.free or not fit.errors:
        return fit
    whiten, q, m = fit.whitening, len(fitter.free), len(fit.whitening.covariance)
    columns, rests = [], []
    for t, rest, size in zip(runs, fit.remaining, whiten.sizes, strict=True):
        own, _ = np.linalg.qr(whiten(t.dy[:, :, q:], size))
        shared, rest = whiten(t.dy[:, :, :q], size), rest.reshape(-1)
        columns.append(shared - own @ (own.T @ shared))
        rests.append(rest - own @ (own.T @ rest))
    scale = np.sqrt(sum((c**2).sum(0) for c in columns)) + 1e-300
    inverse = np.linalg.pinv(sum((c / scale).T @ (c / scale) for c in columns), rcond=1e-13)
    sums = []
    for e, c, rest in zip(data.segments, columns, rests, strict=True):
        moves = (c / scale * rest[:, None]).reshape(len(e.time), m, q).sum(1) @ inverse
        sums += [part.sum(0) for part in np.array_split(moves, _blocks(e.time, len(data.segments), BLOCK * data.pace))]
    spread = np.sqrt((np.array(sums) ** 2).sum(0) * len(sums) / max(len(sums) - 1, 1)) / scale
    return replace(
        fit,
        errors=fit.errors
        | {k: max(fit.errors.get(k, 0.0), float(s)) for k, s in zip(fitter.free, spread, strict=True)},
    )


def _blocks(time: np.ndarray, segments: int, length: float) -> int:
    """Into how many blocks a segment is cut."""
    if segments >= FEWEST_BLOCKS:
        return 1
    return max(int((time[-1] - time[0]) / length), -(-FEWEST_BLOCKS // segments))
