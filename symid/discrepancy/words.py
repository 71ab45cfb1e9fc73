"""The finding as sentences."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, floor, log10

from symid.discrepancy.diagnosis import Effect
from symid.discrepancy.freerun import FreeRun
from symid.discrepancy.remainder import Test
from symid.discrepancy.search import Candidate
from symid.discrepancy.suspects import Suspect

_UNITS = {"1": "", "N*m": "N m", "N*m*s/rad": "N m s/rad", "kg*m^2": "kg m^2"}


def sentence(suspect: Suspect, parameters: Mapping[str, tuple[float, float]]) -> str:
    """The law's own sentence with place, values and standard errors put in."""
    units = {q.key: q.unit for q in suspect.law.parameters}
    filled = {k: quantity(v, s, units[k]) for k, (v, s) in parameters.items()}
    return suspect.law.sentence.format(place=suspect.term.location.removeprefix("sensor:"), **filled)


def quantity(value: float, error: float, unit: str) -> str:
    """A value with its standard error and unit: "84 +- 3 ms", "0.052 +- 0.004 N m"."""
    unit = _UNITS.get(unit, unit.replace("*", " "))
    if unit == "s" and abs(value) < 1:
        value, error, unit = 1e3 * value, 1e3 * error, "ms"
    elif unit == "rad" and abs(value) < 0.2:
        value, error, unit = degrees(value), degrees(error), "deg"
    elif 0 < abs(value) < 1e-2 and unit[:1] in ("N", "m"):
        factor, prefix = (1e3, "m") if abs(value) > 1e-3 else (1e6, "µ")
        value, error, unit = factor * value, factor * error, prefix + unit
    digits = 2 if not error > 0 else max(0, 1 - floor(log10(error)) if error < 10 else 0)
    shown = f"{value:.{min(digits, 9)}f}" + (f" ± {error:.{min(digits, 9)}f}" if error > 0 else "")
    return f"{shown} {unit}".strip()


def words(verdict: str, effects: tuple[Effect, ...], equivalent: tuple[Candidate, ...], left: list[Test],
          runs: Mapping[str, FreeRun]) -> str:
    """Everything that a reader should know, most important first."""
    out = []
    if verdict == "adequate":
        out.append("The model explains the recording: no suspect improves it beyond chance and nothing systematic is left.")
    elif verdict == "missing_physics":
        out += [f"{e.sentence}." for e in effects]
    else:
        e, others = effects[0], effects[1:]
        out.append(f"Something systematic acts at {e.location} that no established effect explains. It looks like this: "
                   f"{e.sentence[:1].lower()}{e.sentence[1:]}.")
        out += [f"Besides: {o.sentence}." for o in others]
    if equivalent:
        names = " or ".join(f"{c.suspect.term.name} at {c.suspect.term.location}" for c in equivalent[:3])
        out.append(f"{names} would explain the recording almost as well; motion that is faster, larger or longer would "
                   "tell them apart.")
    if "augmented_heldout" in runs and effects:
        before, after = runs["baseline_heldout"].rms, runs["augmented_heldout"].rms
        out.append(f"The error of free simulation on the held-out window goes from {degrees(before):.3g} to "
                   f"{degrees(after):.3g} deg.")
    if verdict == "adequate" and left:
        out.append(f"The most suspicious of {len(left)} tests for a remainder has odds of 1 in {10 ** min(left[0].surprise, 15):.0f} "
                   "by chance.")
    return " ".join(out)
