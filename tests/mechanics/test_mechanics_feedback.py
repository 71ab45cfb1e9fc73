"""Feedback laws: parameters by name, published weights, delays, muscles, any joints."""

import json

import numpy as np
import pytest
import sympy as sm
from conftest import SHARED

from symid.errors import ModelError
from symid.mechanics import PD, Chain, DelayedFullState, DoubleLinkPendulum, FullStatePD, NeuralNetwork
from symid.mechanics.neural import ACTIVATIONS
from symid.model import Model
from symid.model.check import violations

BODY = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29)
LAWS = [
    PD(),
    FullStatePD(),
    FullStatePD(delay=(0, 0.3)),
    PD(muscle=(0.01, 0.3)),
    DelayedFullState(lags=(0.05, 0.1)),
    NeuralNetwork(),
    NeuralNetwork(activation="as_printed", lags=(0.0, 0.1)),
    NeuralNetwork(delay=(0, 0.2), hidden=2),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("plant", [BODY.plant(), Chain.uniform(3, upright=True).plant()], ids=["standing", "chain"])
def test_every_law_closes_every_loop(law, plant):
    before = plant.fingerprint
    model = law.close(plant)
    assert list(violations(model)) == []
    assert plant.fingerprint == before
    joints = [p.name for p in plant.ports.values() if p.role == "joint"]
    for role in ("feedback_torque", "feedback_error", "feedback_rate"):
        assert {c.at for c in model.find(role)} == set(joints)


def test_names_bounds_and_units_of_the_gains():
    pd, full = BODY.with_feedback(PD()), BODY.with_feedback(FullStatePD())
    assert set(pd.parameters) == {"kp_ankle", "kd_ankle", "kp_hip", "kd_hip", "ref_ankle", "ref_hip"}
    assert set(full.parameters) == {
        "kp_aa",
        "kp_ah",
        "kd_aa",
        "kd_ah",
        "kp_ha",
        "kp_hh",
        "kd_ha",
        "kd_hh",
        "ref_ankle",
        "ref_hip",
    }
    assert full.kp_aa.bounds == full.kd_hh.bounds == (0.0, 5000.0)
    assert full.kp_ah.bounds == full.kd_ha.bounds == (-5000.0, 5000.0)
    assert full.ref_hip.bounds == (-0.5, 0.5)
    assert (full.kp_ah.unit, full.kd_ah.unit, full.ref_hip.unit) == ("N*m/rad", "N*m*s/rad", "rad")


def test_torques_resist():
    model = BODY.with_feedback(PD())
    force = model.inline(model.ankle_balance.expr)
    assert sm.diff(force, model.kp_ankle.symbol) == -(model.ankle_angle - model.ref_ankle.symbol)
    assert sm.diff(model.inline(model.hip_balance.expr), model.kd_hip.symbol) == -model.hip_velocity.symbol


def test_one_unknown_delay_makes_every_signal_late():
    model = BODY.with_feedback(FullStatePD(delay=(0.0, 0.3)))
    assert {str(d.of) for d in model.delays.values()} == set(model.states)
    assert {d.lag for d in model.delays.values()} == {model.feedback_delay.symbol}
    read = model.inline(model.ankle_torque.symbol).free_symbols
    assert not read & {s.symbol for s in model.states.values()}


def test_delayed_gains_read_the_state_at_their_own_lag():
    model = BODY.with_feedback(DelayedFullState(lags=(0.06, 0.12)))
    slope = sm.diff(model.inline(model.ankle_torque.symbol), model.kp_ah_2.symbol)
    (late,) = (s for s in slope.free_symbols if s in model.delays)
    assert (str(model.delays[late].of), float(model.delays[late].lag)) == ("hip_angle", 0.12)


def test_muscle_torque_settles_at_what_is_asked_for():
    model, plain = BODY.with_feedback(PD(muscle=(0.01, 0.3))), BODY.with_feedback(PD())
    state = model.ankle_torque_muscle
    settled = model.inline(model.ankle_torque_muscle_equation.expr).xreplace({state.dot: sm.S.Zero})
    assert sm.expand(settled - state.symbol + plain.inline(plain.ankle_torque.symbol)) == 0
    assert model.inline(model.ankle_torque.symbol) == state.symbol


@pytest.mark.parametrize(("activation", "below"), [("leaky_relu", 0.3), ("as_printed", 1.7)])
def test_activations_have_their_slopes_and_never_overflow(activation, below):
    x = sm.Symbol("x", real=True)
    f = ACTIVATIONS[activation](x)
    value, slope = sm.lambdify(x, f), sm.lambdify(x, sm.diff(f, x))
    for at in (-100.0, -1.0):
        assert slope(at) == pytest.approx(below, abs=1e-3)
        assert value(at) == pytest.approx(below * at, abs=1e-3)
    assert slope(1.0) == pytest.approx(1.0, abs=1e-3)
    assert value(100.0) == pytest.approx(100.0, abs=1e-3)


def test_leaky_relu_is_the_published_formula():
    x = sm.Symbol("x", real=True)
    f = ACTIVATIONS["leaky_relu"](x)
    for at in (-0.2, -0.01, 0.0, 0.03, 0.3):
        assert float(f.subs(x, at)) == pytest.approx(at + 0.7 / 50 * np.log(1 + np.exp(-50 * at)), rel=1e-12)


def test_published_layout_of_the_weights():
    """4x5 input weights row by row, then 2x5 output weights, torque = 100 N m x output."""
    rng = np.random.default_rng(7)
    weights, x = rng.normal(size=30), rng.normal(size=4) * 0.1
    model = BODY.with_feedback(NeuralNetwork())
    table = {p.symbol: w for p, w in zip(model.parameters.values(), weights, strict=True)}
    table |= {s.symbol: v for s, v in zip(model.states.values(), x, strict=True)} | {model.torque_scale.symbol: 100.0}
    hidden = weights[:20].reshape(4, 5) @ np.r_[x, 1]
    hidden = hidden + 0.7 / 50 * np.log(1 + np.exp(-50 * hidden))
    expected = 100 * weights[20:].reshape(2, 5) @ np.r_[hidden, 1]
    found = [float(model.inline(model[f"{j}_torque"].symbol).xreplace(table)) for j in ("ankle", "hip")]
    assert np.allclose(found, expected)


@pytest.mark.skipif(not SHARED.is_dir(), reason="needs the folder 'shared' beside the checkout")
def test_published_networks_have_thirty_weights():
    results = json.loads((SHARED / "reference/paper_results.json").read_text())["results"]
    for r in (r for r in results if r["controller"] == "NN"):
        assert len(r["best_start_weights"]) == len(BODY.with_feedback(NeuralNetwork()).parameters)


@pytest.mark.parametrize("lags", [(), (-0.1,), (0.1, 0.1), (0.2, 0.1)])
def test_lags_that_make_no_sense_are_refused(lags):
    with pytest.raises(ModelError, match="not negative and increasing"):
        DelayedFullState(lags=lags)


def test_networks_that_make_no_sense_are_refused():
    with pytest.raises(ModelError, match="activation 'relu' is not known"):
        NeuralNetwork(activation="relu")
    with pytest.raises(ModelError, match="hidden=0"):
        NeuralNetwork(hidden=0)


def test_a_model_without_joints_is_refused():
    with pytest.raises(ModelError, match="has no joint at which PD could act"):
        PD().close(Model("empty"))
