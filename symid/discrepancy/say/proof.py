"""The proof as sentences: held-out data, chance, and either half of the recording."""

from __future__ import annotations

import numpy as np

from symid.discrepancy.prove.held_out import Proof
from symid.discrepancy.say.names import law_name
from symid.discrepancy.say.story import Story, capital, listed
from symid.units import rough

STILL = 3.0
"""What varies by less than so many times the sensors' noise does not move."""


def unproved(s: Story) -> list[str]:
    if s.proof is None or s.proof.confirmed:
        return []
    return [
        "The held-out data speak against this."
        if not s.proof.margin > 0
        else "The held-out data do not confirm this yet."
    ]


def paid_words(s: Story) -> list[str]:
    """What only the held-out data made believed."""
    paid = s.evidence.paid
    if paid is None:
        return []
    name = capital(law_name(paid.term.name, paid.term.location))
    return [f"{name} is not certain enough by the fit window alone: what it explains of the held-out data makes it so."]


def proof_words(s: Story) -> list[str]:
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
    by = f", by {rough(100 * abs(s.proof.margin))} %" if np.isfinite(s.proof.margin) else " without bound"
    errors = errors if s.proof.free_runs.margin > 0 else f"does not fall: it {errors}"
    return [
        f"On the held-out window predictions from sample to sample err {more}{by}"
        f"{_confirmation(s.proof)}. The error of free simulation, which holds all that random forces did, {errors}.",
        *_chance(s),
    ]


def _confirmation(p: Proof) -> str:
    """What the blocks of the held-out data say of the fall of the error."""
    if p.confirmed:
        return f", which confirms the finding (probability {min(p.probability, 0.999):.3g} from {_blocks(p.blocks)})"
    if not p.margin > 0:  # nor where a run diverges
        return ": the held-out window does not confirm the finding"
    if p.contradicted:
        chance = f"probability {p.free_runs.probability:.2g} from {_blocks(p.free_runs.blocks)}"
        return f": not confirmed, because free simulation loses more than that ({chance})"
    longer = f"; about {rough(p.needed)} s like these would" if p.needed is not None and p.needed > p.seconds else ""
    chance = f"probability {p.probability:.2g} from {_blocks(p.blocks)}{longer}"
    return f": not confirmed, because chance could do that ({chance})"


def _blocks(count: int) -> str:
    return f"{count} block{'s' * (count != 1)}"


def _chance(s: Story) -> list[str]:
    """How often chance alone looks like the finding, in recordings like this one."""
    if s.chance is None or s.effects and s.effects[0].name.startswith("unknown"):
        return []
    size = rough(s.chance) if s.chance >= 1e-6 else "below one in a million"
    what = "the least certain effect" if s.effects else "the best suspect"
    dear = ", but it does not explain enough to pay for its unknowns" if not s.effects and s.chance < 0.05 else ""
    return [
        f"With nothing missing, chance alone would make a suspect look as good as {what} here "
        f"with a probability of {size}{dear}."
        if s.chance >= 1e-6
        else f"With nothing missing, chance alone would make a suspect look like this with a probability {size}{dear}."
    ]


def halves_words(s: Story) -> list[str]:
    if not s.survived:
        return []
    one = len(s.survived) == 1
    kept = [law_name(v.name, v.location) for v in s.survived if not v.reason]
    out = []
    if kept:
        out.append(
            f"{'It' if one else capital(listed(kept))} {'survives' if one or len(kept) == 1 else 'survive'} on both "
            "halves of the fit window, taken alone."
        )
    out += [
        f"{'It' if one else capital(law_name(v.name, v.location))} does not survive on two halves of the fit window: "
        f"{v.reason}."
        for v in s.survived
        if v.reason
    ]
    return out


def verdicts_of_halves(s: Story) -> list[str]:
    """Whether either half alone leads to the same verdict and to the same suspect."""
    if not s.halves:
        return []
    other = [
        f"the {which} half leads to '{v.verdict.replace('_', ' ')}'"
        for v, which in zip(s.halves, ("first", "second"), strict=True)
        if v.verdict != s.verdict
    ]
    out = [
        f"Taken alone, {listed(other)}: another verdict than on the whole."
        if other
        else "Either half alone leads to the same verdict."
    ]
    return out + [
        f"On the {which} half alone {law_name(v.rival.term.name, v.rival.term.location)} explains more "
        "than what was found."
        for v, which in zip(s.halves, ("first", "second"), strict=True)
        if v.rival is not None
    ]
