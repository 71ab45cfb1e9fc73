"""Small problems that make a study, also as a program of its own: `python study_problems.py STORE JOBS|ADDRESS`."""

import signal
import sys
import time
from pathlib import Path

from conftest import pendulum, pendulum_recording

from symid.identification import Cluster, Identification, LocalPool, Solve, Study

STARTS = 8
PAUSE = 0.05
"""After each solve of the program [s]: it is still at work where a busy machine is late to kill it."""


def problem(damping: float = 0.4, **changes) -> Identification:
    return Identification(pendulum(), pendulum_recording(damping, noise=0.01), **changes)


def study(store=None, starts: int = STARTS, **changes) -> Study:
    """Two problems from `starts` random starts each."""
    return Study.product(
        {("light", 1): problem(0.2, **changes), ("heavy", 1): problem(0.8, **changes)},
        starts,
        seed=3,
        labels=("damping", "episodes"),
        store=store,
    )


class Poison:
    """Kills the process that unpickles it, as a lack of memory would."""

    def __reduce__(self):
        return signal.raise_signal, (signal.SIGKILL,)

    def __repr__(self):
        return "Poison()"


def poisoned() -> Solve:
    return Solve(problem(), options={"options": {"print_level": Poison()}})


def numbers(result) -> dict[str, tuple]:
    """Everything of a result but the time it took: equal to the last bit, or not equal."""
    found = {}
    for name, row in result.rows.items():
        z = result._store[result.solves[name].key].result.z
        found[name] = (row.status, row.objective, row.rms, row.iterations, row.parameters, z.tobytes())
    return found


def kept(store: Path) -> dict[str, int]:
    """Finished solves in a store, and when they were written."""
    return {f.stem: f.stat().st_mtime_ns for f in store.glob("*.json") if f.name != "study.json"}


def numbers_of(undisturbed, starts):
    return {name: n for name, n in undisturbed.items() if int(name.rsplit("/", 1)[1]) < starts}


if __name__ == "__main__":
    place = sys.argv[2]
    with LocalPool(int(place)) if place.isdigit() else Cluster(place) as executor:
        study(sys.argv[1]).run(executor, on_finished=lambda _: time.sleep(PAUSE))
