"""A solution's model on another window, or another recording, with all parameters kept."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from symid import checked
from symid.errors import RecordingWarning, SolveError
from symid.identification.arguments import same_samples
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
    if any(
        _overlap(window, w or r.interval) and same_samples(run, r) for r, w in zip(p.recordings, p.windows, strict=True)
    ):
        warnings.warn(
            f"fit_on: {window[0]:g} to {window[1]:g} s holds samples that were fitted: its errors are none of held-out "
            "data",
            RecordingWarning,
            stacklevel=3,
        )
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


def _overlap(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether two windows share more than the sample at which one ends and the other begins."""
    return max(one[0], other[0]) < min(one[1], other[1])
