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

    Attributes
    ----------
    iterations : all that it was told, in their order.

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
        """What has happened so far; earlier starts are pale."""
        figure = Picture(figsize=(8, 2.8), layout="constrained")
        left, right = figure.subplots(1, 2)
        starts = self._starts()
        for start in starts:
            alpha = 1.0 if start is starts[-1] else 0.3
            number = [i.number for i in start]
            left.plot(number, [i.objective for i in start], ".-", color=MODEL, lw=1, alpha=alpha)
            for values, colour, label in (
                ([i.infeasibility for i in start], WARN, "violated equations"),
                ([i.dual_infeasibility for i in start], INK, "not yet optimal"),
            ):
                known = np.where(np.array(values) > 0, values, np.nan)
                right.semilogy(
                    number, known, ".-", color=colour, lw=1, alpha=alpha, label=label if alpha == 1 else None
                )
        which = f"start {len(starts)}: " if len(starts) > 1 else ""
        left.set(xlabel="iteration", ylabel="objective")
        left.set_title(f"{which}objective {self.iterations[-1].objective:.6g}", loc="left", fontsize=10)
        right.set(xlabel="iteration", ylabel="largest, scaled")
        opened(left, right)
        names = right.get_legend_handles_labels()
        figure.legend(*names, frameon=False, fontsize=8.5, ncols=2, loc="outside lower right")  # the title is above
        return figure

    def _starts(self) -> list[list[Iteration]]:
        """The iterations of each start: they count from the beginning again."""
        found: list[list[Iteration]] = []
        for one in self.iterations:
            if not found or one.number <= found[-1][-1].number:
                found.append([])
            found[-1].append(one)
        return found

    def _show(self) -> None:
        display = import_module("IPython.display").display
        if self._handle is None:
            self._handle = display(self.figure(), display_id=True)
        else:
            self._handle.update(self.figure())

    def _repr_png_(self) -> bytes | None:
        return self.figure()._repr_png_() if self.iterations else None
