"""Fits by simulation: least squares get numbers that they can compute with, whatever a model gives."""

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import SymidError
from symid.identification.starts.shooting import DIVERGED, LARGEST, computable


def test_what_cannot_be_computed_with_is_replaced_and_nothing_else():
    values = np.array([np.nan, np.inf, -np.inf, 1e300, 3.5, -1e40])
    assert np.array_equal(computable(values, nan=DIVERGED), [DIVERGED, LARGEST, -LARGEST, LARGEST, 3.5, -1e40])
    assert np.isfinite(np.sum(np.full(10**6, LARGEST) ** 2) ** 3)


@pytest.mark.parametrize("start", ["default", "stable"])
def test_an_output_that_overflows_is_a_sentence_or_a_result(start):
    model = pendulum()
    model.redefine("measured", model.angle + 1e-9 * sm.exp(1e6 * model.damping))
    problem = si.Identification(model, pendulum_recording(duration=2, noise=0.01))
    try:
        assert problem.solve(start=start).message
    except SymidError as told:
        assert 0 < len(str(told)) < 2000
