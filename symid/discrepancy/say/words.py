"""The finding as sentences."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import degrees, floor, isfinite, log10

import numpy as np

from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.discrepancy.say.diagnosis import Effect
from symid.estimation.free_run import FreeRun

_UNITS = {"1": "", "N*m": "N m", "N*m*s/rad": "N m s/rad", "kg*m^2": "kg m²"}
_PREFIXED = ("N*", "N/", "m", "kg*")
LOSSES = ("viscous_friction", "coulomb_friction", "quadratic_drag", "stribeck_friction", "joint_drag",
          "load_dependent_friction", "bouc_wen_hysteresis")
"""Laws by which a mechanism loses energy."""
UNSURE, HOPELESS = 100.0, 1e6
"""A value with an error this many times larger, or with one this large in its unit, is not worth digits."""
STILL = 3.0
"""What varies by less than so many times the sensors' noise does not move."""
ABOVE = 2.0
"""A rest this many times larger than the sensors' noise is spoken of."""


# ---- names and numbers -----------------------------------------------------------------------
def place_name(location: str) -> str:
    """A place as a person says it: "joint 1", "the ankle", "the sensor of link 2"."""
    kind, _, rest = location.rpartition(":")
    noun = re.sub(r"([a-z])(\d+)$", r"\1 \2", rest).replace("_", " ")
    noun = noun if noun[-1:].isdigit() else f"the {noun}"
    return f"the {kind} of {noun}" if kind else {"the global": "the whole system", "the input": "the input"}.get(noun, noun)


def law_name(name: str, location: str = "") -> str:
    """A law as a person says it, with its place: "viscous friction at joint 1"."""
    said = name.replace("_", " ")
    return said if location in ("", "global", "input", "base") else f"{said} at {place_name(location)}"


def sentence(suspect: Suspect, parameters: Mapping[str, tuple[float, float]]) -> str:
    """The law's own sentence with place, values and standard errors put in."""
    units = {q.key: q.unit for q in suspect.law.parameters}
    filled = {k: quantity(v, s, units[k]) for k, (v, s) in parameters.items()}
    place = place_name(suspect.term.location)
    template = re.sub(r"\b([Tt])he (?:sensor )?\{place\}", lambda the: place if the[1] == "t" else place[:1].upper() + place[1:],
                      suspect.law.sentence)
    return template.format(place=place.removeprefix("the "), **filled)


def quantity(value: float, error: float, unit: str) -> str:
    """A value with its standard error and unit: "84 ± 3 ms", "0.052 ± 0.004 N m"."""
    prefixed = unit.startswith(_PREFIXED)
    unit = _UNITS.get(unit, unit.replace("*", " ")).replace("^2", "²").replace("^3", "³")
    size = abs(value) or error
    if unit == "s" and size < 1:
        value, error, unit = 1e3 * value, 1e3 * error, "ms"
    elif unit == "rad" and size < 0.2:
        value, error, unit = degrees(value), degrees(error), "deg"
    elif 0 < size < 1e-2 and prefixed and not unit.startswith("kg"):
        factor, prefix = (1e3, "m") if size > 1e-3 else (1e6, "µ")
        value, error, unit = factor * value, factor * error, prefix + unit
    if not isfinite(error) or error > UNSURE * abs(value) > 0 or error > HOPELESS:
        return f"{value:.2g} {unit}".strip() + " (hardly determined)"
    if not error > 0:
        return f"{value:.3g} {unit}".strip()
    digits = min(9, max(0, 1 - floor(log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f} {unit}".strip()


def _listed(items: Sequence[str], last: str = "and") -> str:
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {last} {items[-1]}"


def _deg(radians: float) -> str:
    return f"{degrees(radians):.3g}"


# ---- the text --------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class Story:
    """What there is to tell."""

    verdict: str
    effects: tuple[Effect, ...]
    equivalent: tuple[Hypothesis, ...]
    ranking: Sequence[Hypothesis]
    left: Sequence[Test]
    runs: Mapping[str, FreeRun]
    audit: Audit
    survived: tuple[Survival, ...]
    halves: tuple[HalfVerdict, ...]
    white: bool
    driven: bool
    weight: float


def words(story: Story) -> str:
    """Everything that a reader should know, most important first, one line a paragraph."""
    losses = _losses(story)
    first = (losses, _finding(story)) if len(losses) and " not enough" in losses[0] else (_finding(story) + losses,)
    parts = (*first, _alike(story), _proof(story) + _rest(story), _halves(story) + _verdicts_of_halves(story), _caveats(story))
    return "\n".join(" ".join(part) for part in parts if part)


def _finding(s: Story) -> list[str]:
    if s.verdict == "adequate":
        return ["The model explains the recording: no suspect improves it beyond chance and nothing systematic is left."]
    known = [e for e in s.effects if e.name != "unknown"]
    if s.verdict == "missing_physics":
        return [f"{e.sentence}." for e in known]
    first, others = s.effects[0], [e for e in known if e is not s.effects[0]]
    said = [f"{e.sentence}." for e in others if e.established]
    part = [f"In part it looks like this: {_lowered(e.sentence)}." for e in others if not e.established]
    if said and first.name == "unknown":
        return [*said, f"That is not all: something systematic is left at {place_name(first.location)}, {first.sentence}, "
                       "which no established effect explains.", *part]
    out = [f"Something systematic acts at {place_name(first.location)} that no established effect explains. It looks like this: "
           f"{_lowered(first.sentence)}.", *part]
    return out + (["Besides:", *said] if said else [])


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
    left = float(np.sqrt(np.mean(np.vstack(alone.fit.innovations) ** 2)))
    name = law_name(alone.suspect.term.name, alone.suspect.term.location)
    return [f"{text}, and one law is not enough: the best alone, {name}, leaves an error of {_deg(left)} deg in the fit window, "
            f"all that was found together {_deg(s.runs['augmented_train'].rms)} deg."]


def _alike(s: Story) -> list[str]:
    if not s.equivalent:
        return []
    names = _listed([law_name(c.suspect.term.name, c.suspect.term.location) for c in s.equivalent[:3]], "or")
    return [f"{names[:1].upper()}{names[1:]} would explain the recording almost as well; motion that is faster, larger or longer "
            "would tell them apart."]


def _proof(s: Story) -> list[str]:
    if "augmented_heldout" not in s.runs:
        return []
    before, after = s.runs["baseline_heldout"].rms, s.runs["augmented_heldout"].rms
    if np.all(s.runs["baseline_heldout"].recorded.std(axis=0) < STILL * s.audit.noise):
        return ["In the held-out window nothing moves, so that it proves nothing."]
    if not s.effects or before == after:
        return [f"The error of free simulation on the held-out window is {_deg(before)} deg."]
    text = f"The error of free simulation on the held-out window goes from {_deg(before)} to {_deg(after)} deg"
    return [f"{text}." if after < before else f"{text}: the held-out window does not confirm the finding."]


def _halves(s: Story) -> list[str]:
    if not s.survived:
        return []
    one = len(s.survived) == 1
    kept = [law_name(v.name, v.location) for v in s.survived if not v.reason]
    out = []
    if kept:
        out.append(f"{'It' if one else _capital(_listed(kept))} {'survives' if one or len(kept) == 1 else 'survive'} on both halves "
                   "of the fit window, taken alone.")
    out += [f"{'It' if one else _capital(law_name(v.name, v.location))} does not survive on two halves of the fit window: {v.reason}."
            for v in s.survived if v.reason]
    return out


def _verdicts_of_halves(s: Story) -> list[str]:
    """Whether either half alone leads to the same verdict and to the same suspect."""
    if not s.halves:
        return []
    other = [f"the {which} half leads to '{v.verdict.replace('_', ' ')}'" for v, which in zip(s.halves, ("first", "second"), strict=True)
             if v.verdict != s.verdict]
    out = [f"Taken alone, {_listed(other)}: another verdict than on the whole." if other else
           "Either half alone leads to the same verdict."]
    return out + [f"On the {which} half alone {law_name(v.rival.term.name, v.rival.term.location)} explains more than what was found."
                  for v, which in zip(s.halves, ("first", "second"), strict=True) if v.rival is not None]


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _rest(s: Story) -> list[str]:
    """How far the improved model's free runs are from the noise of the sensors, where nothing random drives."""
    if s.verdict == "adequate":
        worst = s.left[0] if s.left else None
        return [] if worst is None else [f"The most suspicious of {len(s.left)} tests for a remainder has odds of 1 in "
                                         f"{10 ** min(worst.minus_log10_p, 15):,.0f} by chance."]
    floor_, rms = float(np.sqrt(np.mean(s.audit.noise**2))), s.runs["augmented_train"].rms
    if s.driven or s.verdict != "unexplained" or not rms > ABOVE * floor_:
        return []
    return [f"In the fit window an error of {_deg(rms)} deg remains, {rms / floor_:.0f} times the noise of the sensors "
            f"({_deg(floor_)} deg): unexplained."]


def _caveats(s: Story) -> list[str]:
    out = []
    if s.audit.filtered:
        cutoff = float(np.nanmax(s.audit.cutoff))
        out.append(f"The recording holds nothing above about {cutoff:.2g} Hz: it was low-pass filtered. Only one sample in "
                   f"{round(1 / s.weight)} is counted as independent; tests for a remainder may still be too strict.")
    elif not s.audit.stated:
        noise = _listed([_deg(x) for x in s.audit.noise])
        out.append(f"The sensors' noise was not stated; the highest frequencies of the recording show {noise} deg.")
    if not s.white and any(e.parameters for e in s.effects):
        out.append("What is left is not random, so the standard errors are taken from blocks of the recording.")
    return out
