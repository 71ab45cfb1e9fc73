"""The start that a user asks for, by its name, by values, or by an earlier solution."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SolveError
from symid.identification.starts.default import default_start, given_start, random_start
from symid.identification.starts.search import can_search, relaxed_start, search_start
from symid.identification.starts.stable import stable_start

if TYPE_CHECKING:
    from symid.identification.problem import Identification
    from symid.identification.solution import Solution

SEARCHES = {"search": search_start, "relaxed": relaxed_start, "stable": stable_start}


def start_of(
    problem: Identification, kind: str | dict[str, float] | np.ndarray | Solution, seed: int, number: int
) -> np.ndarray:
    """The free vector that `Identification.start` gives."""
    if isinstance(kind, np.ndarray):
        return kind
    if not isinstance(kind, str):
        return given_start(problem.transcription, kind)
    if kind == "default":
        z, simulated = default_start(problem.transcription)
        return z if simulated or not can_search(problem) else search_start(problem, seed, number)
    if kind == "random":
        return random_start(problem.transcription, seed, number)
    if kind in SEARCHES:
        return SEARCHES[kind](problem, seed, number)
    known = ", ".join(f"'{name}'" for name in ("default", "random", *SEARCHES))
    raise SolveError(f"start: '{kind}' is not known; give {known}, parameter values by name, or a Solution")
