"""The article's recording of a standing person, of which nobody knows the truth."""

import pytest

import symid as si


@pytest.mark.slow
def test_a_memory_of_the_noise_does_not_hide_late_feedback(shared):
    folder = shared / "recordings" / "standing_subject05"
    with pytest.warns(UserWarning, match="row 15500"):
        recording = si.read_recording(folder / "recording_50hz.csv")
    body = si.mechanics.DoubleLinkPendulum.from_json(folder / "body.json")
    told: list[str] = []
    found = si.diagnose(
        body.with_feedback(si.mechanics.FullStatePD()),
        recording,
        fit_window=(160, 260),
        held_out=(260, 309),
        progress=told.append,
    )
    assert any("beside" in text and ("delay" in text or "muscle_lag" in text) for text in told)
    assert not {e.name for e in found.effects} & {"elastic_mount", "bouc_wen_hysteresis", "quadratic_drag"}
    assert found.verdict == "unexplained"
