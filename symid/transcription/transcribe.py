"""Model + recordings + scheme -> a sparse nonlinear program, with the map back to names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from symid.checked import nearest
from symid.codegen import compile_program
from symid.codegen.equations.interval import interval_program, late_signals, objective_program
from symid.codegen.equations.rates import with_rates_solved
from symid.codegen.equations.symbols import algebraics_at_nodes, own_points
from symid.errors import TranscriptionError
from symid.model import Model
from symid.nlp import NonlinearProgram
from symid.transcription.data import Measured
from symid.transcription.demands import Demands, bounds, ties
from symid.transcription.episodes import Episodes
from symid.transcription.known import episode_data, error_constants, interval_constants, row_names
from symid.transcription.late import gather_late, refuse_late
from symid.transcription.layout import Layout
from symid.transcription.program import CollocationProgram
from symid.transcription.scales import bounded_scale, objective_scale
from symid.transcription.schemes import Scheme
from symid.transcription.sizes import scaled_by_data


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
    information : the objective of an error of one standard deviation, by which priors are weighted.
    cost : the objective of a unit of what the model's own objectives, soft constraints and smooth controls ask for.
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
    information: float = 1.0
    cost: float = 1.0

    @cached_property
    def diverged(self) -> float:
        """SI size of a state that is far beyond all that was recorded: a simulation that reaches it has diverged."""
        largest = [np.abs(m.states[m.nodes]).max(axis=0) for m in self.measured]
        return 1e3 * float(np.max([*largest, self.layout.state_scale], initial=0.0))

    @cached_property
    def smooth_motion(self) -> list[np.ndarray]:
        """Per episode (samples, n) recorded states, smoothed by cross-validation, with rates that are theirs."""
        states = list(self.model.states)
        rates = {states.index(v): states.index(x) for v, x in self.model.rates().items()}
        smooth = [m.smooth_states(rates) for m in self.measured]
        return [smooth[r] for r in self.recording_of]

    def nonlinear_program(self, start: np.ndarray) -> NonlinearProgram:
        """The program from this start (a free vector)."""
        return self.program.nonlinear_program(start)

    def start(self, parameters: np.ndarray, states: Sequence[np.ndarray] | None = None) -> np.ndarray:
        """A free vector with these free parameters (SI) and the recorded trajectory, or `states`.

        states : one array per episode, SI: (samples, n), or (samples, width) with controls and algebraics.
        """
        if states is None:
            states = [self.measured[r].states[self.measured[r].nodes] for r in self.recording_of]
        states = [
            self.measured[r].on_mesh(x, self.layout.refine) for r, x in zip(self.recording_of, states, strict=True)
        ]
        return self._settled(self.layout.fill(states, parameters))

    def start_from(self, other: Transcription, z: np.ndarray) -> np.ndarray:
        """The free vector `z` of another problem of the same model, recordings and mesh as one of this problem."""
        layout = other.layout
        nodes = [layout.nodes(z, e) for e in range(len(layout.intervals))]
        return self._settled(self.layout.fill(nodes, layout.parameters(z)))

    def _settled(self, z: np.ndarray) -> np.ndarray:
        self.program.settle_late(z)
        return np.clip(z, self.program.lower, self.program.upper)


def transcribe(
    model: Model,
    measured: Sequence[Measured],
    scheme: Scheme,
    episodes: Episodes,
    weights: np.ndarray,
    per_recording: Sequence[str],
    backend: str,
    refine: int = 1,
    duration: str | None = None,
    loss: dict[str, float] | None = None,
    information: float = 1.0,
    cost: float = 1.0,
) -> Transcription:
    """Compile the kernels, lay out the free vector, and gather the data of every episode.

    weights : (recordings, m) of the time integrals of the squared output errors.
    duration : name of the parameter that is the motion's duration [s], where this is unknown; the time of
        `measured` is then a share of it.
    information : what the objective is for an error of one standard deviation: priors are weighted by it.
    cost : what it is for a unit of what the model's own objectives ask for.
    loss : output name -> width [its unit] beyond which its error counts by its size instead of its square.
    """
    model.check(units=False)
    model = with_rates_solved(model)
    refuse_late(model, measured)
    _refuse_averaged(model, scheme)
    graded = not all(m.even for m in measured)
    interval = compile_program(interval_program(model, scheme.stencil, duration, graded), backend=backend)
    loss, gaps = _checked_loss(model, loss or {}), any(m.present is not None for m in measured)
    recorded = all(m.targets is not None for m in measured)
    error = compile_program(objective_program(model, gaps, loss), backend=backend) if recorded else None
    layout, recording_of = _lay_out(model, measured, scheme, episodes, per_recording, refine)
    weights = np.asarray(weights)
    data = [
        episode_data(model, scheme, measured[r], noise, refine, graded, gaps, loss)
        for r in range(len(measured))
        for noise in episodes.draw(model, measured[r].intervals)
    ]
    if measured[0].targets is not None:
        layout = scaled_by_data(model, scheme, interval, error, layout, measured, data, recording_of, weights, graded)
    seconds = {k: sum(kernel.seconds.get(k, 0.0) for kernel in (interval, error) if kernel) for k in interval.seconds}
    demands = Demands(
        model, scheme, layout, tuple(measured), recording_of, duration, graded, information, cost, backend, seconds
    )
    tied, tie_names = ties(model, layout, _linked_episodes(episodes, recording_of))
    program = CollocationProgram(
        layout=layout,
        interval=interval,
        error=error,
        data=tuple(data),
        constants=interval_constants(
            model, scheme, interval, layout, measured, data, recording_of, _for_scales(model, layout, duration), graded
        ),
        error_constants=error_constants(model, layout),
        weights=weights[list(recording_of)],
        objective_scale=objective_scale(measured, recording_of, weights),
        late=tuple(gather_late(model, scheme, layout, measured, recording_of, interval.m * sum(layout.intervals))),
        ties=tied,
        tie_names=tie_names,
        bounds=bounds(model, layout),
        row_names=row_names(model, scheme),
        times=tuple(measured[r].mesh(refine) for r in recording_of),
        demanded=demands.demanded(),
        wanted=demands.wanted(),
    )
    return Transcription(
        model,
        scheme,
        episodes,
        tuple(measured),
        recording_of,
        layout,
        program,
        model.fingerprint,
        seconds,
        information,
        cost,
    )


def _checked_loss(model: Model, loss: dict[str, float]) -> dict[str, float]:
    for name, width in loss.items():
        if name not in model.outputs:
            raise TranscriptionError(
                f"loss: model '{model.name}' has no output '{name}'; {nearest(name, model.outputs)}"
            )
        if not (np.isfinite(width) and width > 0):
            raise TranscriptionError(
                f"loss: the width {width:g} of '{name}' must be a positive number, in the output's unit"
            )
    return loss


def _refuse_averaged(model: Model, scheme: Scheme) -> None:
    """Where a scheme averages residuals of several points, algebraic unknowns at the points are not determined."""
    if model.algebraics and not algebraics_at_nodes(model) and len(scheme.stencil.weights) < scheme.stencil.points:
        raise TranscriptionError(
            f"model '{model.name}' has algebraic variables that only equations with rates determine, and "
            f"the scheme '{scheme.name}' averages equations over an interval: use Midpoint or HermiteSimpson"
        )


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
    scales[index] = bounded_scale(model.parameters.values())
    beside = [*model.controls, *(model.algebraics if algebraics_at_nodes(model) else ())]
    own = own_points(model, scheme.stencil)
    late, of_states, of_beside = (
        late_signals(model),
        np.ones(len(model.states)),
        bounded_scale(model[b] for b in beside),
    )
    by_name = dict(zip((*model.states, *beside), (*of_states, *of_beside), strict=True))
    layout = Layout(
        state_names=tuple(model.states),
        parameter_names=tuple(free),
        late_names=tuple(map(str, late)),
        interior=scheme.stencil.interior,
        points=scheme.stencil.points,
        intervals=tuple(measured[r].intervals * refine for r in recording_of),
        parameter_index=index[list(recording_of)],
        state_scale=of_states,
        parameter_scale=scales,
        late_scale=np.array([by_name.get(str(model.delays[y].of), 1.0) for y in late]),
        refine=refine,
        beside_names=tuple(beside),
        beside_scale=of_beside,
        own_names=tuple(model.algebraics) if own else (),
        own_scale=bounded_scale(model.algebraics.values()) if own else np.zeros(0),
        own_points=len(own),
    )
    return layout, recording_of


def _for_scales(model: Model, layout: Layout, duration: str | None) -> np.ndarray:
    """(free parameters,) SI, at which equations are scaled: zero, but for the duration by which rates are divided."""
    values = np.zeros(len(layout.parameter_names))
    if duration:
        part = model.parameters[duration]
        values[layout.parameter_names.index(duration)] = part.guess or 0.5 * sum(part.bounds)
    return values


def _linked_episodes(episodes: Episodes, recording_of) -> list[tuple[int, int]]:
    """Pairs of neighbouring episodes that start in the same state."""
    if not episodes.shared_initial_state:
        return []
    return [(e, e + 1) for e in range(len(recording_of) - 1) if recording_of[e] == recording_of[e + 1]]
