"""One BLAS thread: the systems here are small and many, and waiting threads cost ten times the work."""

from __future__ import annotations

import mmap
import threading
from collections.abc import Callable
from functools import cache, wraps
from typing import TypeVar, cast

from threadpoolctl import threadpool_limits

Function = TypeVar("Function", bound=Callable[..., object])
BLAS_BYTES = 36 * 2**20
"""What a copy of OpenBLAS takes at its first use in a thread: 33 MB measured with those of NumPy 2.4 and SciPy 1.17."""
STACK_BYTES = 72 * 2**20
"""What a thread takes on Linux: 8 MB of stack and 64 MB of addresses for its heap."""


def one_blas_thread(function: Function) -> Function:
    """Decorator: the call keeps to one thread, whose memory for BLAS is there."""
    limited = threadpool_limits.wrap(limits=1, user_api="blas")(function)

    @wraps(function)
    def call(*arguments, **options):
        hold_blas_memory(1)
        return limited(*arguments, **options)

    return cast("Function", call)


@cache
def hold_blas_memory(threads: int) -> None:
    """Take now what BLAS takes at its first use in so many threads, once a process.

    Where memory is out, OpenBLAS asks again for ever and holds Python's lock meanwhile (its issue 5289): neither
    Ctrl-C nor a sign of life comes through. What it has taken it keeps.

    Raises
    ------
    MemoryError
        If there is not that much.
    """
    import numpy as np
    from scipy.linalg.blas import dgemm

    need = BLAS_BYTES * (threads + 1) + STACK_BYTES * threads  # SciPy's copy computes under Python's lock: one buffer
    if not room_for(need):
        raise MemoryError(f"linear algebra in {threads} thread{'s' * (threads > 1)} needs {need / 1e6:.0f} MB more")
    square, together = np.eye(200), threading.Barrier(threads)
    dgemm(1.0, square, square)

    def multiply() -> None:
        together.wait()
        for _ in range(5):  # a millisecond each: the threads meet
            square @ square

    others = [threading.Thread(target=multiply) for _ in range(threads - 1)]
    for other in others:
        other.start()
    multiply()
    for other in others:
        other.join()


def room_for(size: int) -> bool:
    """Whether this process would get so many bytes more: a limit such as `ulimit -v` is not reached by them."""
    try:
        mmap.mmap(-1, size).close()
    except OSError:
        return False
    return True


ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of a process that keeps to one thread."""
