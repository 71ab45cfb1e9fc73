"""What is left, in words: what kind of force, where in the motion, when, and which way energy goes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from symid.discrepancy.locate.flexible_law import FlexibleLaw
from symid.discrepancy.locate.rest import BINS, Rest, Stretch, ranges_of
from symid.discrepancy.name.closed_form import Proposal
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.nameless import Nameless
from symid.discrepancy.say.names import place_name
from symid.mechanics.coordinates import coordinate, signal_unit
from symid.mechanics.missing.dictionary import law_text
from symid.model import Model, Port
from symid.units import quantity, reduced, same_dimension

NOUNS = {"N*m": "torque", "N": "force", "W": "flow", **dict.fromkeys(("m/s^2", "rad/s^2", "1/s^2"), "acceleration")}
AMOUNTS = ("m^3", "cm^3", "L", "mL", "kg", "g", "mol", "mmol")
"""What flows where a unit is one of these over a time."""
LARGEST = 0.99
"""Part of the samples below whose force the rest is told: the few above may answer to a start that is far off."""
ORDER = ("first", "middle", "last")
UNEVEN = 1.5
"""A part of the motion where the force is so many times what it is elsewhere is named."""
MOSTLY = 0.7
"""Part of the samples from which on they are called small or large."""


def nameless_words(unnamed: Nameless, error: Callable[[np.ndarray], str]) -> list[str]:
    """Sentences on a rest, on the flexible law that was fitted in its place, and on the closed form that does as well.

    Parameters
    ----------
    error : errors (m,) of the outputs as text.
    """
    out = rest_words(unnamed.rest) if unnamed.rest is not None else []
    tested = {k: f" (held-out error {error(e)})" for k, e in unnamed.errors.items()}
    if unnamed.flexible is not None:
        out.append(flexible_words(unnamed.flexible) + tested.get("flexible", "") + ".")
        if unnamed.refuted:
            without = error(unnamed.errors["names"])
            out.append(f"Without it the held-out error is {without}, so the improved model leaves it out.")
    if unnamed.proposal is not None:
        out.append(
            f"The simplest closed form that does as well is {formula(unnamed.proposal)}"
            f"{tested.get('proposal', ', not tested on held-out data')}."
        )
    elif unnamed.flexible is not None:
        out.append("No closed form of the dictionary does as well.")
    return out


def formula(proposal: Proposal) -> str:
    """The law as a person writes it: "force = -a speed³ with a = 1.20 ± 0.05 N s³/m³"."""
    names = {str(s): signal_name(proposal.model, proposal.port, s) for s in proposal.flexible.signals}
    text = law_text(proposal.shapes, names)
    values, errors = proposal.values, proposal.errors
    numbers = [
        f"{q.key.replace('_', ' ')} = {quantity(values[q.key], errors[q.key], q.unit)}" for q in proposal.law.parameters
    ]
    return f"{noun(proposal.port.unit)} = {text} with {', '.join(numbers)}"


def flexible_words(law: FlexibleLaw) -> str:
    """What the flexible law is, and how much it explains."""
    names = dict.fromkeys(signal_name(law.model, law.port, s) for s in law.signals)
    return (
        f"A flexible {noun(law.port.unit)} at {place_name(law.port.at)}, given by splines over {' and '.join(names)} "
        f"with {law.size} unknowns, can stand for it"
    )


def rest_words(rest: Rest) -> list[str]:
    """Sentences on a rest: the force and what it follows, where it is largest, and its energy in time and by size."""
    return [_force(rest), *_where(rest), *_energy(rest)]


def noun(unit: str) -> str:
    """What a force with this unit is called."""
    amount, _, time = unit.partition("/")
    return NOUNS.get(unit, "flow" if amount in AMOUNTS else "rate" if time == "s" else "force")


def signal_name(model: Model, port: Port, signal) -> str:
    """An expression of the states as a person says it at a port."""
    angle = signal_unit(model, coordinate(port)) == "rad"
    if signal == port.position:
        return ("angle" if angle else "position") if port.rate != 0 else place_name(str(signal)).removeprefix("the ")
    return "speed" if signal == port.rate else place_name(str(signal)).removeprefix("the ")


def _force(rest: Rest) -> str:
    what, unit = noun(rest.port.unit), rest.port.unit
    names = list(dict.fromkeys(signal_name(rest.model, rest.port, s) for s in rest.signals))
    follows = names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
    size = np.abs(rest.force)
    largest = float(np.quantile(size, LARGEST))
    usual = float(np.sqrt(np.mean(size[size <= largest] ** 2)))
    article = "an" if what == "acceleration" else "a"
    return (
        f"What no established law explains is like {article} {what} at {place_name(rest.port.at)} of "
        f"{quantity(usual, unit=unit)} (rms; up to {quantity(largest, unit=unit)}) that follows the {follows}."
    )


def _where(rest: Rest) -> list[str]:
    """For each signal where in its range the force is largest, if it is uneven."""
    found = []
    for signal, edges, rms in ranges_of(rest):
        name, unit = signal_name(rest.model, rest.port, signal), signal_unit(rest.model, signal)
        large = np.nan_to_num(rms) >= np.nanmax(rms) / UNEVEN
        if np.nanmax(rms) < UNEVEN * np.nanmin(rms) or large.all():
            continue
        place = _range(large, edges, unit, name)
        found += [place] if place else []
    return [f"It is largest {' and '.join(found)}."] if found else []


def _range(large: np.ndarray, edges: np.ndarray, unit: str, name: str) -> str:
    """Which of the bins are large, as a range of the signal; nothing where they are scattered."""
    k = np.flatnonzero(large)
    low, high = quantity(edges[k[0]], unit=unit), quantity(edges[k[-1] + 1], unit=unit)
    if len(k) == k[-1] - k[0] + 1:
        if k[0] == 0:
            return f"where the {name} is below {high}"
        return (
            f"where the {name} is above {low}" if k[-1] == BINS - 1 else f"where the {name} is between {low} and {high}"
        )
    inside = np.flatnonzero(~large)
    if large[0] and large[-1] and len(inside) == inside[-1] - inside[0] + 1:
        a, b = quantity(edges[inside[0]], unit=unit), quantity(edges[inside[-1] + 1], unit=unit)
        return f"where the {name} is outside {a} to {b}"
    return ""


# ---- energy ----------------------------------------------------------------------------------
def _energy(rest: Rest) -> list[str]:
    """Which way energy, or in a balance of first order the balance, goes: on the whole, in time, by amplitude."""
    unit = rest.port.unit if rest.first_order else power_unit(rest)
    way = _way(rest.whole)
    if rest.first_order:
        said = {1: "On average it adds", -1: "On average it takes away"}
        whole = f"{said[way]} {quantity(abs(rest.whole.power), rest.whole.error, unit)}" if way else ""
    else:
        said = {1: "It puts energy into the motion", -1: "It takes energy out of the motion"}
        whole = f"{said[way]}, {quantity(abs(rest.whole.power), rest.whole.error, unit)} on average" if way else ""
    neither = (
        "On average it is nothing" if rest.first_order else "On the whole it neither takes energy out nor puts it in"
    )
    whole = whole or neither
    parts = [*_in_time(rest, unit), *_by_amplitude(rest, unit)]
    return [f"{whole}.", *parts]


def power_unit(rest: Rest) -> str:
    """Of force times rate: W for a torque or a force."""
    rate = signal_unit(rest.model, rest.port.rate)
    return "W" if same_dimension(f"({rest.port.unit})*({rate})", "W") else reduced(f"({rest.port.unit})*({rate})")


def _way(stretch: Stretch) -> int:
    """1 where it puts in, -1 where it takes out, 0 where neither is sure."""
    return int(np.sign(stretch.power)) if abs(stretch.power) > POLICY.sure * stretch.error else 0


def _meaning(way: int, rest: Rest) -> str:
    if rest.first_order:
        return "the model gives too little" if way > 0 else "the model gives too much"
    return "the model loses too much" if way > 0 else "the model loses too little"


def _verb(way: int, rest: Rest) -> str:
    if rest.first_order:
        return "adds" if way > 0 else "takes away"
    return "puts in" if way > 0 else "takes out"


def _in_time(rest: Rest, unit: str) -> list[str]:
    """The parts of the window in which it does something else than elsewhere, or more."""
    ways = [_way(s) for s in rest.stretches]
    sizes = np.array([abs(s.power) for s in rest.stretches])
    if not any(ways):
        return []
    if len(set(ways)) == 1:
        if sizes.max() < UNEVEN * sizes.min():
            return [f"So it does in all parts of the window: {_meaning(ways[0], rest)}."]
        which, s = ORDER[int(np.argmax(sizes))], rest.stretches[int(np.argmax(sizes))]
        return [
            f"So it does in all parts of the window, most in the {which} third ({_span(s)}{_size(s, rest)}), "
            f"{quantity(abs(s.power), s.error, unit)}: {_meaning(ways[0], rest)}."
        ]
    found = []
    for which, s, way in zip(ORDER, rest.stretches, ways, strict=True):
        if way:
            found.append(
                f"In the {which} third ({_span(s)}{_size(s, rest)}) it {_verb(way, rest)} "
                f"{quantity(abs(s.power), s.error, unit)}: there {_meaning(way, rest)}."
            )
    return found


def _span(stretch: Stretch) -> str:
    return f"{stretch.span[0]:.3g} to {stretch.span[1]:.3g} s"


def _size(stretch: Stretch, rest: Rest) -> str:
    """Whether the motion was small or large there."""
    limit = quantity(rest.limit, unit=signal_unit(rest.model, coordinate(rest.port)))
    if stretch.small >= MOSTLY:
        return f", at small amplitudes, below {limit}"
    return f", at large amplitudes, above {limit}" if stretch.small <= 1 - MOSTLY else ""


def _by_amplitude(rest: Rest, unit: str) -> list[str]:
    """Small against large motion, where these differ."""
    small, large = _way(rest.small), _way(rest.large)
    if small == large or not (small and large):
        return []
    limit = quantity(rest.limit, unit=signal_unit(rest.model, coordinate(rest.port)))
    return [
        f"At amplitudes below {limit} it {_verb(small, rest)} "
        f"{quantity(abs(rest.small.power), rest.small.error, unit)}, "
        f"above that it {_verb(large, rest)} {quantity(abs(rest.large.power), rest.large.error, unit)}."
    ]
