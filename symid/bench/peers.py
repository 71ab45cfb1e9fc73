"""A task for packages that know nothing of symid: the same program as arrays and SymPy expressions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import sympy as sm

from symid.bench.task import Task
from symid.model import Model

# Torques, and with them gains and the balance equations, are divided by this for the peers, as
# the authors of the article did by hand; symid scales by itself.
TORQUE = 100.0


@dataclass(frozen=True, eq=False)
class PeerTask:
    """The program of a Task.

    Attributes
    ----------
    model : whose residuals are the equations.
    step : [s].
    recorded : (nodes, n) states to start from; the outputs are the first states.
    targets : (nodes, outputs).
    acceleration : (nodes,) the input.
    noises : per episode (nodes - 1, noises).
    state_bounds (2, n), parameter_bounds (2, q), start (q,) : of scaled parameters.
    parameter_scale (q,), row_scale (n,) : SI = scale * number; rows are divided.
    """

    model: Model
    step: float
    recorded: np.ndarray
    targets: np.ndarray
    acceleration: np.ndarray
    noises: list[np.ndarray]
    state_bounds: np.ndarray
    parameter_bounds: np.ndarray
    parameter_scale: np.ndarray
    row_scale: np.ndarray
    start: np.ndarray

    @property
    def nodes(self) -> int:
        """Nodes of all episodes."""
        return len(self.noises) * len(self.recorded)

    @property
    def symbols(self) -> tuple[list, list, list, list]:
        """States, their rates, parameters, input and noises, in SymPy."""
        m = self.model
        states = list(m.states.values())
        return (
            [s.symbol for s in states],
            [s.dot for s in states],
            [p.symbol for p in m.parameters.values()],
            [c.symbol for c in (*m.inputs.values(), *m.noises.values())],
        )

    @property
    def rows(self) -> list[sm.Expr]:
        """The scaled residuals in `symbols`, constants put in."""
        values = {c.symbol: sm.Float(c.value) for c in self.model.constants.values()}
        values |= {p: sm.Float(s) * p for p, s in zip(self.symbols[2], self.parameter_scale, strict=True)}
        return [r.xreplace(values) / sm.Float(s) for r, s in zip(self.model.residual(), self.row_scale, strict=True)]

    def function(self, mathematics: dict) -> Callable:
        """`rows` as a function of all `symbols`, with another package's sine and cosine."""
        return sm.lambdify([s for group in self.symbols for s in group], self.rows, modules=[mathematics], cse=True)

    def rms(self, states: np.ndarray) -> float:
        """Root mean square output error [SI] of (episodes, nodes, n) states."""
        error = states[:, :, : self.targets.shape[1]] - self.targets
        return float(np.sqrt(np.mean(error**2)))


def for_peers(task: Task) -> PeerTask:
    """The arrays of `task`, its random start included."""
    problem = task.identification()
    t, z = problem.transcription, problem.start("random", 0, task.number)
    m, model, layout = t.measured[0], t.model, t.layout
    scale = np.array([TORQUE if "N" in p.unit else 1.0 for p in model.parameters.values()])
    states, parameters = (np.array([c.bounds for c in kind.values()]).T for kind in (model.states, model.parameters))
    (acceleration,) = m.inputs.values()
    return PeerTask(
        model=model,
        step=m.step,
        recorded=layout.states(z, 0),
        targets=m.targets[m.nodes],
        acceleration=acceleration[m.nodes],
        noises=[d.noise for d in t.program.data],
        state_bounds=states,
        parameter_bounds=parameters / scale,
        parameter_scale=scale,
        row_scale=np.array([1.0 if e.endswith("kinematics") else TORQUE for e in model.equations]),
        start=layout.parameters(z) / scale,
    )
