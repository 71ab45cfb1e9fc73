"""When values that a model needs in the held-out window are others than those of the fitted one."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si
from symid.discrepancy.prove.elsewhere import _begun, _changed
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.simulation import simulator


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


@pytest.mark.parametrize(("tilt", "pieces"), [(0.3, 1), (np.pi - 1e-6, 2)], ids=["hangs", "stands"])
def test_held_out_motion_that_small_differences_change_is_compared_in_pieces(tilt, pieces):
    model = si.Model("pendulum")
    model.q, model.w = si.State(unit="rad"), si.State(unit="rad/s")
    model.k = si.Parameter(unit="1/s^2", bounds=(0.1, 100))
    model.kinematics = si.Equation(model.q.dot - model.w)
    model.balance = si.Equation(model.w.dot + model.k * sm.sin(model.q))
    model.seen = si.Output(model.q, channel="angle")
    time = np.arange(0, 6, 0.02)
    swing = simulator(model).simulate({"k": 9.0}, [tilt, 0.0], time, {}).y
    recording = si.Recording("swing", time, {"angle": swing[:, 0]}, units={"angle": "rad"})
    data = Data(segments_of(model, recording, (0, 6), None), np.array([1e-3]), driven=False)
    begin, held = _begun(fit_model(model, data, {"k": 9.0}), data)
    assert len(held.segments) >= pieces and (len(held.segments) > 1) == (pieces > 1)
    assert len(begin.initial) == len(held.segments)


def slider() -> si.Model:
    model = si.Model("slider")
    model.x, model.v = si.State(unit="m"), si.State(unit="m/s")
    model.k = si.Parameter(unit="1/s^2", bounds=(1, 100))
    model.kinematics = si.Equation(model.x.dot - model.v)
    model.balance = si.Equation(model.v.dot + model.k * model.x)
    model.seen = si.Output(model.x, channel="place")
    parts = {"position": model.x, "rate": model.v, "into": {"balance": -1.0}}
    model.port = si.Port(**parts, role="joint", at="slide", unit="m/s^2")
    return model


@pytest.mark.parametrize(("friction_later", "verdict"), [(0.035, "missing_physics"), (0.03, "unexplained")])
def test_friction_that_only_slow_motion_shows_to_set_in_gradually_is_no_other_law(friction_later, verdict):
    """In the fitted window it is as good as a jump. Friction of another size in the held-out one is told."""
    half, time = 20.0, np.arange(0, 40, 0.02)

    def rates(t, x):
        size = 0.035 if t < half else friction_later
        return [x[1], -9 * x[0] - size * np.tanh(x[1] / 0.015)]

    place = solve_ivp(rates, (0, 2 * half), [0.3, 0], t_eval=time, rtol=1e-10, atol=1e-12, max_step=0.02).y[0]
    noisy = place + np.random.default_rng(0).normal(0, 1e-4, time.size)
    recording = si.Recording("slide", time, {"place": noisy}, {"place": "m"})
    laws = [s for s in si.suspects(slider()) if s.term.name in ("coulomb_friction", "viscous_friction", "joint_drag")]
    windows = {"fit_window": (0, half), "held_out": (half, 2 * half)}
    found = si.diagnose(slider(), recording, **windows, driven=False, suspects=laws, threads=1)
    assert found.verdict == verdict, str(found)
    assert [e.name for e in found.effects][-1] == "coulomb_friction"
