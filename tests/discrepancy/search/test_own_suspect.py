"""A user's own law is one more suspect: the example of the page on diagnoses."""

from types import SimpleNamespace

import numpy as np
from conftest import ROOT

import symid as si
from symid.mechanics import rig_model
from symid.recording import Recording
from symid.simulation import simulator

BODY = {"m1_kg": 0.1, "a1_m": 0.1, "I1_kg_m2": 1e-4, "g_m_s2": 9.81}


def test_the_law_of_the_page_is_found():
    page = (ROOT / "docs/pages/howto/diagnose.md").read_text(encoding="utf-8")
    code = page.split("## Your own suspect")[1].split("```")[1].removeprefix("python")
    model = rig_model(BODY)
    given = {"si": si, "case": SimpleNamespace(model=model)}
    exec(code, given)
    (suspect,) = given["mine"]
    true = {suspect.term.parameter_name("strength_Nm"): 0.004}
    time = np.arange(0, 24, 0.02)
    y = simulator(model.with_term(suspect.term)).simulate(true, np.array([0.9, 0.0]), time, substeps=4).y
    y = y[:, 0] + 1e-3 * np.random.default_rng(0).standard_normal(len(time))
    recording = Recording("magnet", time, {"link1_angle": y}, {"link1_angle": "rad"})
    pool = [s for s in si.suspects(model) if s.term.name in ("viscous_friction", "cubic_stiffness", "torsional_spring")]
    found = si.diagnose(
        model,
        recording,
        fit_window=(0, 16),
        held_out=(16, 24),
        segment_length=4.0,
        driven=False,
        suspects=[*pool, *given["mine"]],
        threads=1,
    )
    assert [(e.name, e.location) for e in found.effects] == [
        ("magnet", "joint1")
    ] and found.verdict == "missing_physics"
    value, error = found.effects[0].parameters["strength_Nm"]
    assert abs(value - 0.004) < 4 * error and "A magnet of 4.0" in found.words
