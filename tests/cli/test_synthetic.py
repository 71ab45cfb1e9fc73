"""The synthetic recording: made again to the last written digit, and identified with honest standard errors."""

import json

import numpy as np
import pytest
from agreement import assert_same_table
from conftest import ROOT

import symid as si
from symid.errors import RecordingError, SymidError
from symid.mechanics import FullStatePD
from symid.recording import read_recording
from symid.synthetic import BODY, GAINS, GivenPlatform, body_table, csv_text, standing_recording, write_standing

SHIPPED = ROOT / "data" / "standing_synthetic"


@pytest.fixture(scope="module")
def model():
    return BODY.with_feedback(FullStatePD())


@pytest.mark.elsewhere
def test_shipped_files_are_made_again_to_the_last_written_digit(tmp_path):
    write_standing(tmp_path)
    assert_same_table(tmp_path / "recording.csv", SHIPPED / "recording.csv")
    for name in ("body.json", "truth.json"):
        assert (tmp_path / name).read_bytes() == (SHIPPED / name).read_bytes(), name


def test_shipped_recording_reads_without_a_warning(recwarn):
    recording = read_recording(SHIPPED / "recording.csv")
    assert not recwarn.list
    assert recording.complete and recording.sampling_interval == pytest.approx(0.02) and len(recording) == 6001
    assert np.abs(recording["ankle_angle"]).max() < 0.2 and 0.4 < recording["platform_acceleration"].std() < 0.7


def test_platform_columns_are_derivatives_of_each_other():
    recording = read_recording(SHIPPED / "recording.csv")
    for lower, upper, share in (
        ("platform_position", "platform_velocity", 0.02),
        ("ankle_angle", "ankle_velocity", 1e-3),
    ):
        difference = np.gradient(recording[lower], recording.time) - recording[upper]
        assert np.sqrt(np.mean(difference[1:-1] ** 2)) < share * recording[upper].std()


def test_body_and_truth_are_those_in_the_files():
    assert type(BODY).from_json(SHIPPED / "body.json") == BODY
    assert json.loads((SHIPPED / "truth.json").read_text())["parameters"] == GAINS
    assert list(body_table(BODY)) == list(json.loads((SHIPPED / "body.json").read_text()))


def test_text_gives_the_recording_back(model, tmp_path):
    recording = standing_recording(model, GAINS, duration=4, rate=50, seed=3)
    (tmp_path / "r.csv").write_text(csv_text(recording))
    back = read_recording(tmp_path / "r.csv")
    assert list(back.channels) == list(recording.channels)
    for name in recording.channels:
        np.testing.assert_allclose(back[name], recording[name], atol=1e-6)


def test_seed_changes_everything_and_nothing_else_does(model):
    make = lambda seed: standing_recording(model, GAINS, duration=4, rate=50, seed=seed)  # noqa: E731
    assert csv_text(make(1)) == csv_text(make(1)) != csv_text(make(2))


def test_given_platform_is_what_was_given(model):
    time = np.arange(0, 6, 0.02)
    given = GivenPlatform(time, np.sin(2 * time))
    recording = standing_recording(model, GAINS, duration=5, rate=50, seed=1, platform=given)
    np.testing.assert_allclose(recording["platform_acceleration"], np.sin(2 * recording.time), atol=1e-6)
    assert "platform_position" not in recording.channels


def test_a_person_who_falls_is_reported(model):
    with pytest.raises(SymidError, match="the body falls: ankle_angle leaves -1 to 1 rad at"):
        standing_recording(model, GAINS | {"kp_aa": 0.0, "kp_ah": 0.0}, duration=20)


def test_a_unit_without_a_column_format_is_refused():
    with pytest.raises(RecordingError, match="no column format for channels in kg"):
        csv_text(si.Recording("scale", [0.0, 1.0], {"load": [1.0, 2.0]}, {"load": "kg"}))


def errors_in_standard_errors(model, seed: int) -> np.ndarray:
    """How many standard errors each identified gain is from the truth."""
    solution = si.Identification(model, standing_recording(model, GAINS, seed=seed)).solve()
    assert solution.solved, solution.message
    return np.array([(p.value - GAINS[name]) / p.std_error for name, p in solution.parameters.iterrows()])


def check_three_standard_errors(model, seeds: range) -> None:
    far = np.array([errors_in_standard_errors(model, seed) for seed in seeds])
    within = np.mean(np.abs(far) < 3)
    assert within >= 0.95, f"{100 * within:.1f} % of the gains within three standard errors\n{far.round(1)}"
    # Standard errors far too large would pass the line above.
    assert np.sqrt(np.mean(far**2)) > 0.5


@pytest.mark.slow
def test_true_gains_within_three_standard_errors(model):
    check_three_standard_errors(model, range(8))


@pytest.mark.slow
def test_true_gains_within_three_standard_errors_of_forty_seeds(model):
    check_three_standard_errors(model, range(100, 140))
