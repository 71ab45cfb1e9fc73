"""The scales of an identification, found from its recordings and its equations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.codegen import Kernel
from symid.codegen.equations.interval import late_signals
from symid.model import Model
from symid.transcription.data import Measured
from symid.transcription.guesses import first_guess, parameter_guesses
from symid.transcription.known import equation_of_rows, error_constants, interval_constants_of
from symid.transcription.layout import Layout
from symid.transcription.program import EpisodeData
from symid.transcription.scales import (
    Sizes,
    hidden_scale,
    natural_size,
    parameter_scale,
    rate_scale,
    seen_scale,
    state_scale,
    variation,
)
from symid.transcription.schemes import Scheme


def scaled_by_data(
    model: Model,
    scheme: Scheme,
    interval: Kernel,
    error: Kernel,
    layout: Layout,
    measured: Sequence[Measured],
    data: Sequence[EpisodeData],
    recording_of: Sequence[int],
    weights: np.ndarray,
    graded: bool,
) -> Layout:
    """`layout`, whose states have no scale yet, with the scales of states and parameters that the recordings suggest.

    weights : (recordings, m) of the time integrals of the squared output errors.
    """
    layout = replace(layout, parameter_scale=np.ones(len(layout.parameter_names)))
    bounds = np.array([s.bounds for s in model.states.values()], dtype=float).reshape(-1, 2)

    def sizes(hidden, parameters):
        return _sizes(model, scheme, interval, layout, measured, data, recording_of, graded, hidden, parameters)

    hidden, states = first_guess(bounds), state_scale(measured)
    shown = np.isfinite(states)
    if np.isnan(states).any():
        hidden, loose = hidden_scale(sizes(hidden, parameter_guesses(model)).states, states)
        if loose.any():
            at_rest = sizes(np.where(loose, 0.0, hidden), parameter_guesses(model)).parameters
            hidden = _beside_inputs(model, loose, hidden, at_rest)
        states = hidden
    natural = natural_size(sizes(hidden, parameter_guesses(model, small=True)), rate_scale(measured, states))
    parameters = np.ones(len(layout.parameter_names))
    parameters[layout.parameter_index] = parameter_scale(model.parameters.values(), natural)
    curvature = _curvature(model, error, layout, measured, data, recording_of, weights, hidden)
    scale = seen_scale(states, shown * curvature, float(np.mean(variation(measured, weights))) / len(model.outputs))
    by_name = dict(zip(model.states, scale, strict=True))
    late = [
        by_name.get(str(model.delays[y].of), s) for y, s in zip(late_signals(model), layout.late_scale, strict=True)
    ]
    return replace(layout, state_scale=scale, parameter_scale=parameters, late_scale=np.array(late))


def _beside_inputs(model: Model, loose: np.ndarray, scale: np.ndarray, at_rest: np.ndarray) -> np.ndarray:
    """`scale` (n,), with that of each `loose` state so large as what a parameter multiplies beside it.

    The lag of a filter multiplies the difference of its input and its state: that says of how many volts the state is,
    before the lag is known.

    at_rest : (equations, q) sizes of the derivatives to the parameters where these states are zero.
    """
    out, parameters = scale.copy(), list(model.parameters.values())
    residuals, states = model.residual(), [s.symbol for s in model.states.values()]
    for i in np.flatnonzero(loose):
        found = []
        for e, q in np.argwhere(at_rest > 0):
            own = residuals[e].diff(parameters[q].symbol, states[i])
            if own.is_number and own != 0:
                found.append(at_rest[e, q] / abs(float(own)))
        out[i] = min(found, default=scale[i])
    return out


def _curvature(
    model: Model, error: Kernel, layout: Layout, measured, data, recording_of, weights, hidden
) -> np.ndarray:
    """(n,) second derivatives of a recording's objective to a state at all its samples, in the mean of recordings."""
    n, total = layout.n, np.zeros(layout.n + 1)  # the last entry takes what is no second derivative of a state
    own = np.where((error.hessian_rows == error.hessian_cols) & (error.hessian_rows < n), error.hessian_rows, n)
    for r, m in enumerate(measured):
        known, states = data[recording_of.index(r)], m.states[m.nodes]
        local = np.zeros((len(states), layout.width))
        local[:, :n] = np.where(np.any(states != 0, axis=0), states, hidden)
        shown, of_outputs = (
            np.hstack([known.node, known.loss]),
            np.concatenate([error_constants(model, layout), weights[r]]),
        )
        index = np.ascontiguousarray(np.broadcast_to(own, (len(states), len(own))), dtype=np.int32)
        steps = np.full((len(states), 1), m.step / len(measured))
        error.hessian_into(total, index, local, parameter_guesses(model), shown, of_outputs, steps)
    return np.nan_to_num(total[:n], nan=0.0, posinf=0.0)


def _sizes(
    model, scheme, interval: Kernel, layout: Layout, measured, data, recording_of, graded, hidden, parameters
) -> Sizes:
    """Sizes at the recorded motion and these parameters (q,), in the first episode.

    hidden : (n,) values of the states that nothing recorded shows.
    """
    m, n, equations = measured[recording_of[0]], layout.n, len(model.equations)
    states = m.states[m.nodes]
    nodes = m.on_mesh(np.where(np.any(states != 0, axis=0), states, hidden), layout.refine)
    z = layout.fill([nodes], np.zeros(len(layout.parameter_names)))
    z[layout.parameter_columns(0)] = parameters
    arguments = (
        layout.local_view(z, 0),
        z[layout.parameter_columns(0)],
        data[0].interval,
        interval_constants_of(model, layout, data[0], np.ones(equations), graded),
    )
    # An expression may have no value at the recorded motion: the solver says so, in words.
    residual, slopes = (
        np.nan_to_num(np.abs(f(*arguments)), nan=0.0, posinf=0.0) for f in (interval.residual, interval.jacobian)
    )
    rows, columns = equation_of_rows(model, scheme)[interval.jacobian_rows], interval.jacobian_cols
    state_of = np.full(layout.local + interval.n_shared, -1)
    state_of[:n] = state_of[layout.block : layout.block + n] = np.arange(n)
    state_of[layout.width : layout.width + n * layout.interior] = np.tile(np.arange(n), layout.interior)
    of_state, of_parameter = (rows >= 0) & (state_of[columns] >= 0), (rows >= 0) & (columns >= layout.local)
    to_states, to_parameters, content = (
        np.zeros((equations, n)),
        np.zeros((equations, interval.n_shared)),
        np.zeros(equations),
    )
    np.maximum.at(
        to_states,
        (rows[of_state], state_of[columns[of_state]]),
        slopes[:, of_state].max(axis=0) * m.step / layout.refine,
    )
    np.maximum.at(
        to_parameters,
        (rows[of_parameter], columns[of_parameter] - layout.local),
        np.sqrt(np.mean(slopes[:, of_parameter] ** 2, axis=0)),
    )
    own = equation_of_rows(model, scheme)
    np.maximum.at(content, own[own >= 0], np.sqrt(np.mean(residual[:, own >= 0] ** 2, axis=0)))
    return Sizes(to_states, to_parameters, content)
