"""Body files: units in their keys, to SI, all faults told at once."""

import json

import pytest
from waves import DEGREE, written

from symid.errors import RecordingError
from symid.recording import read_body

STANDING_BODY = {
    "leg_length": "m",
    "leg_com": "m",
    "trunk_com": "m",
    "leg_mass": "kg",
    "trunk_mass": "kg",
    "leg_inertia": "kg*m^2",
    "trunk_inertia": "kg*m^2",
    "gravity": "m/s^2",
}
PLAIN = {"leg_length": "m", "leg_mass": "kg", "tilt": "rad"}
PLAIN_JSON = {"leg_length_mm": 840, "leg_mass_kg": 20.5, "tilt_deg": -2, "source": "a person"}


def test_a_body_is_converted_to_si(tmp_path):
    body = read_body(written(tmp_path, json.dumps(PLAIN_JSON), "body.json"), PLAIN)
    assert body == {"leg_length": pytest.approx(0.84), "leg_mass": 20.5, "tilt": pytest.approx(-2 * DEGREE)}
    assert read_body(PLAIN_JSON, PLAIN) == body


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"leg_mass_kg": None}, "'leg_mass_kg' must be a number, found null"),
        ({"leg_mass_kg": "20"}, 'must be a number, found "20"'),
        ({"leg_mass_kg": True}, "must be a number, found true"),
        ({"leg_mass_kg": float("nan")}, "'leg_mass_kg' must be finite, found nan"),
        ({"leg_mass_kg": 0}, "'leg_mass_kg' must be greater than zero, found 0"),
        ({"leg_length_mm": -840}, "'leg_length_mm' must be greater than zero"),
        ({"leg_mass_kg": ..., "leg_mass_m": 20}, "'leg_mass_m' is in m, but leg_mass is measured in kg"),
        ({"leg_mass_kg": ..., "leg_mass": 20}, "'leg_mass' has no unit; write 'leg_mass_<unit>' \\(kg\\)"),
        ({"leg_mass_kg": ...}, "'leg_mass' \\[kg\\] is missing"),
        (
            {"leg_mass_kg": ..., "leg_mas_kg": 2},
            "'leg_mas_kg' is not expected; did you mean leg_mass.*'leg_mass' \\[kg\\] is missing; 'leg_mas_kg'",
        ),
        ({"shoe_size_1": 42}, "'shoe_size_1' is not expected"),
        ({"leg_mass_g": 20500}, "'leg_mass_g' gives leg_mass a second time"),
        ({"leg_mass_kgs": 1}, "'leg_mass_kgs' does not end in a known unit"),
    ],
)
def test_bodies_that_are_refused(change, message):
    content = {k: v for k, v in (PLAIN_JSON | change).items() if v is not ...}
    with pytest.raises(RecordingError, match=f"^subject 5: .*{message}"):
        read_body(content, PLAIN, name="subject 5")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{'leg': 1}", "is not JSON: .*line 1 column 2"),
        ("", "is not JSON"),
        ("[1, 2]", "a JSON object such as"),
        ('{"leg_mass_kg": 1, "leg_mass_kg": 2}', "the key 'leg_mass_kg' occurs twice"),
    ],
)
def test_body_files_that_are_refused(tmp_path, text, message):
    with pytest.raises(RecordingError, match=f"body.json: {message}"):
        read_body(written(tmp_path, text, "body.json"), PLAIN)


def test_a_body_file_that_is_not_there(tmp_path):
    with pytest.raises(RecordingError, match="there is no such body file"):
        read_body(tmp_path / "body.json", PLAIN)
    with pytest.raises(RecordingError, match="cannot be read"):
        read_body(tmp_path, PLAIN)


def test_all_faults_of_a_body_are_told_at_once():
    with pytest.raises(RecordingError, match="'leg_mass_kg' must be finite.*'leg_length' \\[m\\] is missing.*'tilt'"):
        read_body({"leg_mass_kg": float("inf")}, PLAIN)


def test_body_files_of_both_kinds(shared):
    body = read_body(shared / "recordings" / "standing_subject05" / "body.json", STANDING_BODY)
    assert body["leg_length"] == 0.8435298 and list(body) == list(STANDING_BODY)
    case = json.loads((shared / "concealed" / "cases" / "dev-s16" / "case.json").read_text())
    letters = {"l_L": "m", "d_L": "m", "d_T": "m", "m_L": "kg", "m_T": "kg", "I_L": "kg*m^2", "I_T": "kg*m^2"}
    assert read_body(case["body"], letters)["m_T"] == case["body"]["m_T_kg"]
