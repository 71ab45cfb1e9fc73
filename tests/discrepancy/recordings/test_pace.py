"""Fast and slow machines: what a diagnosis states in seconds follows the pace of the motion."""

import numpy as np
import pytest

import symid as si
from symid.discrepancy.locate.audit import audit
from symid.estimation.signals.data import Data
from symid.estimation.signals.swings import pace_of
from symid.estimation.signals.windows import segments_of
from symid.mechanics.feedback import torques_along
from symid.simulation import simulator

NOISE = 1e-4


def spring(pace: float) -> si.Model:
    """A driven mass on a spring whose period is about two times `pace` [s]."""
    m = si.Model("spring")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.push = si.Input(channel="push", unit="N")
    m.mass = si.Parameter(unit="kg", bounds=(0.01 * pace**2, 100 * pace**2))
    m.damping = si.Parameter(unit="N*s/m", bounds=(0, 100 * pace))
    m.stiffness = si.Parameter(unit="N/m", bounds=(0, 1000))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.damping * m.v + m.stiffness * m.x - m.push)
    m.shown = si.Output(m.x, channel="position")
    m.spring = si.Port(position=m.x, rate=m.v, into={"balance": -1.0}, role="joint", at="spring")
    return m


def recorded(pace: float, cubic: float, size: float = 1.0, seed: int = 0) -> tuple[si.Model, si.Recording]:
    """30 paces of it with a stiffness that grows, driven by noise without what is faster than the recording shows.

    size : of all motions and forces.
    """
    model, rng = spring(pace), np.random.default_rng(seed)
    time = np.arange(1501) * 0.02 * pace
    push = size * np.convolve(rng.standard_normal(time.size + 40), np.hanning(41) / 4, mode="valid")[: time.size]
    law = si.mechanics.LIBRARY["cubic_stiffness"].at("spring")
    true = model.with_term(law)
    values = {
        "mass": pace**2,
        "damping": 0.4 * pace,
        "stiffness": 10.0,
        law.parameter_name("k3_Nm_rad3"): cubic / size**2,
    }
    run = simulator(true).simulate(values, np.zeros(2), time, {"push": push}, substeps=8)
    position = run.outputs["position"] if "position" in run.outputs else run.y[:, 0]
    return model, si.Recording(
        name="spring",
        time=time,
        channels={"push": push, "position": position + size * NOISE * rng.standard_normal(time.size)},
        units={"push": "N", "position": "m"},
    )


@pytest.mark.slow
@pytest.mark.parametrize(("pace", "size"), [(1e-3, 1.0), (1e-4, 1e-6), (1.0, 1.0), (200.0, 10.0)])
def test_a_law_is_found_at_any_pace_and_size(pace, size, tmp_path):
    model, recording = recorded(pace, cubic=150.0, size=size)
    found = si.diagnose(model, recording, fit_window=(0, 20 * pace), held_out=(20 * pace, 30 * pace), threads=1)
    assert [e.name for e in found.effects] == ["cubic_stiffness"], found.words
    if pace > 1:
        assert found.report(tmp_path / "report.html").is_file()
    value, error = found.effects[0].parameters["k3_Nm_rad3"]
    assert abs(value * size**2 - 150.0) < 3 * error * size**2 < 15.0
    assert found.proof.confirmed
    assert "N/m³" in found.words and "position" in found.words


def test_laws_are_looked_for_at_the_size_of_the_motion():
    from symid.discrepancy.model.sizes import Sizes

    model = si.mechanics.PD().close(spring(1.0))
    (torque,) = torques_along(model, np.array([[0.3, -2.0], [0.0, 1.0]]), dict.fromkeys(model.parameters, 0.5)).values()
    assert torque == pytest.approx([0.5 * (0.3 - 0.5) + 0.5 * -2.0, 0.5 * (0.0 - 0.5) + 0.5 * 1.0])
    usual, small = (
        next(s for s in si.suspects(model, sizes) if s.term.name == "torque_saturation")
        for sizes in (None, Sizes(torque={"spring": 1e-3}))
    )
    assert small.law.parameters[0].bounds == tuple(1e-3 * b for b in usual.law.parameters[0].bounds)
    assert small.law.parameters[0].starts == tuple(1e-3 * v for v in usual.law.parameters[0].starts)


def test_the_pace_is_that_of_the_motion_and_not_of_its_noise():
    model, recording = recorded(1e-3, cubic=0.0)
    pieces = segments_of(model, recording, (0, 0.03))
    assert 1e-3 < pace_of(pieces) < 4e-3
    assert Data(pieces, np.array([NOISE]), False).with_segments([pieces[0].head(9)]).pace == pace_of(pieces)
    slow, recording = recorded(1.0, cubic=0.0)
    assert pace_of(segments_of(slow, recording, (0, 30))) == 1.0


def test_an_input_without_high_frequencies_is_no_filter_of_the_output():
    model, recording = recorded(1e-3, cubic=0.0)
    assert audit(model, recording, segments_of(model, recording, (0, 0.03)), None).filter is None


@pytest.mark.slow
def test_dry_friction_sets_in_as_abruptly_as_the_recording_shows():
    from scipy.integrate import solve_ivp

    width, time = 0.02, np.arange(1001) * 0.01
    push = 30 * np.sin(2 * np.pi * 0.4 * time) + 12 * np.sin(2 * np.pi * 0.13 * time)
    force = lambda t, x: [x[1], (np.interp(t, time, push) - 20 * x[1] - 6 * np.tanh(x[1] / width)) / 5]  # noqa: E731
    how = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-13, "max_step": 0.002}
    x = solve_ivp(force, (0, 10), [0, 0], t_eval=time, **how).y[0]
    m = si.Model("slide")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.push = si.Input(channel="push", unit="N")
    m.mass = si.Parameter(unit="kg", bounds=(0.1, 100))
    m.friction = si.Parameter(unit="N*s/m", bounds=(0, 500))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.friction * m.v - m.push)
    m.shown = si.Output(m.x, channel="position")
    m.slide = si.Port(position=m.x, rate=m.v, into={"balance": -1.0}, role="joint", at="slide")
    channels = {"push": push, "position": x + 2e-6 * np.random.default_rng(0).standard_normal(time.size)}
    recording = si.Recording(name="slide", time=time, channels=channels, units={"push": "N", "position": "m"})
    found = si.diagnose(m, recording, fit_window=(0, 7), held_out=(7, 10), threads=1)
    assert [e.name for e in found.effects] == ["coulomb_friction"], found.words
    assert found.verdict == "missing_physics"
    (speed,) = found.improved.find("friction_speed")
    assert speed.value == pytest.approx(width, rel=0.02)
    assert found.effects[0].parameters["torque_Nm"][0] == pytest.approx(6.0, rel=1e-3)
