"""Models of rigs from their parameters: names, units, inputs, what is refused."""

import numpy as np
import pytest
from rigs import DOUBLE, SINGLE

from symid.errors import ModelError, RecordingError
from symid.mechanics import BenchDoublePendulum, model_of, rig_model
from symid.simulation import simulator


# ---- models ----------------------------------------------------------------------------------
def test_two_links_are_the_bench_double_pendulum():
    own = BenchDoublePendulum.from_parameters(DOUBLE).plant(("joint1",))
    assert (
        rig_model({"parameters": DOUBLE | {"k1_N_m_s_rad": 1e-4}, "source": "made"}, friction=["joint1"]).fingerprint
        == own.fingerprint
    )


def test_long_names_and_a_single_link_without_numbers():
    long = {"link1_mass_kg": 0.12, "link1_com_m": 0.15, "link1_inertia_kg_m2": 9e-4, "gravity_m_s2": 9.81}
    short = {"m_kg": 0.12, "a_m": 0.15, "I_kg_m2": 9e-4}
    one = rig_model(SINGLE)
    assert [str(rig_model(t).residual) for t in (long, short)] == [str(one.residual)] * 2
    assert all(rig_model(t).constants["gravity"].value == 9.81 for t in (long, short))


def test_what_the_recording_shows_decides_on_angles_and_inputs():
    relative = rig_model(DOUBLE, ["joint1_angle", "joint2_angle"])
    assert "joint2_angle" in relative.states and [y.channel for y in relative.outputs.values()] == [
        "joint1_angle",
        "joint2_angle",
    ]
    driven = rig_model(DOUBLE, ["link1_angle", "link2_angle", "cart_acceleration", "joint2_torque"])
    assert set(driven.inputs) == {"cart_acceleration", "joint2_torque"}
    driven.check()


def test_a_torque_at_a_joint_turns_it_forward():
    model = rig_model(SINGLE, ["link1_angle", "joint1_torque"])
    time = np.linspace(0, 0.1, 11)
    run = simulator(model).simulate({}, np.zeros(2), time, {"joint1_torque": np.full(11, 0.01)})
    inertia = SINGLE["I1_kg_m2"] + SINGLE["m1_kg"] * SINGLE["a1_m"] ** 2
    assert run.y[-1, 0] == pytest.approx(0.5 * 0.01 / inertia * 0.1**2, rel=0.05)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "no link has a mass"),
        ({"m1_kg": 0.1}, r"'a1' \[m\] is missing"),
        (DOUBLE | {"m2_kg": -1}, "'m2_kg' must be greater than zero"),
        ({"parameters": 3}, "must be an object"),
        ({k: v for k, v in DOUBLE.items() if k != "L1_m"}, r"'L1' \[m\] is missing"),
    ],
)
def test_parameters_are_checked_by_name(parameters, message):
    with pytest.raises(RecordingError, match=message):
        rig_model(parameters)


def test_friction_at_a_joint_that_is_not_there():
    with pytest.raises(ModelError, match="no such joint; it has joint1"):
        rig_model(SINGLE, friction=["joint2"])


@pytest.mark.parametrize(
    ("facts", "message"),
    [
        ({"system": "rig"}, "the key 'parameters' is missing"),
        ({"system": "rig", "parameters": 1}, "no table"),
        ({"system": "rig", "parameters": DOUBLE, "baseline": {"terms": ["magic"]}}, "the term 'magic'"),
        ({"system": None}, "known are 'standing', 'rig'"),
    ],
)
def test_facts_are_checked(facts, message):
    with pytest.raises(ModelError, match=message):
        model_of(facts)
