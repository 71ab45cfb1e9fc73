"""Every public name says what it is, with an example, and the examples are true."""

import doctest
import inspect
import re
import types
from importlib import import_module

import numpy as np
import pytest
import sympy as sm
from conftest import ROOT, pendulum, pendulum_recording

import symid as si
import symid.conceal
from symid import plots

DATA_FOLDER = ROOT / "data"
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL
PUBLIC = {name: getattr(si, name) for name in si.__all__ if name != "mechanics"}
PUBLIC |= {f"mechanics.{name}": getattr(si.mechanics, name) for name in si.mechanics.__all__}
for room, names in {
    "recording": (
        "differentiate",
        "fill_gaps",
        "join",
        "joint_angles",
        "lowpass",
        "resample",
        "smooth_states",
        "unwrap",
    ),
    "recording.table.columns": ("load_columns",),
    "report": ("write_diagnosis_report", "write_report", "write_study_report"),
    "plots": tuple(name for name in plots.__all__ if name != "Picture"),  # matplotlib gives it methods of its own
    "conceal": symid.conceal.__all__,
    "cases": ("Case",),
    "discrepancy": ("Effect", "read_answer"),
    "discrepancy.prove.held_out": ("Proof",),
    "fetch": ("standing", "standing_raw"),
    "simulation": ("Simulator", "Trajectory", "synthetic_recording"),
}.items():
    PUBLIC |= {name: getattr(import_module(f"symid.{room}"), name) for name in names}
"""What the pages refer to, beside the exported names."""
DATA = ("mechanics.CANONICAL", "mechanics.LIBRARY")
"""Tables, described where they are defined."""


def methods(kind: type) -> dict[str, str | None]:
    """Public methods and properties that a class defines itself -> docstring."""
    found = {}
    for name, thing in vars(kind).items():
        inner = getattr(thing, "fget", None) or getattr(thing, "func", None) or getattr(thing, "__func__", thing)
        if not name.startswith("_") and inspect.isfunction(inner):
            found[name] = thing.__doc__ if isinstance(thing, property) else inspect.getdoc(getattr(kind, name))
    return found


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in DATA])
def test_a_public_name_has_a_docstring_with_an_example(name):
    thing = PUBLIC[name]
    assert thing.__doc__ and ">>>" in thing.__doc__ or "::" in thing.__doc__, name
    assert ">>>" not in thing.__doc__.partition("Examples\n")[0], f"{name}: pages set examples as code below Examples"
    if inspect.isclass(thing):
        silent = [n for n, text in methods(thing).items() if not text]
        assert not silent, f"{name} has methods that say nothing: {silent}"


def called(name: str) -> list[tuple[str, types.FunctionType, str]]:
    """Name, function and words of what can be called by a public name: itself, or its public methods."""
    thing = PUBLIC[name]
    if inspect.isfunction(thing):
        return [(name, thing, "")]
    found = [(k, getattr(v, "__func__", v)) for k, v in vars(thing).items()] if inspect.isclass(thing) else []
    own = [(k, v) for k, v in found if inspect.isfunction(v) and not k.startswith("_")]
    return [(k, v, f"{thing.__doc__}\n{inspect.getdoc(getattr(thing, k)) or ''}") for k, v in own]


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in DATA])
def test_whatever_is_given_and_raised_is_typed_and_told(name):
    for method, function, words in called(name):
        words += inspect.getdoc(function) or ""
        given = {k: p for k, p in inspect.signature(function).parameters.items() if k not in ("self", "cls")}
        assert not [k for k, p in given.items() if p.annotation is p.empty], method
        assert inspect.signature(function).return_annotation is not inspect.Signature.empty, method
        untold = [k for k, p in given.items() if p.kind is not p.POSITIONAL_ONLY and not re.search(rf"\b{k}\b", words)]
        if (function.__module__ or "").startswith("symid"):
            assert not untold, f"{name}.{method}"
            assert "Raises" in words or not re.search(r"\braise \w+\(", inspect.getsource(function)), f"{name}.{method}"


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in DATA and inspect.isclass(PUBLIC[n])])
def test_what_a_constructor_or_a_property_raises_is_told(name):
    thing, raises = PUBLIC[name], r"\braise \w+\(|\bchecked\.(?!shown)"
    for k, v in vars(thing).items():
        function = getattr(v, "fget", v)
        if k in ("__init__", "__post_init__") or isinstance(v, property):
            written = "symid" in function.__code__.co_filename  # not by dataclass
            told = f"{thing.__doc__} {v.__doc__ if isinstance(v, property) else ''}"
            assert not (written and re.search(raises, inspect.getsource(function))) or "Error" in told, f"{name}.{k}"


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in DATA and inspect.isclass(PUBLIC[n])])
def test_what_an_object_is_made_of_and_holds_is_told(name):
    own = [c for c in PUBLIC[name].__mro__ if c.__module__.startswith("symid")]
    words = " ".join(c.__doc__ or "" for c in own)
    makers = [vars(c)["__init__"] for c in own if inspect.isfunction(vars(c).get("__init__"))]
    taken = [p for made in makers for p in inspect.signature(made).parameters.values() if p.name != "self"]
    given = {p.name for p in taken if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)}
    held = {k for c in own for k in vars(c).get("__annotations__", {}) if not k.startswith("_")}
    described = {k for c in own for k in re.findall(r'^ {4}(\w+)\b.*\n {4}"""', inspect.getsource(c), re.M)}
    assert not [k for k in (given | held) - described if not re.search(rf"\b{k}\b", words)], name


@pytest.fixture(scope="module")
def prepared():
    """What the examples take for granted: a model, a recording, and `m`, which has a few parts already."""
    recording, model = pendulum_recording(noise=0.01), pendulum()
    recording = recording.with_channel("velocity", recording["rate"], "rad/s")
    names = {n: getattr(si.mechanics, n) for n in si.mechanics.__all__} | {n: getattr(si, n) for n in si.__all__}
    solution = si.Identification(model, recording).solve()
    around = {"model": model, "recording": recording, "solution": solution}
    return names | around | {"si": si, "np": np, "sm": sm, "sympy": sm}


def a_model() -> si.Model:
    m = si.Model("example")
    for name in ("x", "y", "speed", "angle", "left", "right", "clock"):
        setattr(m, name, si.State(unit="m"))
    for name in ("c", "p1", "p2"):
        setattr(m, name, si.Parameter(unit="1", bounds=(0, 1)))
    return m


def plannable() -> si.Model:
    m = si.Model("cart")
    m.x, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2")
    m.motion = si.Equation({0: m.x.dot - m.v, 1: m.v.dot - m.force})
    m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    m.effort = si.Objective(running=m.force**2)
    return m


def first_order() -> si.Model:
    m = si.Model("first order")
    m.x, m.u = si.State(unit="1"), si.Control(unit="1", bounds=(-1, 1))
    m.gain = si.Parameter(unit="1/s", bounds=(0.1, 10))
    m.motion = si.Equation(m.x.dot + m.gain * (m.x - m.u))
    m.begin = si.Boundary(initial={m.x: 0})
    m.seen = si.Output(m.x)
    return m


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in DATA])
def test_its_examples_are_true(name, prepared, monkeypatch, tmp_path):
    (tmp_path / "data").symlink_to(DATA_FOLDER)
    monkeypatch.chdir(tmp_path)  # files that an example writes land there
    around = prepared | {"problem": si.Identification(prepared["model"], prepared["recording"]), "m": a_model()}
    if name in ("Free", "Optimization"):
        around["model"] = plannable()
    if name == "design":
        around["plant"] = first_order()
    if name == "Objective":
        around["m"].force = si.Control(unit="N")
    if name.startswith("mechanics."):
        around |= {n: getattr(si.mechanics, n) for n in si.mechanics.__all__}
    around |= {} if "." in name else {n: PUBLIC[n] for n in (name, *symid.conceal.__all__) if n in PUBLIC}
    tests = [t for t in doctest.DocTestFinder(recurse=False).find(PUBLIC[name], name, globs=around) if t.examples]
    runner, told = doctest.DocTestRunner(optionflags=FLAGS), []
    for test in tests:
        runner.run(test, out=told.append)
    assert runner.failures == 0, "".join(told)
