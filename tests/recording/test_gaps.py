"""Missing and uneven samples, outliers: what is not there has no weight, and the mesh goes on."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from hypothesis import HealthCheck, given, settings, strategies as st

import symid as si
from symid.errors import RecordingError, TranscriptionError
from symid.nlp import check_derivatives


def with_gaps(recording: si.Recording, share: float = 0.3, seed: int = 0) -> si.Recording:
    angle = recording["angle"].copy()
    angle[np.random.default_rng(seed).random(len(angle)) < share] = np.nan
    return replace(recording, channels=dict(recording.channels) | {"angle": angle})


def test_missing_samples_have_no_weight():
    recording = pendulum_recording(noise=0.01)
    gappy = with_gaps(recording)
    solution = si.Identification(pendulum(), gappy).solve()
    assert solution.solved and solution.values["damping"] == pytest.approx(
        0.4, abs=5 * solution.parameters.std_error["damping"]
    )
    assert solution.fit["rms"]["measured"] == pytest.approx(0.01, rel=0.15)
    # The objective is the weighted sum over the samples that are there.
    t, z, missing = solution.transcription, solution.result.z, ~np.isfinite(gappy["angle"])
    error = t.layout.states(z, 0)[:, 0] - recording["angle"]
    weight = t.program.weights[0, 0] * t.program.data[0].step
    assert t.program.objective(z) == pytest.approx(weight * np.sum(error[~missing] ** 2))


def test_derivatives_with_gaps_and_robust_loss_agree_with_central_differences():
    problem = si.Identification(
        pendulum(), with_gaps(pendulum_recording(duration=0.6, step=0.05)), loss={"measured": 0.02}, backend="numpy"
    )
    t = problem.transcription
    z = t.start(np.array([0.7])) + np.random.default_rng(1).normal(0, 0.1, t.layout.size)
    assert check_derivatives(t.nonlinear_program(t.start(np.array([0.7]))), z).worst_error < 1e-6


def test_the_objective_of_a_robust_output_is_the_pseudo_huber_sum():
    recording, width = pendulum_recording(duration=0.6, step=0.05), 0.02
    t = si.Identification(pendulum(), recording, loss={"measured": width}, backend="numpy").transcription
    z = t.start(np.array([0.7])) + np.random.default_rng(1).normal(0, 0.1, t.layout.size)
    error = t.layout.states(z, 0)[:, 0] - recording["angle"]
    weight = t.program.weights[0, 0] * t.program.data[0].step
    expected = weight * np.sum(2 * width**2 * (np.sqrt(1 + (error / width) ** 2) - 1))
    assert t.program.objective(z) == pytest.approx(expected)


@pytest.mark.parametrize("scheme", [si.Midpoint(), si.HermiteSimpson()])
def test_uneven_samples_need_no_resampling(scheme):
    recording = pendulum_recording(step=0.01)
    rng = np.random.default_rng(0)
    kept = np.sort(rng.choice(np.arange(1, len(recording) - 1), 200, replace=False))
    kept = np.r_[0, kept, len(recording) - 1]
    uneven = replace(recording, time=recording.time[kept], channels={k: v[kept] for k, v in recording.channels.items()})
    solution = si.Identification(pendulum(), uneven, scheme=scheme).solve()
    assert solution.values["damping"] == pytest.approx(0.4, abs=2e-3 if scheme.order == 2 else 1e-4)


def test_outliers_hardly_move_a_robust_fit():
    recording = pendulum_recording(noise=0.01)
    angle = recording["angle"].copy()
    angle[100:130] += 1.0
    spoilt = replace(recording, channels=dict(recording.channels) | {"angle": angle})
    plain, robust = (
        si.Identification(pendulum(), spoilt, loss=loss).solve().values["damping"] for loss in ({}, {"measured": 0.02})
    )
    assert abs(plain - 0.4) > 4 * abs(robust - 0.4) and robust == pytest.approx(0.4, abs=0.02)


def test_a_recording_says_how_much_of_a_channel_is_missing():
    recording = pendulum_recording()
    angle = recording["angle"].copy()
    angle[100:130] = np.nan
    gappy = replace(recording, channels=dict(recording.channels) | {"angle": angle})
    assert str(gappy).count("missing") == 1 and ", 30 missing" in str(gappy) and "missing" not in str(recording)
    assert gappy._repr_html_().count(">30</td>") == 1 and "missing" not in recording._repr_html_()


def test_what_cannot_be_missing_is_refused_in_words():
    recording = pendulum_recording()
    drive = recording["drive"].copy()
    drive[7] = np.nan
    with pytest.raises(TranscriptionError, match="input 'drive' is missing in 1 samples .* first at 0.14 s"):
        si.Identification(pendulum(), replace(recording, channels=dict(recording.channels) | {"drive": drive})).solve()
    with pytest.raises(TranscriptionError, match="no output 'angel'"):
        si.Identification(pendulum(), recording, loss={"angel": 1}).solve()


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data(), st.integers(8, 25), st.sampled_from(["", "nan", "NaN"]))
def test_every_cell_that_is_there_is_read_in_its_place(tmp_path, data, rows, blank):
    """Whichever cells are blank and rows left out; NaN stands where nothing stood."""
    values = np.round(np.sin(np.arange(3 * rows)).reshape(rows, 3), 6)
    missing = np.array(data.draw(st.lists(st.booleans(), min_size=3 * rows, max_size=3 * rows))).reshape(rows, 3)
    missing[[0, -1]] = False
    gone = data.draw(st.sets(st.integers(2, rows - 3), max_size=2))
    kept = [k for k in range(rows) if k not in gone]
    cells = [[blank if m else f"{x:.6f}" for x, m in zip(values[k], missing[k], strict=True)] for k in kept]
    lines = [",".join([f"{0.1 * k:.1f}", *row]) for k, row in zip(kept, cells, strict=True)]
    path = tmp_path / "gaps.csv"
    path.write_text("\n".join(["time_s,a_m,b_m,c_m", *lines]) + "\n")
    recording = si.read_recording(path, allow_gaps=True)
    at = {round(t, 6): i for i, t in enumerate(recording.time)}
    for j, name in enumerate(("a", "b", "c")):
        read = np.array([recording[name][at[round(0.1 * k, 6)]] for k in kept])
        assert np.array_equal(read, np.where(missing[kept, j], np.nan, values[kept, j]), equal_nan=True)
    if missing[kept].any():
        with pytest.raises(RecordingError, match="--allow-gaps"):
            si.read_recording(path)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(1, 8), st.sampled_from([-2, -1, 1, 2]), st.booleans())
def test_rows_of_another_length_than_the_header_are_refused_in_every_mode(tmp_path, row, more, gaps):
    lines = [[f"{0.1 * k:.1f}", "1.0", "2.0", "3.0"] for k in range(10)]
    lines[row] = lines[row][:more] if more < 0 else [*lines[row], *["9.0"] * more]
    path = tmp_path / "ragged.csv"
    path.write_text("time_s,a_m,b_m,c_m\n" + "\n".join(",".join(cells) for cells in lines) + "\n")
    with pytest.raises(RecordingError, match=rf"(row|line) {row + 1}\b|line {row + 2}\b"):
        si.read_recording(path, allow_gaps=gaps)
