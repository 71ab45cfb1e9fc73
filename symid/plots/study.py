"""Figure of a study: how every solve of every problem ended."""

from __future__ import annotations

import numpy as np
from matplotlib.ticker import MaxNLocator

from symid.identification.fit import common_unit
from symid.identification.studies.study_result import StudyResult
from symid.plots.style import MODEL, WARN, Picture, opened
from symid.units import unit_for

EDGE = 0.05
"""Part of the axis to the right of the largest value, for the whole of its mark."""


def plot_study(result: StudyResult) -> Picture:
    """RMS error of every solve, one line for each problem, and how long it took.

    Parameters
    ----------
    result : what a Study gives.

    Examples
    --------
    >>> study = si.Study.product({"given": problem, "short": si.Identification(model, recording, (0, 3))}, starts=1)
    >>> plot_study(study.run_here(on_finished=None)).savefig("study.png")
    """
    groups = by_problem(result)
    unit = common_unit(y.unit for s in result.solves.values() for y in s.problem.model.outputs.values())
    rows = [row for row in result.rows.values() if np.isfinite(row.rms)]
    text, factor = unit_for(max((row.rms for row in rows), default=0.0), unit or "1")
    figure = Picture(figsize=(9, 0.5 * len(groups) + 1.0), layout="constrained")
    errors, times = figure.subplots(1, 2, sharey=True, width_ratios=[1.6, 1])
    errors.set_zorder(times.get_zorder() + 1)  # its labels may go on there
    errors.patch.set_visible(False)
    for y, (label, names) in enumerate(groups.items()):
        told = errors.annotate(label, (0.01, y - 0.32), xycoords=("axes fraction", "data"), fontsize=8.5, va="center")
        told.set_in_layout(False)  # a long one goes on above the other panel's points
        for row in (result.rows[n] for n in names):
            look = {"color": MODEL, "alpha": 0.6, "mec": "none"} if row.solved else {"mfc": "white", "mec": WARN}
            errors.plot(row.rms * factor, y, "o", ms=6, **look)
            times.plot(row.seconds, y, "o", ms=6, **look)
    errors.set_yticks([])
    errors.set_ylim(len(groups) - 0.5, -0.6)
    errors.set_xlabel(f"RMS error [{text or '1'}]" if unit else "RMS error,\noutputs of different units together")
    times.set_xlabel("solve [s]")
    for axes in (errors, times):
        opened(axes)
        low, high = axes.get_xlim()
        low = min(0.0, low) if np.isfinite(low) else 0.0
        axes.set_xlim(
            low, high + EDGE * (high - low)
        )  # from zero on, solves that ended alike have no margin of their own
        axes.xaxis.set_major_locator(MaxNLocator(4))
    return figure


def by_problem(result: StudyResult) -> dict[str, list[str]]:
    """Names of the solves of each problem, under its labels as one text."""
    groups: dict[str, list[str]] = {}
    for name, solve in result.solves.items():
        groups.setdefault(", ".join(map(str, dict(solve.labels).values())) or "all", []).append(name)
    return groups
