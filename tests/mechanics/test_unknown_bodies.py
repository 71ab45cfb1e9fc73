"""Rigs whose bodies are not all known: what the motion determines is estimated, and no more is said."""

import json

import numpy as np
import pytest
from rigs import DOUBLE, SINGLE

from symid.cases import diagnose_case, rig_case
from symid.discrepancy import suspects
from symid.errors import RecordingError
from symid.estimation.bodies import bodies_words, determined, rig_with_unknown_bodies, unknown_bodies
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.mechanics import LIBRARY, rig_model
from symid.mechanics.chains.combined import combined_of
from symid.simulation import synthetic_recording

JITTER = 5e-4


def recorded(true, friction, seed=0, start=(0.8, 0.5), duration=16.0, term=None, values=()):
    """Free swings of a rig with viscous friction, and perhaps a law that its model lacks."""
    count = sum(k.startswith("m") for k in true)
    channels = [f"link{i + 1}_angle" for i in range(count)]
    model = rig_model(true, channels, [f"joint{i + 1}" for i in range(count)])
    own = dict(zip(model.parameters, friction, strict=True))
    return synthetic_recording(
        model if term is None else model.with_term(term),
        own | dict(values),
        duration=duration,
        rate=100,
        seed=seed,
        warm_up=0,
        sensor_noise=dict.fromkeys(channels, JITTER),
        initial_state=dict(zip(channels, start, strict=False)),
    )


def found(true, unknown, friction, **options):
    recording = recorded(true, friction, **options)
    joints = [f"joint{i + 1}" for i in range(len(friction))]
    model, given = rig_with_unknown_bodies(true | dict.fromkeys(unknown), recording, joints, (0.0, 16.0))
    segments = segments_of(model, recording, (0.0, 16.0), 4.0)
    data = Data(segments, np.full(len(model.outputs), JITTER), False)
    fit = fit_model(model, data)
    truth = rig_model(true, recording.channels, joints)
    numbers = {c.symbol: c.value for c in truth.constants.values()}
    numbers |= {p.symbol: v for p, v in zip(truth.parameters.values(), friction, strict=True)}
    true_values = {c.meaning: float(c.expr.subs(numbers)) for c in combined_of(truth)}
    return determined(fit, data, given, unknown_bodies(given)), true_values, model


ALL_OF_TWO = tuple(k for k in DOUBLE if not k.startswith("g"))


@pytest.mark.parametrize(
    ("true", "unknown", "friction", "meanings"),
    [
        (SINGLE, ("I1_kg_m2",), [1e-3], ["I1"]),
        (
            SINGLE,
            ("m1_kg", "a1_m", "I1_kg_m2"),
            [1e-3],
            [
                "the reduced length of link 1, its inertia over its static moment",
                "the friction of joint1 over the inertia of link 1",
            ],
        ),
        (DOUBLE, ("I1_kg_m2", "a2_m"), [2e-4, 1e-5], ["I1", "a2"]),
        (
            DOUBLE,
            ALL_OF_TWO,
            [2e-4, 1e-5],
            [
                "L1",
                "the reduced length of link 1, its inertia over its static moment",
                "the reduced length of link 2, its inertia over its static moment",
                "the static moment of link 2 over that of link 1",
                "the friction of joint1 over the inertia of link 1",
                "the friction of joint2 over the inertia of link 1",
            ],
        ),
    ],
    ids=["one of one", "all of one", "two of two", "all of two"],
)
def test_what_the_motion_determines_is_found_with_its_error_and_nothing_else(true, unknown, friction, meanings):
    bodies, truth, _ = found(true, unknown, friction)
    assert [b.meaning for b in bodies] == meanings
    for b in bodies:
        assert 0 < b.error < 0.02 * abs(b.value)
        assert b.value == pytest.approx(truth[b.meaning], abs=4 * b.error)


def test_what_cannot_be_told_is_said():
    bodies, _, model = found(SINGLE, ("m1_kg", "a1_m", "I1_kg_m2"), [1e-3])
    text = bodies_words(bodies, ("m1", "a1", "I1"))
    assert "m1, a1, I1 cannot be told one by one" in text and "reduced length of link 1" in text and " m;" in text
    assert list(model.parameters)[0] == "I1" and {"m1", "a1"} <= set(model.constants)


def test_the_scale_of_masses_does_not_matter():
    some = found(SINGLE, ("a1_m", "I1_kg_m2"), [1e-3])[0]
    heavier = {k: v * 10 if k in ("m1_kg", "I1_kg_m2") else v for k, v in SINGLE.items()}
    other = found(heavier, ("a1_m", "I1_kg_m2"), [1e-2])[0]
    ratios = ["reduced length" in b.meaning for b in some]
    assert any(ratios)
    for a, b, same in zip(some, other, ratios, strict=True):
        assert not same or a.value == pytest.approx(b.value, rel=1e-5)


@pytest.mark.slow
def test_a_diagnosis_of_a_rig_of_unknown_bodies_names_the_law_and_what_is_determined(tmp_path):
    term = LIBRARY["quadratic_drag"].at("link1")
    drag = {term.parameter_name("coefficient_Nm_s2_rad2"): 2e-3}
    recording = recorded(SINGLE, [1e-3], term=term, values=drag, duration=24.0)
    rows = "\n".join(f"{t:.2f},{y:.7f}" for t, y in zip(recording.time, recording["link1_angle"], strict=True))
    (tmp_path / "swing.csv").write_text("time_s,link1_angle_rad\n" + rows + "\n")
    (tmp_path / "rig.json").write_text(json.dumps({"m1_kg": None, "a1_m": None, "I1_kg_m2": None}))
    case = rig_case(
        tmp_path / "swing.csv",
        tmp_path / "rig.json",
        friction=["joint1"],
        fit_window=(0.0, 16.0),
        held_out=(16.0, 24.0),
        sensor_noise=JITTER,
    )
    few = [s for s in suspects(case.model) if s.term.name in ("quadratic_drag", "coulomb_friction", "cubic_stiffness")]
    dia = diagnose_case(case, suspects=few)
    assert [e.name for e in dia.effects] == ["quadratic_drag"]
    length = dia.bodies[0]
    assert "reduced length" in length.meaning and length.value == pytest.approx(0.2, abs=4 * length.error + 1e-4)
    assert "cannot be told one by one" in dia.words and dia.answer()["bodies"][0]["unit"] == "m"


def test_a_number_that_is_left_out_is_still_missed():
    with pytest.raises(RecordingError, match="'I1'.*is missing"):
        rig_model({"m1_kg": 0.1, "a1_m": None}, ["link1_angle"])
