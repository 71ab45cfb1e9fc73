"""Frequencies at which a periodic suspect explains most, where every segment has a start of its own."""

from __future__ import annotations

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.suspects import Suspect
from symid.simulation import Simulator

RATE = 40.0
"""So many samples in the pace of a motion tell frequencies of interest apart [Hz]: this choice needs no more."""
SPACING = 0.4
"""Spacing of the simulated frequencies, in parts of one over the longest segment. Between them the
response is interpolated: it is smooth where its phase is counted from the middle of each segment."""
FINE = 0.4
"""Spacing of the frequencies that are compared, in parts of one over the whole recording."""
CHUNK = 64


def comb(
    projection: Projection, suspect: Suspect, sim: Simulator, highest: float, keep: int = 6
) -> list[dict[str, float]]:
    """The best frequencies up to `highest` [Hz], with the other values of `suspect`, strength off.

    Segments far apart in time ask for a fine grid of frequencies, each alone for a coarse one.
    """
    segments, (t0, t1), q = projection.data.segments, projection.data.span, suspect.scanned
    highest, width = min(q.bounds[1], highest), SPACING / max(float(e.time[-1] - e.time[0]) for e in segments)
    fine = np.arange(max(q.bounds[0], 1.5 / (t1 - t0)), highest, FINE / (t1 - t0))
    known = np.arange(max(fine[0] - 2 * width, 0.25 * width), highest + 3 * width, width)
    rows = np.arange(0, projection.data.samples, max(1, int(projection.data.pace / (RATE * segments[0].step))))
    middles = [0.5 * float(e.time[0] + e.time[-1]) for e in segments]
    answers = []
    for f in known:
        turned = 2 * np.pi * f * np.array(middles)
        cos, sin = (
            projection.response(
                suspect, sim, suspect.starts()[0] | {q.key: float(f)}, [{suspect.phase: turn - a} for a in turned]
            )
            for turn in (np.pi / 2, 0.0)
        )
        if cos is None or sin is None:
            return []
        answers.append((cos + 1j * sin)[:, 0].reshape(-1, projection.outputs)[rows].reshape(-1))
    outputs = projection.outputs
    middle = np.repeat(np.repeat(middles, [len(e.time) for e in segments])[rows], outputs)
    take = (rows[:, None] * outputs + np.arange(outputs)).reshape(-1)
    own, _ = np.linalg.qr(projection.own[take])

    def gains(rest: np.ndarray) -> np.ndarray:
        left = rest[take] - own @ (own.T @ rest[take])
        return np.concatenate(
            [
                _gains(_between(known, np.array(answers), f) * np.exp(2j * np.pi * np.outer(f, middle)), own, left)
                for f in np.array_split(fine, len(fine) // CHUNK + 1)
            ]
        )

    from scipy.signal import find_peaks  # here: it loads scipy.stats, 0.4 s that most diagnoses never need

    projection.scans.append(lambda rest: gains(rest).max(axis=0))
    gain = gains(projection.rest[:, None])[:, 0]
    peaks, _ = find_peaks(np.pad(gain, 1), distance=3)
    best = sorted(peaks - 1, key=lambda k: -gain[k])[:keep]
    return [suspect.starts()[0] | {q.key: float(fine[k])} for k in best]


def _between(known: np.ndarray, answers: np.ndarray, f: np.ndarray) -> np.ndarray:
    """Lagrange's cubic through the four known frequencies around each `f`: (len(f), rows)."""
    first = np.clip(np.searchsorted(known, f) - 2, 0, len(known) - 4)
    x = known[first[:, None] + np.arange(4)]
    out = np.zeros((len(f), answers.shape[1]), dtype=complex)
    for k in range(4):
        others = [j for j in range(4) if j != k]
        weight = np.prod([(f - x[:, j]) / (x[:, k] - x[:, j]) for j in others], axis=0)
        out += weight[:, None] * answers[first + k]
    return out


def _gains(turned: np.ndarray, own: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """(f, k) gain of twice the log-likelihood forecast for sine and cosine together, of (rows, k) that are left."""
    parts = [part - (part @ own) @ own.T for part in (turned.real, turned.imag)]
    along = np.stack([part @ rest for part in parts], axis=1)
    square = np.array([[np.einsum("fr,fr->f", a, b) for a in parts] for b in parts]).transpose(2, 0, 1)
    square += 1e-9 * np.trace(square, axis1=1, axis2=2)[:, None, None] * np.eye(2) + 1e-300 * np.eye(2)
    return np.einsum("fik,fik->fk", along, np.linalg.solve(square, along))
