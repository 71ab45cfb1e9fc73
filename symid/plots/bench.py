"""Figures of measurements: growth of the cost, formulations head to head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from symid.plots.style import INK, MODEL, RECORDED, Picture, opened, plain_ticks


def plot_growth(found: Mapping[str, Sequence[Mapping]]) -> Picture:
    """Processor time [s] against nodes and against episodes, beside what n log n would be.

    Parameters
    ----------
    found : of `bench.growth.measure_growth`.
    """
    picture = Picture(figsize=(7.6, 3.3), layout="constrained")
    for axis, (by, runs) in zip(picture.subplots(1, len(found)), found.items(), strict=True):
        opened(axis)
        size, total = np.array([r[by] for r in runs]), np.array([r["total"] for r in runs])
        nodes = np.array([r["nodes"] for r in runs])
        reference = nodes * np.log(nodes)
        axis.loglog(
            size, reference * np.exp(np.mean(np.log(total / reference))), "--", color=RECORDED, lw=1, label="n log n"
        )
        axis.loglog(size, total, "o-", color=MODEL, ms=5, label="build and solve")
        axis.loglog(size, [r["iteration"] for r in runs], "s:", color=INK, ms=3.5, lw=1, label="one iteration")
        slope = np.polyfit(np.log(size), np.log(total), 1)[0]
        axis.set_title(f"time ~ {by}^{slope:.2f}", fontsize=9)
        axis.set_xticks(size, [str(s) for s in size], rotation=45 if by == "nodes" else 0, fontsize=8)
        axis.minorticks_off()
        axis.set_xlabel(by)
        axis.set_ylabel("processor time [s]")
        axis.legend(frameon=False, fontsize=8)
    return picture


PANELS = (
    ("stable", "stable controllers [%]"),
    ("gain_error", "error of the gains [%]"),
    ("held_out_deg", "held-out RMS [deg]"),
    ("seconds", "processor time [s]"),
)


def plot_formulations(rows: pd.DataFrame) -> Picture:
    """Per formulation: share of stable controllers, and each recording's gain error, held-out error and cost.

    Parameters
    ----------
    rows : of `bench.formulations.head_to_head`.
    """
    names = list(dict.fromkeys(rows["formulation"]))
    picture = Picture(figsize=(9.4, 0.6 * len(names) + 1.6), layout="constrained")
    for axis, (column, words) in zip(picture.subplots(2, 2, sharey=True).ravel(), PANELS, strict=True):
        opened(axis)
        for i, name in enumerate(names):
            values = rows[rows["formulation"] == name][column].astype(float)
            if column == "stable":
                axis.barh(i, 100 * values.mean(), color=MODEL, height=0.55)
                continue
            shown = 100 * values if column == "gain_error" else values
            axis.plot(shown, np.full(len(shown), i), "|", color=RECORDED, ms=9, mew=1.2)
            axis.plot([shown.median()], [i], "o", color=MODEL, ms=6)
        if column == "stable":
            axis.set_xlim(0, 105)
        else:
            axis.set_xscale("log")
            plain_ticks(axis.xaxis)
        axis.set_xlabel(words, fontsize=8.5)
    for axis in picture.axes[::2]:  # what stands on the left of a row
        axis.set_yticks(range(len(names)), names, fontsize=8)
    picture.axes[0].invert_yaxis()
    return picture
