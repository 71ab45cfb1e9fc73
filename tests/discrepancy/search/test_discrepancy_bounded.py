"""A fit to samples that correct the state does not end in a loop that runs away."""

import numpy as np
import pytest
from driven_cart import SENSOR, TRUE, cart, data_of, recorded

from symid.estimation.fitting.fitter import Fitter
from symid.estimation.predicting.growth import growth, growth_normal, runs_away
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment


def values(fitter, **changed):
    return np.array([(TRUE | changed)[k] for k in fitter.sim.parameters])


def test_growth_is_priced_with_the_right_slope():
    fitter = Fitter(cart(-1e3), data_of(recorded(1)))
    path = np.zeros((3, 2))
    assert growth(fitter, values(fitter), path) == 0
    assert not np.any(growth_normal(fitter, values(fitter), path)[1])
    p = values(fitter, stiffness=-3.0)
    # s = (-c + sqrt(c^2 - 4 m k)) / 2 m over 40 s, two powers of e allowed to be missing, ten errors each.
    m, c, k = 2.0, 1.2, -3.0
    root = np.sqrt(c**2 - 4 * m * k)
    assert growth(fitter, p, path) == pytest.approx(10 * ((-c + root) / (2 * m) * 40 + 2), rel=1e-3)
    H, g = growth_normal(fitter, p, path)
    slope = -10 * 40 / root
    i = fitter.free.index("stiffness")
    assert H[i, i] == pytest.approx(slope**2, rel=1e-2) and g[i] == pytest.approx(
        -growth(fitter, p, path) * slope, rel=1e-2
    )


def test_what_leaves_the_recording_has_run_away():
    fitter = Fitter(cart(-1e3), data_of(recorded(1)))
    x0 = np.array([[1e-3, 0.0]])
    assert runs_away(fitter, values(fitter, stiffness=-3.0), x0)
    assert not runs_away(fitter, values(fitter), x0)


@pytest.mark.parametrize("seed", [1, 7])
def test_a_fit_does_not_end_in_a_loop_that_runs_away(seed, monkeypatch):
    # A drift that the model lacks looks like a motion that grows; samples that correct it hide that it would not stop.
    time = np.arange(0, 30, 0.02)
    drift = np.cumsum(np.random.default_rng(seed).standard_normal(len(time))) * 1e-3
    data = Data((Segment(time, drift[:, None], {"shaker": 0 * time}),), np.array([SENSOR]), True)

    def grown():
        fitter = Fitter(cart(-1e3), data)
        fit = fitter.fit({"stiffness": 1.0, "damping": 1.0}, np.zeros((1, 2)), np.array([1.0]))
        return growth(fitter, np.array([fit.values[k] for k in fitter.sim.parameters]), np.zeros((1, 2)))

    assert grown() < 1
    monkeypatch.setattr("symid.estimation.fitting.fitter.runs_away", lambda *_: False)
    assert grown() > 20
