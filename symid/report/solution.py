"""The report on one solution: what was found, how well it fits, how it was found, from what."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
from markupsafe import Markup

from symid.errors import ModelError
from symid.files import write_atomically
from symid.identification import Solution
from symid.identification.fit import common_unit, rms_text
from symid.identification.show import error_notes, headline, problem_facts
from symid.model.show import latex_lines
from symid.plots import (
    plot_fit,
    plot_inputs,
    plot_parameters,
    plot_poses,
    plot_residual_spectra,
    plot_starts,
    typical_stretch,
)
from symid.report.origin import CITATION, command, written
from symid.report.page import equations, facts, figure, folded, heading, number, page, paragraph, table
from symid.units import time_unit, typeset, unit_symbol, with_error

SHOWN_EPISODES = 3
"""Episodes that get figures of their own: more of them look alike."""
TOGETHER = 0.9
"""Correlation from which estimates are said to move together: the ellipse's smaller axis is a quarter of the larger."""


def write_report(
    solution: Solution, path: str | Path, held_out: Solution | None = None, truth: dict[str, float] | None = None
) -> Path:
    """Write a report on a solution as one HTML file with its figures inside, whole or not at all.

    Parameters
    ----------
    path : of the file; its folder must exist.
    held_out : what `Solution.free_run` gave on a window that was not fitted.
    truth : known parameter values [SI], where the recording is synthetic.

    Examples
    --------
    >>> write_report(solution, "report.html").name
    'report.html'
    """
    return write_atomically(path, report_html(solution, held_out, truth))


def report_html(solution: Solution, held_out: Solution | None = None, truth: dict[str, float] | None = None) -> str:
    """The same as text."""
    parts = [paragraph(headline(solution), "lead"), paragraph(solution.message, "note" if solution.solved else "bad")]
    parts += [paragraph(warning + ".", "bad") for warning in solution.warnings]
    parts += [
        heading("Parameters"),
        _parameters(solution, truth),
        _errors_note(solution),
        *_beyond_bounds(solution),
        *_together(solution),
        figure(plot_parameters(solution, truth), "Parameters with 95 % intervals, by unit."),
    ]
    parts += [heading("Fit"), _fit(solution, held_out), *_fit_figures(solution), *_held_out_figures(held_out)]
    parts += [figure(plot_residual_spectra(solution), "At which frequencies the residual is, beside the recording.")]
    if solution.model.inputs:
        parts.append(figure(plot_inputs(solution), "What drove the model: the recorded inputs."))
    parts += [heading("Model"), *_poses(solution), folded("Equations", equations(latex_lines(solution.model)))]
    parts += [heading("Starts"), _starts(solution)]
    if len(solution.starts) > 1:
        parts.append(figure(plot_starts(solution), "Where each start ended."))
    parts += [
        heading("Solver"),
        _solver(solution),
        heading("Provenance"),
        _provenance(solution),
        heading("Please cite"),
        *map(paragraph, CITATION),
    ]
    return page(solution.model.name, *parts, footer=written())


def _fit_figures(solution: Solution) -> list[str]:
    """The whole window of the first episodes, and a stretch in which single swings can be seen."""
    names = [frame.attrs["recording"] for frame in solution.trajectories]
    single = len(set(names)) == len(names)
    found = [_by_recording(solution)] if single and len(names) > 1 else []
    for episode, name in enumerate(names[:SHOWN_EPISODES]):
        which = name if single else f"{name}, episode {episode + 1}"
        found.append(figure(plot_fit(solution, episode), f"Recorded, model and residual of {which}."))
    if len(names) > SHOWN_EPISODES:
        kind = "recordings" if single else "episodes"
        found.append(paragraph(f"Of {len(names)} {kind} the first {SHOWN_EPISODES} are shown.", "note"))
    if (stretch := typical_stretch(solution)) is not None:
        caption = "A stretch of it whose error is as large as that of the whole."
        found.append(figure(plot_fit(solution, 0, stretch), caption))
    return found


def _by_recording(solution: Solution) -> str:
    """How well each of several recordings is fitted."""
    outputs = solution.model.outputs

    def errors(frame) -> list[str]:
        rms = {k: float(np.sqrt(np.nanmean((frame[k] - frame[f"{k} recorded"]) ** 2))) for k in outputs}
        return [rms_text(rms[k], y.unit or "1") for k, y in outputs.items()]

    heads = ["recording", *(f"RMS error of {y.channel.replace('_', ' ')}" for y in outputs.values())]
    return folded("Each recording", table(heads, [[f.attrs["recording"], *errors(f)] for f in solution.trajectories]))


def _held_out_figures(held_out: Solution | None) -> list[str]:
    if held_out is None:
        return []
    t0, t1 = held_out.trajectories[0].index[[0, -1]]
    unit, factor = time_unit(t1 - t0)
    window = typeset(f"{t0 * factor:.4g} to {t1 * factor:.4g}")
    caption = f"Held out, {window} {unit}: the model runs freely from a fitted initial state, all parameters kept."
    return [figure(plot_fit(held_out), caption)]


def _beyond_bounds(solution: Solution) -> list[str]:
    """In words, whose 95 % interval reaches beyond a bound that the value itself does not touch."""
    told = []
    for name, p in solution.parameters.iterrows():
        half = 1.96 * p.std_error
        if np.isfinite(half) and not p.at_bound:
            ends = [("lower", p.lower)] * (p.value - half < p.lower) + [("upper", p.upper)] * (p.value + half > p.upper)
            told += [f"{name} ({side} bound {number(float(bound))} {unit_symbol(p.unit)})" for side, bound in ends]
    if not told:
        return []
    return [
        paragraph(
            f"The 95 % interval reaches beyond a bound: {', '.join(told)}. Intervals are symmetric; only "
            f"the part within "
            "the bounds is meant, and `symid.profile` gives one that knows of bounds.",
            "note",
        )
    ]


def _poses(solution: Solution) -> list[str]:
    """A stick figure, where the model is a planar chain of links."""
    try:
        picture = plot_poses(solution, window=typical_stretch(solution))
    except ModelError:
        return []
    return [figure(picture, "The body at some instants, lengths to scale.")]


def _together(solution: Solution) -> list[str]:
    """In words, which estimates the data determine together better than each alone."""
    covariance = solution.covariance.to_numpy()
    names, error = list(solution.values), np.sqrt(np.diag(covariance))
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = covariance / np.outer(error, error)
    pairs = [
        (abs(correlation[i, j]), i, j)
        for i, j in combinations(range(len(names)), 2)
        if abs(correlation[i, j]) > TOGETHER
    ]
    told = [
        f"{names[i]} and {names[j]} ({typeset(f'{correlation[i, j]:+.2f}')})" for _, i, j in sorted(pairs, reverse=True)
    ]
    return (
        [
            paragraph(
                f"Estimates that move together (correlation beyond {TOGETHER:g}): {', '.join(told)}. The data "
                "determine a combination of them better than each.",
                "note",
            )
        ]
        if told
        else []
    )


def _parameters(solution: Solution, truth: dict[str, float] | None) -> str:
    rows = []
    for name, p in solution.parameters.iterrows():
        bounds = f"{number(float(p.lower))} to {number(float(p.upper))}" + (", at its bound" if p.at_bound else "")
        row = [
            (name, p.meaning),
            with_error(p.value, p.std_error, digits=5).replace("-", "−"),
            unit_symbol(p.unit).replace(" ", "\N{NO-BREAK SPACE}"),
            bounds,
        ]
        rows.append(row[:2] + [number(float(truth[name]))] + row[2:] if truth else row)
    head = ["parameter", "value ± standard error", *(["true value"] if truth else []), "unit", "bounds"]
    return table(head, rows, solution.parameters["at_bound"], wide=["bounds"])


def _errors_note(solution: Solution) -> str:
    if not solution.solved:
        return paragraph(
            "Not solved, so there are no standard errors, and the values are where the solver stopped.", "bad"
        )
    at_bound = ["A parameter at a bound has no standard error"] if any(solution.parameters["at_bound"]) else []
    return paragraph(" ".join(f"{note[0].upper()}{note[1:]}." for note in (*error_notes(solution), *at_bound)), "note")


def _fit(solution: Solution, held_out: Solution | None) -> str:
    fits = {"fitted": solution.fit} | ({"held out, free run": held_out.fit} if held_out is not None else {})
    outputs = solution.model.outputs
    units: dict[str, str | None] = {name: y.unit or "1" for name, y in outputs.items()}
    units["all"] = common_unit(y.unit for y in outputs.values())
    rows = []
    for name in [n for n in solution.fit["rms"] if n != "all" or len(outputs) > 1]:
        row = [outputs[name].channel.replace("_", " ") if name in outputs else "all"]
        for fit in fits.values():
            measures = {"vaf_percent": ".1f", "r_squared": ".3f"}
            shares = [format(fit[k][name], form) if name in fit[k] else "" for k, form in measures.items()]
            row += [rms_text(fit["rms"][name], units[name]), *shares]
        rows.append(row)
    heads = [f"{kind}: {measure}" for kind in fits for measure in ("RMS error", "VAF [%]", "R²")]
    return table(["channel", *heads], rows, wide=[h for h in heads if not h.endswith("error")])


def _starts(solution: Solution) -> str:
    unit = common_unit(y.unit for y in solution.model.outputs.values())
    rows = [
        [
            r.number + 1,
            r.kind,
            in_words(r.status, r.solved),
            rms_text(r.rms, unit),
            r.iterations,
            f"{r.seconds:.2f}",
            "best" if i == solution.best else "",
        ]
        for i, r in enumerate(solution.starts)
    ]
    ended = table(
        ["start", "kind", "status", "RMS error", "iterations", "seconds", ""],
        rows,
        [not r.solved for r in solution.starts],
        wide=["kind", "seconds"],
    )
    return Markup("\n").join([ended, *_weighed_anew(solution)])


def _weighed_anew(solution: Solution) -> list[str]:
    """In words, that the solution is not where the best start ended."""
    if solution.result.objective == solution.starts[solution.best].objective:
        return []
    why = "with outputs weighed by the noise that it left, or from a better place"
    return [paragraph(f"From the end of the best start the problem was solved again, {why}.", "note")]


def in_words(status: str, solved: bool) -> str:
    """Ipopt's name of a status as words: Maximum_Iterations_Exceeded -> maximum iterations exceeded."""
    return "solved" if solved else status.replace("_", " ").lower()


def _solver(solution: Solution) -> str:
    linear = solution.result.linear_solver
    details = {
        "interface to Ipopt": solution.result.interface,
        "linear solver": f"{linear.name}: {linear.reason}",
        "factorisations": linear.factorisations,
        "numbers in the largest factor": linear.fill,
        "pivots put off": linear.delayed,
    }
    seconds = {f"{k.replace('_', ' ')} [s]": round(v, 3) for k, v in solution.seconds.items()}
    said = {
        "status": in_words(solution.result.status_name, solution.solved),
        "iterations": solution.result.iterations,
        "time [s]": seconds.pop("total [s]"),
    }
    details = {k: v for k, v in details.items() if v is not None} | seconds
    return Markup("\n").join([facts(said), folded("Where the time went", facts(details))])


def _provenance(solution: Solution) -> str:
    p = dict(solution.provenance)
    recordings = p.pop("recordings")
    constants, noise = p.pop("constants"), p.pop("noise") or []
    p["command"] = command(p["command"])
    plain = {k.replace("_", " "): ", ".join(map(str, v)) if isinstance(v, list) else v for k, v in p.items()}
    plain["episodes"] = problem_facts(solution.problem)["episodes"]
    plain["weights"] = (
        ", ".join(f"{k} {v:g}" for k, v in (p["weights"] or {}).items()) or "by the noise, or 1 for every output"
    )
    outputs = solution.model.outputs
    plain["noise that sets the weights"] = "; ".join(
        ", ".join(f"{k} {rms_text(v, outputs[k].unit or '1', 3)}" for k, v in table.items()) for table in noise
    )
    plain["terms"] = plain["terms"] or "none added"
    for r in recordings:
        window = typeset(f"{r['window_s'][0]:g} to {r['window_s'][1]:g}") + f" s, {r['nodes']} nodes"
        plain[f"recording '{r['name']}'"] = "; ".join([window, *r["history"]])
    units = {k: unit_symbol(c.unit) for k, c in solution.model.constants.items()}
    plain["constants"] = ", ".join(f"{k} = {v:g} {units[k]}".strip() for k, v in constants.items())
    return facts(plain)
