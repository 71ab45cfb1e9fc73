"""The report on one solution: what was found, how well it fits, how it was found, from what."""

from __future__ import annotations

from pathlib import Path

from symid.files import write_atomically
from symid.identification import Solution
from symid.identification.fit import common_unit, rms_text
from symid.identification.show import headline, warnings
from symid.plots import plot_fit, plot_parameters, plot_starts
from symid.report.page import facts, figure, heading, number, page, paragraph, table
from symid.units import unit_symbol


def write_report(solution: Solution, path: str | Path, held_out: dict | None = None,
                 truth: dict[str, float] | None = None) -> Path:
    """Write a report on a solution as one HTML file with its figures inside, whole or not at all.

    Parameters
    ----------
    held_out : fit of another window, from `Solution.fit_on`.
    truth : known parameter values [SI], where the recording is synthetic.
    """
    return write_atomically(path, report_html(solution, held_out, truth))


def report_html(solution: Solution, held_out: dict | None = None, truth: dict[str, float] | None = None) -> str:
    """The same as text."""
    parts = [paragraph(headline(solution), "lead"), paragraph(solution.message, "note" if solution.solved else "bad")]
    parts += [paragraph(warning + ".", "bad") for warning in warnings(solution)]
    parts += [heading("Parameters"), _parameters(solution, truth), _errors_note(solution),
              figure(plot_parameters(solution, truth), "Parameters with 95 % intervals, by unit.")]
    parts += [heading("Fit"), _fit(solution, held_out)]
    for episode in range(min(len(solution.trajectories), 3)):
        name = solution.trajectories[episode].attrs["recording"]
        parts.append(figure(plot_fit(solution, episode), f"{name}, episode {episode + 1}: recorded, model and residual."))
    parts += [heading("Starts"), _starts(solution)]
    if len(solution.starts) > 1:
        parts.append(figure(plot_starts(solution), "Where each start ended."))
    parts += [heading("Solver"), _solver(solution), heading("Provenance"), _provenance(solution)]
    return page(solution.model.name, *parts)


def _parameters(solution: Solution, truth: dict[str, float] | None) -> str:
    rows = []
    for name, p in solution.parameters.iterrows():
        row = [name, float(p.value), float(p.std_error), p.unit, f"{number(float(p.lower))} to {number(float(p.upper))}",
               "yes" if p.at_bound else "", p.meaning]
        rows.append(row[:2] + [float(truth[name])] + row[2:] if truth else row)
    head = ["parameter", "value", *(["true value"] if truth else []), "std. error", "unit", "bounds", "at bound", "meaning"]
    return table(head, rows, solution.parameters["at_bound"])


def _errors_note(solution: Solution) -> str:
    if not solution.solved:
        return paragraph("Not solved, so there are no standard errors, and the values are where the solver stopped.", "bad")
    return paragraph("Standard errors allow for residuals that are correlated in time and between channels; "
                     "a parameter at a bound has none.", "note")


def _fit(solution: Solution, held_out: dict | None) -> str:
    fits = {"fit": solution.fit} | ({"held out, free run": held_out} if held_out else {})
    units: dict[str, str | None] = {name: y.unit or "1" for name, y in solution.model.outputs.items()}
    units["all"] = common_unit(y.unit for y in solution.model.outputs.values())
    rows = []
    for which, fit in fits.items():
        for channel in fit["rms"]:
            shares = [number(fit[k][channel]) if channel in fit[k] else "" for k in ("vaf_percent", "r_squared")]
            rows.append([which, channel, rms_text(fit["rms"][channel], units[channel]), *shares])
    return table(["window", "channel", "RMS error", "VAF [%]", "R²"], rows)


def _starts(solution: Solution) -> str:
    unit = common_unit(y.unit for y in solution.model.outputs.values())
    rows = [[r.number + 1, r.kind, r.status, rms_text(r.rms, unit), r.iterations, round(r.seconds, 2),
             "best" if i == solution.best else ""] for i, r in enumerate(solution.starts)]
    return table(["start", "kind", "status", "RMS error", "iterations", "seconds", ""], rows,
                 [not r.solved for r in solution.starts])


def _solver(solution: Solution) -> str:
    return facts({"status": solution.result.status_name, "iterations": solution.result.iterations,
                  **{f"{k.replace('_', ' ')} [s]": round(v, 3) for k, v in solution.seconds.items()}})


def _provenance(solution: Solution) -> str:
    p = dict(solution.provenance)
    recordings = p.pop("recordings")
    constants = p.pop("constants")
    plain = {k.replace("_", " "): " ".join(map(str, v)) if isinstance(v, list) else v for k, v in p.items()}
    plain["episodes"] = ", ".join(f"{k.replace('_', ' ')} {v}" for k, v in p["episodes"].items() if v != {})
    plain["weights"] = ", ".join(f"{k} {v:g}" for k, v in p["weights"].items()) or "1 for every output"
    plain["terms"] = plain["terms"] or "none added"
    for r in recordings:
        plain[f"recording {r['name']}"] = (f"{r['window_s'][0]:g} to {r['window_s'][1]:g} s, {r['nodes']} nodes; "
                                           + "; ".join(r["history"]))
    units = {k: unit_symbol(c.unit) for k, c in solution.model.constants.items()}
    plain["constants"] = ", ".join(f"{k} = {v:g} {units[k]}".strip() for k, v in constants.items())
    return facts(plain)
