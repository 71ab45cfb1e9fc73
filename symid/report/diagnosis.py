"""The report on one diagnosis: the words first, then what they rest on."""

from __future__ import annotations

from pathlib import Path

from symid.discrepancy import Diagnosis
from symid.discrepancy.locate.latent import latent_torques
from symid.discrepancy.policy import POLICY
from symid.discrepancy.say.names import law_name, place_name
from symid.discrepancy.say.rest import rest_words
from symid.files import write_atomically
from symid.identification.fit import common_unit, rms_text
from symid.mechanics.missing.laws.shared import parameter_name
from symid.mechanics.missing.spline_law import FLEXIBLE
from symid.model.show import latex_lines
from symid.plots import plot_before_after, plot_latent, plot_rest, plot_scores, plot_spectra
from symid.report.experiment import experiment
from symid.report.origin import CITATION, origin, written
from symid.report.page import equations, facts, figure, folded, heading, page, paragraph, table
from symid.units import quantity, rough, typeset, without_unit

VERDICTS = {"missing_physics": "Missing physics", "adequate": "Adequate", "unexplained": "Unexplained"}
MEANING = {
    "missing_physics": "the model leaves out what is named below",
    "adequate": "nothing that this recording could show is missing",
    "unexplained": "something systematic is missing that no established effect explains",
}
REST = (
    "The force that the model lacks, over what it follows and coloured by time, and the energy that it puts into the "
    "motion (red) or takes out (blue), with two standard errors."
)
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
MOST = 15
"""Suspects listed."""


def write_diagnosis_report(
    diagnosis: Diagnosis, path: str | Path, name: str = "Diagnosis", provenance: dict[str, object] | None = None
) -> Path:
    """Write a report on a diagnosis as one HTML file with its figures inside, whole or not at all.

    Parameters
    ----------
    path : of the file; its folder must exist.
    name : title of the page. provenance : what was compared with what, as words.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> write_diagnosis_report(found, "diagnosis.html", name="Diagnosis of r01")  # doctest: +SKIP
    """
    return write_atomically(path, diagnosis_html(diagnosis, name, provenance))


def diagnosis_html(diagnosis: Diagnosis, name: str = "Diagnosis", provenance: dict[str, object] | None = None) -> str:
    """The same as text."""
    d = diagnosis
    first, *more = d.words.split("\n")
    parts = [
        paragraph(f"{VERDICTS[d.verdict]}: {MEANING[d.verdict]}.", "verdict"),
        paragraph(first, "lead"),
        *map(paragraph, more),
    ]
    if d.named:
        parts += [heading("What is missing"), effects_table(d)]
    if d.equivalent:
        parts += [heading("What this recording cannot tell from it"), _equivalents(d)]
    where = "where the improvement is largest" if d.named else "at the beginning of each window"
    parts += [
        heading("Before and after" if d.named else "The fit"),
        _fits(d),
        figure(plot_before_after(d), f"Free simulations, {where}; errors below each."),
        heading("Where and when"),
        *_where(d),
        *_rest(d),
        figure(plot_spectra(d), "At which frequencies the free run is wrong."),
        heading("Suspects"),
        *_suspects(d),
        heading("What is left"),
        *_remainder(d),
        heading("Parameters of the model"),
        *_parameters(d),
        folded("Equations of the improved model" if d.named else "Equations", equations(latex_lines(d.improved))),
        heading("Provenance"),
        facts((provenance or {}) | _compared(d) | origin()),
        heading("Please cite"),
        *map(paragraph, CITATION),
    ]
    return page(name, *parts, footer=written())


def _compared(d: Diagnosis) -> dict[str, str]:
    """The model and the windows."""
    told = {"model": d.baseline.model.name}
    for key, title in (("train", "fit window"), ("heldout", "held-out window")):
        if f"baseline_{key}" in d.runs:
            one = d.runs[f"baseline_{key}"]
            pieces = f" in {len(one.lengths)} pieces" if len(one.lengths) > 1 else ""
            window = typeset(f"{one.time[0]:g} to {one.time[-1]:g}")
            told[title] = f"{window} s, {len(one.time)} samples{pieces}"
    return told


def _rest(d: Diagnosis) -> list[str]:
    """What has no name, in words and as a picture."""
    return [] if d.rest is None else [*map(paragraph, rest_words(d.rest)), figure(plot_rest(d.rest), REST)]


def effects_table(d: Diagnosis) -> str:
    """What was found: law, place, when, whether both halves of the window ask for it, parameters and their errors."""
    timed = any(e.window is not None for e in d.named)
    kept = {(s.name, s.location): "no" if s.reason else "yes" for s in d.halves}
    halved = any((e.name, e.location) in kept for e in d.named)
    rows = []
    for e in d.named:
        values = "; ".join(f"{without_unit(k)} {quantity(v, s, d.unit_of(e, k))}" for k, (v, s) in e.parameters.items())
        both = [kept.get((e.name, e.location), "")] * halved
        when = ["always" if e.window is None else f"{e.window[0]:.2f} to {e.window[1]:.2f} s"] * timed
        rows.append([law_name(e.name), place_name(e.location), *both, values or e.sentence, *when])
    return table(["effect", "place", *["on both halves"] * halved, "parameters", *["when"] * timed], rows)


def _equivalents(d: Diagnosis) -> str:
    rows = [
        [
            law_name(c.suspect.term.name),
            place_name(c.suspect.term.location),
            f"{c.score:,.0f}",
            experiment(c.suspect.term.name),
        ]
        for c in d.equivalent
    ]
    return table(["instead", "place", "score", "experiment that would tell them apart"], rows)


def _fits(d: Diagnosis) -> str:
    rows, unit = [], common_unit(y.unit for y in d.improved.outputs.values())
    for key, title in (("train", "fit window"), ("heldout", "held-out window, not used before")):
        if f"baseline_{key}" in d.runs:
            before, after = (d.runs[f"{k}_{key}"].rms for k in ("baseline", "augmented"))
            rows.append([title, *_compared_errors(before, after, unit)])
    later = d.runs.get("augmented_heldout")
    if later is not None and len(later.lengths) > 1:
        before = d.runs["baseline_heldout"].of_segments()
        rows += [
            [f"  held out, segment from {t:.1f} s", *_compared_errors(b, a, unit)]
            for (t, b), (_, a) in zip(before, later.of_segments(), strict=True)
        ][:MOST]
    head = ["free simulation", "RMS error of the model as given", "of the improved model", "error removed [%]"]
    return table(head, rows) if d.named else table(head[:2], [row[:2] for row in rows])


def _compared_errors(before: float, after: float, unit: str | None) -> list[str]:
    """Both errors in one unit, and how much of the first is gone [%]."""
    removed = typeset(f"{100 * (1 - after / before):.1f}")
    return [rms_text(before, unit, beside=after), rms_text(after, unit, beside=before), removed]


def _where(d: Diagnosis) -> list[str]:
    before = latent_torques(d.baseline, d.runs["baseline_train"])
    if not before:
        return [
            paragraph(
                "The model declares no random forces (Noise), so what is missing is not drawn as a force over time.",
                "note",
            )
        ]
    after = latent_torques(d.final, d.runs["augmented_train"]) if d.named else ()
    caption = (
        "The force that would have to be added at each place to make the free run follow the recording; forces of one "
        "unit have one scale. The band is two standard errors wide to each side, and the grey floor as "
        "high: a force that stays "
        "within is not told from nothing. It holds what random forces contribute as well."
    )
    if d.baseline.kalman_gain is None:
        caption += " It rests on one mean linearisation, so where the motion is large it is a rough picture."
    return [figure(plot_latent(before, after), caption)]


def _suspects(d: Diagnosis) -> list[str]:
    """Every suspect that was fitted completely: as a figure, and folded away all numbers."""
    parts = [
        paragraph(
            "Every law was tried at every place where it could act, together with all unknowns of the model. Shown are "
            "those that were fitted completely, each alone. The score is the growth of twice the "
            "log-likelihood, counted "
            "in independent samples, less a penalty for the unknowns of the suspect and for being one of many.",
            "note",
        )
    ]
    if not d.ranking:
        told = "None was worth a complete fit." if d.improved.ports else "No place was found at which a law could act."
        return [*parts, paragraph(told)]
    if max(c.score for c in d.ranking) > 0:
        caption = (
            f"The number is the score. In the grey band, up to {POLICY.equivalent:g} behind the best, a "
            f"recording hardly "
            "tells one from another; at the dashed line a suspect explains no more than chance. Of effects that were "
            "found together each stands here alone."
        )
        parts.append(figure(plot_scores(d), caption))
    rows = [
        [
            law_name(c.suspect.term.name),
            place_name(c.suspect.term.location),
            typeset(f"{c.score:,.1f}"),
            typeset(f"{c.log_ratio:,.1f}"),
            "a law" if c.suspect.established else "a description",
        ]
        for c in sorted(d.ranking, key=lambda c: -c.score)[:MOST]
    ]
    heads = ["suspect", "place", "score", "log-likelihood ratio", "what it names"]
    numbers = table(heads, rows, wide=heads[3:])
    note = paragraph(
        "A law is an answer when it is found. A description only says what the rest looks like: several mechanisms "
        "look like that.",
        "note",
    )
    return [*parts, folded("All numbers", numbers, note)]


def _remainder(d: Diagnosis) -> list[str]:
    if not d.remainder:
        return [paragraph("Not tested.")]
    rows = [
        [place_name(t.place), t.what, f"{t.log_ratio:.1f}", t.size, _odds(t.minus_log10_p)] for t in d.remainder[:5]
    ]
    systematic = max(t.minus_log10_p for t in d.remainder) > POLICY.remainder
    heads = ["place", "test for", "statistic", "degrees of freedom", "by chance 1 in"]
    return [
        paragraph(
            f"{'After the finding something' if d.named else 'Something'} systematic is left: a test below reaches "
            f"what chance would make once in more than {float(rough(10**POLICY.remainder, 1)):,.0f} recordings."
            if systematic
            else "Nothing beyond what chance makes is left; these tests came nearest to it.",
            "note",
        ),
        table(heads, rows, wide=heads[2:4]),
    ]


def _odds(minus_log10_p: float) -> str:
    if minus_log10_p < 6:
        return f"{10**minus_log10_p:,.0f}"
    return ("over " if minus_log10_p > 300 else "") + "10" + f"{min(minus_log10_p, 300):.0f}".translate(_RAISED)


def _parameters(d: Diagnosis) -> list[str]:
    """Of the model and of what was found; coefficients of a curve without a formula, which nobody reads, are folded."""
    curves = [t for t in d.improved.terms if t.name.startswith((FLEXIBLE, "unknown"))]
    coefficients = [t.parameter_name(q.key) for t in curves for q in t.law.parameters]
    told = _values(d, [name for name in d.values if name not in coefficients])
    if not coefficients:
        return [told]
    note = (
        "The improved model holds a flexible law beside what is named above, and it takes over a part of that: the "
        "values here are those beside it."
    )
    beside = [paragraph(note, "note")] if any(t.name == FLEXIBLE for t in curves) else []
    folds = folded(f"{len(coefficients)} coefficients of what has no formula", _values(d, coefficients))
    return [*beside, told, folds]


def _values(d: Diagnosis, names: list[str]) -> str:
    """Values of parameters; what was found has those of the words, where a moment is the mean over its peaks."""
    rows = []
    own = {
        t.parameter_name(q.key): f"{law_name(t.name)}, {place_name(t.location)}: {without_unit(q.key)}"
        for t in d.improved.terms
        for q in t.law.parameters
    }
    found = {parameter_name(e.name, e.location, k): v for e in d.named for k, v in e.parameters.items()}
    for name in names:
        part, before = d.improved.parameters[name], d.baseline.values.get(name)
        value, error = found.get(name, (float(d.values[name]), float(d.final.errors.get(name, float("nan")))))
        given = "" if before is None else quantity(float(before), unit=part.unit, digits=4)
        bound = " at its bound" if value in part.bounds else ""
        told = quantity(value, error, part.unit, digits=4) + bound
        rows.append([(name, own.get(name, part.meaning)), given, told])
    errors = " ± standard error" if any("±" in told for *_, told in rows) else ""
    if not d.named:
        return table(["parameter", f"value{errors}"], [[name, value] for name, _, value in rows])
    return table(["parameter", "model as given", f"improved{errors}"], rows)
