"""Exported models move as the simulator moves them, and need no symid."""

import ctypes
import re
import runpy
import shutil
import subprocess
import sys

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import CodegenError, ModelError
from symid.simulation import Simulator

BODY = si.mechanics.DoubleLinkPendulum(
    **dict(leg_length=0.8, leg_com=0.45, leg_mass=20, leg_inertia=1.3, trunk_mass=40, trunk_com=0.3, trunk_inertia=2.5)
)
GAINS = dict(kp_aa=900.0, kp_ah=200.0, kd_aa=180.0, kd_ah=50.0, kp_ha=50.0, kp_hh=300.0, kd_ha=60.0, kd_hh=25.0)
STANDING = BODY.with_feedback(si.mechanics.FullStatePD()).fixed(**GAINS, ref_ankle=0.01, ref_hip=-0.02)


def forced() -> si.Model:
    """Time, a control, an output with a rate, a switch, and a part whose name C would not allow."""
    m = si.Model("forced: */ pendulum")
    m.angle, m.rate, m.push = si.State(unit="rad"), si.State(unit="rad/s"), si.Control(unit="1/s^2")
    m.λ = si.Constant(4.0, unit="1/s^2")
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    late = sm.Piecewise((0, m.time < 0.3), (sm.cos(m.time), True))
    m.balance = si.Equation(2 * m.rate.dot + m.λ * sm.sin(m.angle) - m.push - late)
    m.shown = si.Output(m.rate.dot + m.angle, unit="1/s^2")
    return m


def compiled(text, folder, name):
    (folder / "loop.c").write_text(text)
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "loop.c", "-o", "loop.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    library = ctypes.CDLL(str(folder / "loop.so"))
    step, outputs = getattr(library, f"{name}_step"), getattr(library, f"{name}_outputs")
    pointer = np.ctypeslib.ndpointer(float)
    step.argtypes = [ctypes.c_double, ctypes.c_double, pointer, pointer]
    outputs.argtypes = [ctypes.c_double, pointer, pointer, pointer]
    return step, outputs


@pytest.mark.parametrize(("model", "x"), [(STANDING, [0.02, -0.01, 0.1, 0.0]), (forced(), [0.5, -0.2])])
def test_c_and_python_step_as_the_simulator_does(model, x, tmp_path):
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    si.export(model, tmp_path / "loop.c")
    si.export(model, tmp_path / "loop.py")
    text = (tmp_path / "loop.c").read_text()
    step, outputs = compiled(text, tmp_path, re.search(r"int (\w+)_rates", text)[1])
    module = runpy.run_path(str(tmp_path / "loop.py"))
    time, u = np.linspace(0, 1, 101), np.array([0.3])
    inputs = dict.fromkeys(module["INPUTS"], np.full(101, 0.3))
    known = Simulator(model.copy()) if model.inputs else Simulator(held(model))
    expected = known.simulate({}, x, time, inputs if model.inputs else {})
    at_c, at_python, y = np.array(x, dtype=float), np.array(x, dtype=float), np.zeros(len(model.outputs))
    for k in range(100):
        assert step(time[k], 0.01, at_c, u) == 0
        at_python = module["step"](time[k], 0.01, at_python, u)
    end = np.array([s[-1] for s in expected.states.values()])
    assert at_c == pytest.approx(end, rel=1e-9, abs=1e-12) and at_python == pytest.approx(end, rel=1e-9, abs=1e-12)
    assert outputs(1.0, at_c, u, y) == 0
    assert y == pytest.approx([v[-1] for v in expected.outputs.values()], rel=1e-8)
    assert module["outputs"](1.0, at_python, u) == pytest.approx(y, rel=1e-8)
    assert "symid" not in re.sub(r'""".*?"""', "", (tmp_path / "loop.py").read_text(), flags=re.S)


def held(model):
    """The same with the control as a known number."""
    new = model.copy()
    del new.components["push"]
    new.push = si.Constant(0.3, unit="1/s^2")
    return new


def test_an_exported_module_runs_where_symid_is_not(tmp_path):
    si.export(STANDING, tmp_path / "loop.py")
    code = "import sys; sys.modules['symid'] = None; import loop; print(loop.rates(0.0, [0.1, 0, 0, 0], [0.0]).shape)"
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "(4,)"


def test_a_solution_is_exported_with_its_values_and_errors(tmp_path):
    solution = si.Identification(pendulum(), pendulum_recording(duration=3, noise=0.01)).solve()
    si.export(solution, tmp_path / "a.py")
    module = runpy.run_path(str(tmp_path / "a.py"))
    assert module["c_damping"] == solution.values["damping"]
    si.export(solution, tmp_path / "a.tex")
    text = (tmp_path / "a.tex").read_text()
    assert r"\begin{align*}" in text and f"{solution.values['damping']:.6g}" in text
    assert f"{solution.parameters.std_error['damping']:.6g}" in text and text.count("{") == text.count("}")


def test_what_cannot_be_exported_is_refused_in_a_sentence(tmp_path):
    with pytest.raises(CodegenError, match="free parameters .*damping.*fixed"):
        si.export(pendulum(), tmp_path / "a.c")
    late = BODY.with_feedback(si.mechanics.FullStatePD(delay=(0, 0.2))).fixed(
        **GAINS, ref_ankle=0, ref_hip=0, feedback_delay=0.1
    )
    with pytest.raises(CodegenError, match="delayed signals"):
        si.export(late, tmp_path / "a.c")
    with pytest.raises(ModelError, match="ends with none of .c, .py, .tex"):
        si.export(STANDING, tmp_path / "a.fmu")
    with pytest.raises(ModelError, match="Solution or a Model, not dict"):
        si.export({}, tmp_path / "a.c")
    assert not list(tmp_path.iterdir())
