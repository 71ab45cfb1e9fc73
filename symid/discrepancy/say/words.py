"""The finding as sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.model.families import LOSSES
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.say.names import law_name, place_name, sentence, values_of
from symid.discrepancy.say.proof import halves_words, paid_words, proof_words, unproved, verdicts_of_halves
from symid.discrepancy.say.rest import nameless_words
from symid.discrepancy.say.story import Story, listed
from symid.estimation.fitting.correlated import is_correlated
from symid.model.variants import CORRELATION_TIME
from symid.recording.signals.between import CURVES
from symid.units import in_unit, quantity, rough

UNRECORDED = "Random forces that nobody recorded, of wind or waves, count where the model declares a Noise for them"
ABOVE = 2.0
"""A rest this many times larger than the sensors' noise is spoken of."""


def words(story: Story) -> str:
    """Everything that a reader should know, most important first, one line a paragraph."""
    losses = _losses(story)
    first = (losses, _finding(story)) if len(losses) and " not enough" in losses[0] else (_finding(story) + losses,)
    parts = (
        *first,
        _at_bounds(story),
        nameless_words(story.evidence.unnamed, story.error) if story.verdict == "unexplained" else [],
        _alike(story),
        proof_words(story) + paid_words(story) + left_beside_noise(story),
        halves_words(story) + verdicts_of_halves(story),
        _caveats(story),
    )
    return "\n".join(" ".join(part) for part in parts if part)


def _finding(s: Story) -> list[str]:
    if s.verdict == "adequate":
        return [
            "The model explains the recording: no suspect improves it beyond chance and nothing systematic is left."
        ]
    known = [e for e in s.effects if e.name != "unknown"]
    if s.verdict == "missing_physics":
        return [f"{e.sentence}." for e in known] + unproved(s)
    if s.evidence.elsewhere is not None:
        return [f"{e.sentence}." for e in known] + _only_held_out(s, s.evidence.elsewhere)
    first, others = s.effects[0], [e for e in known if e is not s.effects[0]]
    said = [f"{e.sentence}." for e in others if e.established]
    part = [f"In part it looks like this: {_lowered(e.sentence)}." for e in others if not e.established]
    if said and first.name == "unknown":
        return [
            *said,
            f"That is not all: something systematic is left{_at(first.location)}, {first.sentence}, "
            "which no established effect explains.",
            *part,
        ]
    out = [
        f"Something systematic acts{_at(first.location)} that no established effect explains. It looks like this: "
        f"{_lowered(first.sentence)}.",
        *part,
    ]
    return out + (["Besides:", *said] if said else [])


def _at_bounds(s: Story) -> list[str]:
    """A sentence for each parameter of which the model as given asks for a value beyond its bounds."""
    but = ", and what is found may make up for no more than that" if s.effects else ""
    return [
        f"In the model as given {k} lies at its bound ({in_unit(s.base.values[k], s.model.parameters[k].unit)}): the "
        f"recording asks for a value beyond it{but}. Widen it with model.with_bounds({k}=(lower, upper))."
        for k in s.base.at_bounds
    ]


def _at(location: str) -> str:
    return f" at {place_name(location)}" if location not in ("", "global") else ""


def _only_held_out(s: Story, test: Test) -> list[str]:
    what = f"{test.what} at {place_name(test.place)}" if test.place else test.what
    if len(s.effects) > 1:
        return [f"That is not all: the held-out window shows {what}, and the fit window does not."]
    return [f"The model explains the fit window but not the held-out one, which shows {what}."]


def _lowered(sentence: str) -> str:
    return sentence[:1].lower() + sentence[1:]


def _losses(s: Story) -> list[str]:
    """What dissipates, where, and whether one law is enough; of a motion that nothing drives."""
    lossy = [e for e in s.effects if e.name in LOSSES]
    if s.driven or not lossy:
        return []
    text = f"Energy is lost at {listed(sorted({place_name(e.location) for e in lossy}))}"
    if len(lossy) == 1:
        return [f"{text}, and one law of loss is enough."] if s.verdict == "missing_physics" else [f"{text}."]
    alone = next((c for c in s.ranking if c.suspect.term.name in LOSSES), None)
    if alone is None:
        return [f"{text}."]
    name = law_name(alone.suspect.term.name, alone.suspect.term.location)
    left = s.error(alone.fit.rms_errors)
    return [
        f"{text}, and one law is not enough: the best alone, {name}, leaves an error of {left} in the fit "
        f"window, all that was found together {s.error(s.runs['augmented_train'].errors)}."
    ]


def _alike(s: Story) -> list[str]:
    if not s.equivalent:
        return []
    names = listed([law_name(c.suspect.term.name, c.suspect.term.location) for c in s.equivalent[:3]], "or")
    return [
        f"{names[:1].upper()}{names[1:]} would explain the recording almost as well; motion that is faster, larger or "
        "longer would tell them apart."
    ]


def left_beside_noise(s: Story) -> list[str]:
    """How far the improved model's free runs are from the noise of the sensors, where nothing random drives."""
    if s.verdict == "adequate":
        worst = s.left[0] if s.left else None
        return (
            []
            if worst is None
            else [
                f"The most suspicious of {len(s.left)} tests for a remainder has odds of 1 in "
                f"{10 ** min(worst.minus_log10_p, 15):,.0f} by chance."
            ]
        )
    errors = s.runs["augmented_train"].errors
    times = float(np.sqrt(np.mean((errors / s.audit.noise) ** 2)))
    if s.driven or s.data.memory or s.verdict != "unexplained" or not times > ABOVE:
        return []  # what remembers its past is larger than the highest frequencies show
    return [
        f"In the fit window an error of {s.error(errors)} remains, {times:.0f} times the noise of the sensors "
        f"({s.error(s.audit.noise)}): unexplained.",
        *([] if s.model.noises else [f"{UNRECORDED}."]),
    ]


def _are(names: Sequence[str]) -> str:
    return "is" if len(names) == 1 else "are"


def _otherwise(s: Story, other: Hypothesis) -> str:
    """What would be found with inputs that do something else between their samples."""
    model, inputs = other.fit.model, s.evidence.found.fit.model.inputs
    changed = [u for k, u in model.inputs.items() if u.hold != inputs[k].hold]
    does = "held" if changed[0].hold == "zero" else "curved" if changed[0].hold in CURVES else "straight"
    names = [u.channel for u in changed]
    found = " ".join(f"{sentence(law, values_of(law, other.fit), model)}." for law in other.suspects)
    return (
        f"Whether {listed(names)} {_are(names)} {does} between samples the recording hardly tells, and standard errors "
        f"allow for that. If so: {found}"
    )


def _caveats(s: Story) -> list[str]:
    out = []
    if s.input_noise:
        units = {u.channel: u.unit for u in s.model.inputs.values()}
        noise = listed([f"{name} ({quantity(size, unit=units[name])})" for name, size in s.input_noise.items()])
        out.append(
            f"What else would be left is taken for noise in the recorded {noise}, or for random forces that do as "
            "much: that explains it better than any law that was tried."
        )
    curved = [u.channel for u in s.model.inputs.values() if u.hold in CURVES]
    if curved:
        out.append(
            f"Between samples {listed(curved)} {_are(curved)} taken to follow a smooth curve; straight lines would "
            "lose some of it."
        )
    held = [u.channel for u in s.model.inputs.values() if u.hold == "zero"]
    if held:
        out.append(
            f"Between samples {listed(held)} {_are(held)} taken to be held, as a computer's output is; straight lines "
            "would look like a delay of half a sample."
        )
    if s.evidence.otherwise is not None:
        out.append(_otherwise(s, s.evidence.otherwise))
    if s.pieces:
        out.append(
            "The model as given cannot follow this motion from one state for long, since small differences soon become "
            f"large or it is far from it: they are compared in pieces of about {rough(s.pieces)} s, each from a state "
            "of its own."
        )
    if s.filter is not None:
        stated = ", as stated" if s.audit.known else ""
        out.append(
            f"The recording was low-pass filtered{stated}: about as {s.filter} does. That was undone before "
            "anything was compared."
        )
    elif not s.audit.stated.all():
        out.append(
            "The sensors' noise was not stated; the highest frequencies of the recording show "
            f"{s.channels(s.audit.noise)}."
        )
    if is_correlated(s.evidence.found.fit):
        seconds = rough(s.evidence.found.fit.values[CORRELATION_TIME])
        out.append(f"The random forces are not white: they are correlated over {seconds} s, which was fitted, too.")
    if s.data.memory:
        out.append(
            f"The noise is not white: each sample follows in part from the {s.data.memory} before it "
            f"({rough(s.data.memory * s.data.segments[0].step)} s), which was fitted with the model."
        )
    if not s.white and any(e.parameters for e in s.effects):
        out.append("What is left is not random, so the standard errors are taken from blocks of the recording.")
    return out
