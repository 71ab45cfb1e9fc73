"""What single laws of missing physics say: sizes, units, compositions."""

import numpy as np
import pytest
import sympy as sm
from term_models import CART, RIG, STANDING, effort

import symid as si
from symid.mechanics import LIBRARY, BenchDoublePendulum, lagrange_residuals


def test_dry_friction_of_a_standing_person_has_its_own_width():
    augmented = STANDING.with_term(LIBRARY["coulomb_friction"].at("ankle"))
    assert augmented.friction_speed.value == 0.02


def test_at_a_displacement_laws_have_units_of_force():
    augmented = CART.with_term(LIBRARY["viscous_friction"].at("cart"))
    assert augmented.viscous_friction_cart_coefficient_Nms_rad.unit == "N*s/m"


def test_a_push_is_a_sine_squared_within_its_time():
    term = LIBRARY["external_push"].at("joint1")
    force, _, augmented = effort(RIG, term)
    for key, value in (("peak_Nm", 3.0), ("start_s", 10.0), ("duration_s", 0.4)):
        force = force.subs(augmented[term.parameter_name(key)].symbol, value)
    push = sm.lambdify(RIG.time, force)
    inside = np.linspace(10.0, 10.4, 9)
    assert np.allclose(push(inside), 3 * np.sin(np.pi * (inside - 10) / 0.4) ** 2, atol=1e-3)
    assert np.allclose(push(np.array([0.0, 9.9, 10.5, 60.0])), 0, atol=1e-6)


def test_a_gain_change_multiplies_the_whole_torque_after_its_time():
    term = LIBRARY["gain_change"].at("ankle")
    augmented = STANDING.with_term(term)
    ratio = sm.simplify(augmented.inline(augmented.ankle_torque.symbol) / STANDING.inline(STANDING.ankle_torque.symbol))
    table = {
        augmented.gain_change_ankle_factor.symbol: 1.5,
        augmented.gain_change_ankle_time_s.symbol: 20.0,
        augmented.gain_change_ankle_switching_time.symbol: augmented.gain_change_ankle_switching_time.value,
    }
    assert [round(float(ratio.xreplace(table | {STANDING.time: t})), 6) for t in (19.8, 20.0, 20.2)] == [1.0, 1.25, 1.5]


def test_a_tilt_is_an_offset_of_both_sensors():
    """Turning the vertical by b is the same as reading both absolute angles b lower."""
    tilted = RIG.with_term(LIBRARY["gravity_tilt"].at("global"))
    b = tilted.gravity_tilt_global_bias_rad.symbol
    angles = {RIG.link1_angle.symbol: RIG.link1_angle - b, RIG.link2_angle.symbol: RIG.link2_angle - b}
    for new, old in zip(tilted.residual(), RIG.residual(), strict=True):
        new = new.xreplace({tilted.gravity_tilt_global_g_scale.symbol: sm.S.One})
        assert sm.expand(sm.expand_trig(new - old.xreplace(angles))) == 0


def test_base_motion_is_the_second_derivative_of_its_displacement():
    moved = RIG.with_term(LIBRARY["base_motion"].at("base"))
    amplitude, frequency, phase = (
        moved[f"base_motion_base_{k}"].symbol for k in ("amplitude_m", "frequency_Hz", "phase_rad")
    )
    displacement = amplitude * sm.sin(2 * sm.pi * frequency * RIG.time + phase)
    assert sm.expand(moved.base_acceleration.expr - sm.diff(displacement, RIG.time, 2)) == 0


def test_a_base_that_moves_up_and_down_adds_its_acceleration_to_gravity():
    moved = RIG.with_term(LIBRARY["vertical_base_motion"].at("base"))
    amplitude, frequency, phase = (
        moved[f"vertical_base_motion_base_{k}"].symbol for k in ("amplitude_m", "frequency_Hz", "phase_rad")
    )
    height = amplitude * sm.sin(2 * sm.pi * frequency * RIG.time + phase)
    forward, down = moved.find("gravity")
    assert sm.expand(down.expr - RIG.find("gravity")[1].expr - sm.diff(height, RIG.time, 2)) == 0
    assert forward.expr == RIG.find("gravity")[0].expr


def test_extra_mass_composes_the_link_anew():
    """A link of two point masses is the link of one of them with the other as extra mass."""
    one, two, at_one, at_two = 3.0, 2.0, 0.2, 0.5
    com = (one * at_one + two * at_two) / (one + two)
    inertia = one * (at_one - com) ** 2 + two * (at_two - com) ** 2
    together = BenchDoublePendulum(5.0, one + two, 0.1, com, 0.3, 0.01, inertia).plant()
    apart = (
        BenchDoublePendulum(5.0, one, 0.1, at_one, 0.3, 0.01, 0.0).plant().with_term(LIBRARY["extra_mass"].at("link2"))
    )
    values = [sm.Rational(k, 7) for k in range(1, 9)]
    state = {s: v for s, v in zip([y for x in RIG.states.values() for y in (x.symbol, x.dot)], values, strict=True)}

    def evaluated(m):
        table = {c.symbol: c.value for c in m.constants.values()} | {n.symbol: 0 for n in m.noises.values()} | state
        table |= {
            sm.Symbol("extra_mass_link2_mass_kg", real=True): two,
            sm.Symbol("extra_mass_link2_height_m", real=True): at_two,
        }
        return [float(r.xreplace(table)) for r in m.residual()]

    assert np.allclose(evaluated(together), evaluated(apart))


def test_an_elastic_mount_equals_lagranges_equations_with_the_mount_as_a_coordinate():
    model = RIG.with_term(LIBRARY["elastic_mount"].at("base"))
    mass, pace = 0.9, 2 * np.pi * 3.0
    q, v, a = (sm.symbols(f"{k}0:3", real=True) for k in "qva")
    c = RIG.constants
    m1, m2, a1, a2, L1, I1, I2, g = (c[k].value for k in ("m1", "m2", "a1", "a2", "L1", "I1", "I2", "gravity"))
    at = [
        (q[0] + a1 * sm.sin(q[1]), -a1 * sm.cos(q[1])),
        (q[0] + L1 * sm.sin(q[1]) + a2 * sm.sin(q[2]), -L1 * sm.cos(q[1]) - a2 * sm.cos(q[2])),
    ]
    speeds = [[sum(sm.diff(e, x) * w for x, w in zip(q, v, strict=True)) for e in point] for point in at]
    kinetic = (
        sum(m * (x**2 + y**2) for m, (x, y) in zip((m1, m2), speeds, strict=True)) / 2
        + (I1 * v[1] ** 2 + I2 * v[2] ** 2 + mass * v[0] ** 2) / 2
    )
    carried = mass + m1 + m2
    potential = g * (m1 * at[0][1] + m2 * at[1][1]) + carried * pace**2 * q[0] ** 2 / 2
    residual = sm.Matrix(lagrange_residuals(kinetic, potential, q, v, a))
    start = dict(zip((*q, *v), (0.02, 0.4, -0.7, 0.3, 1.5, -2.0), strict=True))
    matrix, force = residual.jacobian(a).xreplace(start), residual.xreplace(dict.fromkeys(a, 0)).xreplace(start)
    expected = -np.linalg.solve(np.array(matrix, float), np.array(force, float)[:, 0])

    states = (
        "elastic_mount_base_shift",
        "link1_angle",
        "link2_angle",
        "elastic_mount_base_speed",
        "link1_velocity",
        "link2_velocity",
    )
    table = {k.symbol: k.value for k in model.constants.values()} | {k.symbol: 0 for k in model.noises.values()}
    table |= {model[name].symbol: x for name, x in zip(states, start.values(), strict=True)}
    for key, value in (("inverse_mass_1_kg", 1 / carried), ("frequency_Hz", 3.0), ("damping_ratio", 0.0)):
        table[model[f"elastic_mount_base_{key}"].symbol] = value
    dots = [model[name].dot for name in states]
    f = sm.Matrix(model.residual()).xreplace(table)
    rates = -np.linalg.solve(
        np.array(f.jacobian(dots), float), np.array(f.xreplace(dict.fromkeys(dots, 0)), float)[:, 0]
    )
    assert np.allclose(rates[3:], expected)
    assert np.allclose(rates[:3], [start[w] for w in v])


def test_hysteresis_saturates_at_its_force_and_starts_as_a_spring():
    model = RIG.with_term(LIBRARY["bouc_wen_hysteresis"].at("joint1"))
    z, w = model.bouc_wen_hysteresis_joint1_strain, RIG.link1_velocity.symbol
    row = model.bouc_wen_hysteresis_joint1_strain_equation.expr.xreplace({z.dot: sm.S.Zero})
    assert row.xreplace({z.symbol: sm.S.Zero}) == -w
    assert row.xreplace({z.symbol: sm.S.One, w: sm.Integer(2)}) == 0
    assert row.xreplace({z.symbol: -sm.S.One, w: sm.Integer(-2)}) == 0


def test_a_bent_loop_saturates_or_stiffens_on_the_way_out_and_springs_back_steeper():
    model = RIG.with_term(LIBRARY["bent_hysteresis"].at("joint1"))
    z, w = model.bent_hysteresis_joint1_strain, RIG.link1_velocity.symbol
    rate = (-model.bent_hysteresis_joint1_strain_equation.expr).xreplace({z.dot: sm.S.Zero})
    shape = model.bent_hysteresis_joint1_shape.symbol

    def slope(strain, speed, bend):
        return float(rate.xreplace({z.symbol: sm.Float(strain), w: sm.Float(speed), shape: sm.Float(bend)}) / speed)

    assert slope(0.5, 2.0, 1.0) == 0.0 and slope(-0.5, -2.0, 1.0) == 0.0
    assert slope(0.5, 2.0, -1.4) == pytest.approx(1.2) and slope(-0.5, -2.0, -1.4) == pytest.approx(1.2)
    assert slope(0.5, -2.0, -1.4) == pytest.approx(2.2)


def test_cogging_comes_back_in_each_turn():
    force, _, augmented = effort(RIG, LIBRARY["cogging_torque"].at("joint1"))
    sizes = {"amplitude_Nm": 0.5, "waves_1_rad": 6.0, "phase_rad": 0.3}
    table = {augmented[f"cogging_torque_joint1_{k}"].symbol: v for k, v in sizes.items()}
    torque = sm.lambdify(RIG.link1_angle.symbol, force.xreplace(table))
    assert torque(0.2) == pytest.approx(0.5 * np.sin(6 * 0.2 + 0.3))
    assert torque(0.2 + np.pi / 3) == pytest.approx(torque(0.2))
    assert CART.with_term(LIBRARY["cogging_torque"].at("cart")).cogging_torque_cart_waves_1_rad.unit == "1/m"


def test_input_gain_and_delay_reach_the_drive_in_either_order():
    gain, delay = LIBRARY["input_gain"].at("input"), LIBRARY["input_delay"].at("input")
    for terms in ((gain, delay), (delay, gain)):
        model = STANDING.with_term(terms[0]).with_term(terms[1])
        drive = model.inline(model.base_acceleration.symbol)
        (late,) = (s for s in drive.free_symbols if s in model.delays)
        assert drive == model.input_gain_input_gain * late
        assert model.delays[late].lag == model.input_delay_input_delay_s.symbol


def plainly_held() -> si.Model:
    """A rod held upright by a torque that is written as one expression, no signal of it told apart."""
    m = si.Model("rod held upright")
    m.q, m.w, m.push = si.State(unit="rad"), si.State(unit="rad/s"), si.Input(unit="N*m")
    m.kp, m.kd = si.Parameter(unit="N*m/rad", bounds=(0, 100)), si.Parameter(unit="N*m*s/rad", bounds=(0, 10))
    m.hold = si.Expression(m.kp * m.q + m.kd * m.w, unit="N*m", role="feedback_torque", at="q")
    m.motion = si.Equation(m.q.dot - m.w)
    m.balance = si.Equation(m.w.dot - 9.0 * sm.sin(m.q.symbol) + m.hold - m.push)
    m.seen = si.Output(m.q)
    return m


@pytest.mark.parametrize("name, place", [("feedback_delay", "global"), ("joint_feedback_delay", "q")])
def test_of_a_torque_written_plainly_all_comes_late(name, place):
    late = plainly_held().with_term(LIBRARY[name].at(place))
    states = {late.q.symbol, late.w.symbol}
    assert not late.inline(late.hold.expr).free_symbols & states
    assert {d.of for d in late.delays.values()} == states
    assert str(next(iter(late.delays.values())).lag) == f"{name}_{place}_delay_s"


def test_of_signals_that_are_told_apart_only_they_come_late():
    late = STANDING.with_term(LIBRARY["feedback_delay"].at("global"))
    assert late.ankle_torque.expr == STANDING.ankle_torque.expr
