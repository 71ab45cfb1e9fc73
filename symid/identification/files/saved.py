"""A solution on disk: JSON and NumPy arrays with a format version and checksums, never a pickle.

What is kept is the result; the problem is declared again by the script that reads it, and a result of
any other problem is refused, by name of what differs.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from symid import checked
from symid.errors import SolveError
from symid.files import content_of, write_json
from symid.identification.identity import digest, problem_identity
from symid.identification.likelihood.process_size import unsized, with_sizes
from symid.identification.solution import Solution, build_solution
from symid.identification.studies.store import StudyDirectory
from symid.identification.studies.worker import Outcome

if TYPE_CHECKING:
    from symid.identification.problem import Identification

KEY, SUMMARY = "solution", "summary.json"


def _directory(path: str | Path, problem: Identification) -> StudyDirectory:
    identity = problem_identity(problem)
    return StudyDirectory(path, {KEY: identity | {"key": digest(identity)}})


def save(solution: Solution, path: str | Path) -> None:
    """Write the best start's result to the directory `path`, and ``summary.json`` for people."""
    _directory(path, solution.problem)[KEY] = Outcome(solution.starts[solution.best], solution.result)
    sizes = {name: p.size for name, p in solution.model.processes.items()}
    found = {"noise": solution.problem.noise, "process_sizes": sizes, "tilt": solution.problem.tilt}
    write_json(Path(path) / SUMMARY, solution.to_dict() | found)


def load(path: str | Path, problem: Identification) -> Solution:
    """The solution of `problem` that `save` wrote to `path`.

    Raises
    ------
    SolveError
        The directory is damaged, of another format or of another problem.
    """
    path = checked.path(path, "load", SolveError)
    try:
        summary = json.loads(content_of(Path(path) / SUMMARY))
        noise, sizes = summary["noise"], {n: summary["process_sizes"][n] for n in unsized(problem.model)}
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as absent:
        raise SolveError(
            f"{path} holds no saved solution ({absent}): give the directory that Solution.save wrote"
        ) from None
    # What the solve estimated belongs to its problem.
    model = with_sizes(problem.model, sizes) if sizes else problem.model
    tilt = summary.get("tilt", {}) or problem.tilt
    problem = replace(problem, model=model, noise=noise if sizes else problem.noise or noise, tilt=tilt)
    outcome = _directory(path, problem)[KEY]
    if outcome.result is None:
        raise SolveError(
            f"{path} holds a solve without a result ({outcome.row.message[:200]}): solve the problem again"
        )
    return build_solution(problem, outcome.result, (outcome.row,), 0)
