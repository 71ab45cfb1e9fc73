"""What a person reads: units from the model, and as many digits as the error allows."""

import re

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, strategies as st

import symid.model as si
from symid.errors import ModelError
from symid.identification import Identification
from symid.identification.fit import common_unit, fit_text, rms_text
from symid.mechanics.missing.terms import LIBRARY
from symid.recording import Recording
from symid.units import quantity, rough, shown_unit, unit_symbol, with_error


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (626.6, 100.0, "630 ± 100"),
        (626.6, 99.6, "630 ± 100"),
        (0.052, 0.004, "0.0520 ± 0.0040"),
        (1.23e-9, 4e-11, "(1.230 ± 0.040)·10⁻⁹"),
        (0.0, 1e-3, "0.0000 ± 0.0010"),
        (-12.34, 0.56, "-12.34 ± 0.56"),
        (3.3, 500.0, "3.3 (hardly determined)"),
        (12.345, float("nan"), "12.3"),
        (float("nan"), 1.0, "not known"),
        (5e8, 2e7, "(5.00 ± 0.20)·10⁸"),
    ],
)
def test_digits_follow_the_error(value, error, text):
    assert with_error(value, error) == text


@pytest.mark.parametrize(("value", "text"), [(123.4, "120"), (99.96, "100"), (-4.83, "-4.8"), (3.14e-5, "3.1·10⁻⁵")])
def test_a_number_in_a_sentence_is_no_power_of_ten_unless_it_must(value, text):
    assert rough(value) == text


def test_values_that_are_compared_have_one_unit():
    """28.3 mm to 976 µm hides from the eye by how much it fell."""
    assert [quantity(a, unit="m", beside=b) for a, b in ((0.0283, 9.76e-4), (9.76e-4, 0.0283))] == [
        "28.3 mm",
        "0.976 mm",
    ]
    assert quantity(2e-6, unit="m", beside=0.5) == "2.00 µm" and quantity(0.0, unit="m", beside=0.01) == "0 m"
    assert rms_text(np.radians(0.1), "rad", beside=np.radians(5.0)) == "0.1000 deg"


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6))
def test_a_printed_value_is_right_to_the_second_digit_of_its_error(value, error):
    text = with_error(value, error)
    if "(" in text:
        return
    shown, shown_error = map(float, text.split(" ± "))
    assert abs(shown - value) <= 0.051 * shown_error + 1e-12 * abs(value)
    assert shown_error == pytest.approx(error, rel=0.051)
    assert len(re.sub(r"[.\-]", "", text.split(" ± ")[1]).strip("0")) <= 2


@pytest.mark.parametrize(
    ("value", "error", "unit", "text"),
    [
        (0.084, 0.003, "s", "84.0 ± 3.0 ms"),
        (0.0052, 0.0011, "N*m", "5.2 ± 1.1 mN m"),
        (0.05, 0.01, "rad", "2.86 ± 0.57 deg"),
        (0.0046, 1e-4, "m", "4.60 ± 0.10 mm"),
        (0.2, 0.01, "kg*m^2", "0.200 ± 0.010 kg m²"),
        (843.0, float("nan"), "m", "843 m"),
        (12.3, 0.4, "N*s/m", "12.30 ± 0.40 N s/m"),
        (1.97e-10, float("nan"), "m", "197 pm"),
        (7.3e-8, 1e-9, "m", "73.0 ± 1.0 nm"),
        (2e-14, 1e-15, "N*m", "0.0200 ± 0.0010 pN m"),
    ],
)
def test_a_quantity_takes_the_unit_that_suits_it(value, error, unit, text):
    assert quantity(value, error, unit) == text


def test_units_as_they_are_printed():
    assert unit_symbol("N*m*s^2/rad^2") == "N m s²/rad²"
    assert unit_symbol("1") == unit_symbol("") == ""
    assert shown_unit("rad/s") == ("deg/s", pytest.approx(180 / sm.pi.evalf()))
    assert shown_unit("m") == ("m", 1.0)


def test_one_number_over_outputs_of_different_units_is_not_given_a_unit():
    assert (
        fit_text({"cart": 0.0012, "pole": 0.0174533, "all": 0.0123}, {"cart": "m", "pole": "rad"})
        == "cart 1.200 mm, pole 1.000 deg"
    )
    assert fit_text({"a": 0.0174533, "b": 0.0349066, "all": 0.0276}, {"a": "rad", "b": "rad"}).endswith("all 1.581 deg")
    assert rms_text(0.01, common_unit(["m", "rad"])) == "0.01 (different units together)"
    assert rms_text(0.01, common_unit(["m", "m"])) == "10.00 mm"


def glider(divided_by_mass: bool) -> si.Model:
    m = si.Model("glider")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.mass, m.k = si.Constant(0.2, unit="kg"), si.Parameter(unit="1/s^2", bounds=(0, 100))
    m.kinematics = si.Equation(m.x.dot - m.v)
    balance = m.v.dot + m.k * m.x
    m.balance = si.Equation(balance if divided_by_mass else m.mass * balance)
    m.track = si.Port(position=m.x, rate=m.v, into={"balance": 1}, role="joint", at="track")
    m.place = si.Output(m.x)
    return m


@pytest.mark.parametrize(("divided", "force", "friction"), [(True, "m/s^2", "1/s"), (False, "N", "N*s/m")])
def test_a_port_and_the_laws_at_it_take_the_units_of_the_model(divided, force, friction):
    model = glider(divided)
    assert model.track.unit == force
    lossy = model.with_term(LIBRARY["viscous_friction"].at("track"))
    assert [p.unit for p in lossy.parameters.values()] == ["1/s^2", friction]
    for name in (
        "viscous_friction",
        "coulomb_friction",
        "cubic_stiffness",
        "stribeck_friction",
        "joint_drag",
        "rotor_inertia",
    ):
        model.with_term(LIBRARY[name].at("track")).check()  # dimensions of every equation, too


def test_a_port_whose_unit_is_wrong_or_cannot_be_told_is_refused():
    model = glider(False)
    model.other = si.Port(position=model.x, rate=model.v, into={"balance": 1}, unit="N*m")
    with pytest.raises(ModelError, match=r"port 'other' is declared in N\*m, but the equation 'balance'"):
        model.check()
    model = si.Model("too early")
    model.x = si.State(unit="m")
    model.push = si.Port(position=model.x, rate=model.x.dot, into={"later": 1})
    model.later = si.Equation(model.x.dot)
    with pytest.raises(ModelError, match="port 'push' has no unit"):
        model.check()


@pytest.mark.parametrize(("unit", "right"), [("um", "m"), ("deg", "rad"), ("1/ms", "1/s"), ("rpm", "rad/s")])
def test_a_model_in_other_units_than_si_is_not_solved(unit, right):
    """Its recording is in SI: a place in um would be a million times too small, without a word."""
    m = si.Model("piezo")
    m.place = si.State(unit=unit)
    m.rate = si.Parameter(unit=f"{unit}/s", bounds=(0, 1))
    m.law = si.Equation(m.place.dot - m.rate)
    m.seen = si.Output(m.place, channel="place")
    time = np.arange(5.0)
    recording = Recording("r", time, {"place": time}, {"place": right})
    with pytest.raises(ModelError, match=f"'place' is in {unit}; inside a model use the SI unit {right}"):
        Identification(m, recording).solve(check=False)
