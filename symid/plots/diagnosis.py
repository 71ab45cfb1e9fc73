"""Figures of a diagnosis: before and after, where, at which frequencies, by which suspect."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import welch

from symid.discrepancy.policy import POLICY
from symid.discrepancy.say.names import law_name, place_name
from symid.plots.style import (
    INK,
    MODEL,
    QUIET,
    RECORDED,
    SWINGS,
    WARN,
    WARN_PALE,
    Picture,
    banded,
    opened,
    over_time,
    plain_ticks,
    size_of,
    swing,
)
from symid.units import prefix_for, time_unit, unit_for, unit_symbol

if TYPE_CHECKING:
    from symid.discrepancy import Diagnosis
    from symid.discrepancy.locate.latent import Latent
    from symid.discrepancy.model.hypothesis import Hypothesis
    from symid.estimation.free_run import FreeRun

IN_DETAIL = 1 / 5, 1 / 2
"""Shares of a window, the least and the most that is shown of forces in detail."""
WINDOWS = (("train", "fit window"), ("heldout", "held-out window"))
MOST_SUSPECTS = 12
PIECES = 40
"""Of a window, in each of which the size of a force is told."""
UNTOLD = "two standard errors"
CHOSEN, ALIKE, OTHER = "found", "explains the recording as well", "other suspects"
STANDINGS = {CHOSEN: (MODEL, MODEL), ALIKE: ("white", MODEL), OTHER: ("#9a9a9a", "#9a9a9a")}
"""How a suspect stands -> fill and edge of its mark."""


def plot_before_after(diagnosis: Diagnosis) -> Picture:
    """Recorded, baseline and improved free runs of a diagnosis, where the improvement is largest; residuals below.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> plot_before_after(found).savefig("before_after.png")                      # doctest: +SKIP
    """
    windows = [(k, t) for k, t in WINDOWS if f"baseline_{k}" in diagnosis.runs]
    outputs = list(diagnosis.baseline.model.outputs.values())
    figure = Picture(figsize=(9.5, 2.5 * len(outputs) + 0.6), layout="constrained")
    grid = figure.subplots(
        2 * len(outputs), len(windows), sharex="col", squeeze=False, height_ratios=[2.4, 1] * len(outputs)
    )
    for first, column, (key, title) in zip((True, False), grid.T, windows, strict=False):
        before, after = diagnosis.runs[f"baseline_{key}"], diagnosis.runs[f"augmented_{key}"]
        rows = _where_most_changes(before, after)
        scale = over_time(column[-1], before.time[rows])
        for i, output in enumerate(outputs):
            unit, factor, small, larger = _units(diagnosis, windows, i)
            panels = (column[2 * i], column[2 * i + 1])
            _panel(*panels, before, after, rows, i, scale, factor, larger, bool(diagnosis.named))
            if first:
                column[2 * i].set_ylabel(f"{output.channel.replace('_', ' ')}\n[{unit}]", fontsize=9)
                column[2 * i + 1].set_ylabel(f"error\n[{small}]", fontsize=8)
        column[0].set_title(title, loc="left", fontsize=10)
    figure.legend(
        *grid[0, 0].get_legend_handles_labels(), loc="outside upper right", ncols=3, frameon=False, fontsize=8.5
    )
    figure.align_ylabels(grid[:, 0])
    return figure


def _units(diagnosis: Diagnosis, windows, i: int) -> tuple[str, float, str, float]:
    """Unit and factor of output `i`, and of its error: one for all windows, whose panels have one label."""
    runs = [diagnosis.runs[f"baseline_{key}"] for key, _ in windows]
    unit = list(diagnosis.baseline.model.outputs.values())[i].unit
    error = size_of(*(run.recorded[:, i] - run.simulated[:, i] for run in runs))
    return *unit_for(size_of(*(run.recorded[:, i] for run in runs)), unit), *unit_for(error, unit)


def _where_most_changes(before: FreeRun, after: FreeRun) -> np.ndarray:
    """Rows of the stretch in which the squared error falls most."""
    fall = ((before.recorded - before.simulated) ** 2 - (after.recorded - after.simulated) ** 2).sum(axis=1)
    total = np.concatenate([[0.0], np.cumsum(np.nan_to_num(fall))])
    n = min(len(fall), _samples(before))
    start = int(np.argmax(total[n:] - total[:-n])) if n < len(fall) else 0
    return np.arange(start, start + n)


def _samples(run: FreeRun) -> int:
    """Samples of a stretch in which the single swings can be told apart."""
    return max(2, int(SWINGS * swing(run.time, run.recorded.T) / np.median(np.diff(run.time))))


def _panel(above, below, before: FreeRun, after: FreeRun, rows, i, scale, factor, larger, improved: bool) -> None:
    t = before.time[rows] * scale
    # A new piece begins where time stands still; lines are not drawn across.
    above.plot(t, before.recorded[rows, i] * factor, color=RECORDED, lw=2.6, label="recorded")
    above.plot(t, before.simulated[rows, i] * factor, color=WARN, lw=1.0, label="model as given")
    below.axhline(0, color=INK, lw=0.5)
    below.plot(t, (before.recorded - before.simulated)[rows, i] * larger, color=WARN, lw=0.8)
    if improved:
        above.plot(t, after.simulated[rows, i] * factor, color=MODEL, lw=1.0, label="improved")
        below.plot(t, (after.recorded - after.simulated)[rows, i] * larger, color=MODEL, lw=0.8)
    opened(above, below)


def plot_spectra(diagnosis: Diagnosis) -> Picture:
    """Power spectral density of the free run's error before and after a diagnosis, per output (Welch 1967).

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> plot_spectra(found).savefig("spectra.png")                                # doctest: +SKIP
    """
    before, after = diagnosis.runs["baseline_train"], diagnosis.runs["augmented_train"]
    outputs = list(diagnosis.baseline.model.outputs.values())
    figure = Picture(figsize=(9.5, 2.9), layout="constrained")
    comparable = len({output.unit for output in outputs}) == 1
    panels = figure.subplots(1, len(outputs), squeeze=False, sharey=comparable)[0]
    rate = 1 / np.median(np.diff(before.time))
    length = min(len(before.time), _samples(before))
    for axes, output, i in zip(panels, outputs, range(len(outputs)), strict=True):
        unit, factor = unit_for(size_of(before.recorded[:, i]), output.unit)
        shown = [(before, WARN, 1.0, "model as given")]
        if diagnosis.named:
            shown = [(before, WARN_PALE, 3.0, "model as given"), (after, MODEL, 1.0, "improved")]
        for run, color, width, label in shown:  # where both agree the one shows below the other
            f, power = welch((run.recorded - run.simulated)[:, i] * factor, rate, nperseg=length, detrend=False)
            axes.loglog(*banded(f[1:], power[1:]), color=color, lw=width, label=label)
        axes.set_title(output.channel.replace("_", " "), loc="left", fontsize=10)
        axes.set_xlabel("frequency [Hz]")
        plain_ticks(axes.xaxis)
        if axes is panels[0] or not comparable:
            axes.set_ylabel(f"power of the error\n[{f'({unit})' if {'/', ' '} & set(unit) else unit}²/Hz]", fontsize=9)
        opened(axes)
    figure.legend(
        *panels[-1].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=8.5
    )
    return figure


def plot_scores(diagnosis: Diagnosis) -> Picture:
    """How far each single suspect of a diagnosis stays behind the best one; at the dashed line all is chance.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> plot_scores(found).savefig("scores.png")                                  # doctest: +SKIP
    """
    shown = sorted(diagnosis.ranking, key=lambda c: -c.score)[:MOST_SUSPECTS]
    names = [law_name(c.suspect.term.name, c.suspect.term.location).replace(" at ", "\nat ") for c in shown]
    row = 0.42 if any("\n" in name for name in names) else 0.34  # inches; two lines of 8 points fit into the first
    figure = Picture(figsize=(9.5, row * max(len(shown), 2) + 1.2), layout="constrained")
    axes = figure.subplots()
    best = shown[0].score
    behind, places = np.array([best - c.score for c in shown]), np.arange(len(shown))
    looks = np.array([_standing(diagnosis, c) for c in shown])
    for look, (color, edge) in STANDINGS.items():
        if (looks == look).any():  # a legend for what is drawn, and for nothing else
            axes.plot(behind[looks == look], places[looks == look], "o", ms=7, color=color, mec=edge, label=look)
    axes.set_xscale("symlog", linthresh=POLICY.equivalent, linscale=0.6)
    axes.axvspan(-POLICY.equivalent / 4, POLICY.equivalent, color=QUIET, alpha=0.35, lw=0, zorder=0)
    far = max(2.0 * behind.max(), 1.6 * best, 10 * POLICY.equivalent)
    if best > 0:
        axes.axvline(best, color=INK, lw=0.8, ls="--")
    for y, x, c in zip(places, behind, shown, strict=True):
        text = f"{c.score:,.0f}".replace("-", "\N{MINUS SIGN}")
        left = 0 < best / 5 < x  # away from the dashed line, which stays behind it
        side = {"xytext": (-7 if left else 7, 0), "ha": "right" if left else "left"}
        ground = {"fc": "white", "ec": "none", "pad": 0.5} if left else None
        axes.annotate(text, (x, y), textcoords="offset points", va="center", fontsize=8, color=INK, bbox=ground, **side)
    axes.set_yticks(places, names, fontsize=8, linespacing=1.0)
    axes.set(xlim=(-POLICY.equivalent / 4, far), ylim=(len(shown) - 0.4, -0.6))
    decades = int(np.log10(far))
    ticks = [0, *(10**k for k in range(decades, 0, -1 if decades < 4 else -2))]
    axes.set_xticks(ticks, [f"{x:,}" for x in ticks])
    axes.minorticks_off()
    figure.supxlabel("score behind that of the best single suspect", fontsize=9)
    figure.legend(
        *axes.get_legend_handles_labels(),
        fontsize=8.5,
        frameon=False,
        ncols=3,
        loc="outside upper right",
        columnspacing=1.0,
        handletextpad=0.2,
    )
    opened(axes)
    return figure


def _standing(diagnosis: Diagnosis, suspect: Hypothesis) -> str:
    """Which of STANDINGS a suspect of the ranking has."""
    term = suspect.suspect.term
    if (term.name, term.location) in {(e.name, e.location) for e in diagnosis.effects}:
        return CHOSEN
    return ALIKE if str(term) in {str(c.suspect.term) for c in diagnosis.equivalent} else OTHER


def plot_latent(before: Sequence[Latent], after: Sequence[Latent] = ()) -> Picture:
    """The force that a model lacks at each place: its size over the window, and a stretch with two standard errors.

    Places whose forces have one unit share unit and scale.

    Parameters
    ----------
    before, after : forces at each place, of the model as given and of the improved one.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> from symid.discrepancy.locate.latent import latent_torques
    >>> forces = latent_torques(found.baseline, found.runs["baseline_train"])     # doctest: +SKIP
    >>> plot_latent(forces).savefig("forces.png")                                 # doctest: +SKIP
    """
    time = before[0].time
    stretch = _loudest(before)
    parted = 2 * (stretch.stop - stretch.start) < len(time)
    figure = Picture(figsize=(9.5, 1.9 * len(before) + 0.6), layout="constrained")
    panels = figure.subplots(len(before), 1 + parted, squeeze=False, sharex="col", width_ratios=[1, 1.3][1 - parted :])
    tops = [1.25 * np.abs(b.torque[stretch]).max() or 1.0 for b in before]
    scale, near = time_unit(float(np.ptp(time)))[1], time_unit(float(np.ptp(time[stretch])))[1]
    for i, (row, latent) in enumerate(zip(panels, before, strict=True)):
        top = max(t for t, b in zip(tops, before, strict=True) if b.unit == latent.unit)
        prefix, factor = prefix_for(2 * top)
        if parted:
            centres, sizes = _sizes(latent.time * scale, latent.error)
            row[0].fill_between(centres, 0, 2 * sizes * factor, color=QUIET, alpha=0.6, lw=0, step="mid", label=UNTOLD)
        shown = [(latent, WARN, "model as given"), *((a, MODEL, "improved") for a in after[i : i + 1])]
        for one, color, label in shown:
            _force(row[-1], one, stretch, near, factor, color, label)
            if parted:
                centres, sizes = _sizes(one.time * scale, one.torque)
                row[0].plot(centres, sizes * factor, color=color, lw=1.2, drawstyle="steps-mid")
        row[-1].axhline(0, color=INK, lw=0.5)
        row[-1].set_ylim(-top * factor, top * factor)
        row[0].set_ylabel(f"{place_name(latent.place)}\n[{prefix}{unit_symbol(latent.unit)}]", fontsize=9)
        opened(*row)
    if parted:
        _share_scale(panels[:, 0], before)
        panels[0, 0].set_title("size (RMS)", loc="left", fontsize=10)
        panels[0, -1].set_title("in detail", loc="left", fontsize=10)
    drawn = dict(zip(*reversed(panels[0, -1].get_legend_handles_labels()), strict=True))
    drawn |= dict(zip(*reversed(panels[0, 0].get_legend_handles_labels()), strict=True))
    figure.legend(drawn.values(), drawn, loc="outside upper right", ncols=3, frameon=False, fontsize=8.5)
    over_time(panels[-1, 0], time)
    over_time(panels[-1, -1], time[stretch])
    figure.align_ylabels(panels[:, 0])
    return figure


def _force(axes, latent: Latent, rows: slice, scale: float, factor: float, color: str, label: str) -> None:
    time = latent.time[rows] * scale
    torque, error = latent.torque[rows] * factor, latent.error[rows] * factor
    axes.fill_between(time, torque - 2 * error, torque + 2 * error, color=color, alpha=0.18, lw=0)
    axes.plot(time, torque, color=color, lw=0.9, label=label)


def _loudest(latents: Sequence[Latent]) -> slice:
    """Samples of the stretch of some swings with the largest forces; where a run begins and ends the estimate is
    free.
    """
    time = latents[0].time
    span, wanted = time[-1] - time[0], SWINGS * swing(time, np.stack([b.torque for b in latents]))
    share = float(np.clip(wanted / span, *IN_DETAIL))
    margin, count = len(time) // 50 + 1, max(2, int(share * len(time)))
    if count + 2 * margin >= len(time):
        return slice(margin, len(time) - margin)
    power = sum((b.torque / (np.std(b.torque[margin:-margin]) or 1.0)) ** 2 for b in latents)
    total = np.convolve(power[margin:-margin], np.ones(count), "valid")
    first = margin + int(np.argmax(total))
    return slice(first, first + count)


def _sizes(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middles [s] of `PIECES` pieces of the window, and the RMS of the values in each."""
    pieces = np.array_split(np.arange(len(time)), PIECES)
    return (np.array([time[p].mean() for p in pieces]), np.array([np.sqrt(np.mean(values[p] ** 2)) for p in pieces]))


def _share_scale(panels, latents: Sequence[Latent]) -> None:
    """From zero to the same top for all forces of one unit."""
    tops = [axes.get_ylim()[1] for axes in panels]
    for axes, latent in zip(panels, latents, strict=True):
        axes.set_ylim(0, max(t for t, b in zip(tops, latents, strict=True) if b.unit == latent.unit))
