"""One BLAS thread: the systems here are small and many, and waiting threads cost ten times the work."""

from threadpoolctl import threadpool_limits

one_blas_thread = threadpool_limits.wrap(limits=1, user_api="blas")
