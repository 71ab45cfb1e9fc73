"""Results that wait while another solve needs the memory."""

import tempfile
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symid.ipopt_solver.evaluation import MANY_UNKNOWNS
from symid.ipopt_solver.result import SolverResult

VECTORS = ("z", "constraints", "multipliers", "bound_multipliers_lower", "bound_multipliers_upper")


def set_aside(result: SolverResult) -> Callable[[], SolverResult]:
    """What gives the result back; until then the vectors of a large one are in a temporary file, if there is room.

    Of an hour at 100 Hz they are 55 MiB.
    """
    if result.z.size < MANY_UNKNOWNS:
        return lambda: result
    try:
        file = tempfile.TemporaryFile()
        np.savez(file, **{name: getattr(result, name) for name in VECTORS})
    except OSError:  # no room: then it stays in memory
        return lambda: result
    rest = replace(result, **dict.fromkeys(VECTORS, np.zeros(0)))

    def given_back() -> SolverResult:
        file.seek(0)
        with file, np.load(file, allow_pickle=False) as vectors:
            return replace(rest, **vectors)

    return given_back
