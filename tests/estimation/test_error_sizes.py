"""Errors of free motions are as large everywhere, or grow with the motion, as the data say."""

from dataclasses import replace

import numpy as np
import pytest

import symid as si
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.sensors.whitening import whitening_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_between
from symid.simulation import simulator

TRUE, NOISE, SEEDS = {"stiffness": 40.0, "damping": 0.15}, 1e-3, 24


def swing() -> si.Model:
    m = si.Model("swing that dies away")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.stiffness, m.damping = si.Parameter(unit="1/s^2", bounds=(0, 200)), si.Parameter(unit="1/s", bounds=(0, 5))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.damping * m.v + m.stiffness * m.x)
    m.seen = si.Output(m.x)
    return m


def dying(seed: int, growing: bool, unit: float = 1.0) -> Data:
    """A motion that falls twentyfold in eight pieces; its noise falls with it, or stays as large."""
    time, model = np.arange(0, 40, 0.05), swing()
    clean = simulator(model).simulate(TRUE, [1.0, 0.0], time, substeps=8).y[:, 0]
    size = NOISE * (np.exp(-0.5 * TRUE["damping"] * time) if growing else 1.0)
    noisy = clean + size * np.random.default_rng(seed).standard_normal(len(time))
    return Data(segments_between(model, time, {"x": unit * noisy}, (0, 39.9), 5.0), np.array([NOISE]), driven=False)


def fitted(data: Data) -> Fit:
    return fit_model(swing(), data, {k: 1.05 * v for k, v in TRUE.items()})


@pytest.mark.parametrize("growing", [True, False])
def test_errors_grow_with_the_motion_where_they_do_and_only_there(growing):
    data = dying(0, growing)
    sizes = fitted(data).whitening.sizes
    assert len(sizes) == len(data.segments) == 8
    true = np.array([np.std(e.recorded) for e in data.segments]) if growing else np.ones(8)
    true /= np.exp(np.mean(np.log(true)))
    np.testing.assert_allclose(sizes, true, rtol=0.25)


@pytest.mark.parametrize("growing", [True, False])
def test_standard_errors_are_those_of_repeats(growing):
    fits = [fitted(dying(seed, growing)) for seed in range(SEEDS)]
    for name, true in TRUE.items():
        scores = np.array([(f.values[name] - true) / f.errors[name] for f in fits])
        assert 0.7 < np.sqrt(np.mean(scores**2)) < 1.35


def test_small_swings_tell_more_where_their_errors_are_smaller():
    growing, equal = (fitted(dying(3, growing)) for growing in (True, False))
    assert growing.errors["damping"] < 0.6 * equal.errors["damping"]


def test_sizes_have_no_unit_and_change_no_likelihood_by_themselves():
    metres, millimetres = dying(1, True), dying(1, True, unit=1e3)
    np.testing.assert_allclose(metres.error_sizes, millimetres.error_sizes, rtol=1e-9)
    lengths = np.array([len(e.time) for e in metres.segments])
    np.testing.assert_allclose(np.log(metres.error_sizes) @ lengths, 0.0, atol=1e-9)


def test_innovations_are_whitened_to_unit_variance_in_parts_of_their_sizes():
    rng, sizes = np.random.default_rng(0), np.array([[1.0, 1.0], [0.2, 5.0]])
    innovations = [s * rng.standard_normal((600, 2)) for s in (0.4, 10.0)]
    whitening = whitening_of(innovations, 0, sizes)
    np.testing.assert_array_equal(whitening.sizes, sizes[1])
    left = [whitening(s[:, :, None], size).reshape(s.shape) for s, size in zip(innovations, sizes[1], strict=True)]
    for part in left:
        np.testing.assert_allclose(part.std(axis=0), 1.0, rtol=0.1)


@pytest.mark.parametrize(("driven", "push"), [(True, 0.0), (False, 0.0), (False, 1.0)])
def test_one_segment_rest_and_driven_motions_have_errors_of_one_size(driven, push):
    time = np.arange(20) * 0.1
    still = Segment(time, np.full((20, 2), 3.0), {})
    pushed = {"push": push * np.sin(time)}
    moving = Segment(time, np.column_stack([np.sin(time), np.full(20, 3.0)]), pushed)
    noise = np.array([1e-3, 1e-3])
    assert Data((moving,), noise, driven=False, pace=1.0).error_sizes.tolist() == [[1.0]]
    assert Data((still, still), noise, driven=False, pace=1.0).error_sizes.tolist() == [[1.0, 1.0]]
    both = Data((moving, replace(still, inputs=pushed)), noise, driven=driven, pace=1.0).error_sizes
    assert np.isfinite(both).all() and np.all(both > 0)
    assert len(both) == 1 if driven or push else both.max() / both.min() > 5
