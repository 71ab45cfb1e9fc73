"""A figure of what a model lacks: the force over what it follows, and its energy in time and by amplitude."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import MaxNLocator

from symid.discrepancy.say.rest import noun, power_unit, signal_name
from symid.mechanics.coordinates import signal_unit
from symid.plots.style import INK, MODEL, QUIET, WARN, Picture, opened
from symid.units import prefix_for, shown_unit, time_unit, unit_symbol

if TYPE_CHECKING:
    from symid.discrepancy.locate.rest import Rest, Stretch

MOST_POINTS = 3000
ABREAST = 2
"""Signals beside each other: more have no room on a phone."""


def plot_rest(rest: Rest) -> Picture:
    """The remaining force over each signal that it follows, and its mean power in the parts of the window.

    Parameters
    ----------
    rest : of a diagnosis that leaves something unexplained.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> if found.rest is not None:                                               # doctest: +SKIP
    ...     plot_rest(found.rest).savefig("rest.png")
    """
    rows, columns = -(-len(rest.signals) // ABREAST), min(len(rest.signals), ABREAST)
    figure = Picture(figsize=(9.5, 2.9 * rows + 2.5), layout="constrained")
    grid = figure.add_gridspec(rows + 1, columns, height_ratios=[*[1.2] * rows, 1])
    panels = [figure.add_subplot(grid[i // columns, i % columns]) for i in range(len(rest.signals))]
    prefix, factor = prefix_for(2 * float(np.abs(rest.force).max()))
    every = max(1, len(rest.force) // MOST_POINTS)
    clock, per = time_unit(float(np.ptp(rest.time)))
    for axes, (signal, values) in zip(panels, rest.signals.items(), strict=True):
        unit, scale = shown_unit(signal_unit(rest.model, signal))
        dots = axes.scatter(
            values[::every] * scale, rest.force[::every] * factor, c=rest.time[::every] * per, s=4, lw=0, cmap="viridis"
        )
        axes.axhline(0, color=INK, lw=0.5)
        axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.set_xlabel(f"{signal_name(rest.model, rest.port, signal)} [{unit}]", fontsize=9)
        opened(axes)
    for axes in panels[::columns]:
        axes.set_ylabel(f"remaining {noun(rest.port.unit)} [{prefix}{unit_symbol(rest.port.unit)}]", fontsize=9)
    figure.colorbar(dots, ax=panels, label=f"time [{clock}]", pad=0.02)
    _bars(figure.add_subplot(grid[rows, :]), rest)
    return figure


def _bars(axes, rest: Rest) -> None:
    """Mean power, or mean flow, with two standard errors: all, parts of the window, small and large motion."""
    parts: list[tuple[str, Stretch]] = [("all", rest.whole)]
    clock, per = time_unit(float(np.ptp(rest.time)))
    parts += [(f"{s.span[0] * per:.3g} to {s.span[1] * per:.3g} {clock}", s) for s in rest.stretches]
    parts += [("small motion", rest.small), ("large motion", rest.large)]
    prefix, factor = prefix_for(2 * max(abs(s.power) for _, s in parts))
    values = np.array([[s.power, s.error] for _, s in parts]) * factor
    places = np.arange(len(parts))
    colors = [MODEL if p < -2 * e else WARN if p > 2 * e else QUIET for p, e in values]
    axes.barh(places, values[:, 0], xerr=2 * values[:, 1], color=colors, height=0.65, error_kw={"lw": 1, "ecolor": INK})
    axes.axvline(0, color=INK, lw=0.5)
    axes.set_yticks(places, [name for name, _ in parts], fontsize=8.5)
    axes.invert_yaxis()
    unit = rest.port.unit if rest.first_order else power_unit(rest)
    what = "mean flow" if rest.first_order else "mean power into the motion"
    axes.set_xlabel(f"{what} [{prefix}{unit_symbol(unit)}]", fontsize=9)
    opened(axes)
