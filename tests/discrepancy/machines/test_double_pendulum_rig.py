"""A real double pendulum, its bodies as published, is followed where nothing was fitted."""

import numpy as np
import pytest

import symid as si

BEST_HELD_OUT_DEG = 0.0366
"""Held-out error that a diagnosis of this rig may have at most."""


@pytest.mark.slow
def test_small_swings_are_followed_although_wide_ones_were_fitted(shared):
    rig = shared / "recordings" / "double_pendulum_rig"
    found = si.diagnose_case(si.rig_case(rig / "recording_250hz.csv", rig / "published_parameters.json"))
    errors = np.degrees(found.runs["augmented_heldout"].errors)
    assert np.sqrt(np.mean(errors**2)) <= BEST_HELD_OUT_DEG
    assert found.proof.confirmed
    assert {"coulomb_friction", "link_drag"} <= {e.name for e in found.effects}
    clocks = {"periodic_torque", "base_motion", "vertical_base_motion", "external_push"}
    assert not clocks & {e.name for e in found.effects}
