"""The finding as sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.prove.evidence import Evidence
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.discrepancy.prove.held_out import Proof
from symid.discrepancy.say.diagnosis import Effect
from symid.discrepancy.say.names import law_name, place_name
from symid.discrepancy.say.rest import nameless_words
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.estimation.free_run import FreeRun
from symid.estimation.zero_phase import ZeroPhase
from symid.identification.fit import common_unit, rms_text
from symid.model import Model
from symid.units import quantity

LOSSES = (
    "viscous_friction",
    "coulomb_friction",
    "quadratic_drag",
    "stribeck_friction",
    "joint_drag",
    "load_dependent_friction",
    "bouc_wen_hysteresis",
)
"""Laws by which a mechanism loses energy."""
STILL = 3.0
"""What varies by less than so many times the sensors' noise does not move."""
ABOVE = 2.0
"""A rest this many times larger than the sensors' noise is spoken of."""


def _listed(items: Sequence[str], last: str = "and") -> str:
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {last} {items[-1]}"


# ---- the text --------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class Story:
    """What there is to tell.

    pieces : seconds of those in which a motion is compared that cannot be followed from one state for longer.
    """

    verdict: str
    effects: tuple[Effect, ...]
    equivalent: tuple[Hypothesis, ...]
    ranking: Sequence[Hypothesis]
    evidence: Evidence
    audit: Audit
    base: Fit
    data: Data
    pieces: float | None = None

    @property
    def left(self) -> Sequence[Test]:
        return self.evidence.left

    @property
    def runs(self) -> Mapping[str, FreeRun]:
        return self.evidence.runs

    @property
    def survived(self) -> tuple[Survival, ...]:
        return self.evidence.survived

    @property
    def halves(self) -> tuple[HalfVerdict, ...]:
        return self.evidence.halves

    @property
    def white(self) -> bool:
        return self.evidence.white

    @property
    def proof(self) -> Proof | None:
        return self.evidence.proof

    @property
    def chance(self) -> float | None:
        return self.evidence.chance

    @property
    def driven(self) -> bool:
        return self.base.kalman_gain is not None

    @property
    def filter(self) -> ZeroPhase | None:
        return self.data.filter

    @property
    def model(self) -> Model:
        return self.base.model

    def error(self, errors: np.ndarray, beside: np.ndarray | None = None) -> str:
        """The rms errors (m,) of the outputs, as one number where they share a unit; in units that suit those `beside`,
        with which they are compared.
        """
        others = np.zeros_like(errors) if beside is None else beside
        unit = common_unit(y.unit for y in self.model.outputs.values())
        if unit is not None:
            rms, other = (float(np.sqrt(np.mean(np.square(e)))) for e in (errors, others))
            return rms_text(rms, unit, digits=3, beside=other)
        return _listed(
            [
                f"{quantity(e, unit=y.unit, beside=o)} of {y.channel}"
                for e, o, y in zip(errors, others, self.model.outputs.values(), strict=True)
            ]
        )

    def channels(self, values: np.ndarray) -> str:
        """One number for each output, with its unit."""
        return _listed(
            [quantity(float(v), unit=y.unit) for v, y in zip(values, self.model.outputs.values(), strict=True)]
        )


def words(story: Story) -> str:
    """Everything that a reader should know, most important first, one line a paragraph."""
    losses = _losses(story)
    first = (losses, _finding(story)) if len(losses) and " not enough" in losses[0] else (_finding(story) + losses,)
    parts = (
        *first,
        nameless_words(story.evidence.unnamed, story.error) if story.verdict == "unexplained" else [],
        _alike(story),
        _proof(story) + _rest(story),
        _halves(story) + _verdicts_of_halves(story),
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
        return [f"{e.sentence}." for e in known] + _unproved(s)
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


def _at(location: str) -> str:
    return f" at {place_name(location)}" if location not in ("", "global") else ""


def _only_held_out(s: Story, test: Test) -> list[str]:
    what = f"{test.what} at {place_name(test.place)}" if test.place else test.what
    if len(s.effects) > 1:
        return [f"That is not all: the held-out window shows {what}, and the fit window does not."]
    return [f"The model explains the fit window but not the held-out one, which shows {what}."]


def _unproved(s: Story) -> list[str]:
    if s.proof is None or s.proof.confirmed:
        return []
    return [
        "The held-out data do not confirm this yet." if s.proof.margin > 0 else "The held-out data speak against this."
    ]


def _lowered(sentence: str) -> str:
    return sentence[:1].lower() + sentence[1:]


def _losses(s: Story) -> list[str]:
    """What dissipates, where, and whether one law is enough; of a motion that nothing drives."""
    lossy = [e for e in s.effects if e.name in LOSSES]
    if s.driven or not lossy:
        return []
    text = f"Energy is lost at {_listed(sorted({place_name(e.location) for e in lossy}))}"
    if len(lossy) == 1:
        return [f"{text}, and one law of loss is enough."] if s.verdict == "missing_physics" else [f"{text}."]
    alone = next((c for c in s.ranking if c.suspect.term.name in LOSSES), None)
    if alone is None:
        return [f"{text}."]
    left = np.sqrt(np.mean(np.vstack(alone.fit.innovations) ** 2, axis=0))
    name = law_name(alone.suspect.term.name, alone.suspect.term.location)
    return [
        f"{text}, and one law is not enough: the best alone, {name}, leaves an error of {s.error(left)} in the fit "
        f"window, all that was found together {s.error(s.runs['augmented_train'].errors)}."
    ]


def _alike(s: Story) -> list[str]:
    if not s.equivalent:
        return []
    names = _listed([law_name(c.suspect.term.name, c.suspect.term.location) for c in s.equivalent[:3]], "or")
    return [
        f"{names[:1].upper()}{names[1:]} would explain the recording almost as well; motion that is faster, larger or "
        "longer would tell them apart."
    ]


def _proof(s: Story) -> list[str]:
    if "augmented_heldout" not in s.runs:
        return _chance(s)
    before, after = s.runs["baseline_heldout"].errors, s.runs["augmented_heldout"].errors
    # Before a filter the noise was larger than what is seen of it now.
    if s.filter is None and np.all(s.runs["baseline_heldout"].recorded.std(axis=0) < STILL * s.audit.noise):
        return ["In the held-out window nothing moves, so that it proves nothing.", *_chance(s)]
    if not s.effects or np.array_equal(before, after) or s.proof is None:
        return [f"The error of free simulation on the held-out window is {s.error(before)}.", *_chance(s)]
    errors = f"goes from {s.error(before, after)} to {s.error(after, before)}"
    if s.proof.free_runs is None:
        return [f"The error of free simulation on the held-out window {errors}{_confirmation(s.proof)}.", *_chance(s)]
    more = "less" if s.proof.margin > 0 else "more"
    errors = errors if s.proof.free_runs.margin > 0 else f"does not fall: it {errors}"
    return [
        f"On the held-out window forecasts from sample to sample err {more}, by {100 * abs(s.proof.margin):.2g} %"
        f"{_confirmation(s.proof)}. The error of free simulation, which holds all that random forces did, {errors}.",
        *_chance(s),
    ]


def _confirmation(p: Proof) -> str:
    """What the blocks of the held-out data say of the fall of the error."""
    if p.confirmed:
        return f", which confirms the finding (probability {min(p.probability, 0.999):.3g} from {p.blocks} blocks)"
    if p.margin <= 0:
        return ": the held-out window does not confirm the finding"
    if p.contradicted:
        chance = f"probability {p.free_runs.probability:.2g} from {p.free_runs.blocks} blocks"
        return f": not confirmed, because free simulation loses more than that ({chance})"
    longer = f"; about {p.needed:.2g} s like these would" if p.needed is not None and p.needed > p.seconds else ""
    chance = f"probability {p.probability:.2g} from {p.blocks} blocks{longer}"
    return f": not confirmed, because chance could do that ({chance})"


def _chance(s: Story) -> list[str]:
    """How often chance alone looks like the finding, in recordings like this one."""
    if s.chance is None or s.effects and s.effects[0].name.startswith("unknown"):
        return []
    size = f"{s.chance:.2g}" if s.chance >= 1e-6 else "below one in a million"
    what = "the least certain effect" if s.effects else "the best suspect"
    dear = ", but it does not explain enough to pay for its unknowns" if not s.effects and s.chance < 0.05 else ""
    return [
        f"With nothing missing, chance alone would make a suspect look as good as {what} here "
        f"with a probability of {size}{dear}."
        if s.chance >= 1e-6
        else f"With nothing missing, chance alone would make a suspect look like this with a probability {size}{dear}."
    ]


def _halves(s: Story) -> list[str]:
    if not s.survived:
        return []
    one = len(s.survived) == 1
    kept = [law_name(v.name, v.location) for v in s.survived if not v.reason]
    out = []
    if kept:
        out.append(
            f"{'It' if one else _capital(_listed(kept))} {'survives' if one or len(kept) == 1 else 'survive'} on both "
            "halves of the fit window, taken alone."
        )
    out += [
        f"{'It' if one else _capital(law_name(v.name, v.location))} does not survive on two halves of the fit window: "
        f"{v.reason}."
        for v in s.survived
        if v.reason
    ]
    return out


def _verdicts_of_halves(s: Story) -> list[str]:
    """Whether either half alone leads to the same verdict and to the same suspect."""
    if not s.halves:
        return []
    other = [
        f"the {which} half leads to '{v.verdict.replace('_', ' ')}'"
        for v, which in zip(s.halves, ("first", "second"), strict=True)
        if v.verdict != s.verdict
    ]
    out = [
        f"Taken alone, {_listed(other)}: another verdict than on the whole."
        if other
        else "Either half alone leads to the same verdict."
    ]
    return out + [
        f"On the {which} half alone {law_name(v.rival.term.name, v.rival.term.location)} explains more "
        "than what was found."
        for v, which in zip(s.halves, ("first", "second"), strict=True)
        if v.rival is not None
    ]


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _rest(s: Story) -> list[str]:
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
    if s.driven or s.verdict != "unexplained" or not times > ABOVE:
        return []
    return [
        f"In the fit window an error of {s.error(errors)} remains, {times:.0f} times the noise of the sensors "
        f"({s.error(s.audit.noise)}): unexplained."
    ]


def _caveats(s: Story) -> list[str]:
    out = []
    curved = [u.channel for u in s.model.inputs.values() if u.hold == "cubic"]
    if curved:
        out.append(
            f"Between its samples {_listed(curved)} is taken to follow a smooth curve; straight lines would lose "
            "some of it."
        )
    if s.pieces:
        out.append(
            "In this motion small differences soon become large ones: it is compared in pieces of about "
            f"{s.pieces:.2g} s, each from a state of its own."
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
    if s.data.memory:
        out.append(
            f"The noise is not white: each sample follows in part from the {s.data.memory} before it "
            f"({s.data.memory * s.data.segments[0].step:.2g} s), which was fitted with the model."
        )
    if not s.white and any(e.parameters for e in s.effects):
        out.append("What is left is not random, so the standard errors are taken from blocks of the recording.")
    return out
