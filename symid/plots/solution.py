"""Figures of a solution."""

from __future__ import annotations

import numpy as np
from matplotlib.ticker import MaxNLocator

from symid.identification import Solution
from symid.identification.fit import common_unit, rms_text
from symid.plots.style import (
    INK,
    MODEL,
    QUIET,
    RECORDED,
    SWINGS,
    WARN,
    Picture,
    banded,
    bridged,
    opened,
    over_time,
    plain_ticks,
    size_of,
    swing,
)
from symid.units import unit_for, unit_symbol, with_error

SAME = 1.0
"""Percent: starts that end nearer to each other are drawn as ending at one place."""


def plot_fit(solution: Solution, episode: int = 0, window: tuple[float, float] | None = None) -> Picture:
    """Recorded and modelled outputs of one episode over time, and below each its residual.

    Parameters
    ----------
    window : part of the time [s] that is drawn, all by default; the errors in the titles are those of this part.

    Examples
    --------
    >>> plot_fit(solution, window=(0, 2)).savefig("fit.png")
    """
    frame = solution.trajectories[episode]
    frame = frame if window is None else frame.loc[window[0] : window[1]]
    outputs = solution.model.outputs
    figure = Picture(figsize=(9, 2.6 * len(outputs) + 0.5), layout="constrained")
    axes = figure.subplots(2 * len(outputs), 1, sharex=True, squeeze=False, height_ratios=[2.6, 1] * len(outputs))[:, 0]
    time = frame.index.to_numpy()
    factor_t = over_time(axes[-1], time)
    wide = (
        3.0 if time[-1] - time[0] <= 3 * SWINGS * _period(solution, episode) else 1.6
    )  # below a model that fits, the recording and its gaps show
    for (name, output), above, below in zip(outputs.items(), axes[::2], axes[1::2], strict=True):
        recorded, model = frame[f"{name} recorded"].to_numpy(), frame[name].to_numpy()
        error = recorded - model
        unit, factor = unit_for(size_of(recorded, model), output.unit)
        small, larger = unit_for(size_of(error), output.unit)
        above.plot(time * factor_t, recorded * factor, color=RECORDED, lw=wide, label="recorded")
        above.plot(time * factor_t, model * factor, color=MODEL, lw=0.9, label="model")
        below.axhline(0, color=INK, lw=0.5)
        below.plot(time * factor_t, error * larger, color=WARN, lw=0.6)
        rms = rms_text(float(np.sqrt(np.nanmean(error**2))), output.unit or "1", digits=3)
        above.set_title(f"{output.channel.replace('_', ' ')}: RMS error {rms}", loc="left", fontsize=10)
        above.set_ylabel(unit)
        below.set_ylabel(f"residual\n{small}", fontsize=8)
        opened(above, below)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=9)
    figure.align_ylabels(axes)
    return figure


def typical_stretch(solution: Solution, episode: int = 0) -> tuple[float, float] | None:
    """`SWINGS` swings [s] whose error is nearest to that of the whole; None where the whole is hardly longer.

    Parameters
    ----------
    episode : which one, from 0.

    Examples
    --------
    >>> typical_stretch(solution) is None                   # six seconds are hardly more than eight swings
    True
    """
    frame = solution.trajectories[episode]
    time = frame.index.to_numpy()
    count = max(2, int(SWINGS * _period(solution, episode) / (time[-1] - time[0]) * len(time)))
    if 2 * count >= len(time):
        return None
    error = np.stack([frame[name] - frame[f"{name} recorded"] for name in solution.model.outputs])
    square = error**2 / np.maximum(np.nanmean(error**2, axis=1, keepdims=True), 1e-300)
    share = np.convolve(np.nan_to_num(square, nan=1.0).mean(axis=0), np.full(count, 1 / count), "valid")
    first = int(np.argmin(np.abs(share - 1)))
    return float(time[first]), float(time[first + count - 1])


def _period(solution: Solution, episode: int) -> float:
    """Time [s] of a swing of the modelled outputs."""
    frame = solution.trajectories[episode]
    return swing(frame.index.to_numpy(), np.stack([frame[name].to_numpy() for name in solution.model.outputs]))


def plot_inputs(solution: Solution, episode: int = 0) -> Picture:
    """What drove the model in one episode: its recorded inputs over time.

    Examples
    --------
    >>> plot_inputs(solution).savefig("inputs.png")
    """
    t = solution.transcription
    measured = t.measured[t.recording_of[episode]]
    inputs = solution.model.inputs
    figure = Picture(figsize=(9, 1.5 * len(inputs) + 0.5), layout="constrained")
    panels = figure.subplots(len(inputs), 1, sharex=True, squeeze=False)[:, 0]
    time = measured.time[measured.nodes]
    factor_t = over_time(panels[-1], time)
    for (name, part), axes in zip(inputs.items(), panels, strict=True):
        values = measured.inputs[name][measured.nodes]
        unit, factor = unit_for(size_of(values), part.unit)
        axes.plot(time * factor_t, values * factor, color=INK, lw=0.7)
        axes.set_title(part.channel.replace("_", " "), loc="left", fontsize=10)
        axes.set_ylabel(unit)
        opened(axes)
    figure.align_ylabels(panels)
    return figure


def plot_residual_spectra(solution: Solution, episode: int = 0) -> Picture:
    """Power spectral density of each output's recording and residual in one episode (Welch 1967).

    Examples
    --------
    >>> plot_residual_spectra(solution).savefig("spectra.png")
    """
    from scipy.signal import welch

    frame = solution.trajectories[episode]
    outputs = solution.model.outputs
    rate = (len(frame) - 1) / (frame.index[-1] - frame.index[0])
    length = min(len(frame), max(int(SWINGS * _period(solution, episode) * rate), len(frame) // 8))
    figure = Picture(figsize=(9, 2.2 * len(outputs) + 0.5), layout="constrained")
    panels = figure.subplots(len(outputs), 1, sharex=True, squeeze=False)[:, 0]
    for (name, output), axes in zip(outputs.items(), panels, strict=True):
        recorded = frame[f"{name} recorded"].to_numpy()
        unit, factor = unit_for(size_of(recorded), output.unit)
        recorded = recorded * factor
        signals = {
            "recorded": (recorded, RECORDED, 2.0),
            "residual": (recorded - frame[name].to_numpy() * factor, WARN, 1.0),
        }
        for label, (signal, colour, width) in signals.items():
            frequency, power = welch(bridged(signal - np.nanmean(signal)), rate, nperseg=length)
            f, power = banded(frequency[1:], power[1:])
            axes.loglog(f, np.maximum(power, 1e-300), color=colour, lw=width, label=label)
        axes.set_title(output.channel.replace("_", " "), loc="left", fontsize=10)
        axes.set_ylabel(f"{unit or '1'}² / Hz" if not {"/", " "} & set(unit) else f"({unit})² / Hz")
        opened(axes)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=9)
    panels[-1].set_xlabel("frequency [Hz]")
    plain_ticks(panels[-1].xaxis)
    figure.align_ylabels(panels)
    return figure


def plot_parameters(solution: Solution, truth: dict[str, float] | None = None) -> Picture:
    """Parameters with their 95 % intervals, one panel for each unit.

    An interval that would make the others unreadable is cut off and ends in an arrow head; a
    parameter at a bound is marked, it has no interval.

    Parameters
    ----------
    truth : known values [SI] to be shown beside, for a synthetic recording.

    Examples
    --------
    >>> plot_parameters(solution, truth={"damping": 0.4}).savefig("parameters.png")
    """
    groups = list(solution.parameters.groupby("unit", sort=False))
    rows = [len(table) for _, table in groups]
    figure = Picture(figsize=(8.5, 0.3 * sum(rows) + 0.75 * len(rows) + 0.3), layout="constrained")
    panels = figure.subplots(len(rows), 1, squeeze=False, height_ratios=[n + 0.6 for n in rows])[:, 0]
    for (unit, table), axes in zip(groups, panels, strict=True):
        _parameter_panel(axes, table, unit, truth or {})
    return figure


def _parameter_panel(axes, table, unit: str, truth: dict[str, float]) -> None:
    places = np.arange(len(table))[::-1]
    value, half = table["value"].to_numpy(), 1.96 * table["std_error"].to_numpy()
    low, high = _limits(value, half, [truth[k] for k in table.index if k in truth])
    axes.axvline(0, color=QUIET, lw=1, zorder=0)
    for name, y, v, h, bound in zip(table.index, places, value, half, table["at_bound"], strict=True):
        if bound:
            axes.plot(v, y, "s", mfc="white", mec=WARN, ms=6)
            text = f"{v:.4g}  at its bound"
        else:
            if np.isfinite(h):
                axes.plot(np.clip([v - h, v + h], low, high), [y, y], color=MODEL, lw=2, solid_capstyle="butt")
                for end, mark in ((v - h, 8), (v + h, 9)):  # matplotlib's caret markers, left and right
                    if not low <= end <= high:
                        axes.plot(np.clip(end, low, high), y, marker=mark, color=MODEL, ms=6, clip_on=False)
            axes.plot(v, y, "o", color=MODEL, ms=5)
            text = with_error(v, h / 1.96, digits=4) + ("" if np.isfinite(h) else "  (no standard error)")
        if name in truth:
            axes.plot(truth[name], y, "x", color=INK, ms=7, mew=1.6, zorder=5)
        axes.annotate(
            text.replace("-", "\N{MINUS SIGN}"),
            (1.02, y),  # clear of an arrow head
            xycoords=("axes fraction", "data"),
            va="center",
            fontsize=8.5,
            color=WARN if bound else INK,
        )
    axes.set_yticks(places, table.index, fontsize=8.5)
    axes.set(xlim=(low, high), ylim=(-0.7, len(table) - 0.3))
    axes.xaxis.set_major_locator(MaxNLocator(5))  # as many as a phone has room for
    axes.xaxis.get_major_formatter().set_useMathText(True)
    legend = "     × true value" if truth else ""
    axes.set_title(f"[{unit_symbol(unit) or '1'}]{legend}", loc="left", fontsize=9)
    opened(axes)


def _limits(value: np.ndarray, half: np.ndarray, others: list[float]) -> tuple[float, float]:
    """An axis that holds all values, and of their intervals as much as leaves the values apart."""
    shown = np.array([*value, *others, 0.0] if len(value) == 1 else [*value, *others])
    ends = np.nan_to_num(half)
    shortest = ends[ends > 0].min() if ends.any() else 0.0  # what is hardly longer hides nothing
    span = max(np.ptp(shown), 1e-3 * np.abs(shown).max(), 4.0 * shortest, 1e-12)
    low = max(min((value - ends).min(), shown.min()), shown.min() - 1.5 * span)
    high = min(max((value + ends).max(), shown.max()), shown.max() + 1.5 * span)
    margin = 0.06 * max(high - low, span)
    return low - margin, high + margin


def plot_starts(solution: Solution) -> Picture:
    """How every start ended: its error by its number, and how far its parameters are from the best's.

    Parameters
    ----------
    solution : of several starts; errors are in the unit of its outputs.

    Examples
    --------
    >>> plot_starts(problem.solve(starts=2)).savefig("starts.png")
    """
    rows, names = solution.starts, list(solution.values)
    together = common_unit(y.unit for y in solution.model.outputs.values())
    error = np.array([r.rms for r in rows])
    unit, factor = unit_for(size_of(error), together or "1")
    figure = Picture(figsize=(9, max(3.2, 0.24 * len(names) + 1.2)), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[1, 1.3])
    number, error = np.array([r.number + 1 for r in rows]), error * factor
    solved, best = np.array([r.solved for r in rows]), np.arange(len(rows)) == solution.best
    for chosen, look, label in (
        (solved & ~best, {"color": MODEL}, "solved"),
        (solved & best, {"color": MODEL, "marker": "D"}, "best"),
        (~solved, {"mfc": "white", "mec": WARN}, "not solved"),
    ):
        if chosen.any():
            left.plot(number[chosen], error[chosen], **{"marker": "o", "ms": 6, "ls": "", "label": label} | look)
    left.legend(frameon=False, fontsize=8.5, ncols=3, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.1)
    left.set(
        xlabel="start",
        ylabel="RMS error" + (f" [{unit or '1'}]" if together else ", outputs of different units together"),
        xlim=(number.min() - 0.7, number.max() + 0.7),
        ylim=_apart(error),
    )
    left.xaxis.get_major_locator().set_params(integer=True)
    found = solution.starts[solution.best].parameters
    largest = {k: max(abs(r.parameters[k]) for r in rows if r.parameters) or 1.0 for k in names}
    for row in [r for r in rows if r.parameters]:
        away = [100 * (row.parameters[k] - found[k]) / largest[k] for k in names]
        look = {"color": MODEL, "mec": "none"} if row.solved else {"color": "white", "mec": WARN}
        right.plot(away, np.arange(len(names)), "o", ms=5, alpha=0.6, **look)
    right.set_yticks(np.arange(len(names)), names, fontsize=8)
    right.invert_yaxis()
    low, high = right.get_xlim()
    right.set_xlim(min(low, -SAME), max(high, SAME))
    right.set_xlabel("from the best start\n[% of largest size]", fontsize=9)
    opened(left, right)
    return figure


def _apart(values: np.ndarray) -> tuple[float, float]:
    """Limits in which values that are the same to `SAME` percent look the same."""
    known = values[np.isfinite(values)]
    if not len(known):
        return 0.0, 1.0
    middle, half = (known.max() + known.min()) / 2, 0.6 * (known.max() - known.min())
    half = max(half, SAME / 100 * abs(middle), 1e-12)
    return middle - half, middle + half
