"""A closed form stands for a flexible law where one does as well, and none where none does."""

from functools import cache

import numpy as np
import pytest
import sympy as sm
from driven_cart import TRUE, cart, data_of, few, finding, recorded
from rigs import ROD, law_of

from symid.discrepancy.locate.flexible_law import flexible_law
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.closed_form import _Regression, closed_form
from symid.discrepancy.prove.nameless import nameless
from symid.discrepancy.say.rest import formula
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import rig_model
from symid.mechanics.missing.dictionary import Shape, closed_law, shapes_of, unit_quotient
from symid.simulation import simulator, synthetic_recording

X, V = sm.symbols("position speed", real=True)


def fitted(force, size, seed=1):
    """The flexible law for a cart on which `force` acts, of a recording with gusts."""
    data = data_of(recorded(seed, law_of(force).at("cart"), {"size": size}))
    return flexible_law([fit_model(cart(), data)], data)


@pytest.mark.parametrize("shape", shapes_of(X, V, [X, V]), ids=str)
def test_a_shape_is_the_same_as_numbers_and_as_sympy(shape):
    x, v = np.array([-0.3, 0.2, 0.7]), np.array([0.5, -1.1, 0.4])
    written = sm.lambdify((X, V), shape.expression(0.4, 0.1))
    expected = np.broadcast_to(written(x, v), 3)
    assert shape.numbers({X: x, V: v}, 0.4, 0.1) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("unit", "factors", "expected"),
    [
        ("N*m", [("rad", 2), ("rad/s", 1)], "N*m*s/rad^3"),
        ("N", [("m", 1)], "N/m"),
        ("N", [], "N"),
        ("m^3/s", [("m", 3)], "1/s"),
        ("m/s^2", [("m", 1), ("m/s", 1)], "1/(m*s)"),
    ],
)
def test_the_unit_of_a_coefficient(unit, factors, expected):
    assert unit_quotient(unit, factors) == expected


def test_every_shape_gives_a_law_whose_dimensions_fit():
    model = rig_model(ROD, ["link1_angle"], ["joint1"])
    port = model.ports["joint1"]
    every = shapes_of(port.position, port.rate, [port.position, port.rate])
    assert len(every) == len(set(every)) > 60
    for start in range(0, len(every), 8):
        model.with_term(closed_law(model, port, every[start : start + 8]).at("joint1")).check()


@cache
def bump_found():
    bump = law_of(lambda x, v: sm.exp(-((x - 0.03) ** 2) / 0.02**2)).at("cart")
    return finding(recorded(3, bump, {"size": 1.0}), few()[:3])


@pytest.mark.slow
def test_a_diagnosis_proposes_the_law_that_acts_with_its_numbers():
    found = bump_found()
    assert found.verdict == "unexplained" and found.proposal is not None
    assert found.proposal.shapes == (Shape((), (), "bell", sm.Symbol("position", real=True), True),)
    for key, truth in (("a", 1.0), ("a_width", 0.02), ("a_centre", 0.03)):
        value, error = abs(found.proposal.values[key]), found.proposal.errors[key]
        assert value == pytest.approx(truth, abs=4 * error) and error < 0.05 * truth
    assert found.proof.confirmed and found.proof.free_runs.margin > 0.7
    assert found.improved is found.proposal.model
    said = formula(found.proposal)
    assert said.startswith("force = a exp(-((position - a centre)/a width)²) with a = ") and "mm" in said
    assert said in found.words and found.answer()["proposal"]["parameters"]["a"]["unit"] == "N"


@pytest.mark.slow
def test_a_proposal_can_be_accepted_into_the_user_s_model():
    law, found = bump_found().proposal.law, bump_found()
    accepted = cart().with_term(law.at("cart")).check()
    fit = fit_model(accepted, data_of(recorded(3)), start=found.values | TRUE)
    assert abs(fit.values["closed_form_cart_a"]) < 0.1  # of a recording where it does not act
    assert found.proposal.expression.free_symbols == {sm.Symbol("position", real=True)}


@pytest.mark.parametrize(
    ("force", "size", "shape"),
    [
        pytest.param(lambda x, v: -(v**3), 8.0, Shape(((V, 3),)), marks=pytest.mark.slow, id="cubic"),
        pytest.param(lambda x, v: -sm.sin(x / 0.03), 1.0, Shape((), (), "sin", X), marks=pytest.mark.slow, id="magnet"),
        pytest.param(lambda x, v: -(x**2) * v, 400.0, Shape(((X, 2), (V, 1))), marks=pytest.mark.slow, id="vdp"),
    ],
)
def test_the_true_form_is_proposed(force, size, shape):
    assert [s.expression() for s in closed_form(fitted(force, size)).shapes] == [shape.expression()]


@pytest.mark.slow
def test_nothing_is_proposed_where_no_form_does_as_well():
    def hills(x, v):
        return sum(s * sm.exp(-(((x - c) / 0.012) ** 2)) for s, c in ((1, -0.07), (-1, -0.035), (1, 0.0), (1, 0.05)))

    law = fitted(hills, 1.0)
    assert law.log_ratio > 100
    assert closed_form(law) is None


@pytest.mark.slow
def test_without_held_out_data_a_proposal_says_that_it_was_not_tested():
    data = data_of(recorded(1, law_of(lambda x, v: -(v**3)).at("cart"), {"size": 8.0}))
    base = fit_model(cart(), data)
    unnamed = nameless(Hypothesis((), base, base, data), data, None)
    assert unnamed.proposal is not None and unnamed.errors == {}


@pytest.mark.slow
def test_a_shape_that_the_model_has_already_is_no_closed_form():
    """Beside a friction of the model one more is nothing but rounding, with a coefficient of any size."""
    model, brake = rig_model(ROD, ["link1_angle"], ["joint1"]), law_of(lambda x, v: -(v**3)).at("joint1")
    values = {"viscous_friction_joint1_coefficient_Nms_rad": 1e-3, brake.parameter_name("size"): 1e-3}
    values = {k: values.get(k, 1e-3) for k in simulator(model.with_term(brake)).parameters}
    made = synthetic_recording(
        model.with_term(brake), values, duration=12, rate=50, seed=1, warm_up=0,
        initial_state={"link1_angle": 1.0}, sensor_noise={"link1_angle": 2e-4},
    )  # fmt: skip
    channels = dict(made.channels)
    data = Data(segments_between(model, made.time, channels, (0.0, 11.9), 4.0), np.array([2e-4]), driven=False)
    law = flexible_law([fit_model(model, data)], data)
    shapes, speed = {shape for shape, _ in _Regression(law).atoms}, law.port.rate
    assert Shape(((speed, 3),)) in shapes and Shape(((speed, 1),)) not in shapes
