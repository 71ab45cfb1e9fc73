"""Mistakes of units and signs are told by their likely cause; what is right is left in peace."""

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from conftest import ROOT, pendulum, pendulum_recording
from mistakes import BODIES, RECORDINGS, only_one

import symid as si
from symid.cases import read_case
from symid.errors import RecordingWarning
from symid.plausibility import body_remarks, channel_remarks, remarks
from symid.plausibility.evidence import Witness
from symid.plausibility.motion import motion_of
from symid.recording import Recording, read_recording
from symid.synthetic import BODY, standing_recording

DATA = ROOT / "data" / "standing_synthetic"
CHILD = replace(
    BODY,
    leg_length=0.52,
    leg_com=0.29,
    trunk_com=0.2,
    leg_mass=6.4,
    trunk_mass=13.1,
    leg_inertia=0.185,
    trunk_inertia=0.35,
)
"""A child of about 1.06 m and 19.5 kg, with the proportions of Winter (2009)."""


def person(body=BODY, law=None):
    return body.with_feedback(law or si.mechanics.FullStatePD())


@pytest.fixture(scope="module")
def swaying() -> Recording:
    """A child, whom no practice case shows, at another rate and with noise of another size."""
    gains = {
        "kp_aa": 190.0,
        "kp_ah": 70.0,
        "kp_ha": 20.0,
        "kp_hh": 60.0,
        "kd_aa": 30.0,
        "kd_ah": 11.0,
        "kd_ha": 8.0,
        "kd_hh": 7.0,
        "ref_ankle": 0.02,
        "ref_hip": -0.03,
    }
    return standing_recording(
        person(CHILD), gains, duration=40.0, rate=80.0, seed=11, torque_noise=0.6, sensor_noise=2e-4
    )


@pytest.mark.parametrize(
    "law", [si.mechanics.FullStatePD(), si.mechanics.PD(), si.mechanics.FullStatePD(delay=(0.0, 0.3))], ids=repr
)
def test_what_is_right_is_left_in_peace(swaying, law):
    assert remarks(person(CHILD, law), swaying) == []


@pytest.mark.parametrize(
    ("name", "bare"),
    [
        *((name, True) for name in RECORDINGS),
        *(pytest.param(name, False, marks=pytest.mark.slow) for name in RECORDINGS),
    ],
)
def test_a_mistake_in_a_recording_is_named(swaying, name, bare):
    """With angles and the platform's acceleration alone, and with all rates."""
    plant, words = RECORDINGS[name]
    kept = swaying.select("ankle_angle", "hip_angle", "platform_acceleration") if bare else swaying
    found = remarks(person(CHILD), plant(kept))
    assert any(re.search(words, text) for text in found), found


@pytest.mark.parametrize("body", [BODY, CHILD], ids=["adult", "child"])
@pytest.mark.parametrize("name", BODIES)
def test_a_mistake_in_a_body_is_named(body, name):
    plant, words = BODIES[name]
    assert body_remarks(person(body)) == []
    found = body_remarks(person(plant(body)))
    assert any(words in text for text in found), found


@pytest.mark.parametrize("law", [si.mechanics.PD(), si.mechanics.FullStatePD(), si.mechanics.NeuralNetwork()])
def test_the_recording_that_ships_raises_no_remark(law):
    body = si.mechanics.DoubleLinkPendulum.from_json(DATA / "body.json")
    assert remarks(person(body, law), read_recording(DATA / "recording.csv")) == []


@pytest.mark.parametrize("law, blind", [(si.mechanics.NeuralNetwork(), True), (si.mechanics.FullStatePD(), False)])
def test_a_network_is_not_asked_about_a_recording(law, blind):
    body = si.mechanics.DoubleLinkPendulum.from_json(DATA / "body.json")
    motion = motion_of(person(body, law), read_recording(DATA / "recording.csv"))
    assert Witness(person(body, law), motion).is_blind == blind


@pytest.mark.parametrize("damping, strength", [(0.1, 0.0), (0.4, 1.0), (0.2, 0.3)])
@pytest.mark.parametrize("channel, factor", [("angle", 180 / np.pi), ("angle", -1.0), ("drive", -1.0)])
def test_a_first_look_at_few_samples_changes_no_remark(monkeypatch, damping, strength, channel, factor):
    """Also of a motion that dies away, of which the beginning alone tells much."""
    recording = pendulum_recording(damping=damping, duration=80.0, noise=1e-3, strength=strength)
    bad = replace(recording, channels=dict(recording.channels) | {channel: factor * recording[channel]})
    found = []
    for few in (250, 10**9):
        monkeypatch.setattr("symid.plausibility.mistakes.FEW", few)
        found.append(remarks(pendulum(), bad))
    assert found[0] == found[1]
    assert strength == 0.0 or any("far better if" in text for text in found[0])


@pytest.mark.slow
def test_no_shipped_case_raises_a_remark():
    for folder in sorted((ROOT / "data" / "concealed" / "cases").iterdir()):
        case = read_case(folder)
        assert remarks(case.model, case.recording) == [], folder.name


@pytest.mark.slow
def test_no_practice_case_and_no_real_recording_raises_a_remark(shared):
    for folder in sorted((shared / "concealed" / "cases").iterdir()):
        case = read_case(folder)
        assert remarks(case.model, case.recording) == [], folder.name
    folder = shared / "recordings" / "standing_subject05"
    body = si.mechanics.DoubleLinkPendulum.from_json(folder / "body.json")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # one odd sample at 50 Hz
        for rate in (50, 100):
            recording = read_recording(folder / f"recording_{rate}hz.csv")
            for law in (si.mechanics.PD(), si.mechanics.FullStatePD(), si.mechanics.NeuralNetwork()):
                assert remarks(person(body, law), recording) == []
    rig = shared / "recordings" / "double_pendulum_rig"
    recording = read_recording(rig / "recording_250hz.csv")
    assert remarks(si.mechanics.rig_model(rig / "published_parameters.json", recording.channels), recording) == []
    for name, restoring in (("air_track_glider", lambda x: x), ("slow_pendulum", sm.sin)):
        recording = read_recording(shared / "recordings" / name / "recording.csv", allow_gaps=True)
        assert channel_remarks(recording) == []
        assert remarks(swings(recording, restoring), recording) == []


def swings(recording: Recording, restoring) -> si.Model:
    """A damped oscillator whose position is the recording's only channel."""
    (channel,) = recording.channels
    m = si.Model("swings")
    m.x, m.v = si.State(unit=recording.units[channel]), si.State(unit=recording.units[channel] + "/s")
    m.k, m.c = si.Parameter(unit="1/s^2", bounds=(0, 100)), si.Parameter(unit="1/s", bounds=(0, 5))
    m.moves = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.k * restoring(m.x) + m.c * m.v)
    m.seen = si.Output(m.x, channel=channel)
    return m


# -- other systems ----------------------------------------------------------------------------


def cart_pole() -> si.Model:
    """A pole on a cart that a recorded force moves (Barto, Sutton & Anderson 1983), friction of the cart unknown."""
    m = si.Model("cart-pole")
    m.position, m.angle = si.State(unit="m", bounds=(-10, 10)), si.State(unit="rad", bounds=(-10, 10))
    m.speed, m.rate = si.State(unit="m/s"), si.State(unit="rad/s")
    m.force = si.Input(unit="N")
    m.cart, m.pole = (
        si.Constant(1.0, unit="kg", role="mass", at="cart"),
        si.Constant(0.2, unit="kg", role="mass", at="pole"),
    )
    m.length, m.g = si.Constant(0.5, unit="m", role="length", at="pole"), si.Constant(9.81, unit="m/s^2")
    m.friction = si.Parameter(unit="N*s/m", bounds=(0, 10))
    sin, cos = sm.sin(m.angle), sm.cos(m.angle)
    m.moves, m.turns = si.Equation(m.position.dot - m.speed), si.Equation(m.angle.dot - m.rate)
    m.pushed = si.Equation(
        (m.cart + m.pole) * m.speed.dot
        + m.pole * m.length * (m.rate.dot * cos - m.rate**2 * sin)
        + m.friction * m.speed
        - m.force
    )
    m.swings = si.Equation(m.length * m.rate.dot + m.speed.dot * cos + m.g * sin)
    m.seen_position, m.seen_angle = si.Output(m.position), si.Output(m.angle)
    return m


@pytest.fixture(scope="module")
def pushed() -> Recording:
    """The cart-pole from SciPy's integrator, hanging, pushed by three sines; sensor noise of a good encoder."""
    from scipy.integrate import solve_ivp

    time = np.arange(0, 20, 0.01)
    force = lambda t: 2 * np.sin(2.9 * t) + 1.5 * np.sin(5.3 * t + 1) + np.cos(1.1 * t)  # noqa: E731

    def f(t, x):
        _, a, v, w = x
        matrix = [[1.2, 0.1 * np.cos(a)], [np.cos(a), 0.5]]
        right = [force(t) - 0.8 * v + 0.1 * w**2 * np.sin(a), -9.81 * np.sin(a)]
        return [v, w, *np.linalg.solve(matrix, right)]

    x = solve_ivp(f, (0, 20), [0, 0.4, 0, 0], t_eval=time, rtol=1e-9, atol=1e-10).y
    noise = np.random.default_rng(3).standard_normal((2, time.size))
    return Recording(
        "cart",
        time,
        {"position": x[0] + 1e-4 * noise[0], "angle": x[1] + 1e-3 * noise[1], "force": force(time)},
        {"position": "m", "angle": "rad", "force": "N"},
    )


CART = {
    "position in mm": (lambda r: only_one(r, "position", 1e3), "position holds millimetres"),
    "position labelled mm": (
        lambda r: only_one(r, "position", 1e-3),
        "position holds metres but is labelled as millimetres",
    ),
    "angle in degrees": (lambda r: only_one(r, "angle", 180 / np.pi), "angle holds degrees"),
    "angle labelled degrees": (lambda r: only_one(r, "angle", np.pi / 180), "angle holds radians"),
    "force reversed": (lambda r: only_one(r, "force", -1.0), "force has the opposite sign"),
    "angle reversed": (lambda r: only_one(r, "angle", -1.0), "angle has the opposite sign"),
    "time in ms": (lambda r: replace(r, time=1e3 * r.time), "milliseconds"),
    "force in mN": (lambda r: only_one(r, "force", 1e3), "force is a thousand times too large"),
}


def test_a_cart_pole_that_is_right(pushed):
    assert remarks(cart_pole(), pushed) == []


@pytest.mark.parametrize("name", CART)
def test_a_mistake_in_the_recording_of_a_cart_pole(pushed, name):
    plant, words = CART[name]
    found = remarks(cart_pole(), plant(pushed))
    assert any(words in text for text in found), found


def test_a_mistake_in_the_masses_of_a_cart_pole(pushed):
    heavy = cart_pole().with_constants(cart=10.0, pole=2.0)
    assert any("all masses are 10 times too large" in text for text in remarks(heavy, pushed))


def test_unknown_masses_do_not_pass_for_a_mistake(pushed):
    """Inertias that no-one knows begin at their lower bounds, far from what weighs the equations rightly."""
    unknown = cart_pole().free("cart", "pole")
    assert remarks(unknown, pushed) == []
    assert any("angle holds degrees" in text for text in remarks(unknown, only_one(pushed, "angle", 180 / np.pi)))


def slow(tmp_path, unit: str, factor: float) -> tuple[si.Model, Recording]:
    """A torsion pendulum that turns by a thousandth of a radian in half a minute, once a second, from a file."""
    m = si.Model("torsion")
    m.twist, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.stiffness = si.Parameter(unit="N*m/rad", bounds=(0, 1))
    m.inertia = si.Constant(1e-6, unit="kg*m^2")
    m.turns = si.Equation(m.twist.dot - m.rate)
    m.balance = si.Equation(m.inertia * m.rate.dot + m.stiffness * m.twist)
    m.mirror = si.Output(m.twist)
    time = np.arange(0.0, 300.0)
    path = tmp_path / "mirror.csv"
    rows = [f"{t:g},{x:.6g}" for t, x in zip(time, factor * 1e-3 * np.cos(0.2 * time), strict=True)]
    path.write_text("\n".join([f"time_s,twist_{unit}", *rows]))
    return m, read_recording(path)


@pytest.mark.parametrize(("unit", "factor"), [("mrad", 1e3), ("rad", 1.0)])
def test_slow_and_small_is_no_mistake(tmp_path, unit, factor):
    assert remarks(*slow(tmp_path, unit, factor)) == []


def test_small_numbers_of_degrees_may_be_radians(tmp_path):
    assert "if the file holds radians" in remarks(*slow(tmp_path, "deg", 1.0))[0]


# -- where it is said -------------------------------------------------------------------------


def test_a_solution_and_its_text_say_it(swaying):
    recording = only_one(swaying, "platform_acceleration", -1.0)
    problem = si.Identification(person(CHILD), recording, (0, 10))
    with pytest.warns(RecordingWarning, match="opposite sign"):
        solution = problem.solve(max_iterations=3)
    assert any("platform_acceleration has the opposite sign" in text for text in solution.warnings)
    assert "platform_acceleration has the opposite sign" in str(solution)
    assert solution.to_dict()["warnings"] == list(solution.warnings)
