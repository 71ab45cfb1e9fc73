"""When values that a model needs in the held-out window are others than those of the fitted one."""

from types import SimpleNamespace

import pytest

from symid.discrepancy.prove.elsewhere import _changed


@pytest.mark.parametrize(
    ("apart", "changed"),
    [
        (3.6, []),  # of five values chance makes one of them differ so much in 600 recordings
        (6.0, ["stiffness"]),
    ],
)
def test_values_that_chance_may_make_differ_are_no_other_machine(apart, changed):
    errors = {"stiffness": 3.0, "damping": 0.1, "inertia": 1e-4, "friction": 0.1, "gain": 0.1, "held": 0.0}
    fit = SimpleNamespace(values=dict.fromkeys(errors, 1.0), errors=errors)
    other = SimpleNamespace(values=fit.values | {"stiffness": 1.0 + 5.0 * apart}, errors=errors | {"stiffness": 4.0})
    assert _changed(fit, other) == changed


def test_of_two_values_that_differ_both_are_told_and_without_errors_none():
    fit = SimpleNamespace(values={"a": 0.0, "b": 0.0}, errors={"a": 1.0, "b": 1.0})
    other = SimpleNamespace(values={"a": 20.0, "b": 5.0}, errors={"a": 1.0, "b": 1.0})
    assert _changed(fit, other) == ["a", "b"]
    assert _changed(SimpleNamespace(values=fit.values, errors={}), other) == []
