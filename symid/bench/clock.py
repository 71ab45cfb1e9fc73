"""Processor time, children included: a compiler that a package calls is part of its cost."""

from __future__ import annotations

import resource
import statistics
import time
from collections.abc import Callable


def processor_seconds() -> float:
    """Seconds of processor time of this process and of the processes it waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in used)


def median_ms(call: Callable[[], object], times: int = 51) -> float:
    """Median processor time of `call` [ms]."""
    spent = []
    for _ in range(times):
        began = time.process_time()
        call()
        spent.append(time.process_time() - began)
    return 1e3 * statistics.median(spent)


def peak_memory_mb() -> float:
    """The most memory that this process has held so far [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6
