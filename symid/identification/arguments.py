"""Arguments of a wrong type, refused in words before anything is built."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from symid import checked
from symid.errors import SolveError, TranscriptionError
from symid.ipopt_solver import refuse_unknown_options
from symid.model import Model
from symid.recording import Recording
from symid.transcription import SCHEMES, Episodes, Scheme

if TYPE_CHECKING:
    from symid.identification.problem import Identification


FINEST = 1000
"""Intervals in a sample interval: a recording says nothing of a mesh with more."""
OF_SOLVE_FROM = ("dual_limit", "kept", "near")
"""Options of `Identification.solve_from` that are none of the solver's."""


class Recordings:
    """A field that takes one recording or several and keeps them as a tuple."""

    def __get__(self, owner: object, kind: type | None = None) -> tuple[Recording, ...]:
        if owner is None:
            raise AttributeError("recordings: a field without a default")
        found: tuple[Recording, ...] = vars(owner)["recordings"]
        return found

    def __set__(self, owner: object, given: Recording | Sequence[Recording]) -> None:
        vars(owner)["recordings"] = as_recordings(given)


def as_recordings(recordings) -> tuple[Recording, ...]:
    """One recording or several as a tuple; TranscriptionError for what is none."""
    many = tuple(recordings) if isinstance(recordings, Sequence) and not isinstance(recordings, str) else (recordings,)
    for r in many:
        if not isinstance(r, Recording):
            raise TranscriptionError(f"a Recording is needed, not {checked.shown(r)}: {_way(r)}")
    if not many:
        raise TranscriptionError("no recording was given: an Identification needs at least one")
    return many


def _way(thing) -> str:
    if isinstance(thing, str) or hasattr(thing, "__fspath__"):
        return "read the file first, symid.read_recording(path)"
    if hasattr(thing, "columns"):
        return (
            "write the table to a CSV with units in its column names and read that, or give "
            "Recording(name, time, channels, units)"
        )
    return "make one with symid.read_recording(path) or Recording(name, time, channels, units)"


def refuse_wrong_types(problem: Identification) -> None:
    """TranscriptionError at the first argument that is not what it should be."""
    if not isinstance(problem.model, Model):
        raise TranscriptionError(f"an Identification begins with a Model, not {checked.shown(problem.model)}")
    refuse_scheme(problem.scheme)
    if not isinstance(problem.episodes, Episodes):
        raise TranscriptionError(
            f"episodes={checked.shown(problem.episodes)}: give Episodes(count, amplitude), as Episodes(3, 0.25)"
        )
    if isinstance(problem.per_recording, str) or not isinstance(problem.per_recording, Sequence):
        raise TranscriptionError(
            f"per_recording={checked.shown(problem.per_recording)}: give a list of names of parameters"
        )
    noise = problem.noise
    if noise is not None and (isinstance(noise, (str, Mapping)) or not isinstance(noise, Sequence)):
        raise TranscriptionError(f"noise={checked.shown(noise)}: give one dictionary for each recording, in a list")
    tables = [("weights", problem.weights), ("loss", problem.loss), *(("noise", table) for table in noise or ())]
    for name, table in tables:
        if table is not None and not isinstance(table, Mapping):
            raise TranscriptionError(f"{name}={checked.shown(table)}: give a dictionary of output name -> number")
        for of, value in (table or {}).items():
            checked.number(value, f"{name} of '{of}'", TranscriptionError)
    checked.kind(problem.tilt, Mapping, "tilt", TranscriptionError)
    for of, value in problem.tilt.items():
        checked.number(value, f"tilt of '{of}'", TranscriptionError)
    refine = "collocation intervals of a sample interval, refine"
    checked.whole(problem.refine, refine, TranscriptionError, least=1, most=FINEST)
    if not checked.number(problem.ridge, "ridge", TranscriptionError, least=0.0) < inf:
        raise TranscriptionError("ridge=inf: give a finite number of at least 0")
    for name in ("backend", "ridge_about"):
        checked.kind(getattr(problem, name), str, name, TranscriptionError)
    if problem.window is not None and not _is_window(problem.window):
        raise TranscriptionError(
            f"window={checked.shown(problem.window)}: give (t0, t1) [s], or one such pair for each recording"
        )


def refuse_wrong_options(options: Mapping[str, object]) -> None:
    """SolveError at the first option of a solve that is not what it should be."""
    refuse_unknown_options(options, *OF_SOLVE_FROM)
    if options.get("time_limit_s") is not None:
        checked.number(options["time_limit_s"], "time_limit_s", SolveError, least=0.0)
    if options.get("options") is not None:
        checked.kind(options["options"], Mapping, "options of Ipopt", SolveError)


def refuse_wrong_executor(executor: Any) -> None:
    """SolveError at what nothing can be sent to."""
    if executor is not None and not (hasattr(executor, "submit") or hasattr(executor, "get_executor")):
        raise SolveError(f"executor={checked.shown(executor)}: give an executor of concurrent.futures, or a Client")


def refuse_scheme(scheme) -> None:
    if not isinstance(scheme, Scheme):
        known = ", ".join(f"{make.__name__}()" for make in SCHEMES.values())
        raise TranscriptionError(f"scheme={checked.shown(scheme)}: give one of {known}")


def _is_window(window) -> bool:
    if not isinstance(window, Sequence) or isinstance(window, str) or not len(window):
        return False
    pairs = [window] if isinstance(window[0], (int, float)) else window
    return all(
        p is None or (isinstance(p, Sequence) and len(p) == 2 and all(isinstance(t, (int, float)) for t in p))
        for p in pairs
    )


def shared_samples(recordings: Sequence[Recording], windows: Sequence[tuple[float, float] | None]) -> Iterator[str]:
    """A sentence where the same samples are given twice: they would count as two measurements."""
    whole = [w or r.interval for r, w in zip(recordings, windows, strict=True)]
    for (i, a), (j, b) in combinations(enumerate(recordings), 2):
        start, end = max(whole[i][0], whole[j][0]), min(whole[i][1], whole[j][1])
        if start < end and same_samples(a, b):
            yield (
                f"{a.name}: recordings {i + 1} and {j + 1} are the same from {start:g} to {end:g} s; what was measured "
                "once counts twice, and standard errors are too small"
            )


def same_samples(a: Recording, b: Recording) -> bool:
    """Whether two recordings hold the same measurements."""
    return a is b or (
        np.array_equal(a.time, b.time)
        and a.channels.keys() == b.channels.keys()
        and all(np.array_equal(x, b.channels[name], equal_nan=True) for name, x in a.channels.items())
    )
