"""Which splines make up a law without a formula at a place: chosen by what they are forecast to explain."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from symid.discrepancy.locate.probe import force_responses
from symid.discrepancy.locate.projection import Projection
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.path import along, fitted_signals
from symid.estimation.sensors.independence import independent_share, price_of_one
from symid.estimation.signals.data import Data
from symid.mechanics.missing.spline_law import Block, knots_of
from symid.mechanics.places import other_signals
from symid.model import Model, Port, Term

KNOTS = 7
"""Of one spline where parts are chosen."""
MOST_PARTS = 3
"""Of one flexible law."""
DEPENDENT = 1e-9
"""Directions of the unknowns along which the outputs' squares change so much less than along others do not count."""


def chosen_blocks(
    fit: Fit, data: Data, port: Port, projection: Projection, force: Callable[[np.ndarray], np.ndarray] | None = None
) -> tuple[float, Port, tuple[Block, ...]]:
    """Forecast worth of the best set of parts at a port, found by adding and leaving out.

    Parameters
    ----------
    projection : of `fit`, or of one with a flexible law at the port. force : of that law, (N, n + u) states and inputs
        -> (N,).
    """
    parts, signals = candidate_blocks(fit, data, port), fitted_signals(projection.fit, data)
    shapes = [numbers(b, signals, fit.model) for b in parts]
    columns = force_responses(projection, port, np.hstack(shapes))
    if columns is None:
        return -np.inf, port, ()
    columns = np.split(columns, np.cumsum([s.shape[1] for s in shapes])[:-1], axis=1)
    rest = projection.rest
    if force is not None:
        # What the law explains now, any set of parts has to explain in its place.
        own = force_responses(projection, port, force(signals)[:, None])
        rest = rest + projection.project(own[:, 0])
    forecast = _Forecast(projection, columns, rest)
    best: tuple[int, ...] = ()
    while True:
        moves = [tuple(sorted({*best, i})) for i in range(len(parts)) if i not in best and len(best) < MOST_PARTS]
        moves += [tuple(j for j in best if j != i) for i in best if len(best) > 1]
        share = forecast.share(best)
        better = max(moves, key=lambda chosen: forecast.worth(chosen, share), default=best)
        share = forecast.share(max(better, best, key=len))
        if forecast.worth(better, share) <= forecast.worth(best, share) + 1e-9:
            return forecast.worth(best, forecast.share(best)), port, tuple(parts[i] for i in best)
        best = better


class _Forecast:
    """What sets of parts would explain of the innovations `rest`, forecast from their responses."""

    def __init__(self, projection: Projection, columns: list[np.ndarray], rest: np.ndarray):
        self.rest, self.samples = rest, projection.data.samples
        self.shapes = [e.recorded.shape for e in projection.data.segments]
        a = projection.project(np.hstack(columns))
        self.columns = a / (np.sqrt((a**2).sum(0)) + 1e-300)
        self.gram, self.onto = self.columns.T @ self.columns, self.columns.T @ rest
        ends = np.cumsum([c.shape[1] for c in columns])
        self.where = [np.arange(end - c.shape[1], end) for c, end in zip(columns, ends, strict=True)]
        self.total, self.shares = float(rest @ rest), {}

    def explained(self, chosen: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, int]:
        """Columns of some parts, their coefficients, and how many directions of them count."""
        use = np.concatenate([self.where[i] for i in chosen])
        size, directions = np.linalg.eigh(self.gram[np.ix_(use, use)])
        directions = directions[:, size > DEPENDENT * size[-1]]
        size = size[size > DEPENDENT * size[-1]]
        return use, directions @ ((directions.T @ self.onto[use]) / size), len(size)

    def share(self, chosen: tuple[int, ...]) -> float:
        """Part of the samples that what the parts leave lets count as independent."""
        if chosen not in self.shares:
            left = self.rest
            if chosen:
                use, coefficients, _ = self.explained(chosen)
                left = left - self.columns[:, use] @ coefficients
            pieces = np.split(left, np.cumsum([n * m for n, m in self.shapes])[:-1])
            self.shares[chosen] = independent_share(
                [p.reshape(shape) for p, shape in zip(pieces, self.shapes, strict=True)]
            )
        return self.shares[chosen]

    def worth(self, chosen: tuple[int, ...], share: float) -> float:
        """Twice the log-likelihood of independent samples, the noise estimated anew, less log N for each unknown."""
        if not chosen:
            return 0.0
        use, coefficients, size = self.explained(chosen)
        left = max(self.total - float(coefficients @ self.onto[use]), 1e-9 * self.total)
        gain = -len(self.rest) * np.log(left / self.total)
        return share * gain - price_of_one(share * self.samples) * size


def candidate_blocks(fit: Fit, data: Data, port: Port, count: int = KNOTS) -> list[Block]:
    """Splines of position, of rate, each times the other, and of the other states, alone and times the rate."""
    signals, model = fitted_signals(fit, data), fit.model

    def block(signal, times=1) -> Block | None:
        values = along(signals, signal, model)
        return Block(signal, times, knots_of(values, count)) if np.ptp(values) > 0 and times != 0 else None

    x, v = port.position, port.rate
    one = x * 0 + 1
    pairs = [(x, one)] + ([(v, one), (x, v), (v, x)] if v != 0 else [])
    for s in other_signals(model, port):
        pairs += [(s, one)] + ([(s, v)] if v != 0 else [])
    return [b for b in (block(*p) for p in pairs) if b is not None]


def numbers(block: Block, signals: np.ndarray, model: Model) -> np.ndarray:
    """(N, unknowns) what each unknown of a part is multiplied by along states and inputs (N, n + u)."""
    times = 1.0 if block.times == 1 else along(signals, block.times, model)
    return block.basis(along(signals, block.along, model), times)


def names_of(term: Term) -> list[str]:
    """The term's parameters as a model calls them."""
    return [term.parameter_name(q.key) for q in term.law.parameters]
