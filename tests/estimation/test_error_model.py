"""The error model of a recording: filters are undone, memory is whitened, and neither is taken for physics."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from driven_cart import SENSOR, TRUE, cart, data_of, few, finding, recorded
from noises import autoregressive
from scipy.signal import butter, filtfilt, lfilter

from symid.estimation import noise_memory
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.measurement import fits_of
from symid.estimation.noise_memory import _is_broad, _swings, with_memory
from symid.estimation.sensors.cutoff import estimated_filter
from symid.estimation.sensors.sensor_noise import noise_before
from symid.estimation.sensors.whitening import Whitening, is_coloured, remembered
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.simulation import simulator

STEP = 0.01


# ---- filters -----------------------------------------------------------------------------------
@pytest.mark.parametrize(("order", "cutoff"), [(2, 4.0), (2, 10.0), (4, 6.0)])
def test_gain_is_that_of_the_filter_forwards_and_backwards(order, cutoff):
    impulse = np.zeros(4001)
    impulse[2000] = 1.0
    answer = filtfilt(*butter(order, cutoff * 2 * STEP), impulse)
    gain = np.abs(np.fft.rfft(answer))
    np.testing.assert_allclose(gain, ZeroPhase(order, cutoff, 1 / STEP).gain(np.fft.rfftfreq(4001, STEP)), atol=1e-6)


def test_undoing_restores_what_the_filter_left():
    rng = np.random.default_rng(0)
    f = ZeroPhase(2, 6.0, 1 / STEP)
    ratio = f.ratio(STEP)
    quiet = np.fft.rfft(rng.standard_normal(6000))
    quiet[np.fft.rfftfreq(6000, STEP) > 0.9 * 0.5 / STEP / ratio] = 0
    x = np.fft.irfft(quiet, 6000)
    restored, added = f.undone(filtfilt(*butter(2, 12.0 * STEP), x), STEP, ratio)
    inside = slice(300, -300)
    assert np.max(np.abs(restored - x)[inside]) < 0.01 * x.std()
    sharper, _ = f.sharpened(1.3).undone(filtfilt(*butter(2, 12.0 * STEP), x), STEP, ratio)
    np.testing.assert_allclose(sharper[inside], (restored + 0.3 * added)[inside], atol=1e-6 * x.std())


@pytest.mark.parametrize("order", [1, 2, 4, 8])
@pytest.mark.parametrize("share", [0.1, 0.2, 0.4, 0.6, 0.8, 0.95])
def test_undoing_any_filter_gives_back_the_motion_and_never_blows_up(order, share):
    """Of any order, and with a cutoff up to the highest frequency that the samples hold, where it left nothing."""
    rng, time = np.random.default_rng(3), STEP * np.arange(2000)
    motion = np.sin(2 * np.pi * 0.4 * share * time * 0.25 / STEP / 2)
    x = motion + 0.01 * rng.standard_normal(2000)
    f = ZeroPhase(order, share * 0.5 / STEP, 1 / STEP)
    ratio = f.ratio(STEP)
    found, added = f.undone(filtfilt(*butter(order, share), x), STEP, ratio)
    inner = slice(200, -200)
    assert np.abs(found - motion)[inner].std() < 0.05 and np.abs(added).max() < 2
    assert np.isfinite(f.log_volume(STEP * ratio)).all()


@pytest.mark.parametrize("order", [2, 4])
@pytest.mark.parametrize("part", [0.12, 0.3, 0.4, 0.5, 0.7, 0.9])
def test_white_noise_stays_white_where_the_band_fades(order, part):
    """The bins beside the edge of the band keep the power of their aliases, so that no sample foretells another.

    part : the cutoff, of half the sampling rate. Where that is large there is a zero of the filter near to it.
    """
    rng, f = np.random.default_rng(1), ZeroPhase(order, part * 0.5 / STEP, 1 / STEP)
    ratio = f.ratio(STEP)
    noise = filtfilt(*butter(order, part), rng.standard_normal(100_000))
    assert noise_before([noise], STEP, f) == pytest.approx(1.0, rel=0.03)
    left = f.undone(noise, STEP, ratio)[0][500:-500:ratio]
    assert left.std() == pytest.approx(ratio**-0.5, rel=0.02)
    lags = [abs(np.corrcoef(left[k:], left[:-k])[0, 1]) for k in (1, 2, 3, 4)]
    assert max(lags) < 4 / np.sqrt(len(left))


def test_undoing_meets_no_kink_at_the_ends_of_a_large_swing():
    time = np.arange(0, 24, STEP)
    x = 0.8 * np.cos(7 * time + 1) * np.exp(-0.02 * time)
    f = ZeroPhase(2, 6.0, 1 / STEP)
    restored, _ = f.undone(filtfilt(*butter(2, 12.0 * STEP), x), STEP, f.ratio(STEP))
    assert np.max(np.abs(restored - x)[200:-200]) < 2e-4


@pytest.mark.parametrize("cutoff", [4.0, 8.0])
def test_filter_is_told_from_what_the_motion_leaves(cutoff):
    rng = np.random.default_rng(3)
    n, force = 8000, rng.standard_normal(8000)
    motion = lfilter([STEP**2], [1, -2 + 0.05 + 0.001, 1 - 0.05], force)  # a damped body under random force
    recorded = filtfilt(*butter(2, cutoff * 2 * STEP), motion + 0.02 * motion.std() * rng.standard_normal(n))
    found = estimated_filter([recorded], [], STEP)
    assert found.order == 2
    assert found.cutoff == pytest.approx(cutoff, rel=0.3)


# ---- with a model ------------------------------------------------------------------------------
def filtered(recording, cutoff=4.0):
    """The recorded position low-pass filtered forwards and backwards, as motion capture is."""
    position = filtfilt(*butter(2, cutoff * 2 * 0.02), recording["position"])
    return replace(recording, channels=dict(recording.channels) | {"position": position})


def unfiltered_fits(seed, start):
    recording = filtered(recorded(seed))
    return fits_of(cart(), recording, (0.0, 40.0), None, data_of(recording), ZeroPhase(2, start, 50.0), False, {})[0]


def test_the_fit_finds_the_truth_and_the_cutoff_under_a_filter():
    z = []
    for seed, start in ((0, 4.6), (1, 3.6)):
        data, fit = unfiltered_fits(seed, start)
        assert data.filter.sharpened(fit.process[-1]).cutoff == pytest.approx(4.0, rel=0.05)
        assert remembered(fit.innovations) <= 1
        z += [(fit.values[k] - TRUE[k]) / fit.errors[k] for k in TRUE]
    assert np.abs(z).max() < 4


@pytest.mark.parametrize("start", [2.3, 7.5])
def test_a_cutoff_settles_from_far_away_and_with_it_the_noise_of_the_sensor(start):
    recording = filtered(recorded(2))
    plain = data_of(recording)
    wrong = replace(plain, sensor_noise=np.array([1e-2]))
    ((data, fit),) = fits_of(
        cart(), recording, (0.0, 40.0), None, wrong, ZeroPhase(2, start, 50.0), False, {}, stated=np.array([False])
    )
    assert data.filter.sharpened(fit.process[-1]).cutoff == pytest.approx(4.0, rel=0.05)
    # The noise of one sample in `ratio`, whose band holds no more of it.
    assert data.sensor_noise[0] == pytest.approx(plain.sensor_noise[0] / np.sqrt(data.segments[0].ratio), rel=0.5)
    assert fit.values["stiffness"] == pytest.approx(TRUE["stiffness"], abs=4 * fit.errors["stiffness"])


def test_a_filter_is_not_believed_where_a_run_ends():
    recording = filtered(recorded(0, duration=40))
    ((data, _),) = fits_of(
        cart(), recording, (0.0, 40.0), None, data_of(recording), ZeroPhase(2, 4.0, 50.0), False, {}, known=True
    )
    (segment,) = data.segments
    assert segment.time[0] == pytest.approx(0.5, abs=0.1) and segment.time[-1] == pytest.approx(39.5, abs=0.1)


def test_fits_of_a_recording_as_it_is_where_nothing_was_filtered():
    plain = data_of(recorded(0))
    ((data, fit),) = fits_of(cart(), recorded(0), (0.0, 40.0), None, plain, None, False, {})
    assert data is plain and fit.values["stiffness"] == pytest.approx(
        TRUE["stiffness"], abs=4 * fit.errors["stiffness"]
    )


def test_inputs_may_have_gone_through_the_filter_too():
    recording = filtered(recorded(1))
    possible = fits_of(cart(), recording, (0.0, 40.0), None, data_of(recording), ZeroPhase(2, 4.0, 50.0), True, {})
    assert len(possible) == 2 and possible[0][1].loglik2 > possible[1][1].loglik2 + 50  # here they have not
    assert possible[0][0].cutoff_free and not possible[1][0].cutoff_free


def test_sparser_outputs_keep_all_of_the_inputs():
    (segment,) = data_of(recorded(0)).segments
    sparse, sim = segment.sparser(5), simulator(cart().with_unstated_holds("linear"))  # which does not know its ends
    whole = segment.simulate(sim, TRUE, np.zeros(2), substeps=2)
    part = sparse.simulate(sim, TRUE, np.zeros(2), substeps=10)
    np.testing.assert_allclose(part.y, whole.y[::5], atol=1e-12)
    half = sparse.part(slice(100, 300))
    again = half.simulate(sim, TRUE, whole.x[500], substeps=10)
    np.testing.assert_allclose(again.y, whole.y[500:1500:5], atol=1e-9)


def test_a_gain_corrects_at_the_samples_of_the_outputs_only():
    (segment,) = data_of(recorded(0)).segments
    gain, seen = np.array([[0.3], [1.0]]), segment.sparser(5)
    blind = np.full_like(segment.recorded, np.nan)
    blind[::5] = segment.recorded[::5]
    expected = replace(segment, recorded=blind).simulate(simulator(cart()), TRUE, np.zeros(2), gain, substeps=2)
    run = seen.simulate(simulator(cart()), TRUE, np.zeros(2), gain, substeps=10)
    np.testing.assert_allclose(run.y, expected.y[::5], atol=1e-12)


def test_memory_of_the_sensors_widens_errors_to_what_repeats_scatter():
    z = []
    for seed in range(3):
        recording = recorded(seed, gust=0.02)
        rng = np.random.default_rng(seed)
        noise = 2e-3 * autoregressive(rng, len(recording), 0.85, outputs=1)[:, 0]
        data = data_of(
            replace(recording, channels=dict(recording.channels) | {"position": recording["position"] + noise})
        )
        white = fit_model(cart(), data)
        coloured, fit = with_memory(white, data)
        assert coloured.memory > 0 and remembered(fit.remaining) == 0
        z += [(fit.values[k] - TRUE[k]) / fit.errors[k] for k in TRUE]
    assert np.abs(z).max() < 4 and np.std(z) < 1.7


def test_colour_too_weak_for_a_memory_is_seen_all_the_same():
    """Fits anew may explain more by a memory than the innovations of a fit that took them for white."""
    rng = np.random.default_rng(1)
    white = rng.standard_normal((3000, 2))
    b, a = [1.0, -0.8], [1.0, -0.87]
    weak = np.column_stack([lfilter(b, a, white[:, 0]), white[:, 1]])
    assert remembered([weak]) == 0 and is_coloured([weak], 0)
    assert not is_coloured([weak[:50]], 4)  # too short for a longer memory
    assert not any(is_coloured([rng.standard_normal((400, 2))], k % 3) for k in range(60))


def test_fits_tell_how_much_is_remembered_where_innovations_tell_too_little(monkeypatch):
    recording, rng = recorded(0, gust=0.02), np.random.default_rng(0)
    wave = lfilter([1.0], [1.0, -1.2, 0.6], rng.standard_normal(len(recording)))
    data = data_of(
        replace(recording, channels=dict(recording.channels) | {"position": recording["position"] + 2e-3 * wave})
    )
    white = fit_model(cart(), data)
    monkeypatch.setattr(noise_memory, "remembered", lambda innovations: 1)
    coloured, fit = with_memory(white, data)
    assert coloured.memory >= 2 and remembered(fit.remaining) == 0
    monkeypatch.setattr(noise_memory, "remembered", lambda innovations: 0)
    monkeypatch.setattr(noise_memory, "is_coloured", lambda innovations, memory: False)
    assert with_memory(white, data) == (data, white)


def test_lags_are_added_as_long_as_chance_does_not_explain_what_is_left(monkeypatch):
    """Each of several may explain less than its price, and all together far more than chance does."""
    recording, rng = recorded(0, gust=0.02), np.random.default_rng(0)
    wave = 2e-3 * lfilter([1.0], [1.0, -0.6], rng.standard_normal(len(recording)))
    data = data_of(replace(recording, channels=dict(recording.channels) | {"position": recording["position"] + wave}))
    white, asked = fit_model(cart(), data), []
    monkeypatch.setattr(noise_memory, "is_coloured", lambda innovations, memory: asked.append(memory) or memory < 4)
    assert with_memory(white, data)[0].memory == 4 and 3 in asked


@pytest.mark.slow
def test_nothing_is_found_in_a_filtered_recording_that_lacks_nothing():
    finding_of = finding(filtered(recorded(5)))
    assert finding_of.verdict == "adequate"
    assert "low-pass filtered" in finding_of.words and "undone" in finding_of.words


def coloured(recording, size, seed=4):
    """The recorded position with noise more that remembers 50 ms."""
    noise = size * np.sqrt(1 - 0.67**2) * autoregressive(np.random.default_rng(seed), len(recording), 0.67, 1)[:, 0]
    return replace(recording, channels=dict(recording.channels) | {"position": recording["position"] + noise})


@pytest.mark.slow
def test_noise_that_remembers_is_not_taken_for_physics_and_physics_not_for_noise():
    finding_of = finding(coloured(recorded(6), 8 * SENSOR))
    assert finding_of.verdict == "adequate" and "not white" in finding_of.words
    term = next(s.term for s in few() if s.term.name == "cubic_stiffness")
    finding_of = finding(coloured(recorded(6, term, {"k3_Nm_rad3": 3e4}), 8 * SENSOR))
    assert [e.name for e in finding_of.effects] == ["cubic_stiffness"]


@pytest.mark.parametrize("size", [0.5, 1.5])
def test_free_motion_takes_noise_that_remembers_for_noise_and_a_motion_that_is_not_met_for_none(size):
    rng, time = np.random.default_rng(0), np.arange(0, 20, 0.01)
    swing = 0.1 * np.exp(-0.1 * time) * np.cos(7 * time)
    noise = 1e-3 * (rng.standard_normal(2000) + size * np.sqrt(1 - 0.82**2) * autoregressive(rng, 2000, 0.82, 1)[:, 0])
    errors = SimpleNamespace(kalman_gain=None, process=np.zeros(0), innovations=(noise[:, None],))
    assert _is_broad(errors, remembered(errors.innovations))
    missed = SimpleNamespace(kalman_gain=None, process=np.zeros(0), innovations=((noise + 0.1 * swing)[:, None],))
    assert not _is_broad(missed, remembered(missed.innovations))


@pytest.mark.parametrize(
    ("rings_hz", "noise"),
    [(1.1, False), (7.3, True), (None, True)],
    ids=["where it swings", "a hum beyond its swings", "first order"],
)
def test_errors_that_stand_out_where_the_motion_is_are_no_noise(rings_hz, noise):
    rng, step = np.random.default_rng(5), 0.01
    time = np.arange(0, 60, step)
    if rings_hz is None:
        errors = autoregressive(rng, len(time), 0.8, 1)[:, 0]
    else:  # a resonance of that frequency that noise drives
        radius = np.exp(-0.2 * step)
        turns = np.array([1.0, -2 * radius * np.cos(2 * np.pi * rings_hz * step), radius**2])
        errors = lfilter([1.0], turns, rng.standard_normal(len(time)))
    swing = 300.0 * errors.std() * np.cos(2 * np.pi * 1.1 * time) * np.exp(-0.02 * time)
    segment = Segment(time, (swing + errors)[:, None], {})
    data = Data((segment,), np.array([0.1]), driven=False)
    fit = SimpleNamespace(kalman_gain=None, innovations=(errors[:, None],))
    assert _swings(fit, data, 4) is not noise


def test_a_stated_filter_keeps_its_cutoff():
    recording = filtered(recorded(0))
    ((data, fit),) = fits_of(
        cart(), recording, (0.0, 40.0), None, data_of(recording), ZeroPhase(2, 4.0, 50.0), False, {}, known=True
    )
    assert not data.cutoff_free and data.filter == ZeroPhase(2, 4.0, 50.0)
    assert fit.values["stiffness"] == pytest.approx(TRUE["stiffness"], abs=4 * fit.errors["stiffness"])


@pytest.mark.parametrize("sign", [1, 0, -1])
def test_a_covariance_without_a_cholesky_factor_whitens_nothing_though_its_determinant_is_positive(sign):
    assert Whitening(np.zeros((0, 2, 2)), sign * np.eye(2), np.ones(1)).is_possible is (sign > 0)
