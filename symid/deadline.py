"""A time limit for everything that is done inside a block, however deep: simulations and solves look at it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from symid.errors import SolveError

START_LIMIT_S, LIMIT_NODES = 600.0, 60_000
"""Of one start of a solve, making it included, where nothing else is said [s]: solves that get anywhere take seconds,
the longest of the article's a few minutes. And nodes beyond which the limit grows with them, as the time does: an hour
at 100 Hz takes two minutes of a processor, and took ten on one that others shared."""
_until: ContextVar[float | None] = ContextVar("until", default=None)


class TimeUp(SolveError):
    """The time of a block ran out before it had a result."""


def start_limit(nodes: int) -> float:
    """Time limit [s] of one start of a problem of so many nodes, where nothing else is said."""
    return START_LIMIT_S * max(1.0, nodes / LIMIT_NODES)


@contextmanager
def deadline(limit_s: float | None) -> Iterator[None]:
    """In the block, `check` raises TimeUp after `limit_s` seconds; an outer limit that ends earlier stays."""
    until = [t for t in (_until.get(), None if limit_s is None else time.monotonic() + limit_s) if t is not None]
    token = _until.set(min(until, default=None))
    try:
        yield
    finally:
        _until.reset(token)


def remaining() -> float | None:
    """Seconds left [s], below zero where they have run out; None without a limit."""
    until = _until.get()
    return None if until is None else until - time.monotonic()


def check() -> None:
    """TimeUp where the time has run out."""
    left = remaining()
    if left is not None and left <= 0:
        raise TimeUp("the time ran out; allow more of it (time_limit_s), or try another start")
