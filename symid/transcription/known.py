"""The known numbers of every episode: data of its intervals and samples, constants and scales."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.codegen import Kernel
from symid.codegen.equations.interval import equations_over
from symid.codegen.equations.symbols import own_points, used_data
from symid.codegen.ode import UNSTATED
from symid.model import Model
from symid.transcription.data import Measured
from symid.transcription.guesses import guesses
from symid.transcription.layout import Layout
from symid.transcription.program import EpisodeData
from symid.transcription.scales import INCREMENT, equation_scale, scale_in_equations
from symid.transcription.schemes import Scheme


def episode_data(
    model: Model,
    scheme: Scheme,
    m: Measured,
    noise: np.ndarray,
    refine: int,
    graded: bool,
    gaps: bool,
    loss: dict[str, float],
) -> EpisodeData:
    """Known numbers of one episode, in the order of `interval_program` and `objective_program`."""
    points = [
        input_at(model, scheme, m, str(u), c, refine)
        for c in scheme.stencil.abscissae
        for u in used_data(model, model.residual())
    ]
    columns = np.column_stack(points) if points else np.zeros((m.intervals * refine, 0))
    shown = (
        []
        if m.targets is None
        else [m.time if str(u) == "t" else m.inputs[str(u)] for u in used_data(model, model.observed())]
    )
    nodes = np.zeros((m.intervals + 1, 0)) if m.targets is None else m.targets[m.nodes]
    return EpisodeData(
        interval=np.ascontiguousarray(
            np.hstack([columns, np.repeat(noise, refine, axis=0), *interval_steps(m, refine, graded)])
        ),
        node=np.ascontiguousarray(np.column_stack([*(u[m.nodes] for u in shown), nodes])),
        noise=noise,
        step=m.step,
        loss=np.hstack(
            [
                _present(m) if gaps else np.zeros((len(nodes), 0)),
                np.tile([loss[y] for y in model.outputs if y in loss], (len(nodes), 1)),
            ]
        ),
    )


def _present(m: Measured) -> np.ndarray:
    """(samples, m) one where an output of the window was recorded, else zero."""
    targets = m.targets[m.nodes]
    return np.ones(targets.shape) if m.present is None else m.present[m.nodes].astype(float)


def interval_steps(m: Measured, refine: int, graded: bool) -> list[np.ndarray]:
    """On a graded mesh one column, (intervals, 1): the length of each collocation interval."""
    return [np.repeat(m.steps / refine, refine)[:, None]] if graded else []


def input_at(model: Model, scheme: Scheme, m: Measured, name: str, abscissa: float, refine: int) -> np.ndarray:
    """(intervals,) an input, or time, at a point of each collocation interval."""
    if name == "t":
        return m.times(abscissa, refine)
    hold = model.inputs[name].hold
    if hold == "smooth" and scheme.order <= 2 and refine == 1:  # it sees the samples alone, as in the article
        hold = "linear"
    return m.input_at(name, abscissa, refine, UNSTATED.get(hold, hold))


def values_of(model: Model) -> np.ndarray:
    """(constants,) in the order of `codegen.symbols.constant_symbols`."""
    sizes = [1.0 if p.size is None else p.size for p in model.processes.values()]  # 1 until it is estimated
    return np.array([*(c.value for c in model.constants.values()), *sizes], dtype=float)


def scales(layout: Layout) -> np.ndarray:
    """The scales in the order of `codegen.symbols.scales`."""
    apart = layout.own_scale if not set(layout.own_names) & set(layout.beside_names) else []
    return np.concatenate([layout.node_scale, apart, layout.parameter_scale[layout.parameter_index[0]]])


def interval_constants(
    model: Model,
    scheme: Scheme,
    interval: Kernel,
    layout: Layout,
    measured: Sequence[Measured],
    data: Sequence[EpisodeData],
    recording_of: Sequence[int],
    parameters: np.ndarray,
    graded: bool,
) -> tuple[np.ndarray, ...]:
    """Per episode: the constants of `interval_program`, with equation scales found at the recorded motion.

    parameters : (free parameters,) SI, at which the scales are found.
    """
    first, over = measured[recording_of[0]], np.isin(np.arange(len(model.equations)), equations_over(model))
    states = [measured[r].on_mesh(measured[r].states[measured[r].nodes], layout.refine) for r in recording_of]
    equation, step = equation_of_rows(model, scheme)[interval.jacobian_rows], first.step / layout.refine
    counted = (interval.jacobian_cols < interval.n_local) & (equation >= 0)
    by_motion = replace(layout, state_scale=scale_in_equations(measured, layout.state_scale))

    def largest(at):
        z = by_motion.fill(states, at)
        slopes = interval.jacobian(
            by_motion.local_view(z, 0),
            z[by_motion.parameter_columns(0)],
            data[0].interval,
            interval_constants_of(model, by_motion, data[0], np.ones(len(over)), graded),
        )
        steps = data[0].interval[:, -1:] if graded else np.full((len(slopes), 1), step)
        typical = steps if first.targets is None else 1 / INCREMENT
        return equation_scale(
            equation[counted], slopes[:, counted], len(over), np.where(over[equation[counted]], typical, 1.0)
        )

    scale = largest(parameters)
    if not scale.all():  # an unknown mass, for instance
        scale = np.where(scale > 0, scale, largest(guesses(model, layout)))
    scale = np.where(scale > 0, scale, 1.0)
    of_step = over & (first.targets is not None)
    return tuple(
        interval_constants_of(model, layout, d, np.where(of_step, scale * data[0].step / d.step, scale), graded)
        for d in data
    )


def interval_constants_of(
    model: Model, layout: Layout, data: EpisodeData, equations: np.ndarray, graded: bool
) -> np.ndarray:
    """The constants of `interval_program` for one episode. equations : scales of the equations."""
    return np.concatenate([values_of(model), [] if graded else [data.step / layout.refine], scales(layout), equations])


def equation_of_rows(model: Model, scheme: Scheme) -> np.ndarray:
    """(rows of an interval,) place of the equation that each row comes from; -1 for collocation defects."""
    over, stencil = equations_over(model), scheme.stencil
    apart = [i for i in range(len(model.equations)) if i not in over]
    return np.array(
        [
            *(list(over) * len(stencil.weights)),
            *(apart * len(own_points(model, stencil))),
            *([-1] * len(stencil.defects) * len(model.states)),
        ],
        dtype=int,
    )


def row_names(model: Model, scheme: Scheme) -> tuple[str, ...]:
    names, states = list(model.equations), list(model.states) * len(scheme.stencil.defects)
    equation = equation_of_rows(model, scheme)
    return (
        *(f"equation {names[i]}" for i in equation if i >= 0),
        *(f"collocation defect of state {s}" for s in states),
    )


def error_constants(model: Model, layout: Layout) -> np.ndarray:
    """What `objective_program` and `output_program` know beside the weights of the outputs."""
    return np.concatenate([values_of(model), scales(layout)])
