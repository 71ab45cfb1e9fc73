"""Names as a person says them: of places, of laws, and what a law says of itself."""

from __future__ import annotations

import re
from collections.abc import Mapping

from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.mechanics.missing.laws.shared import coordinate_unit
from symid.model import Model
from symid.units import quantity


def place_name(location: str) -> str:
    """A place as a person says it: "joint 1", "the ankle", "the sensor of link 2"."""
    kind, _, rest = location.rpartition(":")
    noun = re.sub(r"^(\w*[a-z]{2})(\d+)$", r"\1 \2", rest).replace("_", " ")
    noun = noun if noun[-1:].isdigit() else f"the {noun}"
    return (
        f"the {kind} {rest}"
        if kind in ("input", "body")
        else f"the value of {rest}"
        if kind == "value"
        else f"the {kind} of {noun}"
        if kind
        else {"the global": "the whole system", "the ": "the whole system"}.get(noun, noun)
    )


def law_name(name: str, location: str = "") -> str:
    """A law as a person says it, with its place: "viscous friction at joint 1"."""
    said = name.replace("_", " ")
    for lower, proper in _PROPER.items():
        said = said.replace(lower, proper)
    return said if location in ("", "global", "input", "base") else f"{said} at {place_name(location)}"


_PROPER = {"bouc wen": "Bouc-Wen", "coulomb": "Coulomb", "stribeck": "Stribeck"}
"""Names of people in those of laws."""
_STRAIGHT = {"torque": "force", "angle": "position", "turns": "moves", "inertia": "mass"}
"""Words of the laws, for a place that moves along a line."""


def sentence(suspect: Suspect, parameters: Mapping[str, tuple[float, float]], model: Model | None = None) -> str:
    """The law's own sentence with place, values and standard errors put in, in the units that it has in `model`.

    Of its clauses, which semicolons separate, those are left out whose sizes could as well be nothing.
    """
    units = {
        q.key: q.unit if model is None else model.parameters[suspect.term.parameter_name(q.key)].unit
        for q in suspect.law.parameters
    }
    filled = {k: quantity(v, s, units[k]) for k, (v, s) in parameters.items()}
    place = place_name(suspect.term.location)
    template = re.sub(
        r"\b([Tt])he (?:sensor )?\{place\}",
        lambda the: place if the[1] == "t" else place[:1].upper() + place[1:],
        " and ".join(_sure_clauses(suspect, parameters)),
    )
    at = suspect.term.location
    if model is not None and any(p.at == at and coordinate_unit(model, at) != "rad" for p in model.ports.values()):
        template = re.sub(r"\b(torque|angle|turns|inertia)\b", lambda word: _STRAIGHT[word[0]], template)
    return template.format(place=place.removeprefix("the "), **filled)


def values_of(suspect: Suspect, fit: Fit) -> dict[str, tuple[float, float]]:
    """By key the value and standard error of each of its parameters that was fitted."""
    names = {q.key: suspect.term.parameter_name(q.key) for q in suspect.law.parameters}
    return {key: (fit.values[k], fit.errors[k]) for key, k in names.items() if k in fit.errors}


def _sure_clauses(suspect: Suspect, parameters: Mapping[str, tuple[float, float]]) -> list[str]:
    """The clauses of a law's sentence of which some size is surely something; all if none is."""
    nothing = {
        q.key
        for q in suspect.law.parameters
        if q.null is not None and q.key in parameters
        if abs(parameters[q.key][0] - q.null) <= POLICY.sure * parameters[q.key][1]
    }
    clauses = suspect.law.sentence.split("; ")
    keys = [{part.split("}")[0] for part in clause.split("{")[1:]} - {"place"} for clause in clauses]
    kept = [clause for clause, own in zip(clauses, keys, strict=True) if not own or own - nothing]
    return kept or clauses
