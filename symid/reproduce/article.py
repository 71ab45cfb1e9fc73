"""What the article reports: its twelve cases and their published numbers."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from symid.checked import nearest
from symid.errors import SymidError

WINDOW = {"PD": (160.0, 260.0), "FPD": (160.0, 260.0), "NN": (160.0, 170.0)}
"""Window of the fit of each controller [s]: samples 8000 to 13000, and 8000 to 8500 for the network."""
RANGE, HELD_OUT = (160.0, 300.0), (260.0, 300.0)
"""Where the range of operating points comes from, and what the forward simulations follow [s]."""
TORQUE_NOISE = 0.25
"""Half width [N m] of the uniform joint-torque noise."""


@dataclass(frozen=True)
class Case:
    """One identification of the article and what it gave there.

    Attributes
    ----------
    rms_deg : of the ten starts, best first.
    eigenvalue_percent, forward_percent : stable share of 14641 states [%].
    gains : name -> (mean, standard deviation) over the good starts, in SI; empty for the network.
    """

    controller: str
    episodes: int
    rms_deg: tuple[float, ...] = field(compare=False)
    eigenvalue_percent: float = field(compare=False)
    forward_percent: float = field(compare=False)
    gains: dict[str, tuple[float, float]] = field(compare=False)

    @property
    def name(self) -> str:
        return f"{self.controller}-{self.episodes}"


@lru_cache
def _cases() -> tuple[Case, ...]:
    facts = json.loads(Path(__file__).with_name("article.json").read_text())
    return tuple(
        Case(
            r["controller"],
            r["episodes"],
            tuple(r["rms_deg"]),
            r["eigenvalue_stable_percent"],
            r["forward_stable_percent"],
            {k: tuple(v) for k, v in r.get("gains", {}).items()},
        )
        for r in facts["results"]
    )


CASES = {case.name: case for case in _cases()}


def chosen(names) -> list[Case]:
    """Cases by name ("PD-3") or by controller ("PD"); all for no names."""
    cases = []
    for name in names or CASES:
        found = [c for c in CASES.values() if name.upper() in (c.name, c.controller)]
        if not found:
            raise SymidError(f"the article has no case '{name}'; {nearest(name.upper(), CASES)}")
        cases += [c for c in found if c not in cases]
    return cases
