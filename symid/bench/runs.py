"""One measurement in a process of its own, pinned to one core, or to as many as it has threads."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import asdict, replace
from importlib import import_module
from pathlib import Path

from symid.bench.task import Task
from symid.errors import SymidError
from symid.threads import ONE_THREAD

MARK = "measured: "
STOPPED = "stopped"


def run_fresh(
    call: str,
    task: Task,
    *arguments: str,
    cache: str | Path | None = None,
    threads: int = 1,
    limit_s: float | None = None,
) -> dict:
    """What ``symid.bench.<call>(task, *arguments)`` returns in a fresh process.

    Parameters
    ----------
    call : "module.function".
    cache : folder of compiled kernels instead of the user's.
    threads : of the linear solver, on as many cores.
    limit_s : wall time after which the process is stopped; its result is then this time as "total", and "status".

    Raises
    ------
    SymidError : the process ended without a result.
    """
    environment = os.environ | ONE_THREAD | {"OMP_NUM_THREADS": str(threads)}
    environment |= {"SYMID_CACHE_DIR": str(Path(cache).absolute())} if cache else {}
    task = replace(task, **{name: str(Path(getattr(task, name)).absolute()) for name in ("recording", "body")})
    command = [sys.executable, "-m", "symid.bench.runs", call, json.dumps(asdict(task)), *arguments]
    said = {"capture_output": True, "text": True, "errors": "replace"}
    try:
        with tempfile.TemporaryDirectory() as folder:  # a peer that is stopped leaves what it compiled
            ended = subprocess.run(command, cwd=folder, env=environment, timeout=limit_s, **said)
    except subprocess.TimeoutExpired:
        return {"total": limit_s, "status": STOPPED}
    results = [line for line in ended.stdout.splitlines() if line.startswith(MARK)]
    if ended.returncode or not results:
        last = [line for line in (ended.stderr or ended.stdout).splitlines() if line.strip()][-1:]
        raise SymidError(f"bench: {call}({', '.join(arguments)}) ended with code {ended.returncode}: {''.join(last)}")
    return json.loads(results[-1][len(MARK) :])


def main(call: str, task: str, *arguments: str) -> None:
    """Run one measurement here and print its result; the other end of `run_fresh`."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[-int(os.environ["OMP_NUM_THREADS"]) :])
    module, function = call.split(".")
    given = json.loads(task)
    given["window"] = tuple(given["window"])
    result = getattr(import_module(f"symid.bench.{module}"), function)(Task(**given), *arguments)
    print(MARK + json.dumps(result), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
