"""Missing-physics laws: nothing at their null, resisting where they resist, at home on any model."""

from string import Formatter

import numpy as np
import pytest
import sympy as sm
from hypothesis import given
from hypothesis import strategies as st

import symid.model as si
from symid.errors import ModelError
from symid.mechanics import (
    CANONICAL,
    LIBRARY,
    PD,
    BenchDoublePendulum,
    DoubleLinkPendulum,
    FullStatePD,
    lagrange_residuals,
    suspects,
)
from symid.model.check import violations

STANDING = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29).with_feedback(FullStatePD())
RIG = BenchDoublePendulum(0.094, 0.138, 0.109, 0.117, 0.173, 4.4e-4, 1.27e-3).plant()


def cart_pole():
    """A cart with a hanging rod, declared part by part: nothing of it is in the library."""
    m = si.Model("cart and pole")
    m.x = si.State(unit="m")
    m.angle = si.State(unit="rad")
    m.v = si.State(unit="m/s")
    m.rate = si.State(unit="rad/s")
    m.cart_mass = si.Constant(1.0, unit="kg")
    m.rod_mass = si.Constant(0.2, unit="kg", role="mass", at="rod")
    m.rod_com = si.Constant(0.3, unit="m", role="center_of_mass", at="rod")
    m.rod_inertia = si.Constant(0.006, unit="kg*m^2", role="inertia", at="rod")
    m.g = si.Constant(9.81, unit="m/s^2")
    m.g_forward = si.Expression(0, unit="m/s^2", role="gravity", at="global")
    m.g_down = si.Expression(m.g, unit="m/s^2", role="gravity", at="global")
    m.drive = si.Input(unit="N", role="excitation", at="input")
    m.stiffness = si.Parameter(unit="N/m")
    m.cart_error = si.Expression(m.x.symbol, unit="m", role="feedback_error", at="cart")
    m.cart_force = si.Expression(m.stiffness * m.cart_error, unit="N", role="feedback_torque", at="cart")
    s, c = sm.sin(m.angle.symbol), sm.cos(m.angle.symbol)
    ml = m.rod_mass * m.rod_com.symbol
    m.x_kinematics = si.Equation(m.x.dot - m.v)
    m.angle_kinematics = si.Equation(m.angle.dot - m.rate)
    m.cart_balance = si.Equation(
        m.drive
        - m.cart_force
        - (m.cart_mass + m.rod_mass.symbol) * m.v.dot
        - ml * (c * m.rate.dot - s * m.rate**2)
        + (m.cart_mass + m.rod_mass.symbol) * m.g_forward
    )
    m.rod_balance = si.Equation(
        -(m.rod_inertia + ml * m.rod_com) * m.rate.dot - ml * c * m.v.dot - ml * (s * m.g_down - c * m.g_forward)
    )
    m.cart = si.Port(position=m.x, rate=m.v, into={"cart_balance": 1}, unit="N", role="joint", at="cart")
    m.pin = si.Port(position=m.angle, rate=m.rate, into={"rod_balance": 1}, role="joint", at="pin")
    m.rod = si.Port(position=m.angle, rate=m.rate, into={"rod_balance": 1}, role="link", at="rod")
    m.seen_x = si.Output(m.x, role="sensor", at="sensor:cart")
    m.seen_angle = si.Output(m.angle, role="sensor", at="sensor:rod")
    return m


CART = cart_pole()
MODELS = {"standing": STANDING, "rig": RIG, "cart": CART}
ALL = [pytest.param(model, term, id=f"{name}-{term}") for name, model in MODELS.items() for term in suspects(model)]
LISTED = {
    "standing": {
        "global": "feedback_delay muscle_lag",
        "input": "input_gain input_delay",
        "trunk": "extra_mass",
        "ankle": "torque_saturation sensory_dead_zone coulomb_friction cubic_stiffness periodic_torque "
        "integral_feedback "
        "acceleration_feedback torque_feedback gain_change external_push viscous_friction torsional_spring",
        "sensor:ankle": "sensor_gain",
        "sensor:hip": "sensor_gain",
    },
    "rig": {
        "joint1": "viscous_friction coulomb_friction torsional_spring cubic_stiffness periodic_torque",
        "joint2": "viscous_friction coulomb_friction torsional_spring cubic_stiffness periodic_torque",
        "link1": "quadratic_drag link_inertia_error",
        "link2": "quadratic_drag link_inertia_error",
        "global": "gravity_tilt",
        "base": "base_motion",
        "sensor:link1": "sensor_offset",
        "sensor:link2": "sensor_offset sensor_delay",
    },
}
LISTED["standing"]["hip"] = LISTED["standing"]["ankle"]


@pytest.mark.parametrize("name", LISTED)
def test_every_canonical_name_is_at_its_places(name):
    there = {str(t) for t in suspects(MODELS[name])}
    wanted = {f"{law}@{place}" for place, laws in LISTED[name].items() for law in laws.split()}
    assert wanted <= there
    assert {w.split("@")[0] for listed in LISTED.values() for laws in listed.values() for w in laws.split()} == set(
        CANONICAL
    )


@pytest.mark.parametrize(("model", "term"), ALL)
def test_a_term_makes_another_sound_model_and_leaves_the_first_alone(model, term):
    before = model.fingerprint, model.residual(), dict(model.delays)
    augmented = model.with_term(term)
    assert list(violations(augmented)) == []
    assert (model.fingerprint, model.residual(), dict(model.delays)) == before
    assert augmented.fingerprint != before[0]
    added = set(augmented.parameters) - set(model.parameters)
    assert added == {term.parameter_name(q.key) for q in term.law.parameters}


def at_null(model, term):
    """Residuals and outputs with the term switched off, its own states solved for, or at rest if nothing moves them."""
    augmented = model.with_term(term)
    table = {
        augmented[term.parameter_name(q.key)].symbol: sm.sympify(q.null)
        for q in term.law.parameters
        if q.null is not None
    }
    for late, delay in augmented.delays.items():
        if late not in model.delays and delay.lag.xreplace(table).is_zero:
            table[late] = delay.of
    rows = {k: augmented.inline(e.expr).xreplace(table) for k, e in (augmented.equations | augmented.outputs).items()}
    added = [augmented[s] for s in augmented.states if s not in model.states]
    own = {state: rows.pop(f"{state.name}_equation") for state in added}
    rest = dict.fromkeys([x for state in added for x in (state.symbol, state.dot)], sm.S.Zero)
    if all(row.xreplace(rest) == 0 for row in own.values()):
        solved = rest
    else:
        solved = {
            state.symbol: sm.solve(row, state.symbol)[0]
            for state, row in own.items()
            if state.dot not in row.free_symbols
        }
    for _ in added:
        rows = {k: r.xreplace(solved) for k, r in rows.items()}
    return rows


@pytest.mark.parametrize(
    ("model", "term"), [p for p in ALL if any(q.null is not None for q in p.values[1].law.parameters)]
)
def test_a_term_at_its_null_changes_nothing(model, term):
    for name, row in at_null(model, term).items():
        assert sm.expand(row - model.inline(model[name].expr)) == 0, name


@pytest.mark.parametrize(
    ("law", "key", "value", "place"),
    [("torque_saturation", "limit_Nm", 1e9, "hip"), ("sensory_dead_zone", "width_rad", 1e-12, "hip")],
)
def test_limits_far_away_change_nothing(law, key, value, place):
    term = LIBRARY[law].at(place)
    augmented = STANDING.with_term(term)
    rng = np.random.default_rng(3)
    symbols = sorted(set().union(*(r.free_symbols for r in STANDING.residual())), key=str)
    table = dict(zip(symbols, rng.normal(size=len(symbols)), strict=True))
    for new, old in zip(augmented.residual(), STANDING.residual(), strict=True):
        new = new.xreplace(table | {augmented[term.parameter_name(key)].symbol: value})
        assert float(new) == pytest.approx(float(old.xreplace(table)), rel=1e-9)


def effort(model, term):
    """Force that a term adds along its port's rate, as a function of the port's position and rate."""
    port = next(p for p in model.ports.values() if p.at == term.location)
    augmented = model.with_term(term)
    equation, coefficient = next(iter(port.into.items()))
    return (augmented[equation].expr - model[equation].expr) / coefficient, port, augmented


@pytest.mark.parametrize(
    "law", ["viscous_friction", "coulomb_friction", "stribeck_friction", "joint_drag", "quadratic_drag"]
)
@given(rate=st.floats(-20, 20), size=st.floats(0, 50), excess=st.floats(0, 50))
def test_friction_takes_energy_away(law, rate, size, excess):
    place = "link1" if law == "quadratic_drag" else "joint1"
    force, port, augmented = effort(RIG, LIBRARY[law].at(place))
    table = {RIG.link1_velocity.symbol: rate} | {c.symbol: c.value for c in augmented.constants.values()}
    for q, value in zip(LIBRARY[law].parameters, (size, excess, 0.1), strict=False):
        table[augmented[f"{law}_{place}_{q.key}"].symbol] = value
    assert float(force.xreplace(table)) * rate <= 0


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        ("coulomb_friction", -2.0 * np.tanh(0.03 / 0.05)),
        ("viscous_friction", -2.0 * 0.03),
        ("torsional_spring", -2.0 * 0.4),
        ("cubic_stiffness", -2.0 * 0.4**3),
        ("joint_drag", -2.0 * 0.03**2),
        ("quadratic_stiffness", -2.0 * 0.4**2),
    ],
)
def test_sizes_and_signs_of_joint_forces(law, expected):
    term = LIBRARY[law].at("joint2")
    force, port, augmented = effort(RIG, term)
    table = {c.symbol: c.value for c in augmented.constants.values()}
    table |= {
        RIG.link1_angle.symbol: 0.1,
        RIG.link2_angle.symbol: 0.5,
        RIG.link1_velocity.symbol: 0.02,
        RIG.link2_velocity.symbol: 0.05,
    }
    table[augmented[term.parameter_name(term.law.parameters[0].key)].symbol] = 2.0
    assert port.into == {"link2_balance": 1, "link1_balance": -1} or list(port.into.values()) == [1, -1]
    assert float(force.xreplace(table)) == pytest.approx(expected)


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


def test_input_gain_and_delay_reach_the_drive_in_either_order():
    gain, delay = LIBRARY["input_gain"].at("input"), LIBRARY["input_delay"].at("input")
    for terms in ((gain, delay), (delay, gain)):
        model = STANDING.with_term(terms[0]).with_term(terms[1])
        drive = model.inline(model.base_acceleration.symbol)
        (late,) = (s for s in drive.free_symbols if s in model.delays)
        assert drive == model.input_gain_input_gain * late
        assert model.delays[late].lag == model.input_delay_input_delay_s.symbol


def test_two_terms_act_on_one_torque():
    model = STANDING.with_term(LIBRARY["torque_saturation"].at("hip")).with_term(LIBRARY["muscle_lag"].at("global"))
    assert list(violations(model)) == []
    assert sm.tanh in {
        type(a) for a in sm.preorder_traversal(model.inline(model.hip_torque_muscle_lag_equation.expr))
    } or model.hip_torque_muscle_lag_equation.expr.has(sm.tanh)
    assert [str(t) for t in model.terms] == ["torque_saturation@hip", "muscle_lag@global"]


def test_sentences_name_their_parameters_and_sources_are_given():
    for law in LIBRARY.values():
        blanks = {f for _, f, _, _ in Formatter().parse(law.sentence) if f}
        assert blanks <= {"place", *(q.key for q in law.parameters)}, law.name
        assert blanks, law.name
        assert law.source, law.name
        assert law.place or "place" in blanks or law.acts_on in ("excitation", "base_acceleration"), law.name
        for q in law.parameters:
            assert q.bounds[0] < q.bounds[1]
            assert all(q.bounds[0] <= v <= q.bounds[1] for v in (*q.starts, *([q.null] if q.null is not None else [])))


def test_a_law_where_it_cannot_act_is_refused():
    with pytest.raises(ModelError, match="cannot act at 'hip'"):
        RIG.with_term(LIBRARY["coulomb_friction"].at("hip"))


def test_a_tilt_needs_both_components_of_gravity():
    m = si.Model("mass")
    m.g_down = si.Expression(9.81, unit="m/s^2", role="gravity", at="global")
    with pytest.raises(ModelError, match="two are needed: the forward component first"):
        m.with_term(LIBRARY["gravity_tilt"].at("global"))


def test_laws_of_a_joint_need_its_port():
    m = si.Model("loop without a port")
    m.x = si.State(unit="rad")
    m.torque = si.Expression(m.x, unit="N*m", role="feedback_torque", at="motor")
    assert "acceleration_feedback" not in {t.name for t in suspects(m)}


def test_a_users_own_law_is_one_more_entry():
    law = si.Law(
        "magnet",
        "link",
        (si.LawParameter("pull_Nm", "N*m"),),
        lambda m, place, p: m.add_effort(place, p.pull_Nm * sm.sin(m[place].position)),
        "{pull_Nm}",
        "me",
    )
    assert [str(t) for t in suspects(RIG, {"magnet": law})] == ["magnet@link1", "magnet@link2"]
    assert list(violations(RIG.with_term(law.at("link2")))) == []


def test_pd_and_full_state_have_the_same_suspects():
    pd = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29).with_feedback(PD())
    assert [str(t) for t in suspects(pd)] == [str(t) for t in suspects(STANDING)]
