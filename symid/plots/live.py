"""A solve as it goes on, in a notebook."""

from __future__ import annotations

import time
from importlib import import_module
from typing import Any

import numpy as np

from symid.ipopt_solver import Iteration
from symid.plots.style import INK, MODEL, WARN, Picture, opened

EVERY_S = 0.5
"""Drawing takes a tenth of a second: more often would slow the solve down."""


class LivePlot:
    """Objective, violated equations and optimality after each iteration; drawn anew twice a second.

    Examples
    --------
    In a notebook::

        problem.solve(on_iteration=si.LivePlot())
    """

    def __init__(self) -> None:
        self.iterations: list[Iteration] = []
        self._shown = -np.inf
        self._handle: Any = None

    def __call__(self, iteration: Iteration) -> None:
        """Take note of one iteration, and draw when the last drawing is old."""
        self.iterations.append(iteration)
        if time.monotonic() - self._shown > EVERY_S:
            self._show()
            self._shown = time.monotonic()

    def figure(self) -> Picture:
        """What has happened so far."""
        figure = Picture(figsize=(8, 2.6), layout="constrained")
        left, right = figure.subplots(1, 2)
        number = [i.number for i in self.iterations]
        left.plot(number, [i.objective for i in self.iterations], ".-", color=MODEL, lw=1)
        left.set(xlabel="iteration", ylabel="objective", title=f"{self.iterations[-1].objective:.6g}")
        for values, colour, label in (
            ([i.infeasibility for i in self.iterations], WARN, "violated equations"),
            ([i.dual_infeasibility for i in self.iterations], INK, "not yet optimal"),
        ):
            right.semilogy(number, np.maximum(values, 1e-16), ".-", color=colour, lw=1, label=label)
        right.set(xlabel="iteration", ylabel="largest, scaled")
        right.legend(frameon=False, fontsize=8.5)
        opened(left, right)
        return figure

    def _show(self) -> None:
        display = import_module("IPython.display").display
        if self._handle is None:
            self._handle = display(self.figure(), display_id=True)
        else:
            self._handle.update(self.figure())

    def _repr_png_(self) -> bytes | None:
        return self.figure()._repr_png_() if self.iterations else None
