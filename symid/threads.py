"""One BLAS thread: the systems here are small and many, and waiting threads cost ten times the work."""

from __future__ import annotations

import mmap
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, lru_cache, wraps
from inspect import isgeneratorfunction
from pathlib import Path
from typing import TypeVar, cast

from threadpoolctl import ThreadpoolController

Function = TypeVar("Function", bound=Callable[..., object])
Item, Result = TypeVar("Item"), TypeVar("Result")
_threads: ContextVar[int] = ContextVar("threads", default=1)
BLAS_BYTES = 36 * 2**20
"""What a copy of OpenBLAS takes at its first use in a thread: 33 MB measured with those of NumPy 2.4 and SciPy 1.17."""
STACK_BYTES = 72 * 2**20
"""What a thread takes on Linux: 8 MB of stack and 64 MB of addresses for its heap."""


@contextmanager
def threads_of(count: int) -> Iterator[None]:
    """Within it `in_threads` works in so many threads."""
    token = _threads.set(count)
    try:
        yield
    finally:
        _threads.reset(token)


def in_threads(function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """`function` of each item, in their order, in the threads of `threads_of`; one that it is called in by itself."""
    if _threads.get() == 1:
        return [function(item) for item in items]

    def alone(item: Item) -> Result:
        with threads_of(1):
            return function(item)

    with ThreadPoolExecutor(_threads.get()) as pool:
        return list(pool.map(alone, items))


def one_blas_thread(function: Function) -> Function:
    """Decorator: the call keeps to one thread, whose memory for BLAS is there; so does each step of a generator."""

    @wraps(function)
    def call(*arguments, **options):
        hold_blas_memory(1)
        with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
            return function(*arguments, **options)

    @wraps(function)
    def steps(*arguments, **options):
        generator, end = function(*arguments, **options), object()
        step = one_blas_thread(lambda: next(generator, end))
        while (item := step()) is not end:
            yield item

    return cast("Function", steps if isgeneratorfunction(function) else call)


@lru_cache(maxsize=1)
def _libraries(modules: int) -> ThreadpoolController:
    """The libraries that compute in threads, looked for again when modules were imported: a search takes 10 ms."""
    return ThreadpoolController()


@cache
def hold_blas_memory(threads: int) -> None:
    """Where memory is limited, take now what BLAS takes at its first use in so many threads, once a process.

    Where memory is out, OpenBLAS asks again for ever and holds Python's lock meanwhile (its issue 5289): neither
    Ctrl-C nor a sign of life comes through. What it has taken it keeps. Without a limit nothing is refused, and
    SciPy's BLAS is not loaded for it: a fifth of a second at the first use of the process.

    Raises
    ------
    MemoryError
        If there is not that much.
    """
    if not memory_is_limited():
        return
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


def memory_is_limited() -> bool:
    """Whether this process can be refused memory: by a limit such as `ulimit -v`, or by a kernel that promises no more
    memory than there is (Linux: vm.overcommit_memory = 2)."""
    try:
        import resource
    except ImportError:  # Windows
        return True
    limits = (resource.RLIMIT_AS, resource.RLIMIT_DATA)
    if any(resource.getrlimit(limit)[0] != resource.RLIM_INFINITY for limit in limits):
        return True
    promises = Path("/proc/sys/vm/overcommit_memory")
    return promises.is_file() and promises.read_text().strip() == "2"


def room_for(size: int) -> bool:
    """Whether this process would get so many bytes more: a limit such as `ulimit -v` is not reached by them."""
    try:
        mmap.mmap(-1, size).close()
    except OSError:
        return False
    return True


ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of a process that keeps to one thread."""
