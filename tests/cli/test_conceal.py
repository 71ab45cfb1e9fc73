"""Concealed cases: what is written is what was simulated, seeded, visible where asked, and sealed."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from agreement import assert_same_document, assert_same_table
from conftest import ROOT, pendulum

import symid.model as si
from symid.cases import read_case
from symid.cli import main
from symid.conceal import (
    Setup,
    Unsuitable,
    conceal,
    draw_case,
    rig_facts,
    setup_from_facts,
    standing_facts,
    with_equivalents,
    write_case,
)
from symid.conceal.fit import fit_free, simulate_free
from symid.conceal.magnitudes import OTHER, RANGES, draw_terms, draw_values
from symid.conceal.shipped import SHIPPED, shipped_case
from symid.conceal.write import csv_text, next_name, sealed_document
from symid.estimation.signals.windows import segments_between
from symid.mechanics import CANONICAL, LIBRARY

SHORT_RIG = ("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 0.004})], (3, 0))


@pytest.fixture(scope="module")
def offset():
    return draw_case(*SHORT_RIG)


@pytest.fixture(scope="module")
def standing():
    return draw_case("standing", [("input_gain", "input", {"gain": 1.3})], (5, 0))


def small_setup(**changes) -> Setup:
    """The driven pendulum, which no shipped system knows."""
    return replace(
        Setup(
            pendulum(),
            {"damping": 0.4},
            rate=50,
            fit=8.0,
            held_out=4.0,
            sensor_noise=1e-3,
            torque_noise={"push": 1.0},
            sway=0.01,
            warm_up=5.0,
        ),
        **changes,
    )


def test_the_same_seed_gives_the_same_bytes_and_another_seed_others(tmp_path, offset):
    again, other = draw_case(*SHORT_RIG), draw_case(*SHORT_RIG[:2], (4, 0))
    files = []
    for i, case in enumerate((offset, again, other)):
        directory = write_case(case, tmp_path / str(i), "r01")
        files.append(
            [
                p.read_bytes()
                for p in (directory / "recording.csv", directory / "case.json", tmp_path / str(i) / "sealed/r01.json")
            ]
        )
    assert files[0] == files[1]
    assert all(a != b for a, b in zip(files[0], files[2], strict=True))


def test_a_case_is_read_by_the_diagnosis_as_it_was_made(tmp_path, standing, offset):
    for case, name in ((standing, "s01"), (offset, "r01")):
        found = read_case(write_case(case, tmp_path, name))
        assert found.model.fingerprint == case.setup.model.fingerprint
        assert (found.fit_window, found.held_out_window) == case.setup.windows
        assert found.segment_length == case.setup.segment and found.settling == case.setup.settling
        for channel, values in case.recording.channels.items():
            np.testing.assert_allclose(found.recording[channel], values, atol=6e-6)
        assert found.recording.time[-1] == case.setup.fit + case.setup.held_out


def test_the_sealed_answer_is_not_in_the_case(tmp_path, standing):
    directory = write_case(standing, tmp_path, "s01")
    told = (directory / "case.json").read_text()
    assert "input_gain" not in told and "seed" not in told
    for value in standing.setup.parameters.values():
        assert f"{value:.6g}" not in told


def test_an_offset_is_in_the_recording_by_its_size(offset):
    """Offset apart, the noise-free channel is the plain pendulum's."""
    model, s = offset.setup.model, offset.setup
    from symid.simulation import simulator

    plain = simulator(model).simulate(
        dict(s.parameters), dict.fromkeys(model.states, 0.0) | dict(s.initial_state), offset.recording.time
    )
    np.testing.assert_allclose(offset.clean - plain.y, [[0.004, 0.0]] * len(offset.clean), atol=1e-7)


def test_noise_has_the_size_that_the_answer_says(standing):
    noise = np.column_stack([standing.recording[k] for k in ("ankle_angle", "hip_angle")]) - standing.clean
    expected = np.hypot(standing.sway, standing.setup.sensor_noise)
    assert np.sqrt(np.mean(noise**2)) == pytest.approx(expected, rel=0.1)
    assert np.radians(0.05) <= standing.sway <= np.radians(0.95)
    stated = standing.setup.facts["angle_noise_rms_rad_approx"]
    assert standing.setup.sensor_noise == pytest.approx(stated, rel=0.11)


def test_encoders_round_to_their_steps(offset):
    step = offset.setup.resolution
    for values in offset.recording.channels.values():
        np.testing.assert_allclose(values / step, np.round(values / step), atol=1e-6)


def test_the_model_misses_as_much_as_the_answer_says(standing):
    """Visibility again, by fitting the model to the noise-free recording from another start."""
    s = standing.setup
    quiet = dict(standing.recording.channels) | dict(zip(("ankle_angle", "hip_angle"), standing.clean.T, strict=True))
    segments = segments_between(s.model, standing.recording.time, quiet, s.windows[0])
    start = {k: v * 1.05 for k, v in s.parameters.items()}
    missed = fit_free(s.model, segments, start, np.zeros((1, 4))).rms(segments, s.settling)
    recorded = np.column_stack([standing.recording[k] for k in ("ankle_angle", "hip_angle")])
    noise = np.sqrt(np.mean((recorded - standing.clean) ** 2))
    assert missed / noise == pytest.approx(standing.visibility, rel=0.01)
    assert 0.45 <= standing.visibility <= 3.2
    reference = standing.reference
    assert reference["baseline"]["heldout_rms_rad"] > 1.05 * reference["true_parameters"]["heldout_rms_rad"]


def test_a_fit_recovers_what_was_simulated():
    setup = small_setup(sway=0.0, sensor_noise=0.0)
    case = conceal(setup, {}, seed=1)
    segments = segments_between(setup.model, case.recording.time, dict(case.recording.channels), setup.windows[0])
    fit = fit_free(setup.model, segments, {"damping": 1.0}, np.zeros((1, 2)))
    assert fit.values["damping"] == pytest.approx(0.4, rel=2e-4)  # the input is known at samples only
    assert fit.rms(segments) < 1e-4
    again = simulate_free(setup.model, segments, fit.values, fit.initial)
    np.testing.assert_array_equal(again.simulated[0], fit.simulated[0])


def test_a_null_is_called_adequate_and_nothing_is_missed():
    case = draw_case("rig", [], (1, 0))
    document = sealed_document(case, "r01")
    assert (document["kind"], document["verdict"], document["effects"]) == ("none", "adequate", [])
    reference = case.reference
    assert reference["baseline"]["heldout_rms_rad"] == pytest.approx(
        reference["true_parameters"]["heldout_rms_rad"], rel=0.03
    )


@pytest.mark.compiled
def test_two_effects_and_a_time_window():
    effects = [("gain_change", "ankle", {"factor": 0.6, "time_s": 30.0}), ("input_gain", "input", {"gain": 1.3})]
    case = draw_case("standing", effects, (2, 0))
    document = sealed_document(case, "s01")
    assert (document["kind"], document["verdict"]) == ("two", "missing_physics")
    assert [e["name"] for e in document["effects"]] == ["gain_change", "input_gain"]
    assert document["effects"][0]["time_window_s"] == [29.5, 30.5] and "time_window_s" not in document["effects"][1]


def test_an_effect_without_a_listed_name_must_stay_unexplained():
    case = draw_case("rig", [("elastic_mount", "base", {})], (1, 0))
    document = sealed_document(case, "r01")
    assert (document["kind"], document["verdict"]) == ("unlisted", "unexplained")


def test_a_law_and_a_model_of_ones_own(pendulum_model):
    def build(model, place, p):
        model.redefine("measured", model["measured"].expr * p.scale)

    model = pendulum_model
    law = si.Law("my_sensor", "sensor", (si.LawParameter("scale", "1", null=1.0),), build)
    model.components["measured"] = replace(model["measured"], role="sensor", at="sensor:angle")
    case = conceal(small_setup(model=model), {law.at("sensor:angle"): {"scale": 2.0}}, seed=1, listed=("my_sensor",))
    plain = conceal(small_setup(model=model), {}, seed=1)
    np.testing.assert_allclose(case.clean, 2 * plain.clean, rtol=1e-9)
    assert case.kind == "single" and plain.kind == "none" and plain.visibility == 0


def test_all_that_is_drawn_at_random_exists_where_it_is_drawn():
    rng = np.random.default_rng(0)
    setups = {
        "standing": setup_from_facts(standing_facts(rng), rng),
        "rig": setup_from_facts(rig_facts(rng, True), rng),
    }
    for system, ranges in RANGES.items():
        for name, sizes in ranges.items():
            keys = {q.key for q in LIBRARY[name].parameters}
            assert sizes.keys() <= keys
            for place in LIBRARY[name].places(setups[system].model):
                values = draw_values(LIBRARY[name].at(place), setups[system], rng)
                assert values.keys() == keys
    assert {name for name, _ in OTHER} <= LIBRARY.keys()


def test_a_rig_without_friction_in_its_model_gets_a_friction():
    rng = np.random.default_rng(0)
    conservative, viscous = (setup_from_facts(rig_facts(rng, c), rng) for c in (True, False))
    friction = {"viscous_friction", "coulomb_friction", "quadratic_drag"}
    for _ in range(20):
        assert draw_terms(conservative, "single", rng)[0].name in friction
        assert draw_terms(viscous, "single", rng)[0].name not in friction
        first, second = draw_terms(conservative, "two", rng)
        assert first.name in friction and second.name not in friction
        assert draw_terms(viscous, "unlisted", rng)[0].name not in CANONICAL


def test_motion_out_of_range_is_refused():
    with pytest.raises(Unsuitable, match="angle reaches .* beyond 0.001"):
        setup = small_setup(limits={"angle": 0.001})
        setup.model.components["measured"] = replace(setup.model["measured"], role="sensor", at="sensor:angle")
        conceal(setup, {}, seed=0)


def test_command_writes_cases_that_follow_those_that_are_there(tmp_path, capsys, offset):
    write_case(offset, tmp_path, "r01")
    imitated = tmp_path / "cases" / "r01" / "case.json"
    arguments = [
        "conceal",
        str(tmp_path),
        "--system",
        str(imitated),
        "--effect",
        "sensor_offset@sensor:link2:offset_rad=0.004",
    ]
    assert main([*arguments, "--seed", "2"]) == 0
    assert str(tmp_path / "cases" / "r02") in capsys.readouterr().out
    old, new = (json.loads((tmp_path / "cases" / n / "case.json").read_text()) for n in ("r01", "r02"))
    assert {k: v for k, v in new.items() if k != "id"} == {k: v for k, v in old.items() if k != "id"}
    assert next_name(tmp_path, "rig") == "r03" and next_name(tmp_path, "standing") == "s01"
    assert csv_text(offset).splitlines()[0] == "time_s,link1_angle_rad,link2_angle_rad"


@pytest.mark.elsewhere
@pytest.mark.parametrize("name", ["s02", "r01"])
def test_the_shipped_cases_are_made_anew_to_the_last_written_digit(tmp_path, name):
    shipped = ROOT / "data" / "concealed"
    assert sorted(p.name for p in (shipped / "cases").iterdir()) == sorted(SHIPPED)
    write_case(shipped_case(name), tmp_path, name)
    assert_same_table(*(folder / f"cases/{name}/recording.csv" for folder in (tmp_path, shipped)))
    assert (tmp_path / f"cases/{name}/case.json").read_bytes() == (shipped / f"cases/{name}/case.json").read_bytes()
    assert_same_document(*(folder / f"sealed/{name}.json" for folder in (tmp_path, shipped)))


def test_sealed_answers_suit_the_scorer(tmp_path, shared, offset, standing):
    scorer = shared / "concealed" / "score.py"
    if not scorer.is_file():
        pytest.skip(f"no scorer at {scorer}")
    for case, name in ((offset, "r01"), (standing, "s01"), (draw_case("rig", [], (1, 0)), "r02")):
        write_case(case, tmp_path, name)
    done = subprocess.run(
        [sys.executable, str(scorer), "--self-test", "--truth", str(tmp_path / "sealed")],
        capture_output=True,
        text=True,
    )
    assert "self-test passed: 3 cases" in done.stdout, done.stderr


@pytest.mark.slow
@pytest.mark.compiled
def test_what_the_noise_hides_is_equivalent_and_what_it_does_not_is_not():
    """The same recording under the same noise, and under noise a thousand times as large."""
    case = draw_case("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 0.002})], (3, 0))
    told = with_equivalents(case)
    assert told.equivalent == told.near == ((),)
    louder = {k: c + 1000 * (v - c) for (k, v), c in zip(case.recording.channels.items(), case.clean.T, strict=True)}
    hidden = with_equivalents(replace(case, recording=replace(case.recording, channels=louder)))
    assert {t.name for t in hidden.equivalent[0]} >= {"sensor_offset", "gravity_tilt", "torsional_spring"}
    (effect,) = sealed_document(hidden, "r01")["effects"]
    assert {"name": "gravity_tilt", "location": "global"} in effect["equivalent"]
