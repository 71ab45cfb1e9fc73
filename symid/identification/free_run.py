"""A solution's model on another window, or another recording, with all parameters kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symid import checked
from symid.errors import SolveError
from symid.identification.problem import Identification
from symid.recording import Recording

if TYPE_CHECKING:
    from symid.identification.solution import Solution


def free_run(solution: Solution, window: tuple[float, float], recording: Recording | None = None) -> Solution:
    """See `Solution.free_run`."""
    if isinstance(window, Recording):
        raise SolveError("fit_on: give a window first, and then a recording: fit_on((0, 10), other)")
    window = checked.window(window, "fit_on: window", SolveError)
    checked.kind(recording, (Recording, type(None)), "fit_on: recording", SolveError)
    known = {name: value for name, value in solution.values.items() if "[" not in name}
    if len(known) < len(solution.values):
        raise SolveError("fit_on: parameters differ between recordings; fix those you mean with model.fixed()")
    p, run = solution.problem, solution.problem.recordings[0] if recording is None else recording
    fitted = solution.transcription.measured[0].first == 0
    bound = fitted and window[0] <= run.time[0]
    other = Identification(
        solution.model.fixed(**known).undisturbed(bound),
        run,
        window,
        scheme=p.scheme,
        weights=p.weights,
        noise=p.noise and p.noise[:1],
        backend=p.backend,
    )
    found = other.solve(check=False)
    if not found.solved:
        raise SolveError(f"fit_on: the free run over {window[0]:g} to {window[1]:g} s was not found: {found.message}")
    return found
