"""Mistakes of signs and units in recordings of small systems, and none where all is right."""

from dataclasses import replace

import numpy as np
import pytest
from small_systems import cart_pole, duffing, mass_spring_damper
from unfamiliar_systems import food_chain, measured

from symid.plausibility import remarks


def test_equations_that_explain_the_motion_from_other_first_values_are_not_questioned():
    """Parameters that enter nonlinearly, and a strongly nonlinear motion whose linearly foretold part is none."""
    for drawn in (measured(food_chain, "white", 4), duffing(np.random.default_rng([1, 23]))):
        assert remarks(drawn.model, drawn.recordings[0]) == []


@pytest.mark.parametrize("seed", range(3))
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
