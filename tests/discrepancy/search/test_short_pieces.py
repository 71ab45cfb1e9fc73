"""What a plant lacks that falls over without its controller: found by way of pieces in which it hardly falls."""

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy import Suspect
from symid.discrepancy.model.dry import with_friction_speeds
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.name.trial.short_pieces import ShortPieces
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import cut
from symid.estimation.signals.segment import Segment
from symid.mechanics import LIBRARY

CART, POLE, LENGTH, G, DAMPING = 0.94, 0.23, 0.33, 9.81, 5.4
NOISE = np.array([1e-5, 5e-4])
JUMP = "forces_place_friction_speed"


def cart_pole() -> si.Model:
    m = si.Model("cart with a balanced pole")
    m.cart, m.pole, m.v, m.w = (si.State(unit=u) for u in ("m", "rad", "m/s", "rad/s"))
    m.force, m.mass = si.Input(unit="N", hold="smooth"), si.Parameter(unit="kg", bounds=(0.1, 10))
    m.damping = si.Parameter(unit="N*s/m", bounds=(0, 100))
    sin, cos = sm.sin(m.pole.symbol), sm.cos(m.pole.symbol)
    m.k1, m.k2 = si.Equation(m.cart.dot - m.v), si.Equation(m.pole.dot - m.w)
    swing = POLE * LENGTH * (cos * m.w.dot - sin * m.w**2)
    m.forces = si.Equation((m.mass + POLE) * m.v.dot + swing + m.damping * m.v - m.force)
    m.moments = si.Equation(POLE * LENGTH * (cos * m.v.dot + LENGTH * 4 / 3 * m.w.dot - G * sin))
    m.y1, m.y2 = si.Output(m.cart), si.Output(m.pole)
    return m


def balanced(lacking) -> Data:
    """Six seconds of a balanced pole whose cart meets a further force [N] of its position and speed, in four pieces."""
    time = np.arange(0, 6, 0.01)

    def controlled(t, s):
        return 40 * (s[0] - 0.1 * np.sin(t) - 0.06 * np.sin(2.3 * t)) + 150 * s[1] + 45 * s[2] + 30 * s[3]

    def rates(t, s):
        sin, cos = np.sin(s[1]), np.cos(s[1])
        mass = np.array([[CART + POLE, POLE * LENGTH * cos], [POLE * LENGTH * cos, 4 / 3 * POLE * LENGTH**2]])
        pull = controlled(t, s) - DAMPING * s[2] + lacking(s[0], s[2]) + POLE * LENGTH * sin * s[3] ** 2
        return [s[2], s[3], *np.linalg.solve(mass, [pull, POLE * G * LENGTH * sin])]

    s = solve_ivp(rates, (0, 6), [0, 0.01, 0, 0], "DOP853", t_eval=time, rtol=1e-8, atol=1e-10, max_step=0.01).y
    seen = s[:2].T + NOISE * np.random.default_rng(2).standard_normal((len(time), 2))
    return Data(tuple(cut(Segment(time, seen, {"force": controlled(time, s)}), 1.5)), NOISE, driven=False)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "size", "lacking"),
    [
        ("torsional_spring", 3.0, lambda x, v: -3.0 * x),
        ("coulomb_friction", 0.8, lambda x, v: -0.8 * np.tanh(v / 5e-3)),
    ],
)
def test_a_force_at_a_cart_whose_pole_falls_when_followed_from_one_state(law, size, lacking):
    """Fitted in the whole pieces from nothing, both ended at half their size, and other names explained more."""
    data = balanced(lacking)
    given = with_friction_speeds(si.mechanics.with_places(cart_pole()), data.segments, NOISE)
    base, suspect = fit_model(given, data), Suspect(LIBRARY[law].at("cart"))
    assert ShortPieces(base, data, []).parts() >= 3
    (found,) = explore(base, data, [suspect], jumps=[JUMP])
    values = list(found.fit.values.values())
    assert values[-1] == pytest.approx(size, rel=2e-3) and values[0] == pytest.approx(CART, rel=5e-3)
    if law == "coulomb_friction":
        assert found.fit.model.constants[JUMP].value == pytest.approx(5e-3, rel=0.1)
        assert found.base.model.constants[JUMP].value == found.fit.model.constants[JUMP].value


# ---- three discs on a shaft, with play between two ---------------------------------------------
INERTIA, SHAFT, LOSS, PLAY = np.array([0.0024, 0.0019, 0.0019]), (2.8, 2.6), np.array([0.008, 0.0009, 0.0011]), 0.02


def discs() -> si.Model:
    m = si.Model("three discs")
    m.torque = si.Input(unit="N*m", hold="linear")
    m.k1, m.k2 = (si.Parameter(unit="N*m/rad", bounds=(0.1, 50)) for _ in "12")
    for i in range(3):
        setattr(m, f"q{i}", si.State(unit="rad"))
        setattr(m, f"w{i}", si.State(unit="rad/s"))
        setattr(m, f"c{i}", si.Parameter(unit="N*m*s/rad", bounds=(0, 1)))
    pulls = [m.torque.symbol, m.k1 * (m.q0 - m.q1), m.k2 * (m.q1 - m.q2), 0]
    for i in range(3):
        setattr(m, f"turns{i}", si.Equation(m[f"q{i}"].dot - m[f"w{i}"]))
        net = pulls[i] - pulls[i + 1] - m[f"c{i}"] * m[f"w{i}"]
        setattr(m, f"disc{i}", si.Equation(INERTIA[i] * m[f"w{i}"].dot - net))
        setattr(m, f"seen{i}", si.Output(m[f"q{i}"]))
    return m


def turned() -> Data:
    """19 s of the discs under a random torque, in which the play is met many times."""
    rng, rate, fine = np.random.default_rng(1), 100, 10
    torque = gaussian_filter1d(rng.standard_normal(19 * rate + 1), 6)
    torque *= 0.25 / torque.std()
    time, at = np.arange(len(torque)) / rate, np.arange(19 * rate * fine) / (rate * fine)

    def rates(t, x):
        slack = x[1] - x[2] - np.clip(x[1] - x[2], -PLAY, PLAY)
        first, second = SHAFT[0] * (x[0] - x[1]), SHAFT[1] * slack
        pulls = np.array([np.interp(t, time, torque) - first, first - second, second])
        return np.concatenate([x[3:], (pulls - LOSS * x[3:]) / INERTIA])

    x, path, h = np.zeros(6), [], 1 / (rate * fine)
    for t in at:
        path.append(x)
        k1 = rates(t, x)
        k2 = rates(t + h / 2, x + h / 2 * k1)
        k3 = rates(t + h / 2, x + h / 2 * k2)
        x = x + h / 6 * (k1 + 2 * (k2 + k3) + rates(t + h, x + h * k3))
    seen = np.array(path)[::fine, :3]
    seen += 4e-4 * rng.standard_normal(seen.shape)
    return Data((Segment(time[:-1], seen, {"torque": torque[:-1]}),), np.full(3, 4e-4), driven=False)


@pytest.mark.slow
def test_a_play_that_is_met_many_times_is_fitted_by_way_of_short_parts():
    """No step of the whole gained any more at a fifth of what the play explains."""
    data, model = turned(), si.mechanics.with_places(discs())
    base = fit_model(model, data)
    (suspect,) = [s for s in si.suspects(model) if str(s.term) == "play@q1-q2"]
    short = ShortPieces(base, data, [])
    assert short.fitted(suspect, {"gap_rad": 0.01}, 0.0) is None
    found = short.fitted(suspect, {"gap_rad": 0.01}, 0.0, leading=[base])
    assert found.fit.values[suspect.term.parameter_name("gap_rad")] == pytest.approx(PLAY, rel=0.02)
    assert found.fit.values["k2"] == pytest.approx(SHAFT[1], rel=0.02) and abs(base.values["k2"] / SHAFT[1] - 1) > 0.1
