"""Does a joint's stiffness or damping come and go? Its motion times sines of every frequency, as a force.

A loop that is nearly linear answers a short push alike at all times: its answer to any force is
that to a push, convolved with the force (Duhamel 1833). So one simulation serves all frequencies.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import fftconvolve

from symid.discrepancy.locate.flexible import along, fitted_path
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.suspects import Suspect
from symid.mechanics.unknown_laws import SHORT_PUSH
from symid.model import Port
from symid.simulation import simulator

HIGHEST = 2.0
"""Up to here a change of stiffness or damping is looked for [Hz]."""
SPACING = 0.5
"""Spacing of the frequencies, in parts of one over the recording."""
LASTS = 10.0
"""So long the answer to a push is followed [s]."""
PARTS = 4
"""Position and rate, each times sine and cosine."""


def modulated(projection: Projection) -> list[tuple[str, float, int]]:
    """Place, largest gain of twice the log-likelihood with `PARTS` coefficients, and how many frequencies were tried.

    Nothing where random forces do not act, pieces of the recording have each a start of their own, or it is too short.
    """
    data, model, found = projection.data, projection.fit.model, []
    time = data.segments[0].time - data.segments[0].time[0]
    frequencies = np.arange(1.5, HIGHEST * time[-1], SPACING) / time[-1]
    if not data.driven or len(data.segments) > 1 or not len(frequencies):
        return found
    path = fitted_path(projection.fit, data)
    for port in (p for p in model.ports.values() if p.role == "joint"):
        answer = _answer(projection, port)
        if answer is None:
            continue
        motion = [along(path, expr, model) for expr in (port.position, port.rate)]
        motion = [(x - x.mean()) / (x.std() or 1.0) for x in motion]
        gains = [
            projection.score(
                np.column_stack(
                    [_to_force(answer, x * wave(2 * np.pi * f * time)) for x in motion for wave in (np.sin, np.cos)]
                )
            )[0]
            for f in frequencies
        ]
        found.append((port.at, max(gains), len(frequencies)))
    return found


def _answer(projection: Projection, port: Port) -> np.ndarray | None:
    """(K, m) whitened change of the predictions after a push at a joint, sample by sample."""
    suspect, segment = Suspect(SHORT_PUSH.at(port.at), established=False), projection.data.segments[0]
    start = len(segment.time) // 2
    column = projection.response(
        suspect,
        simulator(projection.fit.model.with_term(suspect.term)),
        {"impulse_Nms": 0.0, "time_s": float(segment.time[start])},
    )
    return None if column is None else column.reshape(-1, projection.outputs)[start : start + int(LASTS / segment.step)]


def _to_force(answer: np.ndarray, force: np.ndarray) -> np.ndarray:
    """(N m,) answer to a force (N,), up to a factor."""
    return fftconvolve(force[:, None], answer, axes=0)[: len(force)].reshape(-1)
