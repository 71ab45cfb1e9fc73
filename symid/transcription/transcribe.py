"""Model + recordings + scheme -> a sparse nonlinear program, with the map back to names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from symid.codegen import Kernel, compile_program
from symid.codegen.interval import interval_program, late_signals, objective_program, used_data
from symid.errors import TranscriptionError
from symid.model import Model, nearest
from symid.nlp import NonlinearProgram
from symid.transcription.data import Measured, spline
from symid.transcription.delays import LateSignal
from symid.transcription.episodes import Episodes
from symid.transcription.layout import Layout
from symid.transcription.program import CollocationProgram, EpisodeData
from symid.transcription.scales import equation_scale, parameter_scale, state_scale
from symid.transcription.schemes import Scheme


@dataclass(frozen=True, eq=False)
class Transcription:
    """A nonlinear program and what it stands for.

    Parameters
    ----------
    model, scheme, episodes : what was transcribed.
    measured : one entry per recording; episode e belongs to recording `recording_of[e]`.
    layout : the order of the free vector.
    program : values and derivatives of the nonlinear program.
    fingerprint : of the model at this moment; results of another one are refused.
    """

    model: Model
    scheme: Scheme
    episodes: Episodes
    measured: tuple[Measured, ...]
    recording_of: tuple[int, ...]
    layout: Layout
    program: CollocationProgram
    fingerprint: str
    seconds: dict[str, float]

    def nonlinear_program(self, start: np.ndarray) -> NonlinearProgram:
        """The program from this start (a free vector)."""
        return self.program.nonlinear_program(start)

    def start(self, parameters: np.ndarray, states: Sequence[np.ndarray] | None = None) -> np.ndarray:
        """A free vector with these free parameters (SI) and the recorded trajectory, or `states`.

        states : one (samples, n) array per episode, SI.
        """
        if states is None:
            states = [self.measured[r].states[self.measured[r].nodes] for r in self.recording_of]
        states = [self.measured[r].on_mesh(x, self.layout.refine) for r, x in zip(self.recording_of, states, strict=True)]
        z = self.layout.fill(states, parameters)
        self.program.settle_late(z)
        return np.clip(z, self.program.lower, self.program.upper)


def transcribe(model: Model, measured: Sequence[Measured], scheme: Scheme, episodes: Episodes,
               weights: dict[str, float], per_recording: Sequence[str], backend: str, refine: int = 1) -> Transcription:
    """Compile the kernels, lay out the free vector, and gather the data of every episode."""
    model.check(units=False)
    _refuse_late(model)
    interval = compile_program(interval_program(model, scheme.stencil), backend=backend)
    error = compile_program(objective_program(model), backend=backend)
    layout, recording_of = _lay_out(model, measured, scheme, episodes, per_recording, refine)
    data = [_episode_data(model, scheme, measured[r], noise, refine)
            for r in range(len(measured)) for noise in episodes.draw(model, measured[r].intervals)]
    constants = _constants(model, scheme, interval, layout, measured, data, recording_of)
    program = CollocationProgram(
        layout=layout, interval=interval, error=error, data=tuple(data), constants=constants,
        error_constants=_error_constants(model, layout, weights),
        late=tuple(_late_signals(model, scheme, layout, measured, recording_of, interval.m)),
        linked=_linked_episodes(episodes, recording_of), bounds=_bounds(model, layout),
        row_names=_row_names(model, scheme), times=tuple(measured[r].mesh(refine) for r in recording_of))
    seconds = {k: interval.seconds.get(k, 0.0) + error.seconds.get(k, 0.0) for k in interval.seconds}
    return Transcription(model, scheme, episodes, tuple(measured), recording_of, layout, program, model.fingerprint, seconds)


def _refuse_late(model: Model) -> None:
    late = set(model.delays)
    for d in model.delays.values():
        if str(d.of) in model.inputs and model.inputs[str(d.of)].hold == "zero":
            raise TranscriptionError(f"model '{model.name}' delays the input '{d.of}', which is held between samples: direct "
                                     "collocation reads late signals through smooth weights; give hold='linear', or shift "
                                     "the recorded channel by a known lag")
    for name, y in zip(model.outputs, model.observed(), strict=True):
        if y.free_symbols & late:
            raise TranscriptionError(f"output '{name}' of model '{model.name}' shows a delayed signal, which direct "
                                     "collocation does not handle; shift the recorded channel instead")


def _lay_out(model, measured, scheme, episodes, per_recording, refine) -> tuple[Layout, tuple[int, ...]]:
    names = list(model.parameters)
    for p in per_recording:
        if p not in names:
            raise TranscriptionError(f"per_recording: model '{model.name}' has no parameter '{p}'; {nearest(p, names)}")
    free, index = [], np.zeros((len(measured), len(names)), dtype=int)
    for j, name in enumerate(names):
        own = name in per_recording and len(measured) > 1
        index[:, j] = np.arange(len(measured)) + len(free) if own else len(free)
        free += [f"{name}[{r + 1}]" for r in range(len(measured))] if own else [name]
    recording_of = tuple(r for r in range(len(measured)) for _ in range(episodes.count))
    scales = np.ones(len(free))
    scales[index] = parameter_scale(model)
    states = {s.symbol: scale for s, scale in zip(model.states.values(), state_scale(model), strict=True)}
    late = late_signals(model)
    layout = Layout(
        state_names=tuple(model.states), parameter_names=tuple(free), late_names=tuple(map(str, late)),
        interior=scheme.stencil.interior, points=scheme.stencil.points,
        intervals=tuple(measured[r].intervals * refine for r in recording_of), parameter_index=index[list(recording_of)],
        state_scale=np.array(list(states.values())), parameter_scale=scales,
        late_scale=np.array([states.get(model.delays[y].of, 1.0) for y in late]), refine=refine)
    return layout, recording_of


def _episode_data(model: Model, scheme: Scheme, m: Measured, noise: np.ndarray, refine: int) -> EpisodeData:
    """Known numbers of one episode, in the order of `interval_program` and `objective_program`."""
    smooth = "cubic" if scheme.order > 2 or refine > 1 else "linear"

    def at_point(name, c):
        if name == "t":
            return m.times(c, refine)
        hold = model.inputs[name].hold
        return m.input_at(name, c, refine, smooth if hold == "smooth" else hold)
    columns = [at_point(str(u), c) for c in scheme.stencil.abscissae for u in used_data(model, model.residual())]
    columns = np.column_stack(columns) if columns else np.zeros((m.intervals * refine, 0))
    shown = [m.time if str(u) == "t" else m.inputs[str(u)] for u in used_data(model, model.observed())]
    nodes = m.targets[m.nodes]
    return EpisodeData(
        interval=np.ascontiguousarray(np.hstack([columns, np.repeat(noise, refine, axis=0)])),
        node=np.ascontiguousarray(np.column_stack([*(u[m.nodes] for u in shown), nodes])), noise=noise, step=m.step)


def _scales(layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    return layout.state_scale, layout.parameter_scale[layout.parameter_index[0]]


def _constants(model, scheme, interval: Kernel, layout: Layout, measured, data, recording_of) -> tuple[np.ndarray, ...]:
    """Per episode: the constants of `interval_program`, with equation scales found at the recorded motion."""
    values = np.array([c.value for c in model.constants.values()], dtype=float)
    equations = len(model.equations)
    def build(step, scale):
        return np.concatenate([values, [step], *_scales(layout), scale])
    first = measured[recording_of[0]]
    states = [measured[r].on_mesh(measured[r].states[measured[r].nodes], layout.refine) for r in recording_of]
    z, step = layout.fill(states, np.zeros(len(layout.parameter_names))), first.step / layout.refine
    slopes = interval.jacobian(layout.local_view(z, 0), z[layout.parameter_columns(0)], data[0].interval,
                               build(step, np.ones(equations)))
    of_states = (interval.jacobian_cols < interval.n_local) & (interval.jacobian_rows < equations * len(scheme.stencil.weights))
    scale = equation_scale(interval.jacobian_rows[of_states], slopes[:, of_states], equations, step)
    return tuple(build(d.step / layout.refine, scale) for d in data)


def _error_constants(model: Model, layout: Layout, weights: dict[str, float]) -> np.ndarray:
    for name, weight in weights.items():
        if name not in model.outputs:
            raise TranscriptionError(f"weights: model '{model.name}' has no output '{name}'; {nearest(name, model.outputs)}")
        if not (np.isfinite(weight) and weight >= 0):
            raise TranscriptionError(f"weights: the weight {weight:g} of '{name}' must be a finite number of at least 0")
    values = [c.value for c in model.constants.values()]
    return np.concatenate([values, *_scales(layout), [weights.get(y, 1.0) for y in model.outputs]])


def _linked_episodes(episodes: Episodes, recording_of) -> tuple[tuple[int, int], ...]:
    """Pairs of neighbouring episodes that start in the same state."""
    if not episodes.shared_initial_state:
        return ()
    return tuple((e, e + 1) for e in range(len(recording_of) - 1) if recording_of[e] == recording_of[e + 1])


def _bounds(model: Model, layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper bounds of the free vector; interior and late unknowns are free."""
    states = np.array([s.bounds for s in model.states.values()], dtype=float).reshape(-1, 2)
    parameters = np.zeros((len(layout.parameter_names), 2))
    for p, columns in zip(model.parameters.values(), layout.parameter_index.T, strict=True):
        parameters[columns] = p.bounds
    return (layout.spread(states[:, 0], parameters[:, 0], -np.inf), layout.spread(states[:, 1], parameters[:, 1], np.inf))


def _row_names(model: Model, scheme: Scheme) -> tuple[str, ...]:
    groups, defects = len(scheme.stencil.weights), len(scheme.stencil.defects)
    return (*(f"equation {e}" for _ in range(groups) for e in model.equations),
            *(f"collocation defect of state {s}" for _ in range(defects) for s in model.states))


def _late_signals(model, scheme, layout: Layout, measured, recording_of, interval_rows: int):
    """One LateSignal for each episode, point and delayed signal, and the rows of their constraints."""
    states, row = list(model.states), interval_rows * sum(layout.intervals)
    for e, r in enumerate(recording_of):
        m, late_columns = measured[r], layout.late_view(np.arange(layout.size), e)
        for p, c in enumerate(scheme.stencil.abscissae):
            for k, y in enumerate(late_signals(model)):
                of, lag = str(model.delays[y].of), _lag(model, str(model.delays[y].lag))
                is_state = of in states
                samples, before = _on_whole_mesh(m, m.states[:, states.index(of)] if is_state else m.inputs[of], layout.refine)
                column = layout.parameter_columns(e)[lag["parameter"]] if lag["parameter"] is not None else None
                yield LateSignal(
                    samples=samples / layout.late_scale[k], before=before, abscissa=float(c), lag=lag["value"],
                    lag_bounds=lag["bounds"], step=m.step / layout.refine, row=row + np.arange(layout.intervals[e]),
                    late_column=late_columns[:, p, k],
                    node_columns=layout.node_view(np.arange(layout.size), e)[:, states.index(of)] if is_state else None,
                    lag_column=column,
                    lag_scale=1.0 if column is None else layout.parameter_scale[column - layout.offsets[-1]])
                row += layout.intervals[e]


def _on_whole_mesh(m: Measured, samples: np.ndarray, refine: int) -> tuple[np.ndarray, int]:
    """The samples of a whole recording at the nodes of its mesh, and how many of these lie before the window."""
    if refine == 1:
        return samples, m.first
    place = np.arange(len(samples))
    return spline(place, samples)(np.arange(refine * (len(samples) - 1) + 1) / refine), refine * m.first


def _lag(model: Model, text: str) -> dict:
    """A lag's value or parameter, and its range [s]."""
    if text in model.parameters:
        lo, hi = model.parameters[text].bounds
        if not 0 <= lo <= hi < np.inf:
            raise TranscriptionError(f"the lag '{text}' of model '{model.name}' needs bounds of at least 0 s and below "
                                     f"infinity, not {lo:g} to {hi:g} s: they fix which nodes are looked at")
        return {"value": None, "parameter": list(model.parameters).index(text), "bounds": (lo, hi)}
    try:
        value = model.constants[text].value if text in model.constants else float(text)
    except ValueError:
        raise TranscriptionError(f"the lag '{text}' of model '{model.name}' must be a number, a Constant or a "
                                 "Parameter, not an expression of several") from None
    return {"value": value, "parameter": None, "bounds": (value, value)}
