"""How effects are written, and what cannot be concealed or imitated."""

import numpy as np
import pytest

from symid.cli import main
from symid.conceal import draw_case, setup_from_facts, standing_facts
from symid.conceal.magnitudes import parse_effect
from symid.errors import SymidError

BODY = standing_facts(np.random.default_rng(1))["body"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("feedback_delay@global", ("feedback_delay", "global", {})),
        ("sensor_gain@sensor:hip", ("sensor_gain", "sensor:hip", {})),
        ("sensor_gain@sensor:hip:gain=1.2", ("sensor_gain", "sensor:hip", {"gain": 1.2})),
        ("external_push@ankle:peak_Nm=-2e1,start_s=5", ("external_push", "ankle", {"peak_Nm": -20.0, "start_s": 5.0})),
    ],
)
def test_effects_are_written_as_name_place_values(text, expected):
    assert parse_effect(text) == expected


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--effect", "feedback_delay"], "write NAME@PLACE"),
        (["--effect", "feedbak_delay@global"], "no law 'feedbak_delay'; did you mean 'feedback_delay'"),
        (["--effect", "feedback_delay@global:delay=1"], "has no parameter 'delay'; did you mean 'delay_s'"),
        (["--effect", "feedback_delay@global:delay_s=fast"], "delay_s must be a number, found 'fast'"),
        (["--effect", "feedback_delay@global:delay_s=nan"], "delay_s must be a finite number"),
        (["--effect", "feedback_delay@global:delay_s=7"], "delay_s = 7 is outside of its range 0 to 0.5"),
        (["--effect", "feedback_delay@knee"], "cannot act at 'knee'"),
        (["--effect", "end_range_stiffness@hip"], "give a value of torque_Nm"),
        (["--effect", "feedback_delay@global", "--random"], "--effect or --random, not both"),
        (["--count", "0"], "give at least one case"),
        (["--seed", "-1"], "give a whole number from 0 to"),
        (["--system", "unicycle"], "no system 'unicycle' and no such file"),
    ],
)
def test_bad_input_ends_in_one_sentence_and_writes_nothing(tmp_path, capsys, arguments, message):
    assert main(["conceal", str(tmp_path / "out"), *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("symid: error: ") and message in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"system": "unicycle"}, "system 'unicycle' cannot be made"),
        ({"body": None}, "has no 'body'"),
        ({"heldout_window_s": [80, 90]}, "must follow one another"),
        ({"angle_noise_rms_rad_approx": 1.5e154}, "more than half a turn"),
        ({"body": BODY | {"l_L_m": None}}, "leg_length=None: give a number"),
        ({"baseline": {"controller": "LQR"}}, "controller='LQR': known are 'PD', 'FPD'"),
    ],
)
def test_a_case_that_cannot_be_imitated_is_refused(change, message):
    rng = np.random.default_rng(1)
    facts = {k: v for k, v in (standing_facts(rng) | change).items() if v is not None}
    with pytest.raises(SymidError, match=message):
        setup_from_facts(facts, rng)


def test_a_hopeless_effect_says_why(monkeypatch):
    monkeypatch.setattr("symid.conceal.draw.ATTEMPTS", 2)
    with pytest.raises(
        SymidError, match="no suitable case in 2 draws; the last one failed because what the model cannot absorb"
    ):
        draw_case("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 1e-7})], (0, 0))
