"""What inputs do between their samples, in every integrator."""

import numpy as np
import pytest

import symid as si
from symid.recording.signals.between import between
from symid.simulation import Simulator
from symid.simulation.stiff import simulate_stiff


def lag(hold: str) -> si.Model:
    m = si.Model("lag")
    m.x, m.u = si.State(unit="m"), si.Input(unit="m", hold=hold)
    m.rate = si.Parameter(unit="1/s")
    m.motion = si.Equation(m.x.dot - m.rate * (m.u - m.x))
    m.seen = si.Output(m.x)
    return m


def uneven(samples: int) -> np.ndarray:
    """Times from 0 to 2 s of which the first interval has a length of its own."""
    return np.sort(np.r_[0, 2, np.linspace(0, 2, samples)[1:-1] + 0.3 / samples])


@pytest.mark.parametrize("backend", ["c", "numpy"])
@pytest.mark.parametrize("hold, order", [("linear", 2), ("cubic", 4)])
def test_a_sampled_smooth_input_is_met_to_the_order_of_its_curves(backend, hold, order):
    def error(samples: int) -> float:
        t = uneven(samples)
        run = Simulator(lag(hold), backend).simulate({"rate": 1.0}, [0.0], t, {"u": np.sin(4 * t)}, substeps=2)
        exact = (np.sin(4 * t) - 4 * np.cos(4 * t) + 4 * np.exp(-t)) / 17
        return float(np.abs(run.y[:, 0] - exact).max())

    assert np.log2(error(81) / error(161)) == pytest.approx(order, abs=0.3)


@pytest.mark.parametrize("per_period, hold, left", [(6, "cubic", 2e-3), (3, "cubic", 0.065), (3, "band-limited", 2e-3)])
def test_of_a_fast_input_a_curve_keeps_what_its_degree_lets(per_period, hold, left):
    t, fine = np.arange(300.0), np.linspace(60, 240, 18_001)
    wave = np.exp(2j * np.pi * t / per_period)
    kept = between(t, wave.real, fine, hold) + 1j * between(t, wave.imag, fine, hold)
    lost = 1 - np.mean(kept * np.exp(-2j * np.pi * fine / per_period)).real
    assert left / 2 < lost < 1.1 * left


@pytest.mark.parametrize("samples", [2, 3, 4, 5, 12])
def test_a_curve_goes_on_to_the_ends_of_few_samples(samples):
    t = 1e-3 * np.arange(samples)
    line = between(t, 3 + 2 * t, np.linspace(0, t[-1], 50), "band-limited")
    np.testing.assert_allclose(line, 3 + 2 * np.linspace(0, t[-1], 50), atol=1e-12)


@pytest.mark.parametrize("backend", ["c", pytest.param("numpy", marks=pytest.mark.slow)])
@pytest.mark.parametrize("hold", ["linear", "cubic", "band-limited", "zero"])
def test_a_stiff_integrator_sees_the_same_input(hold, backend):
    t = uneven(41)
    u = np.sin(40 * t)
    run = Simulator(lag(hold), backend).simulate({"rate": 5.0}, [0.2], t, {"u": u}, substeps=16)
    stiff = simulate_stiff(lag(hold), np.array([5.0]), np.array([0.2]), t, {"u": u}, {}, np.array([1.0]), 1e-10)
    np.testing.assert_allclose(stiff[:, 0], run.y[:, 0], atol=1e-7)


@pytest.mark.parametrize("backend", ["c", "numpy"])
@pytest.mark.parametrize("delay", [0.0, 0.013, 0.05, 0.12, 0.135])
def test_a_held_input_that_is_late_answers_to_its_delay(backend, delay):
    """Against the sum of what each held step has left, which is exact: x' = rate (u(t - delay) - x)."""
    m = lag("zero")
    m.delay = si.Parameter(unit="s", bounds=(0, 1))
    m.substitute({m["u"].symbol: m.delayed(m["u"].symbol, m["delay"].symbol)})
    t = np.arange(41) * 0.05
    u, rate = np.random.default_rng(3).normal(size=41), 2.0

    def exact(d: float) -> np.ndarray:
        after = np.maximum(t[:, None] - t - d, 0.0)
        return u[0] + np.diff(u, prepend=u[0]) @ (1 - np.exp(-rate * after)).T - u[0] * np.exp(-rate * t)

    run = Simulator(m, backend).simulate(
        {"rate": rate, "delay": delay}, [0.0], t, {"u": u}, substeps=8, sensitivity=["delay"]
    )
    np.testing.assert_allclose(run.y[:, 0], exact(delay), atol=1e-3)
    h = 1e-6
    slope = (exact(delay + h) - exact(delay)) / h  # to one side: where a sample is met the other differs
    np.testing.assert_allclose(run.dy[:, 0, 0], slope, atol=0.05 * np.abs(slope).max())


@pytest.mark.parametrize("step", [0.002, 0.01, 1 / 30])
def test_a_held_input_changes_at_its_samples_however_their_times_were_computed(step):
    t = np.cumsum(np.full(500, step)) - step
    fine = np.arange(499 * 8 + 1) * step / 8
    u = np.arange(500.0)
    np.testing.assert_array_equal(between(t, u, fine, "zero"), np.r_[np.repeat(u[:-1], 8), u[-1]])
    np.testing.assert_allclose(between(t, u, fine, "either"), np.arange(499 * 8 + 1) / 8, atol=1e-9)
