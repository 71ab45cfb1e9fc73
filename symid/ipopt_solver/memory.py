"""What glibc does with freed memory; elsewhere nothing is done."""

import ctypes
import functools
import mmap

import numpy as np


@functools.cache
def _glibc(function: str):
    try:
        return getattr(ctypes.CDLL(None), function)
    except (OSError, AttributeError, TypeError):  # no glibc: macOS, musl, Windows
        return None


def keep_freed_memory(largest: int) -> None:
    """Blocks of up to `largest` bytes are kept when they are freed; larger ones go back to the system.

    What is kept need not be mapped and cleared anew at each iteration, but is not there for blocks of other sizes.
    """
    m_trim_threshold, m_mmap_threshold, most_of_older = -1, -3, 2**25  # malloc.h; older glibc accepts no more
    mallopt = _glibc("mallopt")
    if mallopt is None:
        return
    if not mallopt(m_mmap_threshold, largest):
        mallopt(m_mmap_threshold, most_of_older)
    mallopt(m_trim_threshold, largest)


def unwritten_zeros(size: int) -> np.ndarray:
    """Zeros that take no memory until they are written: of a result, which Ipopt writes at its end."""
    private = {"flags": mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS} if hasattr(mmap, "MAP_ANONYMOUS") else {}
    return np.frombuffer(mmap.mmap(-1, max(8 * size, 1), **private), count=size)


def give_back_freed_memory() -> None:
    """Freed blocks that were kept, and what lies free between those in use, go back to the system."""
    trim = _glibc("malloc_trim")
    if trim is not None:
        trim(0)
