"""The report on a study: every problem with its best solve, and how all of its solves ended."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from symid.files import write_atomically
from symid.identification.fit import common_unit, rms_text
from symid.identification.studies.study_result import StudyResult
from symid.plots import plot_study
from symid.plots.study import by_problem
from symid.report.origin import CITATION, origin, written
from symid.report.page import facts, figure, folded, heading, page, paragraph, table
from symid.report.solution import in_words
from symid.units import unit_symbol, with_error

SAME = 1e-3
"""Relative difference of objectives below which two solves found the same optimum."""


def write_study_report(result: StudyResult, path: str | Path, name: str = "Study") -> Path:
    """Write a report on a study as one HTML file with its figures inside, whole or not at all.

    Parameters
    ----------
    path : of the file; its folder must exist. name : title of the page.

    Examples
    --------
    ::

        result = si.Study.product({"PD": pd_problem, "FPD": fpd_problem}, starts=10).run()
        write_study_report(result, "study.html")
    """
    return write_atomically(path, study_html(result, name))


def study_html(result: StudyResult, name: str = "Study") -> str:
    """The same as text."""
    rows, groups = result.rows, by_problem(result)
    solved, few = sum(r.solved for r in rows.values()), len(groups) == 1
    lead = f"{solved} of {len(rows)} solves of {len(groups)} problem{'' if few else 's'} ended at an optimum."
    parts = [paragraph(lead, "lead" if solved == len(rows) else "bad"), heading("Problems"), _problems(result, groups)]
    note = (
        f"The same optimum: objectives within {100 * SAME:g} % of the best. Seconds are those of all solves together."
    )
    hollow = "; hollow ones did not reach an optimum" if solved < len(rows) else ""
    parts += [paragraph(note, "note"), figure(plot_study(result), f"Every solve{hollow}.")]
    parts += [heading("Best parameters"), *_parameters(result, groups), heading("Solves"), _solves(result)]
    parts += [heading("Provenance"), facts(origin()), heading("Please cite"), *map(paragraph, CITATION)]
    return page(name, *parts, footer=written())


def _problems(result: StudyResult, groups: dict[str, list[str]]) -> str:
    cells = []
    for label, names in groups.items():
        rows = [result.rows[n] for n in names]
        solved = [r for r in rows if r.solved]
        best = min(solved, key=lambda r: r.objective, default=None)
        unit = common_unit(y.unit for y in result.solves[names[0]].problem.model.outputs.values())
        same = (
            0 if best is None else sum(abs(r.objective - best.objective) <= SAME * abs(best.objective) for r in solved)
        )
        cells.append(
            [
                label,
                f"{len(solved)} of {len(rows)}",
                f"{same} of {len(rows)}",
                "none" if best is None else rms_text(best.rms, unit),
                f"{sum(r.seconds for r in rows):.1f}",
            ]
        )
    return table(["problem", "solved", "at the same optimum", "RMS error of the best", "seconds"], cells)


def _parameters(result: StudyResult, groups: dict[str, list[str]]) -> list[str]:
    """Of each problem, those of its best solve; how far the solved starts scatter stands beside."""
    parts = []
    for label, names in groups.items():
        solved = [r for r in (result.rows[n] for n in names) if r.solved]
        if not solved:
            continue
        best = min(solved, key=lambda r: r.objective)
        declared = result.solves[names[0]].problem.model.parameters
        rows = []
        for name, value in best.parameters.items():
            found = [r.parameters[name] for r in solved]
            low, high = (with_error(float(end(found)), np.nan) for end in (np.min, np.max))
            spread = f"{low} to {high}" if low != high else "the same"
            unit = unit_symbol(declared[name.split("[")[0]].unit)
            rows.append([name, with_error(value, np.nan, digits=4), unit, spread])
        parts.append(folded(label, table(["parameter", "value", "unit", "over all solved starts"], rows)))
    return parts or [paragraph("None was solved.")]


def _solves(result: StudyResult) -> str:
    marked = [not r.solved for r in result.rows.values()]
    rows = [
        [name, r.kind, in_words(r.status, r.solved), r.iterations, f"{r.seconds:.2f}"]
        + ([r.message if not r.solved else ""] if any(marked) else [])
        for name, r in result.rows.items()
    ]
    return folded(
        f"All {len(rows)}",
        table(
            ["solve", "start", "status", "iterations", "seconds", *(["what happened"] if any(marked) else [])],
            rows,
            marked,
            wide=["start", "seconds", "what happened"],
        ),
    )
