"""Ctrl-C, held back where it would leave the process broken."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def held_back() -> Iterator[None]:
    """In the block Ctrl-C waits for its end, for a second at most: around the import of a large package.

    One that is broken off half-way leaves modules behind that make every later import of it fail.
    """
    if threading.current_thread() is not threading.main_thread():  # Ctrl-C reaches the main thread alone
        yield
        return
    pressed: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if pressed:
            signal.raise_signal(signal.SIGINT)
