"""Stops on one side: a lower leg that swings freely and meets one, as in Wartenberg's test of the knee."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.discrepancy.model.sizes import sizes_of
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_of
from symid.mechanics.places import with_places
from symid.simulation import simulator

RATE_HZ, SECONDS, FINE = 100, 6, 10
STOPS = "upper_stop", "lower_stop"
BEGINS = 1.2, 0.9, -0.8, 1.1


def leg() -> si.Model:
    m = si.Model("leg")
    m.knee, m.speed = si.State(unit="rad"), si.State(unit="rad/s")
    m.inertia, m.weight = si.Constant(0.35, unit="kg*m^2"), si.Constant(9.0, unit="N*m")
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 5))
    m.stiffness = si.Parameter(unit="N*m/rad", bounds=(0, 50))
    m.kinematics = si.Equation(m.knee.dot - m.speed)
    held = m.weight * sm.sin(m.knee) + m.stiffness * m.knee + m.damping * m.speed
    m.balance = si.Equation(m.inertia * m.speed.dot + held)
    m.seen = si.Output(m.knee, channel="knee")
    return m


def swings(side: int, stop: float, stiffness: float, seed: int) -> si.Recording:
    """Four swings, one after the other, from rest at angles of their own. side : 1 of a stop above, -1 below `stop`."""
    rng, h, found = np.random.default_rng(seed), 1 / RATE_HZ / FINE, []

    def rates(x: np.ndarray) -> np.ndarray:
        beyond = side * max(side * (x[0] - stop), 0.0)
        return np.array([x[1], -(9 * np.sin(x[0]) + 2 * x[0] + 0.35 * x[1] + stiffness * beyond) / 0.35])

    for angle in BEGINS:
        x = np.array([angle, 0.0])
        for k in range(RATE_HZ * SECONDS * FINE):
            if k % FINE == 0:
                found.append(x[0])
            k1 = rates(x)
            k2 = rates(x + h / 2 * k1)
            k3 = rates(x + h / 2 * k2)
            x = x + h / 6 * (k1 + 2 * (k2 + k3) + rates(x + h * k3))
    seen = np.array(found) + 3e-3 * rng.standard_normal(len(found))
    return si.Recording("leg", np.arange(len(seen)) / RATE_HZ, {"knee": seen}, units={"knee": "rad"})


def test_stops_are_looked_for_in_the_recorded_range_only():
    model, made = with_places(leg()), swings(1, 0.6, 0.0, 1)
    data = Data(segments_of(model, made, (0, SECONDS - 0.01), None), np.full(1, 3e-3), False)
    found = {s.term.name: s for s in si.suspects(model, sizes_of(fit_model(model, data), data))}
    low, high = (float(f(data.segments[0].recorded)) for f in (np.min, np.max))
    for name in STOPS:
        angle = found[name].law.parameters[1]
        assert angle.bounds == pytest.approx((low, high))
        assert (angle.starts[0] > (low + high) / 2) is (name == "upper_stop") and low < angle.starts[0] < high
    assert not {s.term.name for s in si.suspects(model)} & set(STOPS)  # nothing tells where it moves


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "side", "angle", "stiffness"), [("upper_stop", 1, 0.6, 60.0), ("lower_stop", -1, -0.4, 20.0)]
)
def test_a_stop_is_described(name, side, angle, stiffness):
    """Its force was told as a push in each of the swings."""
    made, end = swings(side, angle, stiffness, 1), SECONDS * len(BEGINS)
    windows = {"fit_window": (0, end - SECONDS - 0.01), "held_out": (end - SECONDS, end - 0.01)}
    found = si.diagnose(leg(), made, **windows, segment_length=SECONDS, threads=1)
    assert found.verdict == "unexplained" and "meets a stop, or a band" in found.words, str(found)
    assert [e.name for e in found.effects] == [name] and found.confirmed, str(found)
    for key, true in (("angle_rad", angle), ("k_Nm_rad", stiffness)):
        value, error = found.effects[0].parameters[key]
        assert value == pytest.approx(true, abs=4 * error)


@pytest.mark.parametrize("known", [False, True])
def test_the_range_of_a_cord_counts_from_its_natural_length(known):
    """What outputs and inputs show is the distance of its ends."""
    m = si.Model("cord")
    m.x, m.v, m.hand, m.pace = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="m"), si.Input(unit="m/s")
    m.k = si.Parameter(unit="N/m", bounds=(1, 1e3))
    m.length = si.Constant(0.5, unit="m") if known else si.Parameter(unit="m", bounds=(0, 3))
    m.c, m.motion = si.Constant(2.0, unit="N*s/m"), si.Equation(m.x.dot - m.v)
    m.mass = si.Equation(m.v.dot + m.k * (m.x - m.hand - m.length) + m.c * (m.v - m.pace) - 9.81)
    m.seen = si.Output(m.x, channel="camera")
    if known:
        m.cord = si.Port(
            position=m.x - m.hand - m.length, rate=m.v - m.pace, into={"mass": -1.0}, role="joint", at="cord", unit="N"
        )
    time = np.arange(0, 6, 0.02)
    hand, pace = 0.1 * np.sin(5 * time), 0.5 * np.cos(5 * time)
    start, values = np.array([0.5 + 9.81 / 60, 0.0]), {"k": 60.0} | ({} if known else {"length": 0.5})
    path = simulator(m).simulate(values, start, time, {"hand": hand, "pace": pace}).y[:, 0]
    data = Data((Segment(time, path[:, None], {"hand": hand, "pace": pace}),), np.array([1e-3]), driven=False)
    fit = fit_model(with_places(m), data, values)
    ((middle, half),) = [r for place, r in sizes_of(fit, data).ranges.items() if place != "camera"]
    stretch = path - hand - 0.5
    assert middle == pytest.approx((stretch.max() + stretch.min()) / 2, abs=2e-3)
    assert half == pytest.approx(np.ptp(stretch) / 2, abs=2e-3)
