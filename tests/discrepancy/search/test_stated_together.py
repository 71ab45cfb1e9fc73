"""An arm with a payload that nobody stated: three constants of its forearm are wrong at once."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy.name.stated_together import is_stated, stated_together
from symid.simulation import simulator

RATE, SECONDS, NOISE = 100, 40, 0.003
STATED = {"m1": 2.0, "m2": 1.2, "l1": 0.4, "c1": 0.2, "c2": 0.18, "I1": 0.03, "I2": 0.015, "g": 9.81}
UNITS = {"m": "kg", "l": "m", "c": "m", "I": "kg*m^2", "g": "m/s^2"}


def arm(**other: float) -> si.Model:
    """Two links in a vertical plane with a torque at each joint."""
    m = si.Model("arm")
    m.a, m.b = si.State(unit="rad"), si.State(unit="rad")
    m.va, m.vb = si.State(unit="rad/s"), si.State(unit="rad/s")
    m.u1, m.u2 = si.Input(unit="N*m", hold="linear"), si.Input(unit="N*m", hold="linear")
    for name, value in (STATED | other).items():
        setattr(m, name, si.Constant(value, unit=UNITS[name[0]]))
    m.d1, m.d2 = si.Parameter(unit="N*m*s/rad", bounds=(0, 10)), si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    bent, turned = m.m2 * m.l1 * m.c2 * sm.cos(m.b), m.m2 * m.l1 * m.c2 * sm.sin(m.b)
    own = m.I2 + m.m2 * m.c2**2
    whole = m.I1 + m.m1 * m.c1**2 + m.m2 * m.l1**2 + own + 2 * bent
    weight = m.g * m.m2 * m.c2 * sm.sin(m.a + m.b)
    m.turns, m.bends = si.Equation(m.a.dot - m.va), si.Equation(m.b.dot - m.vb)
    m.shoulder = si.Equation(
        whole * m.va.dot
        + (own + bent) * m.vb.dot
        - turned * m.vb * (2 * m.va + m.vb)
        + m.g * (m.m1 * m.c1 + m.m2 * m.l1) * sm.sin(m.a)
        + weight
        + m.d1 * m.va
        - m.u1
    )
    m.elbow = si.Equation((own + bent) * m.va.dot + own * m.vb.dot + turned * m.va**2 + weight + m.d2 * m.vb - m.u2)
    m.seen1, m.seen2 = si.Output(m.a, channel="q1"), si.Output(m.b, channel="q2")
    return m


def carrying(mass: float, at: float) -> dict[str, float]:
    """The forearm's constants with a payload `at` that distance from the elbow (Steiner 1840)."""
    m, c, inertia = (STATED[k] for k in ("m2", "c2", "I2"))
    centre = (m * c + mass * at) / (m + mass)
    return {"m2": m + mass, "c2": centre, "I2": inertia + m * (c - centre) ** 2 + mass * (at - centre) ** 2}


def recorded(true: si.Model) -> si.Recording:
    rng, time = np.random.default_rng(1), np.arange(SECONDS * RATE) / RATE
    pushes = [gaussian_filter1d(rng.standard_normal(time.size), width) for width in (25, 20)]
    u1, u2 = (size * push / push.std() for size, push in zip((5.0, 2.0), pushes, strict=True))
    run = simulator(true).simulate(
        {"d1": 0.6, "d2": 0.4}, {"a": 0, "b": 0, "va": 0, "vb": 0}, time, {"u1": u1, "u2": u2}, substeps=5
    )
    seen = {f"q{i + 1}": run.y[:, i] + NOISE * rng.standard_normal(time.size) for i in range(2)}
    units = {"q1": "rad", "q2": "rad", "u1": "N*m", "u2": "N*m"}
    return si.Recording("arm", time, seen | {"u1": u1, "u2": u2}, units)


@pytest.mark.slow
def test_a_payload_is_told_by_the_three_constants_that_it_changes():
    payload = carrying(0.15, 0.35)
    found = si.diagnose(arm(), recorded(arm(**payload)), fit_window=(0, 24), held_out=(24, 40), threads=2)
    assert found.verdict == "missing_physics" and found.confirmed, str(found)
    assert {e.location for e in found.effects} == payload.keys()
    for e in found.effects:
        value, error = e.parameters["factor"]
        assert value == pytest.approx(payload[e.location] / STATED[e.location], abs=4 * error) and error < 1e-3


class Sums:
    """Hypotheses that are worth what each stated value explains, less 10 for each."""

    def __init__(self, explains: dict[str, float]):
        self.explains, self.sets = explains, []

    def together(self, sets, near):
        return [self.made(suspects) for suspects, _ in sets]

    def made(self, suspects):
        names = {s.term.location: s.off for s in suspects}
        self.sets.append(set(names))
        values = {k: 1.0 + self.explains.get(place, 0.0) for place, off in names.items() for k in off}
        fit = SimpleNamespace(values=values, errors=dict.fromkeys(values, 1.0))
        return SimpleNamespace(suspects=tuple(suspects), fit=fit)

    def better(self, one, other):
        return max(one, other, key=lambda h: sum(self.explains.get(s.term.location, 0) - 10 for s in h.suspects))


def test_what_may_be_as_stated_is_left_out_again():
    pool = [s for s in si.suspects(arm()) if is_stated(s)]
    assert {s.term.location for s in pool} == STATED.keys() - {"g"}
    sums = Sums({"m2": 500.0, "c2": 300.0, "I2": 40.0, "m1": 4.0})
    first = sums.made([s for s in pool if s.term.location in ("m2", "c1")])
    found = stated_together(first, pool, sums.together, sums.better)
    assert {s.term.location for s in found.suspects} == {"m2", "c2", "I2"}
    assert sums.sets[1] == STATED.keys() - {"g"}


def test_what_was_found_beside_a_stated_value_is_weighed_against_all_of_these():
    pool = si.suspects(arm())
    friction = next(s for s in pool if s.term.name == "coulomb_friction")
    mass = next(s for s in pool if is_stated(s))
    sums = Sums({})
    assert stated_together(sums.made([mass, friction]), pool, sums.together, sums.better) is not None
    assert sums.sets[1] == STATED.keys() - {"g"}
    assert stated_together(sums.made([friction]), pool, sums.together, sums.better) is None
    assert stated_together(sums.made([mass]), [mass], sums.together, sums.better) is None
