"""Models as a simulation needs them: algebraic variables solved for, process noise drawn, controls refused in words."""

import numpy as np
import pytest

import symid as si
from symid.discrepancy.task import task_of
from symid.errors import CodegenError, ModelError
from symid.simulation import Simulator


def cart(algebraic: bool = True) -> si.Model:
    m = si.Model("cart on a spring")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.k, m.mass = si.Parameter(unit="N/m", bounds=(0, 50)), si.Constant(2.0, unit="kg")
    m.kinematics = si.Equation(m.x.dot - m.v)
    if algebraic:
        m.pull, m.drag = si.Algebraic(unit="N"), si.Algebraic(unit="N")
        m.share, m.c = si.Constant(0.1, unit="1"), si.Constant(0.5, unit="N*s/m")
        m.spring = si.Equation(m.pull - m.k * m.x + m.share * m.drag)
        m.damper = si.Equation(m.drag - m.c * m.v - m.share * m.pull)
        m.balance = si.Equation(m.mass * m.v.dot + m.pull + m.drag)
    else:
        m.balance = si.Equation(m.mass * m.v.dot + m.k * m.x)
    m.seen = si.Output(m.x)
    return m


def test_linear_algebraic_variables_become_expressions_and_the_motion_is_that_of_the_dae():
    m = cart()
    run = Simulator(m).simulate({"k": 8.0}, {"x": 1.0, "v": 0.0}, np.linspace(0, 2, 201), {}, substeps=4)
    dae = m.fixed(k=8.0)
    dae.begin = si.Boundary(initial={dae.x: 1, dae.v: 0})
    plan = si.Optimization(dae, duration=2, nodes=201).solve()
    np.testing.assert_allclose(run.states["x"], plan["x"], atol=1e-6)
    assert si.identifiability(m).identifiable
    m.simulated("test").check()


def test_process_noise_is_noise_and_a_control_is_refused():
    m = cart(algebraic=False)
    m.gust = si.Process(unit="N")
    m.components["balance"] = si.Equation(m.balance.expr - m.gust, name="balance")
    assert list(m.simulated("diagnose").noises) == ["gust"]
    m.push = si.Control(unit="N")
    m.components["balance"] = si.Equation(m.balance.expr - m.push, name="balance")
    recording = si.Recording("run", np.arange(50) * 0.1, {"x": np.zeros(50)}, {"x": "m"})
    with pytest.raises(ModelError, match=r"diagnose: nothing says what the control push .*undisturbed\(False\)"):
        task_of(m, recording, (0, 4), None, held_out=None)
    with pytest.raises(CodegenError, match="needs to know gust, push, which is a control"):
        Simulator(m)


def test_an_algebraic_variable_that_is_no_expression_is_said():
    m = cart()
    m.components["spring"] = si.Equation(m.pull**3 + m.pull - m.k * m.x, name="spring")
    with pytest.raises(ModelError, match="do not give pull, drag as expressions"):
        Simulator(m)


def test_a_window_may_end_where_the_last_sample_does():
    recording = si.Recording("run", np.arange(100) * 0.1, {"x": np.cos(np.arange(100) * 0.2)}, {"x": "m"})
    t = si.Identification(cart(algebraic=False), recording, window=(5, 10)).transcription  # the last sample is at 9.9 s
    assert t.measured[0].intervals == 49
    with pytest.raises(si.TranscriptionError, match="does not lie in run"):
        si.Identification(cart(algebraic=False), recording, window=(5, 10.2)).solve()


def test_a_bootstrap_keeps_what_a_boundary_fixes():
    time = np.linspace(0, 4, 81)
    run = Simulator(cart(False)).simulate({"k": 8.0}, {"x": 0.2, "v": 0.0}, time, {})
    noisy = run.states["x"] + 0.01 * np.random.default_rng(0).standard_normal(81)
    m = cart(algebraic=False)
    m.begin = si.Boundary(initial={m.x: 0.2, m.v: 0})
    solution = si.Identification(m, si.Recording("run", time, {"x": noisy}, {"x": "m"})).solve(check=False)
    assert len(si.bootstrap(solution, 3, on_finished=None).draws) == 3
