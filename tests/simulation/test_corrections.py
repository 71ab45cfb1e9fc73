"""Corrections at the samples, as of a Kalman filter, and what sensitivities know of them."""

import numpy as np
import pytest
from oscillators import VALUES, central, oscillator

from symid.errors import SymidError


def test_sensitivities_follow_the_sample_corrections(Simulator):
    t = np.linspace(0, 4, 201)
    sim = Simulator(oscillator())
    rng = np.random.default_rng(2)
    common = {
        "time": t,
        "inputs": {"push": np.sin(2 * t)},
        "gain": np.array([[0.3, 0.01], [1.0, 0.1]]),
        "recorded": rng.normal(size=(201, 2)) * 0.1,
        "initial_state": [0.1, 0.0],
    }
    got = sim.simulate(VALUES, sensitivity=["stiffness"], **common)
    slope = central(lambda v: sim.simulate(v, **common).y, VALUES, "stiffness", 1e-3)
    np.testing.assert_allclose(got.dy[:, :, 0], slope, atol=1e-7 * np.abs(slope).max() + 1e-12)
    assert not np.allclose(got.y, sim.simulate(VALUES, [0.1, 0.0], t, {"push": np.sin(2 * t)}).y)


def test_corrections_of_the_past_reach_delayed_signals_and_sensitivities(Simulator):
    t = np.linspace(0, 4, 201)
    sim = Simulator(oscillator(0.07))
    rng = np.random.default_rng(2)
    gain = np.array(
        [
            [[0.3, 0.01], [1.0, 0.1]],
            [[0.2, 0.0], [0.5, 0.1]],
            [[0.1, 0.0], [0.3, 0.0]],
            [[0.0, 0.0], [0.1, 0.0]],
            [[0.0, 0.0], [0.1, 0.0]],
        ]
    )
    common = {
        "time": t,
        "inputs": {"push": np.sin(2 * t)},
        "gain": gain,
        "recorded": rng.normal(size=(201, 2)) * 0.1,
        "initial_state": [0.1, 0.0],
    }
    values = VALUES | {"lag": 0.073}
    got = sim.simulate(values, sensitivity=["stiffness", "lag"], **common)
    for key, h in (("stiffness", 1e-3), ("lag", 1e-6)):
        slope = central(lambda v: sim.simulate(v, **common).y, values, key, h)
        np.testing.assert_allclose(got.sensitivity("seen", key), slope[:, 0], atol=2e-5 * np.abs(slope[:, 0]).max())
    only_now = sim.simulate(values, **(common | {"gain": gain[0]}))
    assert not np.allclose(only_now.y, got.y)


@pytest.mark.parametrize("lag", [None, 0.07])
def test_sensitivities_know_that_the_gain_depends_on_parameters_and_more(Simulator, lag):
    t, rng = np.linspace(0, 4, 201), np.random.default_rng(3)
    sim, values = Simulator(oscillator(lag)), VALUES | ({} if lag is None else {"lag": lag})
    recorded = rng.normal(size=(201, 2)) * 0.1
    recorded[40, 1] = np.nan
    gain, *slopes = rng.uniform(0, 0.1, (3, 2, 2) if lag is None else (3, 6, 2, 2))
    common = {"initial_state": [0.1, 0.0], "time": t, "inputs": {"push": np.sin(2 * t)}, "recorded": recorded}
    got = sim.simulate(
        values, gain=gain, gain_slopes=slopes, sensitivity=["damping"], initial_sensitivity=["rate"], **common
    )
    assert got.wrt == ("damping", "rate(0)", "gain 1")

    def moved(v: dict[str, float]) -> np.ndarray:
        more = gain + (v["damping"] - values["damping"]) * slopes[0] + v["more"] * slopes[1]
        return sim.simulate({k: v[k] for k in values}, gain=more, **common).y

    for column, key in ((0, "damping"), (2, "more")):
        slope = central(moved, values | {"more": 0.0}, key, 1e-4)
        np.testing.assert_allclose(got.dy[:, :, column], slope, atol=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("shape", [(0, 2, 2), (1, 2), (1, 3, 2), (1, 4, 2, 2)])
def test_slopes_of_another_gain_are_refused(Simulator, shape):
    t = np.linspace(0, 1, 11)
    with pytest.raises(SymidError, match="gain_slopes must be at least 1 arrays of the gain's shape"):
        Simulator(oscillator()).simulate(
            VALUES,
            [0.1, 0.0],
            t,
            {"push": t},
            gain=np.zeros((2, 2)),
            recorded=np.zeros((11, 2)),
            sensitivity=["damping"],
            gain_slopes=np.zeros(shape),
        )
