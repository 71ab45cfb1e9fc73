"""Preparing a recording: gaps, rates, filters, derivatives, smoothing; each closed form, and what is refused."""

import numpy as np
import pytest
import scipy
from waves import DEGREE, csv_text, even_rows, wave, without_noise_figure, written

from symid.errors import RecordingError
from symid.recording import (
    Recording,
    differentiate,
    fill_gaps,
    lowpass,
    rate_name,
    rate_unit,
    read_recording,
    resample,
    smooth_states,
)
from symid.recording.signals.smooth import _spline

# -- preparing --------------------------------------------------------------------------------


def with_holes(tmp_path) -> Recording:
    """A smooth angle with three rows missing and two cells blank."""
    angle = 3 * np.sin(0.05 * np.arange(100))
    rows = [f"{0.01 * i:.2f},{a:.6f}" for i, a in enumerate(angle)]
    rows[60], rows[61] = "0.60,", "0.61,NaN"
    return read_recording(written(tmp_path, csv_text(rows[:30] + rows[33:])), allow_gaps=True)


def test_gaps_are_filled_where_allowed(tmp_path):
    holed = with_holes(tmp_path)
    assert not holed.complete and holed.sampling_interval == pytest.approx(0.01) and len(holed) == 100
    assert "3 rows put in without values" in holed.history[-1]
    whole = fill_gaps(holed, max_gap_s=0.05)
    assert whole.complete and len(whole) == 100
    truth = 3 * DEGREE * np.sin(0.05 * np.arange(100))
    assert np.abs(whole["ankle_angle"] - truth).max() < 5e-4
    measured = np.isfinite(holed["ankle_angle"])
    rows = np.round(holed.time[measured] / 0.01).astype(int)
    assert np.array_equal(whole["ankle_angle"][rows], holed["ankle_angle"][measured])
    assert whole.history[-1] == "gaps up to 0.05 s filled by PCHIP: 5 value(s)"


def test_rows_that_are_put_in_belong_to_the_segment_around_them(tmp_path):
    rows = [f"{0.01 * i:.2f},{i % 5},{i // 50}" for i in range(100) if i not in (7, 60, 61)]
    holed = read_recording(written(tmp_path, csv_text(rows, "time_s,ankle_angle_deg,segment")), allow_gaps=True)
    assert len(holed) == 100 and np.array_equal(holed.segment, np.repeat([0, 1], 50))


@pytest.mark.parametrize("row", ["0.05", "0.05,1", "0.05,1,2,3", "0.05,1,2,3,"])
@pytest.mark.parametrize("allow_gaps", [False, True])
def test_a_row_that_is_too_short_or_too_long_is_never_read_shifted(tmp_path, row, allow_gaps):
    rows = [f"{0.01 * i:.2f},{i % 5},{i % 3}" for i in range(20)]
    path = written(tmp_path, csv_text([*rows[:5], row, *rows[6:]], "time_s,ankle_angle_deg,hip_angle_deg"))
    with pytest.raises(RecordingError, match=r"row 6 \(line 7\)"):
        read_recording(path, allow_gaps=allow_gaps)


def test_missing_samples_stay_where_they_were_measured(tmp_path):
    rows = [f"{0.01 * i:.2f},{i % 5},{'' if i == 7 else i % 3}" for i in range(20)]
    recording = read_recording(
        written(tmp_path, csv_text(rows, "time_s,ankle_angle_deg,hip_angle_deg")), allow_gaps=True
    )
    assert recording.valid["ankle_angle"].all()
    assert np.flatnonzero(~recording.valid["hip_angle"]).tolist() == [7]
    assert recording["ankle_angle"][7] == pytest.approx(2 * DEGREE)


def test_gaps_that_are_too_long_or_at_an_end_are_refused(tmp_path):
    with pytest.raises(RecordingError, match="no value from 0.29 s to 0.33 s, longer than max_gap_s = 0.035 s"):
        fill_gaps(with_holes(tmp_path), max_gap_s=0.035)
    rows = [*even_rows(29), "0.29,"]
    recording = read_recording(written(tmp_path, csv_text(rows)), allow_gaps=True)
    with pytest.raises(RecordingError, match="'ankle_angle' begins or ends with a missing value"):
        fill_gaps(recording, max_gap_s=1)


def test_an_incomplete_recording_is_refused_by_the_other_verbs(tmp_path):
    holed = with_holes(tmp_path)
    uneven = Recording("r", np.array([0, 0.1, 0.3]), {"a": np.zeros(3)}, {"a": "m"})
    with pytest.raises(RecordingError, match="window needs evenly spaced samples; use fill_gaps"):
        uneven.window(0, 0.2)
    for verb in (lambda r: lowpass(r, 5), lambda r: resample(r, 50), lambda r: differentiate(r, "ankle_angle")):
        with pytest.raises(RecordingError, match="'ankle_angle' has none at 0.3 s; use fill_gaps"):
            verb(holed)


@pytest.mark.parametrize("rate", [30.0, 50.0, 100.0, 240.0])
def test_resampling_keeps_slow_motion(rate):
    new = resample(wave(400), rate)
    assert new.sampling_interval == pytest.approx(1 / rate)
    assert new.interval[0] == 5.0 and 8.99 - 1.01 / rate < new.interval[1] <= 8.99 + 1e-9
    inner = slice(len(new) // 4, -len(new) // 4)
    truth = 0.05 * np.sin(2 * np.pi * 0.7 * new.time)
    assert np.abs(new["ankle_angle"] - truth)[inner].max() < 1e-5


def test_downsampling_does_not_alias():
    time = 0.01 * np.arange(1000)
    fast = Recording("r", time, {"a": np.sin(2 * np.pi * 22 * time)}, {"a": "m"}, noise={"a": 0.1})
    slow = resample(fast, 20.0)  # 22 Hz would appear as 2 Hz
    assert np.abs(slow["a"][20:-20]).max() < 1e-3
    assert "low-pass at 8 Hz against aliasing" in slow.history[-1] and not slow.noise
    assert "aliasing" not in resample(fast, 200.0).history[-1]


def test_uneven_times_are_put_onto_a_grid(tmp_path):
    rng = np.random.default_rng(1)
    time = 0.01 * np.arange(300) + 0.002 * rng.random(300)
    rows = [f"{t:.6f},{np.sin(3 * t):.9f}" for t in time]
    uneven = read_recording(written(tmp_path, csv_text(rows)), allow_gaps=True)
    even = resample(uneven, 100.0)
    assert even.complete and "uneven times" in even.history[-1]
    assert np.abs(even["ankle_angle"] - DEGREE * np.sin(3 * even.time)).max() < 1e-6
    with pytest.raises(RecordingError, match="do not lie on an even grid"):
        fill_gaps(uneven, max_gap_s=1)


def test_low_pass_has_no_phase_shift_and_6_db_at_the_cut_off():
    time = 0.01 * np.arange(2000)
    tone = np.sin(2 * np.pi * 5 * time)
    recording = Recording("r", time, {"a": tone, "b": tone}, {"a": "m", "b": "m"}, noise={"a": 1, "b": 1})
    new = lowpass(recording, 5.0, "a")
    inner = slice(500, 1500)
    assert np.abs(new["a"][inner] - 0.5 * tone[inner]).max() < 1e-4
    assert np.array_equal(new["b"], tone) and dict(new.noise) == {"b": 1}
    assert "zero phase" in new.history[-1]


@pytest.mark.parametrize("cutoff", [0, -1, 50, 80, float("nan")])
def test_cut_offs_that_are_refused(cutoff):
    with pytest.raises(RecordingError, match="not between 0.0001 and half the sampling rate, 50 Hz|give a number"):
        lowpass(wave(), cutoff)


@pytest.mark.parametrize("rate", [0, -1, float("nan"), float("inf")])
def test_rates_that_are_refused(rate):
    with pytest.raises(RecordingError, match="is not possible|give a number"):
        resample(wave(), rate)


def test_too_few_samples_are_refused():
    with pytest.raises(RecordingError, match="8 samples are too few to filter"):
        lowpass(wave(8), 5)
    with pytest.raises(RecordingError, match="6 samples are too few to differentiate"):
        differentiate(wave(6), "ankle_angle")
    with pytest.raises(RecordingError, match="too short for a rate"):
        resample(wave(30), 1)


def test_derivative_of_a_cubic_is_exact():
    time = 0.1 * np.arange(50)
    recording = Recording("r", time, {"hip_angle": time**3 - time}, {"hip_angle": "rad"})
    new = differentiate(recording, "hip_angle")
    assert new["hip_velocity"] == pytest.approx(3 * time**2 - 1, abs=1e-9)
    assert new.units["hip_velocity"] == "rad/s"
    assert "Savitzky-Golay" in new.history[-1]


def test_names_and_units_of_rates():
    assert rate_name("hip_angle") == "hip_velocity" and rate_name("angle") == "velocity"
    assert rate_name("platform_velocity") == "platform_acceleration"
    assert rate_name("torque") == "torque_rate"
    assert rate_unit("rad") == "rad/s" and rate_unit("m/s") == "m/s^2"
    assert rate_unit("N*m") == "(N*m)/s"


@pytest.mark.parametrize("known", [True, False])
def test_smoothing_gives_angle_and_rates_near_the_best_possible(known):
    noise = 0.001
    noisy = wave(3000, noise=noise, seed=3)
    if not known:
        noisy = without_noise_figure(noisy)
    new = smooth_states(noisy, "ankle_angle")
    phase = 2 * np.pi * 0.7 * noisy.time
    angle, rate = 0.05 * np.sin(phase), 2 * np.pi * 0.7
    assert np.std(new["ankle_angle"] - angle) < 0.3 * noise
    assert np.std(new["ankle_velocity"] - rate * 0.05 * np.cos(phase)) < 0.03 * 0.05 * rate
    assert np.std(new["ankle_acceleration"] + rate**2 * angle) < 0.15 * 0.05 * rate**2
    assert new.units["ankle_acceleration"] == "rad/s^2"
    assert ("noise of 0.001" in new.history[-1]) == known


def test_smoothing_leaves_clean_data_alone_and_averages_pure_noise_away():
    clean = wave(1000)
    new = smooth_states(without_noise_figure(clean), "ankle_angle")
    assert np.abs(new["ankle_angle"] - clean["ankle_angle"]).max() < 1e-6
    noise = np.random.default_rng(0).standard_normal(1000)
    still = Recording("still", clean.time, {"angle": noise}, {"angle": "rad"})
    assert np.std(smooth_states(still, "angle")["angle"]) < 0.2


def test_verbs_work_segment_by_segment():
    half = np.repeat([0, 1], 100)
    time = np.tile(0.01 * np.arange(100), 2)
    angle = np.where(half == 0, 1.0, -1.0)  # a step between segments is no motion
    recording = Recording("r", time, {"angle": angle}, {"angle": "rad"}, segment=half)
    for verb in (lambda r: lowpass(r, 5), lambda r: resample(r, 50), lambda r: fill_gaps(r, 0.1)):
        new = verb(recording)
        assert len(new.runs) == 2
        for part, value in zip(new.segments(), (1.0, -1.0), strict=True):
            assert part["angle"] == pytest.approx(value, abs=1e-9)
    assert np.abs(differentiate(recording, "angle")["velocity"]).max() < 1e-9
    assert np.abs(smooth_states(recording, "angle")["velocity"]).max() < 1e-6


@pytest.mark.parametrize(("samples", "weight"), [(5, 1.0), (6, 1e-3), (50, 1e4), (1001, 1e4), (1001, 1e-2)])
def test_the_smoothing_spline_is_that_of_scipy(samples, weight):
    place, step = np.arange(samples, dtype=float), 0.02
    values = np.sin(0.1 * place) + np.random.default_rng(samples).standard_normal(samples)
    curve = scipy.interpolate.make_smoothing_spline(place, values, lam=weight)
    expected = [curve(place), curve(place, 1) / step, curve(place, 2) / step**2]
    np.testing.assert_allclose(_spline(values, weight, step), expected, atol=1e-9 / step**2)


def test_smoothing_that_is_refused(tmp_path):
    with pytest.raises(RecordingError, match="needs the name of a channel"):
        smooth_states(wave())
    with pytest.raises(RecordingError, match="a segment has 4 samples"):
        smooth_states(wave(4), "ankle_angle")
    with pytest.raises(RecordingError, match="has no channel 'hip'"):
        smooth_states(wave(), "hip")


def test_the_same_rate_by_another_clock_is_not_filtered():
    """A computer's clock that says 200.003 Hz: noise up to the highest frequency stays white."""
    time = np.arange(400) / 200.003
    noise = np.random.default_rng(0).standard_normal(400)
    recording = Recording("r", time, {"a": noise}, {"a": "m"})
    even = resample(recording, 200.0)
    assert "low-pass" not in even.history[-1] and even["a"].std() == pytest.approx(noise.std(), rel=0.05)
    assert "low-pass" in resample(recording, 190.0).history[-1]
