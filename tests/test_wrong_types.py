"""Every argument of a wrong type is refused by an exception of symid that says what to do instead."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError, SymidError, TranscriptionError

RECORDING = pendulum_recording(duration=1)


@pytest.mark.parametrize(
    ("recording", "words"),
    [
        ("data.csv", "read_recording"),
        (Path("data.csv"), "read_recording"),
        (pd.DataFrame({"time_s": [0, 1]}), "write the table"),
        (None, "a Recording is needed, not None"),
        ([], "no recording"),
        ([RECORDING, 3], "not 3"),
        (np.zeros(3), "a ndarray"),
    ],
)
def test_what_is_no_recording_is_refused(recording, words):
    with pytest.raises(TranscriptionError, match=words):
        si.Identification(pendulum(), recording)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"scheme": "midpoint"}, "give one of Midpoint"),
        ({"episodes": 3}, "give Episodes"),
        ({"weights": [1]}, "dictionary"),
        ({"per_recording": "damping"}, "list of names"),
        ({"window": 5}, "give \\(t0, t1\\)"),
        ({"window": (1, 2, 3)}, "give \\(t0, t1\\)"),
        ({"window": "all"}, "give \\(t0, t1\\)"),
        ({"loss": 0.1}, "dictionary"),
    ],
)
def test_options_of_a_wrong_type_are_refused(arguments, words):
    with pytest.raises(TranscriptionError, match=words):
        si.Identification(pendulum(), RECORDING, **arguments)


def test_a_model_is_needed_first():
    with pytest.raises(TranscriptionError, match="begins with a Model"):
        si.Identification(RECORDING, RECORDING)


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (lambda m: si.State(), "has no unit"),
        (lambda m: si.Constant("heavy", unit="kg"), "'heavy'; give a number"),
        (lambda m: si.Equation("x + y"), "is no expression"),
        (lambda m: si.Equation(m.angle <= 1), "belongs into a Constraint"),
        (lambda m: m.angle <= 1, "becomes a Constraint"),
        (lambda m: m.angle + 1, "becomes an Equation"),
        (lambda m: 3, "cannot attach"),
        (lambda m: si.Expression(None, unit="m"), "is no expression"),
        (lambda m: si.Objective(running="x"), "is no expression"),
        (lambda m: si.Output([1, 2]), "is no expression"),
        (lambda m: si.Parameter(unit=None), "has no unit"),
    ],
)
def test_parts_of_a_wrong_type_are_refused(part, words):
    m = pendulum()
    with pytest.raises(ModelError, match=words):
        m.odd = part(m)


@pytest.mark.parametrize("bounds", [None, 3, ("a", "b"), (1, 2, 3)])
def test_bounds_that_are_no_pair_are_refused(bounds):
    m = pendulum()
    m.odd = si.Parameter(unit="1", bounds=bounds)
    with pytest.raises(ModelError, match="are not an interval"):
        m.check()


def test_arithmetic_with_what_is_no_number_is_refused():
    with pytest.raises(SymidError, match="cannot stand in an equation"):
        pendulum().angle + object()
    assert (pendulum().angle <= 1).func is sm.Le
