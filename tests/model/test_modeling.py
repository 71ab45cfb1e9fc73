"""The modeling layer: constants that become parameters, controls, constraints, objectives."""

import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError
from symid.model.expressions.quantity import sympified


def test_a_freed_constant_is_identified_from_its_value_as_a_guess():
    model = pendulum().with_constants(stiffness=3.0).free("stiffness").fixed(damping=0.4)
    assert model.stiffness.guess == 3.0 and model.stiffness.bounds == (0.3, 30.0) and model.stiffness.unit == "1/s^2"
    solution = si.Identification(model, pendulum_recording()).solve()
    assert solution.values["stiffness"] == pytest.approx(4.0, rel=1e-3)


def test_a_constant_is_freed_within_given_bounds_and_zero_only_so():
    assert pendulum().free(stiffness=(1, 5)).stiffness.bounds == (1, 5)
    assert pendulum().with_constants(stiffness=-2).free("stiffness").stiffness.bounds == (-20, -0.2)
    with pytest.raises(ModelError, match="'stiffness' is zero.*give bounds"):
        pendulum().with_constants(stiffness=0).free("stiffness")
    with pytest.raises(ModelError, match="'damping' is a Parameter"):
        pendulum().free("damping")


def test_inputs_become_controls_for_a_plan_with_the_identified_model():
    model = pendulum().fixed(damping=0.4).controlled(drive=(-2, 2))
    assert model.drive.bounds == (-2, 2) and not model.inputs and list(model.controls) == ["drive"]
    model.ends = si.Boundary(initial={model.angle: 0.3, model.rate: 0}, terminal={model.angle: 0, model.rate: 0})
    model.effort = si.Objective(running=model.drive**2)
    plan = si.Optimization(model, duration=2, nodes=21).solve()
    assert plan.solved and abs(plan["angle"][-1]) < 1e-9
    assert plan.plot().png().startswith(b"\x89PNG") and "objective" in plan._repr_html_()


def test_what_follows_from_the_parts_is_kept_until_one_changes():
    m = pendulum()
    before, rates = m.residual(), m.rates()
    assert m.residual() is before and dict(rates) == {"rate": "angle"} and "_kept" not in m.__getstate__()
    with pytest.raises(TypeError):
        rates["rate"] = "other"
    m.gain = si.Parameter(bounds=(0, 1), unit="1/s^2")
    m.kick = si.Expression(m.gain * m.angle, unit="rad/s^2")
    assert m.residual() is not before and m.residual() == before
    m.further = si.Equation(m.kick)
    kicked = m.residual()
    m.redefine("kick", 2 * m.gain)
    assert m.residual()[-1] == 2 * m.gain.symbol != kicked[-1]


def test_parts_repeat_themselves_by_an_index():
    m = si.Model("chain")
    m.x, m.v = si.State(unit="m", index=range(3)), si.State(unit="m/s", index=range(3))
    m.k = si.Constant(2.0, unit="1/s^2")
    m.kinematics = si.Equation({i: m.x[i].dot - m.v[i] for i in m.x})
    m.balance = si.Equation(sm.Matrix([m.v[i].dot + m.k * (m.x[i] - m.x[max(i - 1, 0)]) for i in m.x]))
    assert list(m.states) == ["x_0", "x_1", "x_2", "v_0", "v_1", "v_2"] and m.x[1].name == "x_1"
    assert list(m.equations)[3:] == ["balance_0", "balance_1", "balance_2"] and m.check().copy().x[2] == m.x[2]
    with pytest.raises(ModelError, match="'x' is declared already"):
        m.x = si.State(unit="m")


def test_the_unit_of_what_a_sensor_shows_is_told_from_its_expression():
    m = si.Model("m")
    m.a, m.b, m.v = si.State(unit="rad"), si.State(unit="rad"), si.State(unit="m/s")
    m.k, m.mass = si.Parameter(unit="N*s/m"), si.Constant(2.0, unit="kg")
    m.lean, m.force = si.Output(m.a + 2 * m.b), si.Output(m.k * m.v)
    m.acceleration, m.ratio = si.Output(m.k * m.v / m.mass), si.Output(sm.sin(m.a))
    assert {n: y.unit for n, y in m.outputs.items()} == {
        "lean": "rad",
        "force": "N",
        "acceleration": "m/s^2",
        "ratio": "",
    }


def test_a_free_run_elsewhere_knows_no_disturbance_and_no_boundary_of_the_fitted_window():
    recording = pendulum_recording(duration=6, noise=0.01)
    plain = si.Identification(pendulum(), recording, (0, 4)).solve()
    m = pendulum()
    m.gust = si.Process(unit="1/s^2", size=0.05)
    m.components["balance"] = si.Equation(m.balance.expr - m.gust, name="balance")
    m.begin = si.Boundary(initial={m.angle: (0.25, 0.35)})
    gusty = si.Identification(m, recording, (0, 4)).solve()
    run = gusty.free_run((4, 6))
    assert not run.model.controls and not run.model.boundaries
    values = {"damping": gusty.values["damping"]}
    alike = si.Identification(pendulum().fixed(**values), recording, (4, 6), noise=run.problem.noise).solve(check=False)
    assert run.fit["rms"]["all"] == pytest.approx(alike.fit["rms"]["all"], rel=1e-5)
    assert run.fit["rms"]["all"] == pytest.approx(plain.fit_on((4, 6))["rms"]["all"], rel=0.1)
    assert gusty.free_run((0, 2)).model.boundaries


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda x: sm.Derivative(x**2, x), "contains a Derivative that is not worked out"),
        (lambda x: sm.Integral(x**2, x), "contains a Integral that is not worked out"),
        (lambda x: sm.AccumBounds(sm.exp(x - 1), sm.exp(x + 1)), "is a range"),
        (lambda x: x + sm.AccumBounds(-1, 1), "is a range"),
    ],
)
def test_what_gives_no_number_is_refused(make, words):
    m = pendulum()
    with pytest.raises(ModelError, match=words):
        m.extra = si.Equation(make(m.angle.symbol))
    with pytest.raises(ModelError, match=words):
        m.redefine("measured", make(m.angle.symbol))


def test_a_constant_power_that_is_no_number_is_left_to_the_check():
    """SymPy compares no NaN: found by fuzzing."""
    for power in (sm.Pow(sm.zoo, sm.I, evaluate=False), sm.exp(sm.oo, evaluate=False), sm.exp(sm.nan, evaluate=False)):
        assert sympified(power) == power
