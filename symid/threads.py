"""One BLAS thread: the systems here are small and many, and waiting threads cost ten times the work."""

from collections.abc import Callable
from typing import TypeVar, cast

from threadpoolctl import threadpool_limits

Function = TypeVar("Function", bound=Callable[..., object])


def one_blas_thread(function: Function) -> Function:
    """Decorator: the call keeps to one thread."""
    return cast("Function", threadpool_limits.wrap(limits=1, user_api="blas")(function))


ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of a process that keeps to one thread."""
