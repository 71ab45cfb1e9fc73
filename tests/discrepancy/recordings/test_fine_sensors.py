"""A drive whose encoder resolves a millionth of its travel was not filtered, although its spectrum seems empty."""

import math

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from scipy.ndimage import gaussian_filter1d
from scipy.signal import butter, filtfilt

import symid as si
from symid.discrepancy.locate.audit import audit, unfiltered
from symid.estimation.signals.windows import segments_of

STEP_m, DRY_N, MASS_kg, VISCOUS = 1e-6, 20.3, 95.0, 203.0


def positioning(hold: str = "zero") -> si.Model:
    m = si.Model("positioning")
    m.q, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.force = si.Input(channel="force", unit="N", hold=hold)
    m.mass, m.viscous = si.Parameter(unit="kg", bounds=(1, 1000)), si.Parameter(unit="N*s/m", bounds=(0, 5000))
    m.kinematics = si.Equation(m.q.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.viscous * m.v - m.force)
    m.position = si.Output(m.q, channel="position")
    m.slide = si.Port(position=m.q, rate=m.v, into={"balance": -1.0}, role="joint", at="slide", unit="N")
    return m


@pytest.fixture(scope="module")
def driven() -> si.Recording:
    return slid(0.0)


def slid(pull: float) -> si.Recording:
    """A slide that follows a smooth reference against dry friction and a `pull` [N], 100 samples per second."""
    time = np.arange(0, 16, 0.01)
    steps = 0.12 * np.sin(0.5 * np.pi * time) * np.clip(time / 3, 0, 1) + 0.05 * np.sign(np.sin(0.45 * time))
    reference = gaussian_filter1d(steps, 12)
    rate = np.gradient(reference, time)
    q, v, force, recorded = 0.0, 0.0, [], []
    for r, dr in zip(reference, rate, strict=True):
        force.append(MASS_kg * (1600 * (r - q) + 80 * (dr - v)))
        recorded.append(q)
        for _ in range(20):
            q, v = _later(q, v, force[-1] + pull, time[1] / 20)
    noise = 0.5 * STEP_m * np.random.default_rng(0).standard_normal(len(time))
    position = np.round((np.array(recorded) + noise) / STEP_m) * STEP_m
    return si.Recording(
        "drive", time, {"force": np.array(force), "position": position}, {"force": "N", "position": "m"}
    )


def _later(q: float, v: float, force: float, h: float) -> tuple[float, float]:
    """A step of Runge and Kutta."""

    def rate(v):
        return (force - VISCOUS * v - DRY_N * math.tanh(v / 2e-3)) / MASS_kg

    k1 = rate(v)
    k2 = rate(v + h / 2 * k1)
    k3 = rate(v + h / 2 * k2)
    k4 = rate(v + h * k3)
    return q + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def test_the_floor_of_an_encoder_may_be_the_rounding_of_a_file_after_a_filter(driven):
    pieces = segments_of(positioning(), driven, driven.interval)
    found = audit(positioning(), driven, pieces, None)
    assert found.filtered and found.doubtful
    plain = unfiltered(found, pieces)
    assert not plain.filtered and plain.filter is None and plain.noise[0] == pytest.approx(1e-6, rel=0.5)


@pytest.mark.slow
def test_dry_friction_of_a_drive_is_found_with_its_encoder(driven):
    model, asked = positioning(), ("coulomb_friction", "constant_torque", "cubic_stiffness")
    suspects = [s for s in si.suspects(model) if s.term.name in asked]
    found = si.diagnose(model, driven, fit_window=(0, 10), held_out=(10, 16), suspects=suspects, threads=1)
    assert [e.name for e in found.effects] == ["coulomb_friction"] and found.confirmed
    assert "filtered" not in str(found)
    value, error = found.effects[0].parameters["torque_Nm"]
    assert abs(value - DRY_N) < max(3 * error, 0.01 * DRY_N)


@pytest.mark.slow
def test_dry_friction_and_a_pull_of_a_drive_whose_input_may_be_held_are_found_together():
    """Either alone explains little, a stiffness more; how abruptly friction sets in hangs on what the input does."""
    model, asked = positioning("either"), ("coulomb_friction", "constant_torque", "cubic_stiffness")
    suspects = [s for s in si.suspects(model) if s.term.name in (*asked, "quadratic_stiffness", "asymmetric_damping")]
    found = si.diagnose(model, slid(8.0), fit_window=(0, 10), held_out=(10, 16), suspects=suspects, threads=1)
    told = {e.name: e.parameters["torque_Nm"] for e in found.effects}
    assert found.verdict == "missing_physics" and told.keys() == {"coulomb_friction", "constant_torque"}
    for name, true in (("coulomb_friction", DRY_N), ("constant_torque", 8.0)):
        value, error = told[name]
        assert value == pytest.approx(true, abs=3 * error) and error < 1e-4 * true


def test_a_file_with_digits_after_a_filter_stays_filtered():
    time = np.arange(0, 60, 0.01)
    motion = np.sin(4.4 * time) + 0.3 * np.sin(12 * time + 1)
    smooth = filtfilt(*butter(2, 0.16), motion + 0.05 * np.random.default_rng(2).standard_normal(len(time)))
    model = si.Model("swing")
    model.a, model.w = si.State(unit="rad"), si.State(unit="rad/s")
    model.k = si.Parameter(unit="1/s^2", bounds=(0, 1000))
    model.kinematics, model.balance = si.Equation(model.a.dot - model.w), si.Equation(model.w.dot + model.k * model.a)
    model.angle = si.Output(model.a, channel="angle")
    recording = si.Recording("swing", time, {"angle": np.round(smooth, 5)}, {"angle": "rad"})
    found = audit(model, recording, segments_of(model, recording, recording.interval), None)
    assert found.filter.cutoff == pytest.approx(8.0, rel=0.15)


@pytest.mark.slow
def test_a_filter_is_undone_from_all_samples_that_it_made(monkeypatch):
    """A fit of free motion takes one sample in several of so many; the noise of those is not what the filter left."""
    monkeypatch.setattr("symid.estimation.signals.data.MOST_SAMPLES", 1500)
    swing = pendulum_recording(duration=27, step=0.004)
    noisy = swing["angle"] + 0.003 * np.random.default_rng(0).standard_normal(len(swing.time))
    filtered = {**swing.channels, "angle": filtfilt(*butter(2, 0.25), noisy)}
    recording = si.Recording("dense", swing.time, filtered, swing.units)
    found = si.diagnose(pendulum(), recording, fit_window=(0, 18), held_out=(18, 27), driven=False, threads=1)
    assert found.verdict == "adequate"
    assert "The recording was low-pass filtered" in str(found) and "The noise is not white" not in str(found)
