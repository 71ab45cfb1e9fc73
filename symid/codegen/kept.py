"""The C of a model's simulation, kept on disk by the fingerprint of its equations: deriving it takes long."""

from __future__ import annotations

import functools
import hashlib
import json
from dataclasses import fields
from pathlib import Path

import sympy as sm

from symid.codegen.cache import find_text, keep_text
from symid.codegen.ode import OdeSource, ode_source
from symid.model import Model

_DERIVED = ("functions", "entries", "written")
"""Fields that only the making of the text needs."""


def kept_source(model: Model) -> OdeSource:
    """`ode_source`, from an earlier process where one made it; its `functions` are then empty.

    Raises
    ------
    CodegenError : the residuals of the model are not linear in the rates.
    """
    key = _key(model)
    found = find_text(key)
    if found is not None:
        return _restored(json.loads(found))
    source = ode_source(model)
    kept = {f.name: getattr(source, f.name) for f in fields(source) if f.name not in _DERIVED} | {"text": source.text}
    keep_text(key, json.dumps(kept | {"late": [str(s) for s in source.late]}))
    return source


def _restored(kept: dict) -> OdeSource:
    text = kept.pop("text")
    named = {
        k: tuple(v) if k in ("states", "inputs", "noises", "parameters", "constants", "outputs", "late") else v
        for k, v in kept.items()
    }
    source = OdeSource(**named, **{k: {} for k in _DERIVED})
    source.__dict__["text"] = text  # where the cached property keeps it
    return source


def _key(model: Model) -> str:
    return hashlib.sha256(
        f"{_maker()} {model.fingerprint} {list(model.parameters)} {list(model.constants)}".encode()
    ).hexdigest()[:32]


@functools.cache
def _maker() -> str:
    """Changes with whatever writes the text."""
    here = Path(__file__).parent
    written = b"".join((here / name).read_bytes() for name in ("ode.py", "straight_line/cprint.py", "ode.h", "kept.py"))
    return hashlib.sha256(written + sm.__version__.encode()).hexdigest()
