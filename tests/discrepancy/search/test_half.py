"""A law of which a part came to nothing is no such law, and a simpler one is tried in its place."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from driven_cart import cart, data_of, recorded

from symid.discrepancy import Suspect
from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.discrepancy.name.instead import simpler_than_best, without_halves
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.evidence import near_noise
from symid.discrepancy.say import judge as judge_module
from symid.discrepancy.say.diagnosis import Effect
from symid.discrepancy.say.judge import _as_survived
from symid.estimation.fitting.cold_start import fit_model
from symid.mechanics import LIBRARY

STRIBECK, COULOMB, VISCOUS, SPRING = (
    Suspect(LIBRARY[name].at("cart"))
    for name in ("stribeck_friction", "coulomb_friction", "viscous_friction", "cubic_stiffness")
)


def with_parts(torque: float, excess: float) -> Hypothesis:
    """Stribeck friction of these sizes [N] and a spring, on a cart that dry friction of 0.35 N holds back."""
    data = data_of(recorded(4, COULOMB.term, {"torque_Nm": 0.35}))
    base = fit_model(cart(), data)
    fit = refit([STRIBECK, SPRING], base, base, data, STRIBECK.off | SPRING.off | STRIBECK.named({"speed_rad_s": 0.2}))
    parts = STRIBECK.named({"torque_Nm": torque, "excess_Nm": excess})
    return Hypothesis((STRIBECK, SPRING), replace(fit, values=fit.values | parts), base, data)


@pytest.mark.parametrize(
    ("torque", "excess", "half"), [(0.3, 0.2, False), (0.3, 0.04, False), (0.3, 0.01, True), (0.02, 0.3, True)]
)
def test_of_two_forces_of_one_law_neither_is_next_to_nothing(torque, excess, half):
    found = with_parts(torque, excess)
    assert found.is_half(STRIBECK) is half and not found.is_half(SPRING)


def test_simpler_laws_are_tried_in_the_place_of_one_of_which_a_part_came_to_nothing():
    found = with_parts(0.02, 0.3)
    pool = [STRIBECK, COULOMB, VISCOUS, SPRING]
    instead = {h.suspects: h for h in without_halves([found], pool, found.base)}
    assert instead.keys() == {(SPRING,), (COULOMB, SPRING), (VISCOUS, SPRING)}
    best = max(instead.values(), key=lambda h: h.fit.loglik2)
    assert best.suspects[0] is COULOMB
    assert best.fit.values[COULOMB.term.parameter_name("torque_Nm")] == pytest.approx(0.35, abs=0.02)
    assert without_halves([with_parts(0.3, 0.3)], pool, found.base) == []


def test_friction_that_falls_with_speed_leads_to_plain_friction_where_that_went_astray():
    found = with_parts(0.2, 0.15)
    led = Hypothesis((SPRING, STRIBECK), found.fit, found.base, found.data)
    (simpler,) = simpler_than_best([led], [STRIBECK, COULOMB, VISCOUS, SPRING], near=0.0)
    assert simpler.suspects == (SPRING, COULOMB)
    assert simpler.fit.values[COULOMB.term.parameter_name("torque_Nm")] == pytest.approx(0.35, abs=0.02)
    assert simpler_than_best([led, simpler], [COULOMB], near=simpler.log_ratio - 1) == []


def test_a_law_whose_shape_ends_at_the_bound_of_what_is_possible_is_none():
    found, speed = with_parts(0.3, 0.2), STRIBECK.law.parameters[2]
    at_bound = STRIBECK.named({speed.key: speed.bounds[1]})
    assert replace(found, fit=replace(found.fit, values=found.fit.values | at_bound)).is_half(STRIBECK)


def test_rubber_that_never_yields_is_tried_as_a_spring():
    rubber, spring = (Suspect(LIBRARY[name].at("cart")) for name in ("bouc_wen_hysteresis", "torsional_spring"))
    found, size = with_parts(0.3, 0.2), rubber.law.parameters[1]
    values = rubber.named({"force_Nm": 1.0, size.key: size.bounds[1]})
    fit = refit([rubber], found.base, found.base, found.data, values, iterations=0)
    stuck = Hypothesis((rubber,), replace(fit, values=fit.values | values), found.base, found.data)
    (instead,) = without_halves([stuck], [rubber, spring], found.base)
    assert instead.suspects == (spring,)


DRY_FORCE = COULOMB.term.parameter_name("torque_Nm")


def with_laws(
    count: int, confirmed: bool | None = None, surprise: float = 0.0, certainty: float = 10.0
) -> SimpleNamespace:
    """Evidence for so many laws that both halves bear out, of which one is dry friction."""
    proof = None if confirmed is None else SimpleNamespace(confirmed=confirmed)
    fit = SimpleNamespace(values={DRY_FORCE: certainty}, errors={DRY_FORCE: 1.0})
    found = SimpleNamespace(suspects=range(count), surprise=lambda _: surprise, fit=fit)
    return SimpleNamespace(survived=(), proof=proof, found=found)


def survives(evidence: SimpleNamespace, law: str = "sensor_gain") -> bool:
    return _as_survived(Effect(law, "cart", {}, None, 1.0, ""), evidence, COULOMB).established


@pytest.mark.parametrize(
    ("law", "count", "stays"),
    [
        ("sensor_gain", POLICY.most_effects - 1, True),
        ("sensor_gain", POLICY.most_effects, False),
        ("joint_drag", POLICY.most_effects, True),  # something takes the energy
    ],
)
def test_as_many_laws_as_a_search_takes_beside_a_rest_imitate_it(law, count, stays):
    assert survives(with_laws(count), law) is stays


def test_a_size_that_surprises_beside_a_rest_is_what_it_looks_like_only():
    assert survives(with_laws(1, surprise=0.5 * POLICY.doubt))
    assert not survives(with_laws(1, surprise=2 * POLICY.doubt))


def test_a_size_that_could_be_nothing_beside_a_rest_is_what_it_looks_like_only():
    assert survives(with_laws(1, certainty=1.1 * POLICY.sure))
    assert not survives(with_laws(1, certainty=0.9 * POLICY.sure))


@pytest.mark.parametrize("confirmed", [True, False])
def test_a_name_beside_a_rest_that_the_held_out_data_do_not_confirm_is_what_it_looks_like_only(confirmed):
    assert survives(with_laws(1, confirmed), "cubic_stiffness") is confirmed


@pytest.mark.parametrize(("size", "near"), [(0.1, True), (1.0, False)])
def test_what_sensors_leave_of_a_motion_that_their_noise_hides_is_not_theirs_alone(size, near):
    """A harvester's voltage, filtered far below its resonance: 0 +- 20 times the excitation, with a rest beside it."""
    found = with_parts(0.3, 0.2)
    moves = np.vstack([e.recorded for e in found.data.segments]).std(axis=0)
    data = replace(found.data, sensor_noise=size * moves, driven=False)
    errors = [e * size * moves / found.fit.rms_errors for e in found.fit.innovations]
    fit = replace(found.fit, innovations=errors)
    assert near_noise(replace(found, fit=fit, data=data), data) is near


@pytest.mark.parametrize(("reason", "sensors"), [("", True), ("its k2 differs between the halves", False)])
def test_what_the_halves_contradict_leaves_a_rest_that_is_not_the_noise_of_sensors(reason, sensors, monkeypatch):
    """A flattened planet's field: five laws left 1.2 times the noise of sensors that nobody stated."""
    monkeypatch.setattr(judge_module, "near_noise", lambda *_: True)
    evidence = SimpleNamespace(survived=(SimpleNamespace(reason=reason),), proof=None, found=None)
    audit = SimpleNamespace(stated=np.array([False, False]))
    assert judge_module._may_be_the_sensors(evidence, audit, SimpleNamespace(data=None)) is sensors


def test_a_law_that_became_half_beside_another_loses_its_name_but_does_not_forbid_the_other():
    found = with_parts(0.3, 0.01)
    assert not found.established and found.doubt() == pytest.approx(POLICY.doubt)
    alone = replace(found, suspects=(STRIBECK,))
    assert alone.doubt() >= POLICY.never
