"""How long a motion can be followed from one state: where things turn over, a small difference soon is a large one."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model, fit_states
from symid.estimation.fitting.fit import Fit
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import cut
from symid.estimation.signals.segment import FEWEST, Segment
from symid.model import Model

GROWTH = 30.0
"""A piece is followed as long as a difference of its states grows no more than so many times: beyond that, a fit of its
parameters has many optima (Ribeiro et al. 2020). A free pendulum comes there after thirty wide swings."""
MOST_GROWTH = 1e3
"""Pieces that a fit has found may grow by so much. In eight seconds of an inverted pendulum whose motor follows a
recording the last steps of its encoders grew until they looked like a law."""
LOST = 0.3
"""A fit that leaves more than this part of a motion may move so differently that its growth says nothing of the
recorded one: a pendulum that goes over the top another time. Shorter pieces are asked then."""
SHORTEST = 1.0
"""Pieces that do not grow beyond that last at least so many seconds at the pace of one: shorter ones hide losses behind
their initial states."""
SMALL = 1e-6
"""The difference that is followed, as a part of how much each state moves."""


def followed(
    model: Model, data: Data, fit: Fit, start: Mapping[str, float], near: Callable[[Fit, Data], bool]
) -> float | None:
    """Seconds for which a motion can be followed from one state; None where it can as long as the segments are.

    Parameters
    ----------
    fit : of the model to the data, however far from them. start : values [SI] from which pieces are fitted.
    near : whether a fit has found the motion, so that its pieces need not be shorter.
    """
    whole = length = max(e.time[-1] - e.time[0] for e in data.segments)
    pieces, grows = data, largest_growth(fit, data)
    if lost(fit, data):
        length = _held_together(model, data, start, whole)
    sensitive = grows > GROWTH or length < whole
    if not (sensitive or lost(fit, data)):
        return None
    try:
        if length < whole:
            pieces = _parts(data, length)
            fit = fit_model(model, pieces, dict(start))
            grows = largest_growth(fit, pieces)
        while length / 2 > _shortest(grows, data) and not (grows <= MOST_GROWTH and near(fit, pieces)):
            length /= 2
            pieces = _parts(data, length)
            fit = fit_model(model, pieces, dict(start))
            grows = largest_growth(fit, pieces)
            sensitive = sensitive or grows > GROWTH
            if not (sensitive or lost(fit, pieces)):
                return None
    except SymidError:
        return None
    return length if sensitive and length < whole else None


def _parts(data: Data, length: float) -> Data:
    return data.with_segments(part for e in data.segments for part in cut(e, length))


def _held_together(model: Model, data: Data, start: Mapping[str, float], whole: float) -> float:
    """Seconds for which the motion does not grow away from recorded states, with parameters from which fits begin.

    All of its time where it does so in the shortest pieces, too: then these parameters say nothing.
    """
    length = whole
    while length / 2 > FEWEST * data.segments[0].step:
        pieces = _parts(data, length)
        try:
            if largest_growth(fit_states(model, pieces, start), pieces) <= MOST_GROWTH:
                return length
        except SymidError:
            pass
        length /= 2
    return whole


def _shortest(grows: float, data: Data) -> float:
    """Seconds that pieces last at least whose small differences grow so many times."""
    if grows > MOST_GROWTH:
        return FEWEST * max(e.step for e in data.segments)
    return SHORTEST * data.pace


def lost(fit: Fit, data: Data) -> bool:
    """Whether a fit leaves more than the part `LOST` of what an output moves."""
    moves = np.vstack([e.recorded for e in data.segments]).std(axis=0)
    return bool(np.any(fit.rms_errors > LOST * moves))


def largest_growth(fit: Fit, data: Data) -> float:
    """Of the differences of all pieces, as `growth` tells it of one."""
    return max(
        growth(fit, e, x0, data.pace, data.sensor_noise) for e, x0 in zip(data.segments, fit.initial, strict=True)
    )


def growth(fit: Fit, segment: Segment, start: np.ndarray, pace: float, noise: np.ndarray) -> float:
    """Largest difference of the outputs after a small one of any state, over the largest within the pace.

    Times what the states themselves grow within the pace: that of a balanced pendulum is far slower than its fall.
    """
    run = segment.simulate(fit.simulator, fit.values, start, **fit.steps)
    early, found, sizes = max(2, int(pace / segment.step)), 1.0, run.x.std(axis=0)
    moves, columns = np.flatnonzero(sizes), []
    for j in moves:
        moved = start + SMALL * sizes[j] * (np.arange(len(start)) == j)
        other = segment.simulate(fit.simulator, fit.values, moved, **fit.steps)
        apart = np.linalg.norm((other.y - run.y) / noise, axis=1)
        found = max(found, float(np.nan_to_num(apart, nan=np.inf).max()) / max(float(apart[:early].max()), 1e-300))
        columns.append((other.x - run.x)[:early, moves] / sizes[j] / SMALL)
    return found * _unstable(np.stack(columns, axis=-1)) if columns else found


def _unstable(transition: np.ndarray) -> float:
    """Largest absolute eigenvalue of (N, n, n) transition matrices, at least 1, whatever the units of the states."""
    if not np.all(np.isfinite(transition)):
        return float("inf")
    return max(1.0, float(np.abs(np.linalg.eigvals(transition)).max()))
