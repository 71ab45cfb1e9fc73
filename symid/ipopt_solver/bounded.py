"""Ipopt in a thread of its own, so that the caller hears Ctrl-C and the clock while a factorisation goes on.

A factorisation by MUMPS cannot be stopped from outside, and where pivots are delayed over and over one can
take minutes. A thread that does not come back is left to itself: its next call of a function of the program
ends it. Until then no other solve can begin in this process, because MUMPS keeps state between calls.
"""

from __future__ import annotations

import contextvars
import threading
import time
from collections.abc import Callable

from symid.ipopt_solver.evaluation import Evaluation

LEAVE = 1.12
"""Share of the time limit after which Ipopt, stopped at its next iteration from the limit on, is left to itself.
Ipopt's own limit is not used: it counts by the clock of the day, which may jump or be set."""
GRACE_S = 0.5
"""How long an interrupted solve may take to end before it is left to itself."""
_TICK_S = 0.1

_one_at_a_time = threading.Lock()
_left: list[threading.Thread] = []


def busy() -> bool:
    """Whether a solve that was left to itself is still at work in this process."""
    _left[:] = [thread for thread in _left if thread.is_alive()]
    return bool(_left)


def run_bounded(work: Callable[[], object], evaluation: Evaluation, limit_s: float | None) -> bool:
    """Do `work` in a thread; False if it was left to itself because of the limit.

    The limit counts from when the work begins, not while an earlier solve is waited for.

    Raises
    ------
    What `work` raises, and KeyboardInterrupt.
    """
    failed: list[BaseException] = []

    def run() -> None:
        with _one_at_a_time:
            if limit_s is not None:
                evaluation.until = time.monotonic() + limit_s
            try:
                if evaluation.failure is None:  # interrupted while it waited
                    work()
            except BaseException as error:
                failed.append(error)

    thread = threading.Thread(target=contextvars.copy_context().run, args=(run,), daemon=True, name="symid solve")
    thread.start()
    try:
        while thread.is_alive():
            thread.join(_TICK_S)
            if limit_s is not None and time.monotonic() > evaluation.until + (LEAVE - 1) * limit_s:
                break
    except KeyboardInterrupt as interrupted:
        evaluation.failure = interrupted
        thread.join(GRACE_S)
        raise
    finally:
        if thread.is_alive():
            evaluation.failure = evaluation.failure or TimeoutError("left to itself")
            _left.append(thread)
    if failed:
        raise failed[0]
    return not thread.is_alive()
