"""What determines the numbers that a solve will give, as short fingerprints by part."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np

from symid.model import Model, Noise
from symid.recording import Recording

if TYPE_CHECKING:
    from symid.identification.problem import Identification

VERSION = "version of symid"
"""The part of an identity that says who made a result; it alone makes no other problem."""


def digest(*things) -> str:
    """16 hexadecimal digits that change with any value in `things`, and are the same in every process."""
    total = hashlib.sha256()
    for thing in things:
        _feed(total, thing)
    return total.hexdigest()[:16]


def _feed(total, thing) -> None:
    """Add one value and what it contains, each behind its kind and size, so that no two read alike."""
    if isinstance(thing, np.generic):
        thing = thing.item()
    if isinstance(thing, np.ndarray):
        total.update(f"array {thing.dtype} {thing.shape} ".encode())
        total.update(np.ascontiguousarray(thing).tobytes())
    elif isinstance(thing, Mapping):
        _feed(total, sorted(thing.items()))
    elif isinstance(thing, (tuple, list)):
        total.update(f"sequence {len(thing)} ".encode())
        for part in thing:
            _feed(total, part)
    elif is_dataclass(thing):
        _feed(total, (type(thing).__name__, {f.name: getattr(thing, f.name) for f in fields(thing)}))
    else:
        text = repr(thing).encode()
        total.update(f"{type(thing).__name__} {len(text)} ".encode() + text)


def problem_identity(problem: Identification) -> dict[str, str]:
    """Part of the problem in words -> fingerprint of it.

    Two problems with the same parts have the same solutions from the same start; names of
    recordings and models, and what was done to a recording before, do not matter.
    """
    return {
        "equations": problem.model.fingerprint,
        "constants, bounds or channels": digest(_declared(problem.model)),
        "recordings": digest([_samples(r) for r in problem.recordings]),
        "window": digest(problem.windows),
        "scheme": digest(problem.scheme),
        "episodes": digest(problem.episodes),
        "weights": digest(problem.weights if not problem.loss else (problem.weights, problem.loss)),
        "noise": digest(problem.noise),
        "per_recording": digest(tuple(problem.per_recording)),
        "ridge": digest(problem.ridge if problem.ridge_about == "zero" else (problem.ridge, problem.ridge_about)),
        **({"tilt": digest(problem.tilt)} if problem.tilt else {}),  # as in no earlier version
        "backend": problem.backend,
        "refine": str(problem.refine),
        VERSION: version("symid"),
    }


def _declared(model: Model) -> list[tuple]:
    """Numbers, units and channels of all parts; the expressions are in the model's own fingerprint.

    What a Noise does between samples makes no other problem: an episode draws it for each step of the mesh.
    """
    said, seldom = ("value", "bounds", "guess", "unit", "channel", "hold"), ("size", "smooth", "prior")
    return [
        (
            name,
            {k: getattr(part, k) for k in said if hasattr(part, k) and not (k == "hold" and isinstance(part, Noise))}
            | _given(part, seldom),
        )
        for name, part in model.components.items()
    ]


def _given(part: object, names: tuple[str, ...]) -> dict[str, object]:
    """What few parts have; nothing of the others, so that results of earlier versions stay theirs."""
    return {k: v for k in names if (v := getattr(part, k, None))}


def _samples(recording: Recording) -> tuple:
    return (recording.time, dict(recording.channels), dict(recording.units), recording.segment)
