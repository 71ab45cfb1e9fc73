"""A problem and a solution as text and as HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

from symid.identification.checks.elsewhere import excess_note
from symid.identification.fit import common_unit, fit_text, rms_text
from symid.identification.likelihood.weighting import by_noise
from symid.identification.noise import UNFIT
from symid.model.show import MEANING_EM
from symid.units import in_unit, rough, unit_symbol, with_error

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.identification.solution import Solution


SHOWN = 3
"""Recordings whose noise is written out."""


VERIFIED = 25_000
"""Unknowns up to which a solution is verified when it is shown: that takes a second or less."""
FAR = 100.0
"""Times that a penalty is too loose from which on the noise hides by how much."""


def problem_facts(problem: Identification) -> dict[str, str]:
    """What an Identification will solve, in words; builds nothing."""
    model, e = problem.model, problem.episodes
    facts = {"model": model.name, "unknown": ", ".join(model.parameters) or "nothing but the motion"}
    for recording, window in zip(problem.recordings, problem.windows, strict=True):
        start, end = window or recording.interval
        facts[f"recording {recording.name}"] = f"{start:g} s to {end:g} s"
    given = "" if problem.weights is None else " (weight {:g})"
    facts["compared"] = ", ".join(
        y.channel + given.format((problem.weights or {}).get(name, 1.0)) for name, y in model.outputs.items()
    ) + (", weighted by their noise" if by_noise(problem) else "")
    facts["scheme"] = problem.scheme.name
    facts["episodes"] = str(e.count) if e.count == 1 else f"{e.count}, {e.distribution} noise, seed {e.seed}"
    return facts


def problem_text(problem: Identification) -> str:
    """The same, one line each."""
    return "\n".join(["Identification", *(f"  {k:<12} {v}" for k, v in problem_facts(problem).items())])


def problem_html(problem: Identification) -> str:
    """The same for a notebook."""
    cell = '<td style="text-align:left">{}</td>'
    rows = (f"<tr>{cell.format(escape(k))}{cell.format(escape(v))}</tr>" for k, v in problem_facts(problem).items())
    return f"<b>Identification</b><table>{''.join(rows)}</table>"


MOST_TOLD = 4
"""Outputs whose errors are told one by one in a line."""


def headline(solution: Solution) -> str:
    """One line: solved or not, how well, in how many iterations."""
    word = "Solved" if solution.solved else "NOT SOLVED"
    if solution.solved and solution.result.status != 0:
        word = "ACCEPTABLE, not solved to the tolerance,"
    return (
        f"{word} in {solution.result.iterations} iterations and {solution.seconds['total']:.2f} s. RMS error: "
        f"{errors_of_outputs(solution)}"
    )


def errors_of_outputs(solution: Solution) -> str:
    """RMS error of each output by its channel, of many outputs the least and the largest."""
    outputs, rms = solution.model.outputs, solution.fit["rms"]
    said = {y.channel.replace("_", " "): rms[name] for name, y in outputs.items()} | {"all": rms["all"]}
    units = {y.channel.replace("_", " "): y.unit for y in outputs.values()}
    error, together = fit_text(said, units), common_unit(units.values())
    if len(outputs) > MOST_TOLD and together is not None:
        each = sorted(rms[name] for name in outputs)
        ends = " to ".join(rms_text(x, together) for x in (each[0], each[-1]))
        error = f"{rms_text(rms['all'], together)} over {len(outputs)} outputs ({ends})"
    return error


def warnings(solution: Solution) -> list[str]:
    """A sentence for each mistake of units or signs that shows, and for each state that its bounds cut off."""
    states = solution.model.states
    checked = solution.solved and solution.transcription.layout.size <= VERIFIED
    verified = solution.verification.sentences if checked else ()
    return [*solution.problem.remarks, *_at_bounds(solution), *_joint(solution), *_unfit(solution), *verified] + [
        f"{name} lies at its bounds ({states[name].bounds[0]:g} to {states[name].bounds[1]:g} "
        f"{unit_symbol(states[name].unit)}) at {rough(100 * share)} % of the nodes: they cut the motion off, which "
        f"biases the parameters; widen them with model.with_bounds({name}=(lower, upper))"
        for name, share in solution.cut_off.items()
    ]


def _at_bounds(solution: Solution) -> list[str]:
    """A sentence for each parameter at a bound, if it was solved."""
    table = solution.parameters[solution.parameters["at_bound"]] if solution.solved else solution.parameters[:0]
    return [
        f"{name} lies at its bound ({in_unit(p.value, p.unit)}): the data ask for a value beyond it, and "
        "the other parameters depend on where it stands"
        for name, p in table.iterrows()
        if p.lower < p.upper
    ]


def _joint(solution: Solution) -> list[str]:
    """A sentence where parameters beside process noise are not those of the recordings' likelihood alone."""
    p = solution.problem
    if not (solution.solved and p.model.processes and solution.values) or p.tilt:
        return []
    why = (
        "the outputs have weights, which are no likelihood: give noise=... instead"
        if p.weights is not None
        else "conditions hold beside the equations of motion and the initial state, or the last step to it was not "
        "solved: leave out what a Boundary or Constraint asks of the motion, or start from this solution"
    )
    return [
        f"{', '.join(solution.values)}: of the largest joint density with the motion, not of the recordings' "
        f"likelihood alone, so that process noise ({', '.join(p.model.processes)}) takes the place of damping; {why}"
    ]


def _unfit(solution: Solution) -> list[str]:
    """A sentence for each estimated disturbance whose penalty is far from what it shows."""
    found = []
    for name, ratio in solution.errors.misfit.items() if solution.solved else ():
        u = solution.model[name]
        if 1 / UNFIT < ratio < UNFIT:
            continue
        if name in solution.model.processes:
            found.append(
                f"{name}: its motion is {rough(np.sqrt(ratio))} times what its size {u.size:g} says; leave out size"
            )
        elif ratio > 1:
            found.append(
                f"{name}: smooth={u.smooth:g} is {rough(ratio)} times too stiff beside the noise, so that the "
                f"parameters take up what it does not follow; smooth={rough(u.smooth / ratio)} fits"
            )
        else:
            told = f"{rough(1 / ratio)} times" if ratio > 1 / FAR else "far"
            found.append(
                f"{name}: smooth={u.smooth:g} is {told} too loose beside the noise, which it follows and which "
                f"biases the parameters; try smooth={rough(u.smooth / max(ratio, 1 / FAR))}"
            )
    return found


def error_notes(solution: Solution) -> list[str]:
    """A sentence on the error model, and one on what is determined where single parameters are not."""
    e = solution.errors
    if e is None:
        return []
    outputs = solution.model.outputs.values()
    noise = "; ".join(
        ", ".join(f"{y.channel.replace('_', ' ')} {rms_text(x, y.unit, 3)}" for y, x in zip(outputs, row, strict=True))
        for row in e.noise[:SHOWN]
    )
    more = f"; and {len(e.noise) - SHOWN} more recordings" if len(e.noise) > SHOWN else ""
    notes = [f"Standard errors: {e.model} noise, {e.why}. Noise (standard deviation): {noise}{more}"]
    sizes = [f"{name} {p.size:.3g} {p.unit}*sqrt(s)" for name, p in solution.model.processes.items()]
    if sizes:
        notes.append(f"Process noise (size): {', '.join(sizes)}")
    lost = [name for name, u in zip(solution.values, e.undetermined, strict=True) if u]
    if lost:
        found = e.determined(list(solution.values), np.array(list(solution.values.values())))
        only = "near these values only" if any(c.local for c, _ in found) else "only"
        told = ", ".join(f"{c.text}: {with_error(c.value, error, 5)}" for c, error in found)
        notes.append(f"These data do not determine {', '.join(lost)}" + (f": {only} {told}" if told else " at all"))
    return [*notes, *excess_note(solution), *_unverified(solution)]


def _unverified(solution: Solution) -> list[str]:
    size = solution.transcription.layout.size
    return (
        []
        if size <= VERIFIED
        else [
            f"Not verified by a finer mesh and an integrator, which take as long as the solve: {size} unknowns; "
            "solution.verification does it"
        ]
    )


def text(solution: Solution) -> str:
    """Headline, what Ipopt said, and the parameters."""
    rows = _parameter_rows(solution)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = (
        "  ".join([row[0].ljust(widths[0]), row[1].rjust(widths[1]), row[2].ljust(widths[2]), row[4]]).rstrip()
        for row in rows
    )
    starts = f"\nBest of {len(solution.starts)} starts." if len(solution.starts) > 1 else ""
    cut = "".join(f"\n{warning}." for warning in (*solution.warnings, *error_notes(solution)))
    numbers = "\n".join(lines) if len(rows) > 1 else "There is no free parameter."
    return f"{solution.model.name}\n{headline(solution)}\n{solution.message}{starts}{cut}\n{numbers}"


def _parameter_rows(solution: Solution) -> list[tuple[str, ...]]:
    """Head and a row for each parameter: name, value with its error, unit, bounds, whether it is at one, meaning."""
    table = solution.parameters
    return [
        ("parameter", "value ± std. error", "unit", "bounds", "", "meaning" if any(table["meaning"]) else ""),
        *(
            (name, with_error(p.value, p.std_error, digits=5), p.unit)
            + (f"{p.lower:g} to {p.upper:g}", "at its bound" if p.at_bound else "", p.meaning)
            for name, p in table.iterrows()
        ),
    ]


def html(solution: Solution) -> str:
    """The same for a notebook, with bounds and meanings; a parameter at a bound is red."""
    rows = []
    for name, value, unit, bounds, at, meaning in _parameter_rows(solution):
        cell = "th" if not rows else "td"
        cells = [
            (name if cell == "th" else f"<code>{escape(name)}</code>", "left"),
            (value, "right;white-space:nowrap"),
            (escape(unit), "left"),
            (f"{bounds}, {at}" if at else bounds, "left;white-space:nowrap"),
            (escape(meaning), f"left;min-width:{MEANING_EM}em" if meaning and cell == "td" else "left"),
        ]
        colour = ";color:#c0392b" if at else ""
        rows.append("".join(f'<{cell} style="text-align:{side}{colour}">{text}</{cell}>' for text, side in cells))
    colour = "#666" if solution.solved else "#c0392b"
    return (
        f"<h4>{escape(solution.model.name)}</h4><p>{escape(headline(solution))}</p>"
        f'<p style="color:{colour}">{escape(solution.message)}</p>'
        + "".join(f'<p style="color:#c0392b">{escape(warning)}.</p>' for warning in solution.warnings)
        + "".join(f"<p>{escape(note)}.</p>" for note in error_notes(solution))
        + f"<table>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"
    )
