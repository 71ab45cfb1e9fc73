"""Where solves run: a pool of local processes that outlives its workers, or a dask cluster."""

from __future__ import annotations

import os
import signal
import threading
import warnings
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from multiprocessing import connection, current_process, get_context, parent_process
from typing import Any

from symid import checked
from symid.codegen.build import warn_without_compiler
from symid.codegen.cache import CodegenWarning
from symid.errors import SolveError
from symid.ipopt_solver.bounded import busy
from symid.threads import ONE_THREAD

_NAME = "symid worker"
_GUARD = "in a script, a study must run under `if __name__ == '__main__':`, because every worker reads the script"
_SPAWN = get_context("spawn")
_ENVIRONMENT = threading.Lock()


class WorkerDied(BrokenExecutor):
    """A worker process ended in the middle of a call."""


class LocalPool(Executor):
    """Local processes of one thread each, spawned; a worker that dies is replaced.

    Unlike `concurrent.futures.ProcessPoolExecutor`, whose futures all break with one worker, only
    the call that the worker was at ends with `WorkerDied`, and the pool stays usable. Workers end
    with this process, however it ends.

    Parameters
    ----------
    jobs : number of processes, one for each processor by default.

    Raises
    ------
    SolveError
        `jobs` is no whole number from 1 on. Futures raise it where worker processes cannot start.

    Examples
    --------
    >>> with si.LocalPool(2) as pool:                               # doctest: +SKIP
    ...     solution = problem.solve(starts=20, executor=pool)
    """

    def __init__(self, jobs: int | None = None):
        if current_process().name == _NAME:  # a worker reads a script that begins a study
            raise SolveError(f"a worker process cannot start workers; {_GUARD}")
        self.jobs = (os.cpu_count() or 1) if jobs is None else checked.whole(jobs, "jobs", SolveError, least=1)
        warn_without_compiler()
        self._keepers = ThreadPoolExecutor(self.jobs, thread_name_prefix="symid-keeper")
        self._own = threading.local()
        self._workers: set[_Worker] = set()
        self._closed = False

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Future[Any]:  # type: ignore[override]
        """Call `function(*arguments)`, all of which must pickle, in the next idle worker."""
        return self._keepers.submit(self._call, function, arguments)

    def _call(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """In a keeper thread, which has one worker of its own."""
        worker = getattr(self._own, "worker", None)
        if worker is None:
            worker = self._own.worker = _Worker()
            self._workers.add(worker)
        if self._closed:
            worker.process.kill()
        try:
            return worker.call(function, arguments)
        finally:
            if worker.gone:
                self._workers.discard(worker)
                self._own.worker = None

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """As for every executor; `cancel_futures` also ends the calls that are running.

        Parameters
        ----------
        wait : until the calls have ended.
        """
        self._keepers.shutdown(wait=wait and not cancel_futures, cancel_futures=cancel_futures)
        if cancel_futures:
            self._closed = True
            for worker in tuple(self._workers):
                worker.process.kill()
            self._keepers.shutdown(wait=wait)
        if wait:
            for worker in tuple(self._workers):
                worker.end()

    def __exit__(self, error: type[BaseException] | None, *_: object) -> None:
        self.shutdown(cancel_futures=error is not None)


class _Worker:
    """One process that answers calls over a pipe."""

    def __init__(self) -> None:
        self.gone = False
        self.pipe, theirs = _SPAWN.Pipe()
        self.process = _SPAWN.Process(target=_serve, args=(theirs,), daemon=True, name=_NAME)
        with _ENVIRONMENT:  # the libraries read it while the child loads them
            before = {name: os.environ.get(name) for name in ONE_THREAD}
            os.environ.update(ONE_THREAD)
            try:
                self.process.start()
            finally:
                for name, value in before.items():
                    os.environ.pop(name) if value is None else os.environ.update({name: value})
        theirs.close()
        try:
            self.pipe.recv()
        except (EOFError, OSError):
            self.process.join()
            if self._code() < 0:
                raise WorkerDied(self._end()) from None
            raise SolveError(f"worker processes cannot start (what they said stands above); {_GUARD}") from None

    def call(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        try:
            self.pipe.send((function, arguments))
            answer, error, self.gone = self.pipe.recv()
        except (EOFError, ConnectionError):
            self.gone = True
            self.process.join()
            raise WorkerDied(self._end()) from None
        if self.gone:
            self.end()
        if error is not None:
            raise error
        return answer

    def _code(self) -> int:
        return self.process.exitcode or 0

    def _end(self) -> str:
        code = self._code()
        return f"was killed by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"

    def end(self) -> None:
        self.pipe.close()  # which _serve sees
        self.process.join()


def _serve(pipe: connection.Connection) -> None:
    """A worker's life: answer calls until the pipe or the parent is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the parent, which ends its workers
    warnings.simplefilter("ignore", CodegenWarning)  # the parent has said it
    threading.Thread(target=_end_with_parent, daemon=True).start()
    pipe.send("ready")
    while True:
        try:
            function, arguments = pipe.recv()
        except EOFError:
            return
        try:
            reply, error = function(*arguments), None
        except Exception as raised:
            reply, error = None, raised
        leaving = busy()  # with a factorisation that went on beyond its time
        try:
            pipe.send((reply, error, leaving))
        except (TypeError, AttributeError, ValueError) as error:  # what pickle raises
            pipe.send((None, SolveError(f"a result cannot be sent between processes: {error}"), leaving))
        if leaving:
            os._exit(0)


def _end_with_parent() -> None:
    """A parent that was killed cannot tell; without this its workers would go on, or wait, for ever."""
    parent = parent_process()
    connection.wait([] if parent is None else [parent.sentinel])
    os._exit(1)


class Cluster(Executor):
    """A dask.distributed cluster as an executor that sends what solves share only once.

    Parameters
    ----------
    client : address of a scheduler ("tcp://host:8786"), or a `distributed.Client`.
    timeout_s : how long to wait for the scheduler's answer [s].

    Raises
    ------
    SolveError
        dask.distributed is absent, or no scheduler answers there.

    Examples
    --------
    >>> with si.Cluster("tcp://HOST:8786") as pool:                 # doctest: +SKIP
    ...     solution = problem.solve(starts=20, executor=pool)
    """

    def __init__(self, client: Any, timeout_s: float = 10.0):
        self._own_client = None
        if isinstance(client, str):
            client = self._own_client = _connected(client, timeout_s)
        if not hasattr(client, "get_executor"):
            raise SolveError(f"cluster: give the address of a scheduler or a Client of it, not {checked.shown(client)}")
        self._client, self._executor = client, client.get_executor(pure=False)

    def submit(self, function: Callable[..., Any], /, *arguments: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = self._executor.submit(function, *arguments)
        return future

    def share(self, value: bytes) -> Any:
        """Something that stands for `value` among the arguments of `submit`.

        A task's result rather than scattered data: dask makes it again where a worker that kept it died.
        """
        return self._client.submit(_same, value)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the calls (waiting for them, or cancelling), and the connection if this object made it.

        Parameters
        ----------
        wait : until the calls have ended. cancel_futures : those that have not begun are dropped.
        """
        self._executor.shutdown(wait=wait and not cancel_futures)
        if self._own_client is not None:
            self._own_client.close()

    def __exit__(self, error: type[BaseException] | None, *_: object) -> None:
        self.shutdown(cancel_futures=error is not None)


def _same(value: bytes) -> bytes:
    return value


def _connected(address: str, timeout_s: float) -> Any:
    try:
        from distributed import Client
    except ImportError as absent:
        raise SolveError(f"a cluster needs dask.distributed ({absent}): pip install symid[dask]") from None
    try:
        return Client(address, timeout=timeout_s, set_as_default=False)  # type: ignore[no-untyped-call,unused-ignore]
    except (OSError, ValueError) as problem:
        raise SolveError(
            f"no dask scheduler answers at {address} within {timeout_s:g} s ({problem}); start one with "
            "`dask scheduler`, and workers with `dask worker ADDRESS`"
        ) from None
