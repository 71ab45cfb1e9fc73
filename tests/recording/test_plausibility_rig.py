"""Mistakes in the parameters and in the recording of a rig are named."""

import re
from dataclasses import replace

import numpy as np
import pytest
from mistakes import only_one, swapped

import symid as si
from symid.plausibility import remarks
from symid.recording import Recording

RIG = {"m1_kg": 0.09, "a1_m": 0.11, "I1_kg_m2": 4.5e-4, "L1_m": 0.17, "m2_kg": 0.13, "a2_m": 0.12, "I2_kg_m2": 1.2e-3}


@pytest.fixture(scope="module")
def swinging() -> Recording:
    from symid.simulation import simulator

    model, time = si.mechanics.rig_model(RIG, ["link1_angle"]), np.arange(0, 12, 0.005)
    y = (
        simulator(model)
        .simulate(
            {},
            {"link1_angle": 1.1, "link2_angle": -0.6, "link1_velocity": 0.0, "link2_velocity": 0.0},
            time,
            substeps=4,
        )
        .y
    )
    y = y + 5e-4 * np.random.default_rng(5).standard_normal(y.shape)
    return Recording(
        "rig", time, {"link1_angle": y[:, 0], "link2_angle": y[:, 1]}, {"link1_angle": "rad", "link2_angle": "rad"}
    )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({}, None),
        ({"m1_kg": 0.9}, "m1 is 10 times too large"),
        ({"L1_m": 170.0}, "L1 is"),
        ({"a2_m": 120.0}, "a2 is"),
        ({"I1_kg_m2": 4.5}, "I1"),
    ],
    ids=str,
)
def test_a_mistake_in_the_parameters_of_a_rig(swinging, change, words):
    found = remarks(si.mechanics.rig_model(RIG | change, swinging.channels), swinging)
    assert found == [] if words is None else any(words in text for text in found), found


@pytest.mark.parametrize(
    ("plant", "words"),
    [
        (lambda r: only_one(r, "link2_angle", -1.0), "has the opposite sign"),
        (lambda r: swapped(r, "link1", "link2"), "swapped"),
        (lambda r: replace(r, time=1e3 * r.time), "milliseconds"),
        (lambda r: replace(r, channels={k: np.degrees(v) for k, v in r.channels.items()}), "degrees|_deg"),
        (lambda r: replace(r, channels={k: np.radians(v) for k, v in r.channels.items()}), "radians|_rad"),
    ],
    ids=["reversed", "swapped", "ms", "degrees", "radians"],
)
def test_a_mistake_in_the_recording_of_a_rig(swinging, plant, words):
    found = remarks(si.mechanics.rig_model(RIG, swinging.channels), plant(swinging))
    assert any(re.search(words, text) for text in found), found
