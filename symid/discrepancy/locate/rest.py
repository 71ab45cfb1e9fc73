"""What a fitted model still lacks, as a force along the motion: where, when, how large, and which way energy goes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from symid.discrepancy.locate.probe import force_responses
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.locate.spline_parts import chosen_blocks, numbers
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.sensors.independence import independent_share
from symid.estimation.signals.data import Data
from symid.estimation.signals.swings import swing
from symid.mechanics.coordinates import coordinate
from symid.mechanics.missing.spline_law import Block
from symid.mechanics.places import places
from symid.model import Model, Port

STRETCHES = 3
"""Parts of the window that are told apart."""
BINS = 5
"""Parts of a signal's range that are told apart."""
DEPENDENT = 1e-6
"""Directions of the force's unknowns that move the outputs this much less than others are left at zero."""


@dataclass(frozen=True)
class Stretch:
    """The force in one part of the samples.

    Attributes
    ----------
    span : start and end [s]. power, error : mean of force times rate and its standard error; of the force itself
        in a balance of first order, where nothing tells energy. rms : of the force. small : part of the samples
        at which the motion is smaller than its median.
    """

    span: tuple[float, float]
    power: float
    error: float
    rms: float
    small: float


@dataclass(frozen=True, eq=False)
class Rest:
    """The force that a fitted model lacks at one place, along the motion, SI.

    Attributes
    ----------
    model : with the port. port : where it acts. blocks : what the force follows.
    time, position, rate, amplitude, force, error : (N,) along all segments one after the other; `amplitude` is that
        of the swing around each sample, `error` the standard error of the force.
    ends : number of samples up to the end of each segment.
    whole, stretches : over the window, and over its parts in order of time (none where times of segments overlap).
    small, large : where the motion is smaller or larger than its median, `limit` [unit of the position].
    signals : (N,) of each expression that the force follows.
    explained : part of the innovations' power that the force explains, at best.
    """

    model: Model
    port: Port
    blocks: tuple[Block, ...]
    time: np.ndarray
    position: np.ndarray
    rate: np.ndarray
    amplitude: np.ndarray
    force: np.ndarray
    error: np.ndarray
    ends: np.ndarray
    whole: Stretch
    stretches: tuple[Stretch, ...]
    small: Stretch
    large: Stretch
    limit: float
    signals: dict
    explained: float

    @property
    def first_order(self) -> bool:
        """Whether the place has no rate of its own, so that nothing is said of energy."""
        return self.port.rate == 0

    def table(self) -> dict:
        """Its numbers for a file, SI."""
        parts = {"whole": self.whole, "small_amplitudes": self.small, "large_amplitudes": self.large}
        parts |= {f"third_{i}": s for i, s in enumerate(self.stretches, 1)}
        return {
            "location": self.port.at,
            "unit": self.port.unit,
            "follows": [str(s) for s in self.signals],
            "amplitude_limit": self.limit,
            "parts": {
                k: {"span_s": list(s.span), "power": s.power, "std_error": s.error, "rms": s.rms}
                for k, s in parts.items()
            },
        }


def rest_of(fit: Fit, data: Data) -> Rest | None:
    """The force that explains most of what a fit leaves, at the place and along the states that the data choose.

    It is estimated with the fit's own parameters as they are, so that it is what has to be added to this very model:
    whitened least squares of the innovations on the responses to splines of the states, in each part of the window
    (linear around the fit, so that a large rest is told roughly). None where no place explains anything.
    """
    free = Projection(fit, data)
    ranked = sorted((chosen_blocks(fit, data, p, free) for p in places(fit.model)), key=lambda c: -c[0])
    if not ranked or not ranked[0][0] > 0:
        return None
    _, port, blocks = ranked[0]
    edges, signals = _edges(data), fitted_signals(fit, data)
    time = np.concatenate([e.time for e in data.segments])
    shapes = np.hstack([numbers(b, signals, fit.model) for b in blocks])
    within = np.searchsorted(edges, time, side="right")
    courses = np.hstack([shapes * (within == k)[:, None] for k in range(len(edges) + 1)])
    projection = Projection(fit, data, known=tuple(fit.values))
    columns = force_responses(projection, port, courses)
    if columns is None:
        return None
    estimate = _least_squares(projection, columns)
    return _described(fit, data, port, blocks, signals, courses, within, estimate)


def _edges(data: Data) -> tuple[float, ...]:
    """Times that cut the window into equal stretches; none where the times of its segments overlap."""
    if any(b.time[0] < a.time[-1] for a, b in zip(data.segments[:-1], data.segments[1:], strict=True)):
        return ()
    t0, t1 = data.span
    return tuple(t0 + (t1 - t0) * k / STRETCHES for k in range(1, STRETCHES))


def _least_squares(projection: Projection, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Coefficients, their covariance, and the part of the power that they explain."""
    a, rest = projection.project(columns), projection.rest
    size = np.sqrt((a**2).sum(0)) + 1e-300
    u, s, vt = np.linalg.svd(a / size, full_matrices=False)
    use = s > DEPENDENT * s[0]
    u, inverse = u[:, use], vt[use].T / s[use]
    left = rest - u @ (u.T @ rest)
    shapes = [e.recorded.shape for e in projection.data.segments]
    pieces = np.split(left, np.cumsum([n * m for n, m in shapes])[:-1])
    share = independent_share([p.reshape(shape) for p, shape in zip(pieces, shapes, strict=True)])
    power = float(left @ left) / max(len(left) - int(use.sum()), 1) / share
    inverse = inverse / size[:, None]
    return inverse @ (u.T @ rest), power * inverse @ inverse.T, 1 - float(left @ left) / float(rest @ rest)


def _described(fit, data, port, blocks, signals, phi, within, estimate) -> Rest:
    """From the shapes of the force along the motion and their coefficients to a Rest."""
    (coefficients, covariance, explained), model = estimate, fit.model
    time = np.concatenate([e.time for e in data.segments])
    position, rate = (
        along(signals, e, model) if e != 0 else np.zeros(len(signals)) for e in (coordinate(port), port.rate)
    )
    force = phi @ coefficients
    ends = np.cumsum([len(e.time) for e in data.segments])
    amplitude = _amplitude(position, data)
    limit = float(np.median(amplitude))
    conjugate = rate if port.rate != 0 else np.ones_like(rate)

    def stretch(mask: np.ndarray) -> Stretch:
        w = (phi[mask] * conjugate[mask, None]).mean(0)
        return Stretch(
            (float(time[mask][0]), float(time[mask][-1])),
            float(w @ coefficients),
            float(np.sqrt(max(w @ covariance @ w, 0.0))),
            float(np.sqrt(np.mean(force[mask] ** 2))),
            float(np.mean(amplitude[mask] <= limit)),
        )

    return Rest(
        model,
        port,
        blocks,
        time,
        position,
        rate,
        amplitude,
        force,
        np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", phi, covariance, phi), 0.0)),
        ends,
        stretch(np.ones(len(time), dtype=bool)),
        tuple(stretch(within == k) for k in range(within.max() + 1)) if within.max() else (),
        stretch(amplitude <= limit),
        stretch(amplitude > limit) if np.any(amplitude > limit) else stretch(amplitude >= limit),
        limit,
        {s: along(signals, s, model) for b in blocks for s in b.signals},
        explained,
    )


def _amplitude(position: np.ndarray, data: Data) -> np.ndarray:
    """(N,) amplitude of the sine with the mean square of the swing around each sample, about the mean."""
    squares, found, begin = (position - position.mean()) ** 2, [], 0
    for e in data.segments:
        own = squares[begin : begin + len(e.time)]
        width = int(np.clip(swing(e) / e.step, 1, len(own)))
        total = np.concatenate([[0.0], np.cumsum(own)])
        low = np.clip(np.arange(len(own)) - width // 2, 0, len(own) - width)
        found.append(np.sqrt(2 * (total[low + width] - total[low]) / width))
        begin += len(e.time)
    return np.concatenate(found)


def bins_of(values: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges (BINS + 1,) of equal parts of a signal's range, and the force's rms (BINS,) there; NaN of few samples."""
    edges = np.linspace(*np.quantile(values, (0.005, 0.995)), BINS + 1)
    where = np.clip(np.searchsorted(edges, values) - 1, 0, BINS - 1)
    rms = [np.sqrt(np.mean(force[where == k] ** 2)) if np.mean(where == k) > 0.01 else np.nan for k in range(BINS)]
    return edges, np.array(rms)


def ranges_of(rest: Rest) -> Sequence[tuple[object, np.ndarray, np.ndarray]]:
    """For each signal that the force follows: the signal, edges and rms of `bins_of`."""
    return [(s, *bins_of(values, rest.force)) for s, values in rest.signals.items()]
