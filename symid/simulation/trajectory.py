"""What a simulation gave."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What a simulation gave.

    Attributes
    ----------
    time : (N,) [s].
    x : (N, n) states, y : (N, m) outputs; rows after the end of a run that diverged are NaN.
    wrt : names of the unknowns of the sensitivities: parameters, then ``<state>(0)``, then what only a gain depends on.
    dx : (N, n, q) and dy : (N, m, q) derivatives of x and y, or None.
    reached : samples before the run diverged, or its steps had to be cut everywhere; N if neither.
    state_names, output_names : of the columns of x and y.
    stiff : steps of the integrator in which something was stiff, where those were asked for.
    unseen : first samples of which an output reads what was before the run.

    Examples
    --------
    >>> from symid.simulation import Simulator
    >>> run = Simulator(model).simulate({"damping": 0.3}, {"angle": 0.5, "rate": 0.0}, np.arange(0, 5, 0.01),
    ...                                 {"drive": np.zeros(500)})
    >>> run.x.shape, run.diverged
    ((500, 2), False)
    """

    time: np.ndarray
    x: np.ndarray
    y: np.ndarray
    state_names: tuple[str, ...]
    output_names: tuple[str, ...]
    wrt: tuple[str, ...] = ()
    dx: np.ndarray | None = None
    dy: np.ndarray | None = None
    reached: int = 0
    stiff: int = 0
    unseen: int = 0

    @property
    def diverged(self) -> bool:
        """Whether a state became too large before the end."""
        return self.reached < len(self.time)

    @property
    def states(self) -> dict[str, np.ndarray]:
        """Name -> (N,) values [SI]."""
        return dict(zip(self.state_names, self.x.T, strict=True))

    @property
    def outputs(self) -> dict[str, np.ndarray]:
        """Name -> (N,) values [SI]."""
        return dict(zip(self.output_names, self.y.T, strict=True))

    def every(self, n: int) -> Trajectory:
        """The same run at every `n`-th sample."""
        kept = {
            k: None if a is None else a[::n]
            for k, a in (("x", self.x), ("y", self.y), ("dx", self.dx), ("dy", self.dy))
        }
        return replace(self, time=self.time[::n], reached=-(-self.reached // n), **kept)

    def sensitivity(self, output: str, unknown: str) -> np.ndarray:
        """(N,) derivative of one `output` by one `unknown` of `wrt`."""
        return self.dy[:, self.output_names.index(output), self.wrt.index(unknown)]
