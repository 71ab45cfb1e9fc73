"""Figure of a planned motion."""

from __future__ import annotations

from symid.optimization import Plan
from symid.plots.style import MODEL, QUIET, Picture, opened, over_time, size_of
from symid.units import unit_for


def plot_plan(plan: Plan) -> Picture:
    """States, controls and algebraic variables over time, one axes for each, with the bounds that they touch.

    Parameters
    ----------
    plan : what an Optimization gives.

    Examples
    --------
    >>> m = si.Model("cart")
    >>> m.x, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2")
    >>> m.motion = si.Equation({0: m.x.dot - m.v, 1: m.v.dot - m.force})
    >>> m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    >>> m.effort = si.Objective(running=m.force**2)
    >>> plot_plan(si.Optimization(m, duration=1, nodes=21).solve()).savefig("plan.png")
    """
    frame, model = plan.trajectories, plan.problem.transcription.model
    rows = -(-len(frame.columns) // 2)
    figure = Picture(figsize=(9, 1.5 * rows + 0.6), layout="constrained")
    axes = figure.subplots(rows, 2, sharex=True, squeeze=False).ravel()
    time = frame.index.to_numpy()
    factor_t = over_time(axes[0], time)
    axes[0].set_xlabel("")
    for name, ax in zip(frame.columns, axes, strict=False):
        values = frame[name].to_numpy()
        unit, factor = unit_for(size_of(values), model[name].unit)
        values, held = values * factor, getattr(model[name], "hold", "") == "zero"
        ax.plot(time * factor_t, values, color=MODEL, lw=1.2, drawstyle="steps-post" if held else "default")
        for bound in model[name].bounds:
            if values.min() - 1e-6 <= bound * factor <= values.max() + 1e-6:
                ax.axhline(bound * factor, color=QUIET, lw=1, zorder=0)
        ax.set_title(name.replace("_", " "), loc="left", fontsize=10)
        ax.set_ylabel(unit)
        opened(ax)
    for ax in axes[len(frame.columns) :]:
        ax.set_visible(False)
    for ax in axes[max(0, len(frame.columns) - 2) : len(frame.columns)]:
        over_time(ax, time)
        ax.tick_params(labelbottom=True)
    return figure
