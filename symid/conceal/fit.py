"""Least squares of free simulations: what a model without the concealed effect can absorb.

Kept apart from the diagnosis, so that the sealed figures do not come from what they judge.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from symid.errors import SymidError
from symid.estimation.signals.segment import Segment
from symid.model import Model
from symid.simulation import simulator

DIVERGED = 1e3
"""Error [rad or SI] that stands for a run that left every range."""


@dataclass(frozen=True, eq=False)
class FreeFit:
    """Parameters, one initial state per segment (E, n), and what they simulate, (N, m) per segment."""

    values: dict[str, float]
    initial: np.ndarray
    simulated: tuple[np.ndarray, ...]

    def rms(self, segments: Sequence[Segment], settling: float = 0.0) -> float:
        """Root mean square of recorded minus simulated, without the first seconds of the first segment."""
        begin = segments[0].time[0] + settling
        errors = [(e.recorded - y)[e.time >= begin] for e, y in zip(segments, self.simulated, strict=True)]
        return float(np.sqrt(np.mean(np.vstack(errors) ** 2)))


def fit_free(
    model: Model,
    segments: Sequence[Segment],
    values: Mapping[str, float],
    initial: np.ndarray,
    free: Sequence[str] | None = None,
    white: Callable[[np.ndarray], np.ndarray] = lambda errors: errors,
    most: int = 60,
) -> FreeFit:
    """Fit parameters (all, or those in `free`) and initial states to free simulations of `segments`.

    Parameters
    ----------
    values, initial : where the search begins; (E, n) states.
    white : filter of errors (N, m, ...) along time, whose output is made small. most : evaluations.

    Raises
    ------
    SymidError : the model diverges from there.
    """
    sim = simulator(model.with_unstated_holds("linear"))
    names = list(sim.parameters if free is None else free)
    E, n, q = len(segments), len(sim.states), len(names)
    low = np.array([model.parameters[k].bounds[0] for k in names] + [-np.inf] * (E * n))
    high = np.array([model.parameters[k].bounds[1] for k in names] + [np.inf] * (E * n))
    start = np.clip(np.concatenate([[values[k] for k in names], np.ravel(initial)]), low, high)

    def run(z, sensitivities):
        p = dict(values) | dict(zip(names, z[:q], strict=True))
        return [
            sim.simulate(
                p,
                x0,
                e.time,
                e.inputs,
                substeps=_substeps(e),
                keep="outputs",
                sensitivity=names if sensitivities else (),
                initial_sensitivity=sim.states if sensitivities else (),
            )
            for e, x0 in zip(segments, z[q:].reshape(E, n), strict=True)
        ]

    def errors(z):
        return np.concatenate(
            [
                white(np.nan_to_num(t.y - e.recorded, nan=DIVERGED)).ravel()
                for t, e in zip(run(z, False), segments, strict=True)
            ]
        )

    def slopes(z):
        blocks = [white(np.nan_to_num(t.dy)).reshape(-1, q + n) for t in run(z, True)]
        out, row = np.zeros((sum(map(len, blocks)), q + E * n)), 0
        for i, b in enumerate(blocks):
            out[row : row + len(b), :q] = b[:, :q]
            out[row : row + len(b), q + i * n : q + (i + 1) * n] = b[:, q:]
            row += len(b)
        return out

    if any(t.diverged for t in run(start, False)):
        raise SymidError(f"model '{model.name}' diverges where its fit begins")
    z = least_squares(
        errors, start, slopes, bounds=(low, high), x_scale="jac", max_nfev=most, ftol=1e-7, xtol=1e-9, gtol=1e-12
    ).x
    return FreeFit(
        dict(values) | dict(zip(names, map(float, z[:q]), strict=True)),
        z[q:].reshape(E, n),
        tuple(t.y for t in run(z, False)),
    )


def simulate_free(
    model: Model, segments: Sequence[Segment], values: Mapping[str, float], initial: np.ndarray
) -> FreeFit:
    """What these values simulate, without fitting anything."""
    sim = simulator(model.with_unstated_holds("linear"))
    runs = [
        sim.simulate(values, x0, e.time, e.inputs, substeps=_substeps(e), keep="outputs")
        for e, x0 in zip(segments, initial, strict=True)
    ]
    return FreeFit(dict(values), np.asarray(initial), tuple(t.y for t in runs))


def _substeps(segment: Segment) -> int:
    return max(1, int(np.ceil(segment.step / 0.0101)))
