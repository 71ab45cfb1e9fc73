"""Which linear solver Ipopt works with: the one for chains, MUMPS, or another that Ipopt finds by its name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from symid import kkt
from symid.errors import CodegenError, SolveError
from symid.ipopt_solver.memory import give_back_freed_memory, keep_freed_memory
from symid.ipopt_solver.status import SOLVED

CHAIN: dict[str, str | float] = {"linear_solver": "ma27", "linear_system_scaling": "none"}
# MUMPS without its matching and scaling: collocation systems are well scaled already. Its ordering for
# quasi-dense rows (QAMD), because every equation holds the parameters: against its own choice a third
# to a fifth of the time with several episodes, and half with one.
MUMPS: dict[str, str | float] = {
    "linear_solver": "mumps",
    "mumps_permuting_scaling": 0,
    "mumps_scaling": 0,
    "mumps_pivot_order": 6,
}
KEPT_BYTES, KEPT_BYTES_CHAIN = 2**30, 2**24
"""Freed blocks up to this size are kept: MUMPS takes its work space anew at each factorisation; the solver for chains
holds its own, so that what else is large may go back. An hour at 100 Hz needs a twentieth less memory for it."""


@dataclass(frozen=True)
class LinearSolver:
    """Which linear solver worked, and what it did.

    Attributes
    ----------
    name : str
        "chain" (`symid.kkt`), "mumps", or Ipopt's name of another.
    reason : str
        Why this one.
    factorisations, seconds, fill, delayed : int, float, int, int, or None
        Wall time [s] in it, numbers in the largest factor, delayed pivots in all; None where Ipopt does not tell.
    """

    name: str
    reason: str
    factorisations: int | None = None
    seconds: float | None = None
    fill: int | None = None
    delayed: int | None = None


def run_with(wanted: str, run: Callable[[dict], int]) -> tuple[int, LinearSolver]:
    """Run Ipopt with the linear solver `wanted`; `run` takes Ipopt options and gives Ipopt's status.

    Parameters
    ----------
    wanted : "auto" (chain where there is one and a compiler, MUMPS else), "chain", "mumps", or Ipopt's name.

    Raises
    ------
    SolveError
        "chain" was asked for, and there is no compiler or no chain.
    """
    if wanted not in ("auto", "chain"):
        keep_freed_memory(KEPT_BYTES)
        return run(MUMPS if wanted == "mumps" else {"linear_solver": wanted}), LinearSolver(wanted, "asked for")
    try:
        path = kkt.library_path()
    except CodegenError as problem:
        return _mumps_instead(wanted, run, f"the solver for chains cannot be compiled: {problem}")
    kkt.begin()
    keep_freed_memory(KEPT_BYTES_CHAIN)
    try:
        status = run(CHAIN | {"hsllib": str(path)})
    finally:
        done = kkt.end()
        if 8 * done.fill > kkt.KEEP_BYTES:
            give_back_freed_memory()
    if not done.unknowns and status not in SOLVED:
        return _mumps_instead(wanted, run, "this Ipopt does not load it (option hsllib, Ipopt 3.14)")
    if done.refused:
        return _mumps_instead(wanted, run, f"the problem is no chain ({done.refused:.3g} multiplications per unknown)")
    seconds = done.seconds_analysis + done.seconds_factor + done.seconds_solve
    reason = f"a chain with {done.border} unknown{'s' * (done.border != 1)} that all of it shares"
    return status, LinearSolver("chain", reason, done.factorisations, seconds, done.fill, done.delayed)


def _mumps_instead(wanted: str, run: Callable[[dict], int], reason: str) -> tuple[int, LinearSolver]:
    if wanted == "chain":
        raise SolveError(f"linear_solver='chain' is not possible: {reason}. Choose 'auto' or 'mumps'.")
    keep_freed_memory(KEPT_BYTES)
    return run(MUMPS), LinearSolver("mumps", reason)
