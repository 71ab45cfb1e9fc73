"""Missing-physics laws: nothing at their null, resisting where they resist, at home on any model."""

from string import Formatter

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, strategies as st
from term_models import MODELS, RIG, STANDING, effort

import symid.model as si
from symid.errors import ModelError
from symid.mechanics import CANONICAL, LIBRARY, PD, DoubleLinkPendulum, suspects
from symid.model.check import violations

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
        ("asymmetric_damping", -2.0 * 0.03),
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
