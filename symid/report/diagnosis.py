"""The report on one diagnosis: the words first, then what they rest on."""

from __future__ import annotations

from pathlib import Path

from symid.discrepancy import Diagnosis
from symid.discrepancy.locate.latent import latent_torques
from symid.discrepancy.say.diagnosis import Effect
from symid.files import write_atomically
from symid.identification.fit import common_unit, rms_text
from symid.mechanics.laws import parameter_name
from symid.plots import plot_before_after, plot_latent, plot_scores, plot_spectra
from symid.report.page import facts, figure, heading, number, page, paragraph, table
from symid.units import quantity

VERDICTS = {"missing_physics": "Missing physics", "adequate": "Adequate", "unexplained": "Unexplained"}
MEANING = {
    "missing_physics": "the model leaves out what is named below",
    "adequate": "nothing that this recording could show is missing",
    "unexplained": "something systematic is missing that no established effect explains",
}
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
MOST = 15
"""Suspects listed."""


def write_diagnosis_report(
    diagnosis: Diagnosis, path: str | Path, name: str = "Diagnosis", provenance: dict[str, object] | None = None
) -> Path:
    """Write a report on a diagnosis as one HTML file with its figures inside, whole or not at all.

    Parameters
    ----------
    name : title of the page. provenance : what was compared with what, as words.
    """
    return write_atomically(path, diagnosis_html(diagnosis, name, provenance))


def diagnosis_html(diagnosis: Diagnosis, name: str = "Diagnosis", provenance: dict[str, object] | None = None) -> str:
    """The same as text."""
    d = diagnosis
    first, *more = d.words.split("\n")
    verdict = paragraph(f"Verdict: {VERDICTS[d.verdict].lower()} ({MEANING[d.verdict]}).", "note")
    parts = [paragraph(first, "lead"), *map(paragraph, more), verdict]
    if d.effects:
        parts += [heading("What is missing"), effects_table(d)]
    if d.equivalent:
        parts += [heading("What this recording cannot tell from it"), _equivalents(d)]
    where = "where the improvement is largest" if d.effects else "at the beginning of each window"
    parts += [
        heading("Before and after" if d.effects else "The fit"),
        _fits(d),
        figure(plot_before_after(d), f"Free simulations, {where}; errors below each."),
    ]
    parts += [heading("Where and when"), *_where(d)]
    parts += [figure(plot_spectra(d), "At which frequencies the free run is wrong.")]
    parts += [
        heading("Suspects"),
        paragraph(
            "Every law was tried at every place where it could act, together with all unknowns of "
            "the model. Listed are those that were fitted completely, each alone.",
            "note",
        ),
    ]
    if d.ranking and d.ranking[0].score > 0:
        parts.append(figure(plot_scores(d), "Dark blue: chosen. Light blue: explains the recording as well."))
    parts += [_ranking(d)]
    parts += [heading("What is left"), _remainder(d), heading("Parameters of the model"), _parameters(d)]
    if provenance:
        parts += [heading("Provenance"), facts(provenance)]
    return page(name, *parts)


def effects_table(d: Diagnosis) -> str:
    """What was found: law, place, when, whether both halves of the window ask for it, parameters and their errors."""
    kept = {(s.name, s.location): "no" if s.reason else "yes" for s in d.halves}
    rows = []
    for e in d.effects:
        values = "; ".join(f"{k} = {quantity(v, s, _unit(d, e, k))}" for k, (v, s) in e.parameters.items())
        when = "always" if e.window is None else f"{e.window[0]:.2f} to {e.window[1]:.2f} s"
        rows.append([_plain(e.name), e.location, when, kept.get((e.name, e.location), ""), values or e.sentence])
    return table(["effect", "place", "when", "on both halves", "parameters"], rows)


def _unit(d: Diagnosis, effect: Effect, key: str) -> str:
    """Unit of one parameter of an effect, as the improved model declares it; "1" for what is no parameter of it."""
    part = d.improved.parameters.get(parameter_name(effect.name, effect.location, key))
    return part.unit if part is not None else "1"


def _plain(name: str) -> str:
    return name.replace("_", " ")


def _equivalents(d: Diagnosis) -> str:
    rows = [
        [_plain(c.suspect.term.name), c.suspect.term.location, float(c.score), experiment(c.suspect.term.name)]
        for c in d.equivalent
    ]
    return table(["instead", "place", "score", "experiment that would tell them apart"], rows)


# What separates two laws is where their effects differ: in frequency, amplitude or time.
_EXPERIMENTS = (
    (
        ("delay", "lag", "torque_feedback", "acceleration"),
        "a faster excitation: above the frequencies in this recording a delay turns "
        "the phase without loss, a lag loses amplitude, an inertia grows",
    ),
    (
        ("friction", "drag", "dead_zone", "stiffness", "saturation", "backlash", "hysteresis"),
        "the same excitation at half and at twice the amplitude: "
        "each of these laws changes with amplitude in its own way",
    ),
    (
        ("gain_change", "push", "periodic"),
        "a longer recording: an event passes, a change stays, an oscillation returns",
    ),
    (("integral",), "a constant push that is held for a minute: an accumulated error removes the offset in the end"),
    (
        ("gain", "offset", "tilt", "mass", "inertia"),
        "calibrate the sensors and the drive, or weigh the part: the motion alone shows only their product",
    ),
)


def experiment(name: str) -> str:
    """In words, an experiment in which the law `name` differs from its likes."""
    return next(
        (text for words, text in _EXPERIMENTS if any(w in name for w in words)),
        "motion that is faster, larger or longer",
    )


def _fits(d: Diagnosis) -> str:
    rows, unit = [], common_unit(y.unit for y in d.improved.outputs.values())
    for key, title in (("train", "fit window"), ("heldout", "held-out window, not used before")):
        if f"baseline_{key}" in d.runs:
            before, after = (d.runs[f"{k}_{key}"].rms for k in ("baseline", "augmented"))
            rows.append([title, rms_text(before, unit), rms_text(after, unit), round(100 * (1 - after / before), 1)])
    later = d.runs.get("augmented_heldout")
    if later is not None and len(later.lengths) > 1:
        before = d.runs["baseline_heldout"].of_segments()
        rows += [
            [f"  held out, segment from {t:.1f} s", rms_text(b, unit), rms_text(a, unit), round(100 * (1 - a / b), 1)]
            for (t, b), (_, a) in zip(before, later.of_segments(), strict=True)
        ][:MOST]
    head = ["free simulation", "RMS error of the model as given", "of the improved model", "error removed [%]"]
    return table(head, rows) if d.effects else table(head[:2], [row[:2] for row in rows])


def _where(d: Diagnosis) -> list[str]:
    before = latent_torques(d.baseline, d.runs["baseline_train"])
    if not before:
        return [
            paragraph(
                "The model declares no process noise, so there is no place at which a missing force could be told.",
                "note",
            )
        ]
    after = latent_torques(d.final, d.runs["augmented_train"]) if d.effects else ()
    caption = (
        "The force that would have to be added at each place to make the free run follow the recording, with two "
        "standard errors; it holds what random forces contribute as well."
    )
    if d.baseline.kalman_gain is None:
        caption += " It rests on one mean linearisation, so where the motion is large it is a rough picture."
    return [figure(plot_latent(before, after), caption)]


def _ranking(d: Diagnosis) -> str:
    rows = [
        [
            _plain(c.suspect.term.name),
            c.suspect.term.location,
            round(c.score, 1),
            round(c.log_ratio, 1),
            "" if c.suspect.established else "hypothesis",
        ]
        for c in d.ranking[:MOST]
    ]
    return table(["suspect", "place", "score", "log-likelihood ratio", ""], rows)


def _remainder(d: Diagnosis) -> str:
    rows = [[t.place, t.what, float(t.log_ratio), t.size, _odds(t.minus_log10_p)] for t in d.remainder[:5]]
    return (
        table(["place", "test for", "statistic", "degrees of freedom", "by chance 1 in"], rows)
        if rows
        else paragraph("Not tested.")
    )


def _odds(minus_log10_p: float) -> str:
    if minus_log10_p < 6:
        return f"{10**minus_log10_p:,.0f}"
    return ("over " if minus_log10_p > 300 else "") + "10" + f"{min(minus_log10_p, 300):.0f}".translate(_RAISED)


def _parameters(d: Diagnosis) -> str:
    model, rows = d.improved, []
    for name, value in d.values.items():
        before = d.baseline.values.get(name)
        rows.append(
            [
                name,
                "" if before is None else number(float(before)),
                float(value),
                float(d.final.errors.get(name, float("nan"))),
                model.parameters[name].unit,
            ]
        )
    return table(["parameter", "model as given", "improved", "std. error", "unit (SI)"], rows)
