"""How predictions answer to small forces of any course in time, added to a fitted model at one of its places."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.hypothesis import padded
from symid.estimation.signals.segment import Segment
from symid.mechanics.places import places
from symid.model import Input, Model, Parameter, Port
from symid.simulation import simulator

SIZE = "probe_size"


def probed(model: Model) -> Model:
    """The model with an input at each of its places that acts there as a force, times one parameter."""
    new = model.copy()
    setattr(new, SIZE, Parameter(unit="1"))
    for port in places(model):
        setattr(new, _name(port), Input(unit=port.unit, hold="linear"))
        new.add_effort(port.name, new[SIZE].symbol * new[_name(port)].symbol)
    return new


def _name(port: Port) -> str:
    return f"probe_{port.name}"


def force_responses(projection: Projection, port: Port, forces: np.ndarray) -> np.ndarray | None:
    """(N m, K) whitened change of the predictions per unit of each force (N, K) [SI] at `port`.

    Exact derivatives at the fit of the projection, one run for each force; None where a run diverges.
    """
    fit, data = projection.fit, projection.data
    model = probed(fit.model)
    sim, off = simulator(model), [_name(p) for p in places(fit.model)]
    ends = np.cumsum([len(e.time) for e in data.segments])
    out = []
    for e, x0, course in zip(data.segments, fit.initial, np.split(forces, ends[:-1]), strict=True):
        silent = {name: np.zeros((len(e.time) - 1) * e.ratio + 1) for name in off}
        answers = []
        for force in course.T:
            run = replace(e, inputs={**e.inputs, **silent, _name(port): _at_inputs(e, force)}).simulate(
                sim,
                fit.values | {SIZE: 0.0},
                x0,
                padded(fit.kalman_gain, sim),
                sensitivity=[SIZE],
                keep="outputs",
                **projection.steps,
            )
            if run.diverged:
                return None
            answers.append(run.dy[:, :, 0])
        out.append(np.stack(answers, axis=2))
    return projection.whiten(out)


def _at_inputs(segment: Segment, values: np.ndarray) -> np.ndarray:
    """Values at the samples of the outputs, at those of the inputs."""
    n = len(values)
    return np.interp(np.arange((n - 1) * segment.ratio + 1) / segment.ratio, np.arange(n), values)
