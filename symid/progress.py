"""A sign of life: a line on stderr whenever nothing has been said for some seconds."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import wraps
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., object])
SILENCE_S = 4.5
"""After this long without a line one is printed: at least one every five seconds."""

QUIET, NORMAL, VERBOSE = 0, 1, 2
_level = NORMAL
_last = time.monotonic()
_speakers: list[object] = []  # blocks inside each other: the innermost speaks
_bars: list = []  # at most one, on a terminal


def set_level(level: int) -> None:
    """QUIET: no progress. VERBOSE: every iteration, and where an error comes from."""
    global _level
    _level = level


def level() -> int:
    return _level


def said() -> None:
    """Note that something has just been printed."""
    global _last
    _last = time.monotonic()


def say(line: str) -> None:
    """Print a line of progress on stderr, above a bar if there is one."""
    if _level == QUIET:
        return
    if _bars:
        with suppress(OSError):
            _bars[0].write(line, file=sys.stderr)
    else:
        put(line)
    said()


def put(line: str, end: str = "\n") -> None:
    """Print on stderr. Where nobody reads it any more (`2>&1 | head`), or its disk is full, the work goes on."""
    with suppress(OSError):
        print(line, end=end, file=sys.stderr, flush=True)


def step(done: int, total: int, line: str) -> None:
    """One of `total` things is done: a line, and on a terminal a bar below all lines."""
    if not _bars and done < total and _level != QUIET and sys.stderr.isatty():
        from tqdm import tqdm

        _bars.append(
            tqdm(total=total, file=sys.stderr, leave=False, bar_format="{l_bar}{bar}| {n}/{total}, {remaining} left")
        )
    say(line)
    if _bars:
        _bars[0].update(done - _bars[0].n)
        if done == total:
            _bars.pop().close()


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


def kept_alive(first: str) -> Callable[[Function], Function]:
    """For a function that tells what it does through its argument `progress`: its last line is said by `alive`.

    Parameters
    ----------
    first : what it does until it tells something.
    """

    def around(function: Function) -> Function:
        @wraps(function)
        def called(*arguments: Any, progress: Callable[[str], None] = lambda line: None, **options: Any) -> Any:
            lately = [first]

            def told(line: str) -> None:
                lately.append(line)
                progress(line)

            with alive(lambda: lately[-1]):
                return function(*arguments, progress=told, **options)

        return cast("Function", called)

    return around
