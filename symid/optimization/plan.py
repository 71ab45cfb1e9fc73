"""What an optimization found: motion, controls, parameters and duration, by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from html import escape
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from symid.checked import nearest
from symid.errors import ModelError
from symid.ipopt_solver import SolverResult

if TYPE_CHECKING:
    import pandas as pd

    from symid.optimization.problem import Optimization


@dataclass(frozen=True, eq=False)
class Plan:
    """A planned motion.

    Attributes
    ----------
    problem : what was solved.
    result : what Ipopt returned.

    Examples
    --------
    >>> m = si.Model("cart")
    >>> m.x, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2")
    >>> m.motion = si.Equation({0: m.x.dot - m.v, 1: m.v.dot - m.force})
    >>> m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    >>> m.effort = si.Objective(running=m.force**2)
    >>> plan = si.Optimization(m, duration=1, nodes=21).solve()
    >>> round(plan.objective, 3), round(float(plan[m.x][-1]), 3)        # 12 for one metre in one second
    (12.0, 1.0)
    """

    problem: Optimization
    result: SolverResult

    @property
    def solved(self) -> bool:
        """Whether an optimum was found."""
        return self.result.solved

    @property
    def message(self) -> str:
        """What Ipopt's status means and what to do next."""
        return self.result.message

    @property
    def objective(self) -> float:
        """Value of the objective, penalties of soft constraints and priors included."""
        return self.result.objective

    @cached_property
    def values(self) -> dict[str, float]:
        """Free parameters by name, SI, a free duration [s] among them."""
        layout = self.problem.transcription.layout
        return dict(zip(layout.parameter_names, map(float, layout.parameters(self.result.z)), strict=True))

    @property
    def duration(self) -> float:
        """[s]"""
        name = self.problem.duration_name
        return self.values[name] if name else float(cast("float", self.problem.duration))

    @cached_property
    def trajectories(self) -> pd.DataFrame:
        """States, controls and algebraic variables at the nodes, SI, by time [s]."""
        import pandas as pd

        layout = self.problem.transcription.layout
        time = pd.Index(self.duration * self.problem.shares, name="time_s")
        return pd.DataFrame(layout.nodes(self.result.z, 0), index=time, columns=list(layout.node_names))

    def as_start(self) -> dict[str, Any]:
        """Values by name from which another Optimization can start: functions of time, and parameters."""
        layout, time = self.problem.transcription.layout, self.trajectories.index.to_numpy()
        columns = layout.nodes(self.result.z, 0).T

        def along(column: np.ndarray) -> Callable[[float], Any]:
            return lambda t: np.interp(t, time, column)

        return {name: along(c) for name, c in zip(layout.node_names, columns, strict=True)} | self.values

    def __getitem__(self, name: Any) -> np.ndarray:
        """(nodes,) the motion of one quantity, by name or part."""
        name, known = str(getattr(name, "symbol", name)), self.trajectories
        if name not in known:
            raise ModelError(f"the plan has no motion of '{name}'; {nearest(name, known.columns)}")
        column: np.ndarray = known[name].to_numpy()
        return column

    def save(self, path: str | Path) -> None:
        """Write the plan to the file `path`; `Optimization.load` reads it."""
        from symid.optimization.saved import save

        save(self, path)

    def plot(self) -> Any:
        """Figure of the motion and its controls."""
        # Drawing stands on the roof, and computing must not need it: fetched by name when asked for.
        return import_module("symid.plots").plot_plan(self)

    def _repr_html_(self) -> str:
        first, *rest = repr(self).splitlines()
        return f"<h4>{escape(first)}</h4>" + "".join(f"<p>{escape(line)}</p>" for line in rest)

    def __repr__(self) -> str:
        r = self.result
        lines = [
            f"Plan of '{self.problem.model.name}': objective {r.objective:.6g}, duration {self.duration:.6g} s, "
            f"{len(self.problem.shares)} nodes, {self.problem.scheme.name}, {r.iterations} iterations, "
            f"{r.seconds['total']:.2f} s",
            r.message,
        ]
        lines += [
            f"  {k} = {v:.6g} {self.problem.transcription.model.parameters[k].unit}" for k, v in self.values.items()
        ]
        return "\n".join(lines)
