"""Figures of a diagnosis: before and after, where, at which frequencies, by which suspect."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import welch

from symid.discrepancy.say.names import law_name
from symid.plots.style import INK, MODEL, QUIET, RECORDED, WARN, Picture, opened
from symid.units import shown_unit, unit_symbol

if TYPE_CHECKING:
    from symid.discrepancy import Diagnosis
    from symid.discrepancy.locate.latent import Latent
    from symid.estimation.free_run import FreeRun

ZOOM = 8.0
"""Seconds shown of each window: more and the curves cannot be told apart."""
WINDOWS = (("train", "fit window"), ("heldout", "held-out window"))
MOST_SUSPECTS = 12


def plot_before_after(diagnosis: Diagnosis) -> Picture:
    """Recorded, baseline and improved free runs, where the improvement is largest; residuals below."""
    windows = [(k, t) for k, t in WINDOWS if f"baseline_{k}" in diagnosis.runs]
    outputs = list(diagnosis.baseline.model.outputs.values())
    figure = Picture(figsize=(9.5, 2.5 * len(outputs) + 0.6), layout="constrained")
    grid = figure.subplots(
        2 * len(outputs), len(windows), sharex="col", squeeze=False, height_ratios=[2.4, 1] * len(outputs)
    )
    for first, column, (key, title) in zip((True, False), grid.T, windows, strict=False):
        before, after = diagnosis.runs[f"baseline_{key}"], diagnosis.runs[f"augmented_{key}"]
        rows = _where_most_changes(before, after)
        for i, output in enumerate(outputs):
            _panel(
                column[2 * i],
                column[2 * i + 1],
                before,
                after,
                rows,
                i,
                shown_unit(output.unit),
                bool(diagnosis.effects),
            )
            if first:
                unit = shown_unit(output.unit)[0]
                column[2 * i].set_ylabel(f"{output.channel.replace('_', ' ')}\n[{unit}]", fontsize=9)
                column[2 * i + 1].set_ylabel(f"error\n[{unit}]", fontsize=8)
        column[0].set_title(title, loc="left", fontsize=10)
        column[-1].set_xlabel("time [s]")
    figure.legend(
        *grid[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=3, frameon=False, fontsize=8.5
    )
    figure.align_ylabels(grid[:, 0])
    return figure


def _where_most_changes(before: FreeRun, after: FreeRun) -> np.ndarray:
    """Rows of the stretch in which the squared error falls most."""
    fall = ((before.recorded - before.simulated) ** 2 - (after.recorded - after.simulated) ** 2).sum(axis=1)
    total = np.concatenate([[0.0], np.cumsum(np.nan_to_num(fall))])
    n = min(len(fall), int(ZOOM / np.median(np.diff(before.time))))
    start = int(np.argmax(total[n:] - total[:-n])) if n < len(fall) else 0
    return np.arange(start, start + n)


def _panel(above, below, before: FreeRun, after: FreeRun, rows, i, unit, improved: bool) -> None:
    t, factor = before.time[rows], unit[1]
    # A new piece begins where time stands still; lines are not drawn across.
    above.plot(t, before.recorded[rows, i] * factor, color=RECORDED, lw=2.6, label="recorded")
    above.plot(t, before.simulated[rows, i] * factor, color=WARN, lw=1.0, label="model as given")
    below.axhline(0, color=INK, lw=0.5)
    below.plot(t, (before.recorded - before.simulated)[rows, i] * factor, color=WARN, lw=0.8)
    if improved:
        above.plot(t, after.simulated[rows, i] * factor, color=MODEL, lw=1.0, label="improved")
        below.plot(t, (after.recorded - after.simulated)[rows, i] * factor, color=MODEL, lw=0.8)
    above.set_xlim(t[0], t[-1])
    opened(above, below)


def plot_spectra(diagnosis: Diagnosis) -> Picture:
    """Power spectral density of the free run's error before and after, per output (Welch 1967)."""
    before, after = diagnosis.runs["baseline_train"], diagnosis.runs["augmented_train"]
    outputs = list(diagnosis.baseline.model.outputs.values())
    figure = Picture(figsize=(9.5, 2.9), layout="constrained")
    comparable = len({output.unit for output in outputs}) == 1
    panels = figure.subplots(1, len(outputs), squeeze=False, sharey=comparable)[0]
    rate = 1 / np.median(np.diff(before.time))
    length = min(len(before.time), int(10 * rate))
    for axes, output, i in zip(panels, outputs, range(len(outputs)), strict=True):
        unit, factor = shown_unit(output.unit)
        shown = [(before, WARN, "model as given")] + ([(after, MODEL, "improved")] if diagnosis.effects else [])
        for run, color, label in shown:
            f, power = welch((run.recorded - run.simulated)[:, i] * factor, rate, nperseg=length, detrend=False)
            axes.loglog(f[1:], power[1:], color=color, lw=1.1, label=label)
        axes.set_title(output.channel.replace("_", " "), loc="left", fontsize=10)
        axes.set_xlabel("frequency [Hz]")
        if axes is panels[0] or not comparable:
            axes.set_ylabel(f"power of the error\n[{f'({unit})' if '/' in unit else unit}²/Hz]", fontsize=9)
        opened(axes)
    panels[-1].legend(frameon=False, fontsize=8.5)
    return figure


def plot_scores(diagnosis: Diagnosis) -> Picture:
    """How much better the recording is explained with each single suspect, less the penalty of its parameters."""
    shown = diagnosis.ranking[:MOST_SUSPECTS]
    figure = Picture(figsize=(9.5, 0.28 * max(len(shown), 2) + 0.9), layout="constrained")
    axes = figure.subplots()
    chosen = {(e.name, e.location) for e in diagnosis.effects}
    alike = {str(c.suspect.term) for c in diagnosis.equivalent}
    scores = [c.score for c in shown]
    colors = [
        MODEL
        if (c.suspect.term.name, c.suspect.term.location) in chosen
        else "#8fb3d9"
        if str(c.suspect.term) in alike
        else QUIET
        for c in shown
    ]
    places = np.arange(len(shown))
    axes.barh(places, np.maximum(scores, 0), color=colors, height=0.7)
    for y, s in zip(places, scores, strict=True):
        axes.annotate(
            f"{s:,.0f}".replace("-", "\N{MINUS SIGN}"),
            (max(s, 0), y),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8.5,
            color=INK,
        )
    axes.set_yticks(places, [law_name(c.suspect.term.name, c.suspect.term.location) for c in shown], fontsize=8.5)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.12 * max([*scores, 1.0]))
    axes.set_xlabel(
        "score of each suspect alone: growth of twice the log-likelihood less the penalty of its parameters", fontsize=9
    )
    opened(axes)
    return figure


def plot_latent(before: Sequence[Latent], after: Sequence[Latent] = ()) -> Picture:
    """The torque that a model lacks over time, with a band of two standard errors; before and after."""
    figure = Picture(figsize=(9.5, 1.9 * len(before) + 0.4), layout="constrained")
    panels = figure.subplots(len(before), 1, squeeze=False, sharex=True)[:, 0]
    for i, (axes, latent) in enumerate(zip(panels, before, strict=True)):
        # Where a run begins the estimate is free: its band must not set the scale.
        margin = len(latent.time) // 50 + 1
        top = 1.25 * np.abs(latent.torque[margin:-margin]).max() or 1.0
        prefix, factor = next((p, f) for p, f in (("", 1.0), ("m", 1e3), ("µ", 1e6)) if top * f > 0.5 or p == "µ")
        axes.axhline(0, color=INK, lw=0.5)
        for one, color, label in [
            (latent, WARN, "model as given"),
            *((a, MODEL, "improved") for a in after[i : i + 1]),
        ]:
            torque, error = one.torque * factor, one.error * factor
            low, high = torque - 2 * error, torque + 2 * error
            axes.fill_between(one.time, low, high, color=color, alpha=0.18, lw=0)
            axes.plot(one.time, torque, color=color, lw=0.8, label=label)
        axes.set(xlim=(latent.time[0], latent.time[-1]), ylim=(-top * factor, top * factor))
        axes.set_ylabel(f"{latent.place}\n[{prefix}{unit_symbol(latent.unit)}]", fontsize=9)
        opened(axes)
    panels[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, frameon=False, fontsize=8.5, borderaxespad=0.1)
    panels[-1].set_xlabel("time [s]")
    return figure
