"""A sign of life: a line on stderr whenever nothing has been said for some seconds."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

SILENCE_S = 4.5
"""After this long without a line one is printed: at least one every five seconds."""

_last = time.monotonic()
_speakers: list[object] = []  # blocks inside each other: the innermost speaks


def said() -> None:
    """Note that something has just been printed."""
    global _last
    _last = time.monotonic()


_speakers: list[object] = []  # blocks inside each other: the innermost speaks


def say(line: str) -> None:
    """Print a line of progress on stderr."""
    print(line, file=sys.stderr, flush=True)
    said()


@contextmanager
def alive(what: Callable[[], str]) -> Iterator[None]:
    """While the block runs, say what() and for how long it has been running, where nobody says anything else."""
    ended, began = threading.Event(), time.monotonic()

    def watch() -> None:
        while not ended.wait(max(max(_last, began) + SILENCE_S - time.monotonic(), 0.1)):
            if _speakers[-1:] == [ended] and time.monotonic() - max(_last, began) >= SILENCE_S:
                say(f"{what()}, for {time.monotonic() - began:.0f} s now")

    watcher = threading.Thread(target=watch, daemon=True, name="symid sign of life")
    _speakers.append(ended)
    watcher.start()
    try:
        yield
    finally:
        ended.set()
        _speakers.remove(ended)
        watcher.join()
