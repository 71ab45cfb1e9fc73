"""What a model demands and wants besides its differential equations: bounds, ties, blocks of rows and objectives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from symid.codegen import Kernel, Program, compile_program
from symid.codegen.equations.conditions import (
    end_penalties,
    end_rows,
    ends_program,
    has_running,
    is_bound,
    node_program,
    parameter_penalties,
    parameter_program,
    parameter_rows,
    path_data,
    path_rows,
    running_data,
    running_program,
    terminal_objective,
)
from symid.codegen.equations.symbols import node_symbols
from symid.errors import TranscriptionError
from symid.model import Model, Row, initial, terminal
from symid.transcription.block import Block
from symid.transcription.data import Measured
from symid.transcription.known import input_at, interval_steps, scales, values_of
from symid.transcription.layout import Layout
from symid.transcription.schemes import Scheme


class Demands:
    """Blocks of one transcription; `episodes` are pairs (recording, episode number).

    Parameters
    ----------
    duration : name of the parameter that is the motion's duration, or None.
    graded : whether intervals differ in length.
    information : the objective of a squared error of one standard deviation.
    cost : the objective of a unit of what the model's objectives, soft constraints and smooth controls ask for.
    seconds : what compiling took is added to it.
    """

    def __init__(
        self,
        model: Model,
        scheme: Scheme,
        layout: Layout,
        measured: tuple[Measured, ...],
        recording_of: tuple[int, ...],
        duration: str | None,
        graded: bool,
        information: float,
        cost: float,
        backend: str,
        seconds: dict[str, float],
    ):
        self.model, self.scheme, self.layout, self.duration, self.graded = model, scheme, layout, duration, graded
        self.measured, self.recording_of, self.backend, self.seconds = measured, recording_of, backend, seconds
        self.information, self.cost = information, cost

    def demanded(self) -> tuple[Block, ...]:
        """Constraints at nodes, at the ends, and of parameters."""
        return (*self._path(), *self._ends(end_rows(self.model), "boundary"), *self._parameters())

    def wanted(self) -> tuple[Block, ...]:
        """Running, terminal objectives, priors; these and the process noise's likelihood times `information`."""
        return (
            *self._running(),
            *self._terminal(terminal_objective(self.model), "terminal", self.cost),
            *self._terminal(end_penalties(self.model), "prior of ends", self.information, likelihood=True),
            *self._priors(),
        )

    def _compiled(self, program: Program, backend: str | None = None) -> Kernel:
        kernel = compile_program(program, backend=backend or self.backend)
        for name, value in kernel.seconds.items():
            self.seconds[name] = self.seconds.get(name, 0.0) + value
        return kernel

    def _constants(self, e: int, graded: bool = False) -> np.ndarray:
        step = self.measured[self.recording_of[e]].step / self.layout.refine
        return np.concatenate([values_of(self.model), [] if graded else [step], scales(self.layout)])

    def _path(self) -> Iterator[Block]:
        rows = path_rows(self.model)
        if not rows:
            return
        kernel, layout = self._compiled(node_program(self.model, self.duration)), self.layout
        for e, r in enumerate(self.recording_of):
            m = self.measured[r]
            data = [
                np.append(
                    input_at(self.model, self.scheme, m, str(u), 0.0, layout.refine),
                    input_at(self.model, self.scheme, m, str(u), 1.0, layout.refine)[-1],
                )
                for u in path_data(self.model)
            ]
            times = m.mesh(layout.refine)
            yield Block(
                kernel,
                lambda z, e=e: layout.node_view(z, e),
                layout.parameter_columns(e),
                _columns(data, len(times)),
                self._constants(e),
                layout.size,
                **_bounds_and_names(rows),
                times=times,
                where=f" of episode {e + 1}",
            )

    def _ends(self, rows: list[tuple[str, Row]], name: str) -> Iterator[Block]:
        if rows:
            blocks = self._at_ends([r.expr for _, r in rows], name, **_bounds_and_names(rows))
            yield from (replace(b, where=f" of episode {e + 1}") for e, b in enumerate(blocks))

    def _at_ends(self, expressions: list, name: str, **more) -> Iterator[Block]:
        """Expressions of both ends of each episode; `more` goes to each Block."""
        kernel = self._compiled(ends_program(self.model, expressions, name, self.duration), "numpy")
        for e in range(len(self.recording_of)):
            yield Block(
                kernel,
                self._both_ends(e),
                self.layout.parameter_columns(e),
                self._end_data(e),
                self._constants(e),
                self.layout.size,
                **more,
            )

    def _parameters(self) -> Iterator[Block]:
        rows = parameter_rows(self.model)
        if rows:
            kernel = self._compiled(parameter_program(self.model, [r.expr for _, r in rows], "parameters"), "numpy")
            used = np.unique(kernel.jacobian_cols)
            seen = {tuple(self.layout.parameter_columns(e)[used]): e for e in reversed(range(len(self.recording_of)))}
            for e in sorted(seen.values()):
                yield Block(
                    kernel,
                    _nothing,
                    self.layout.parameter_columns(e),
                    np.zeros((1, 0)),
                    self._constants(e),
                    self.layout.size,
                    **_bounds_and_names(rows),
                )

    def _priors(self) -> Iterator[Block]:
        """Each free parameter once, however many episodes share it."""
        penalties = parameter_penalties(self.model)
        if penalties:
            kernel = self._compiled(parameter_program(self.model, list(penalties.values()), "priors"), "numpy")
            place, seen = [list(self.model.parameters).index(name) for name in penalties], set()
            for e in range(len(self.recording_of)):
                columns = self.layout.parameter_columns(e)[place]
                weights = self.information * np.array([[float(c not in seen) for c in columns]])
                seen |= set(columns)
                if weights.any():
                    yield Block(
                        kernel,
                        _nothing,
                        self.layout.parameter_columns(e),
                        np.zeros((1, 0)),
                        self._constants(e),
                        self.layout.size,
                        weights=weights,
                        likelihood=np.ones(len(place), bool),
                    )

    def _running(self) -> Iterator[Block]:
        if not has_running(self.model):
            return
        kernel, layout = (
            self._compiled(running_program(self.model, self.scheme.stencil, self.duration, self.graded)),
            self.layout,
        )
        for e, r in enumerate(self.recording_of):
            stations = (0.0, *self.scheme.stencil.abscissae, 1.0)
            data = [
                input_at(self.model, self.scheme, self.measured[r], str(u), float(c), layout.refine)
                for c in stations
                for u in running_data(self.model)
            ]
            data += interval_steps(self.measured[r], layout.refine, self.graded)
            yield Block(
                kernel,
                lambda z, e=e: layout.local_view(z, e),
                layout.parameter_columns(e),
                _columns(data, layout.intervals[e]),
                self._constants(e, self.graded),
                layout.size,
                weights=np.tile([self.cost, self.information], (layout.intervals[e], 1)),
                likelihood=np.array([False, True]),
            )

    def _terminal(self, total, name: str, weight: float, likelihood: bool = False) -> Iterator[Block]:
        if total != 0:
            weights, counted = np.full((1, 1), weight), np.array([likelihood])
            yield from self._at_ends([total], name, weights=weights, likelihood=counted)

    def _both_ends(self, e: int):
        columns = self.layout.node_view(np.arange(self.layout.size), e)[[0, -1]].reshape(1, -1)
        return lambda z: z[columns]

    def _end_data(self, e: int) -> np.ndarray:
        m = self.measured[self.recording_of[e]]
        return np.array(
            [[m.time[m.last], *(m.inputs[u][node] for node in (m.first, m.last) for u in self.model.inputs)]],
            dtype=float,
        )


def _nothing(z: np.ndarray) -> np.ndarray:
    """The local symbols of a kernel that sees parameters alone."""
    return np.zeros((1, 0), z.dtype)


def _columns(data: list[np.ndarray], points: int) -> np.ndarray:
    return np.ascontiguousarray(np.column_stack(data)) if data else np.zeros((points, 0))


def _bounds_and_names(rows: list[tuple[str, Row]]) -> dict:
    return {
        "lower": np.array([r.lower for _, r in rows]),
        "upper": np.array([r.upper for _, r in rows]),
        "names": tuple(name for name, _ in rows),
    }


def ties(model: Model, layout: Layout, linked: list[tuple[int, int]]) -> tuple[np.ndarray, tuple[str, ...]]:
    """(T, 2) columns of unknowns that are equal, and what that says.

    The initial states of linked episodes; and the last value of a held control, which holds over no
    interval any more and so repeats the one before.
    """
    pairs, names = [], []
    for a, b in linked:
        for i, state in enumerate(layout.state_names):
            pairs.append((layout.offsets[a] + i, layout.offsets[b] + i))
            names.append(f"initial state {state} of episodes {a + 1} and {b + 1} equal")
    for e in range(len(layout.intervals)):
        at_nodes = layout.node_view(np.arange(layout.size), e)
        for u in model.controls.values():
            if u.hold == "zero":
                pairs.append(tuple(at_nodes[[-1, -2], layout.node_names.index(u.name)]))
                names.append(f"control {u.name} held to the end of episode {e + 1}")
    return np.array(pairs, dtype=int).reshape(-1, 2), tuple(names)


def bounds(model: Model, layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper bounds of the free vector, boundary conditions on one unknown included.

    Interior slots and late unknowns are free.

    Raises
    ------
    TranscriptionError
        A boundary condition contradicts the bounds of the quantity.
    """
    nodes = np.array([model[name].bounds for name in layout.node_names], dtype=float).reshape(-1, 2)
    own = np.array([model[name].bounds for name in layout.own_names], dtype=float).reshape(-1, 2)
    parameters = np.zeros((len(layout.parameter_names), 2))
    for p, columns in zip(model.parameters.values(), layout.parameter_index.T, strict=True):
        parameters[columns] = p.bounds
    lower, upper = (
        layout.spread(nodes[:, i], own[:, i], parameters[:, i], free) for i, free in ((0, -np.inf), (1, np.inf))
    )
    for e in range(len(layout.intervals)):
        low, high = layout.node_view(lower, e), layout.node_view(upper, e)
        for node, column, row in end_bounds(model, layout):
            scale = layout.node_scale[column]
            low[node, column], high[node, column] = (
                max(low[node, column], row.lower / scale),
                min(high[node, column], row.upper / scale),
            )
            if low[node, column] > high[node, column]:
                raise TranscriptionError(
                    f"the boundary condition {row.lower:g} to {row.upper:g} of "
                    f"'{layout.node_names[column]}' of model '{model.name}' lies outside its bounds "
                    f"{model[layout.node_names[column]].bounds}; widen one of them"
                )
    return lower, upper


def end_bounds(model: Model, layout: Layout) -> Iterator[tuple[int, int, Row]]:
    """(0 or -1 for the first or last node, place in the node, row) of conditions that bound one unknown."""
    along = node_symbols(model)
    place = {f(s): (node, column) for node, f in ((0, initial), (-1, terminal)) for column, s in enumerate(along)}
    for boundary in model.boundaries.values():
        for row in boundary.rows(set(along)):
            if is_bound(model, row):
                yield *place[row.expr], row
