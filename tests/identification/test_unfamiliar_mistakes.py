"""Mistakes of signs and units in recordings of small systems, and none where all is right."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from drawn_systems import System, log_uniform, smooth, system
from more_systems import declared, quarter_car
from small_systems import cart_pole, mass_spring_damper
from ugly_noise import measured
from unfamiliar_systems import UNFAMILIAR, flexible_joint, food_chain
from unseen_systems import duffing

import symid as si
from symid.model import as_shown
from symid.plausibility import remarks
from symid.plausibility.mistakes import model_remarks


def test_equations_that_explain_the_motion_from_other_first_values_are_not_questioned():
    """Parameters that enter nonlinearly, and a strongly nonlinear motion whose linearly foretold part is none."""
    chaotic = [duffing(np.random.default_rng(seed)) for seed in ([1, 23], [5005, 7], [5097, 7])]
    for drawn in (measured(food_chain, "white", 4), *chaotic):
        assert remarks(drawn.model, drawn.recordings[0]) == []


@pytest.mark.parametrize(("noise", "seed"), [("white", 6), ("proportional", 0), ("proportional", 9), ("heavy", 4)])
def test_equations_that_explain_half_the_motion_from_first_values_are_asked_from_others(noise, seed):
    """A product of two parameters, of which the first fit holds one at its bound: degrees were blamed for that."""
    drawn = measured(flexible_joint, noise, seed)
    (recording,) = drawn.recordings
    assert remarks(drawn.model, recording) == []
    for channel in ("base", "bend", "voltage"):
        wrong = replace(recording, channels=dict(recording.channels) | {channel: -recording[channel]})
        assert any(f"{channel} has the opposite sign" in text for text in remarks(drawn.model, wrong)), channel


@pytest.mark.slow
@pytest.mark.parametrize("noise", ["white", "proportional", "remembering", "heavy"])
@pytest.mark.parametrize("system", UNFAMILIAR, ids=lambda f: f.__name__)
def test_no_right_recording_of_systems_that_nothing_was_tuned_on_is_blamed(system, noise):
    """The 1440 of `plausibility.mistakes.BETTER`."""
    for seed in range(40):
        drawn = measured(system, noise, seed)
        assert model_remarks(drawn.model, drawn.recordings[0]) == [], seed


@pytest.mark.parametrize("seed", [0, *(pytest.param(s, marks=pytest.mark.slow) for s in (1, 2))])
def test_mistakes_beside_unknown_masses_are_named(seed):
    """Cart, bob and length of a cart-pole are unknown: they enter the accelerations nonlinearly."""
    drawn = cart_pole(np.random.default_rng([seed, 23]))
    (recording,) = drawn.recordings
    assert remarks(drawn.model, recording) == []
    for channel in ("x", "angle", "force"):
        channels = dict(recording.channels) | {channel: -recording[channel]}
        found = remarks(drawn.model, replace(recording, channels=channels))
        assert any("opposite sign" in text for text in found), (channel, found)


def test_a_constant_in_kilograms_is_a_mass_whether_its_model_says_so_or_not():
    drawn = mass_spring_damper(np.random.default_rng([0, 23]))
    assert remarks(drawn.model, drawn.recordings[0]) == []
    heavy = drawn.model.with_constants(mass=10.0)
    assert any("mass is 10 times too large" in text for text in remarks(heavy, drawn.recordings[0]))


def geared_arm() -> System:
    """A motor turns an arm with a weight through a gear and a shaft; both angles are measured."""
    rng = np.random.default_rng(31)
    m = declared(
        "geared arm",
        {"motor": "rad", "load": "rad", "vm": "rad/s", "vl": "rad/s"},
        {"k": ("N*m/rad", (1, 1000)), "d": ("N*m*s/rad", (0, 10)), "b": ("N*m*s/rad", (0, 0.1))},
    )
    m.torque = si.Input(unit="N*m", hold="zero")
    m.jm, m.jl = si.Constant(2e-5, unit="kg*m^2"), si.Constant(0.01, unit="kg*m^2")
    m.mass, m.com = si.Constant(0.8, unit="kg"), si.Constant(0.1, unit="m")
    shaft = m.k * (m.motor / 20 - m.load) + m.d * (m.vm / 20 - m.vl)
    m.one, m.two = si.Equation(m.motor.dot - m.vm), si.Equation(m.load.dot - m.vl)
    m.three = si.Equation(m.jm * m.vm.dot + shaft / 20 + m.b * m.vm - m.torque)
    m.four = si.Equation(m.jl * m.vl.dot - shaft + 9.81 * m.mass * m.com * sm.sin(m.load))
    m.y, m.z = si.Output(m.motor), si.Output(m.load)
    t = np.arange(0, 8, 0.005)
    torque = np.repeat(smooth(rng, t[::4], 2.0, 0.04), 4)
    return system(m, {"k": 25.0, "d": 0.05, "b": 1e-4}, [([0.0] * 4, t, {"torque": torque})], 0.01, rng)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({}, ""),
        ({"mass": 8.0, "jl": 0.1}, "mass and jl are 10 times too large"),
        ({"mass": 8.0, "jl": 0.1, "jm": 2e-4}, "all masses and inertias are 10 times too large"),
        ({"mass": 0.08, "jl": 1e-3, "jm": 2e-6}, "all masses and inertias are 10 times too small"),
    ],
)
def test_masses_that_are_wrong_together_with_their_inertias_are_named(wrong, said):
    drawn = geared_arm()
    found = remarks(drawn.model.with_constants(**wrong), drawn.recordings[0])
    assert all(said in text for text in found) and len(found) == bool(said)


def test_a_power_in_kilowatts_that_is_labelled_as_watts_is_named():
    rng, t = np.random.default_rng(37), np.arange(0, 10800, 10.0)
    m = declared("heated block", {"core": "K", "shell": "K"}, {"h": ("W/K", (0, 1000)), "o": ("W/K", (0, 1000))})
    m.power = si.Input(unit="W", hold="zero")
    m.one = si.Equation(1800 * m.core.dot - m.power + m.h * (m.core - m.shell))
    m.two = si.Equation(500 * m.shell.dot - m.h * (m.core - m.shell) + m.o * (m.shell - 293))
    m.y, m.z = si.Output(m.core), si.Output(m.shell)
    power = 100.0 * (np.sin(t / 300) > 0)
    drawn = system(m, {"h": 8.0, "o": 3.0}, [([295.0, 294.0], t, {"power": power})], 0.01, rng)
    recording = drawn.recordings[0]
    assert remarks(m, recording) == []
    wrong = replace(recording, channels=dict(recording.channels) | {"power": power / 1e3})
    assert any("power holds kilowatts" in text for text in remarks(m, wrong))


def pendulum(offset: float, seed: int) -> System:
    """A driven pendulum, whose sensor shows a little more."""
    rng = np.random.default_rng([seed, 29])
    m = si.Model("pendulum with an offset")
    m.angle, m.rate, m.torque = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="N*m")
    m.inertia, m.weight = si.Constant(0.5, unit="kg*m^2"), si.Constant(4.905, unit="N*m")
    m.c, m.offset = si.Parameter(unit="N*m*s", bounds=(0, 2)), si.Parameter(unit="rad", bounds=(-0.3, 0.3))
    m.moves = si.Equation(m.angle.dot - m.rate)
    m.turns = si.Equation(m.inertia * m.rate.dot + m.c * m.rate + m.weight * sm.sin(m.angle) - m.torque)
    m.seen = si.Output(m.angle + m.offset, unit="rad", channel="angle")
    t = np.arange(0, 20, 0.02)
    run = ([0.3, 0.0], t, {"torque": smooth(rng, t, 1.0, 0.8)})
    return system(m, {"c": 0.2, "offset": offset}, [run], 0.01, rng)


@pytest.mark.parametrize("offset", [-0.1, 0.05])
def test_mistakes_beside_an_unknown_offset_of_the_sensor_are_named(offset):
    drawn = pendulum(offset, 0)
    (recording,) = drawn.recordings
    assert remarks(drawn.model, recording) == []
    changes = {
        "torque has the opposite sign": {"torque": -recording["torque"]},
        "angle has the opposite sign": {"angle": -recording["angle"]},
        "angle holds degrees": {"angle": np.degrees(recording["angle"])},
        "torque is a thousand times too large": {"torque": 1e3 * recording["torque"]},
    }
    for words, channels in changes.items():
        found = remarks(drawn.model, replace(recording, channels=dict(recording.channels) | channels))
        assert any(words in text for text in found), (words, found)
    found = remarks(drawn.model.with_constants(inertia=5.0), recording)
    assert any("inertia is 10 times too large" in text for text in found), found


def geared_servo(seed: int) -> System:
    """A motor with dry friction: the angle is seen behind a gear, the speed before it; the current in amperes."""
    rng = np.random.default_rng([seed, 37])
    m = declared(
        "geared servo",
        {"motor": "rad", "speed": "rad/s"},
        {"b": ("N*m*s/rad", (0, 1)), "dry": ("N*m", (0, 1))},
        {"current": "A"},
    )
    m.inertia, m.torque = si.Constant(2e-4, unit="kg*m^2"), si.Constant(0.05, unit="N*m/A")
    m.gear = si.Constant(20.0, unit="1")
    m.moves = si.Equation(m.motor.dot - m.speed)
    m.turns = si.Equation(m.inertia * m.speed.dot + m.b * m.speed + m.dry * sm.tanh(m.speed / 2) - m.torque * m.current)
    m.shaft = si.Output(m.motor / m.gear, unit="rad", channel="shaft")
    m.tacho = si.Output(m.speed, unit="rad/s", channel="tacho")
    t = np.arange(0, 6, 0.005)
    run = ([0.0, 0.0], t, {"current": smooth(rng, t, 3.0, 0.3)})
    return system(m, {"b": log_uniform(rng, 1e-5, 1e-3), "dry": log_uniform(rng, 1e-4, 5e-3)}, [run], 0.01, rng)


@pytest.mark.parametrize("seed", range(2))
def test_mistakes_behind_a_gear_are_named(seed):
    drawn = geared_servo(seed)
    (recording,) = drawn.recordings
    assert remarks(drawn.model, recording) == []
    changes = {
        "shaft has the opposite sign": ("shaft", -1.0),
        "shaft holds degrees": ("shaft", 180 / np.pi),
        "tacho holds revolutions per minute": ("tacho", 30 / np.pi),
        "tacho holds radians": ("tacho", np.pi / 180),
        "current has the opposite sign": ("current", -1.0),
        "current is a thousand times too large (mA": ("current", 1e3),
    }
    for words, (channel, factor) in changes.items():
        channels = dict(recording.channels) | {channel: factor * recording[channel]}
        found = remarks(drawn.model, replace(recording, channels=channels))
        assert any(words in text for text in found), (words, found)
    swapped = {"shaft": recording["tacho"], "tacho": recording["shaft"]}
    found = remarks(drawn.model, replace(recording, channels=dict(recording.channels) | swapped))
    assert any("the columns of shaft and tacho are swapped" in text for text in found), found
    for factor, words in ((10.0, "inertia is 10 times too large"), (0.1, "inertia is 10 times too small")):
        found = remarks(drawn.model.with_constants(inertia=2e-4 * factor), recording)
        assert any(words in text for text in found), (words, found)


def test_a_gear_before_the_only_sensor_scales_the_speed_too():
    m = declared("gear", {"motor": "rad", "speed": "rad/s"}, {"b": ("1/s", (0, 1))}, {"current": "A"})
    m.gear = si.Constant(20.0, unit="1")
    m.moves, m.turns = si.Equation(m.motor.dot - m.speed), si.Equation(m.speed.dot + m.b * m.speed - m.current)
    m.shaft = si.Output(m.motor / m.gear, unit="rad")
    new = as_shown(m)
    assert sm.expand(new["shaft"].expr - m.motor) == 0 and new.rates() == {"speed": "motor"}
    assert sm.expand(new["turns"].expr - m.gear * (m.speed.dot + m.b * m.speed) + m.current) == 0


@pytest.mark.parametrize("seed", range(2))
def test_masses_that_the_parameters_nearly_make_up_for_are_named(seed):
    """With the wrong mass the equations still explain nine tenths of the motion of a quarter of a car."""
    drawn = quarter_car(np.random.default_rng([seed, 77]))
    (recording,) = drawn.recordings
    assert remarks(drawn.model, recording) == []
    for name, factor in (("mb", 10.0), ("mb", 0.1), ("mw", 10.0), ("mw", 0.1)):
        (found,) = remarks(drawn.model.with_constants(**{name: factor * drawn.model[name].value}), recording)
        assert f"{name} is 10 times too {'large' if factor > 1 else 'small'}" in found


@pytest.mark.parametrize("seed", range(2))
def test_milliseconds_that_the_parameters_make_up_for_are_named(seed):
    """Masses alone are known: stiffness a million times smaller explains a road that is passed in an hour and more."""
    drawn = quarter_car(np.random.default_rng([seed, 77]))
    (recording,) = drawn.recordings
    (found,) = remarks(drawn.model, replace(recording, time=1e3 * recording.time))
    assert "the time column holds milliseconds but is labelled as seconds" in found


def test_swapped_inputs_are_named():
    """A room between a radiator and the street, of which only the temperature of the air is measured."""
    rng, t = np.random.default_rng(43), np.arange(0, 3 * 86400, 300.0)
    m = declared("room", {"air": "K"}, {"loss": ("W/K", (0, 1e3))}, {"heat": "W", "outside": "K"})
    m.capacity = si.Constant(2e6, unit="J/K")
    m.warms = si.Equation(m.capacity * m.air.dot - m.heat - m.loss * (m.outside - m.air))
    m.seen = si.Output(m.air)
    given = {"heat": 1500 + smooth(rng, t, 3e-5, 400.0), "outside": 278 + smooth(rng, t, 2e-5, 3.0)}
    drawn = system(m, {"loss": 90.0}, [([292.0], t, given)], 0.005, rng)
    (recording,) = drawn.recordings
    assert remarks(m, recording) == []
    swapped = {"heat": recording["outside"], "outside": recording["heat"]}
    (found,) = remarks(m, replace(recording, channels=dict(recording.channels) | swapped))
    assert "the columns of heat and outside are swapped" in found


def test_a_length_in_millimetres_is_named():
    """A rod that hangs on a cart, as long as a leg: 843 in the place of 0.843."""
    rng = np.random.default_rng(41)
    m = declared("rod", {"angle": "rad", "rate": "rad/s"}, {"c": ("N*m*s/rad", (0, 5))}, {"acceleration": "m/s^2"})
    m.mass, m.length = si.Constant(2.0, unit="kg"), si.Constant(0.843, unit="m")
    m.inertia, d = si.Constant(0.12, unit="kg*m^2"), m.length / 2
    m.moves = si.Equation(m.angle.dot - m.rate)
    pull = m.mass * d * (9.81 * sm.sin(m.angle) + m.acceleration * sm.cos(m.angle))
    m.turns = si.Equation((m.inertia + m.mass * d**2) * m.rate.dot + m.c * m.rate + pull)
    m.seen, t = si.Output(m.angle), np.arange(0, 20, 0.02)
    drawn = system(m, {"c": 0.1}, [([0.1, 0.0], t, {"acceleration": smooth(rng, t, 1.5, 1.0)})], 0.01, rng)
    assert remarks(m, drawn.recordings[0]) == []
    (found,) = remarks(m.with_constants(length=843.0), drawn.recordings[0])
    assert "length is 1000 times too large" in found


def test_offsets_that_move_with_the_motion_are_none():
    drawn = pendulum(0.05, 1)
    model = as_shown(drawn.model)
    angle, offset = (sm.sympify(drawn.model[n]) for n in ("angle", "offset"))
    assert model["seen"].expr == angle and model["turns"].expr.has(sm.sin(angle - offset))
    assert as_shown(model).fingerprint == model.fingerprint
    slope = drawn.model.copy()
    slope.redefine("seen", angle + offset * slope.rate)
    assert as_shown(slope)["seen"].expr == slope["seen"].expr


@pytest.mark.parametrize(("damping", "per_period", "periods"), [(0.006, 2.5, 11.0), (0.006, 3.0, 4.0), (1.0, 2.5, 1.5)])
def test_an_actuator_that_a_square_wave_lets_ring_between_the_samples_is_not_blamed(damping, per_period, periods):
    """A piezo, in metres, a few samples to a period: smoothing takes the ringing for noise, and nothing fits."""
    rng = np.random.default_rng(31)
    m = si.Model("piezo")
    m.x, m.v, m.volts = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="V", hold="zero")
    w, gain = 2 * np.pi * 900, 80e-9
    m.w2 = si.Parameter(unit="1/s^2", bounds=(0, 10 * w**2))
    m.c, m.gain = si.Constant(2 * damping * w, unit="1/s"), si.Constant(gain, unit="m/V")
    m.moves = si.Equation(m.x.dot - m.v)
    m.rings = si.Equation(m.v.dot + m.c * m.v + m.w2 * (m.x - m.gain * m.volts))
    m.y = si.Output(m.x)
    t = np.arange(0, 200) / (per_period * 900)
    volts = 10 * np.sign(np.sin(np.pi * t * 900 / periods) + 1e-9)
    drawn = system(m, {"w2": w**2}, [([0.0, 0.0], t, {"volts": volts})], 0.01, rng)
    assert remarks(m, drawn.recordings[0]) == []
