"""A free run of data that were not fitted begins from a state of their own, wherever their motion begins."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import sympy as sm
from scipy.integrate import solve_ivp

import symid as si
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.free_run import free_run, with_states_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of

HEAVY, LIGHT, GRAVITY, NOISE = 0.30, 0.10, 9.81, np.array([8e-4, 1.5e-3])


def atwood() -> si.Model:
    """A mass that swings on the thread of a heavier one: from rest it falls into the pulley, where all is singular."""
    m = si.Model("swinging Atwood")
    m.r, m.q, m.v, m.w = si.State(unit="m"), si.State(unit="rad"), si.State(unit="m/s"), si.State(unit="rad/s")
    m.heavy = si.Parameter(unit="kg", bounds=(0.05, 2))
    m.sliding, m.turning = si.Equation(m.r.dot - m.v), si.Equation(m.q.dot - m.w)
    swing = m.q.symbol
    m.along = si.Equation(
        (m.heavy + LIGHT) * m.v.dot - LIGHT * m.r * m.w**2 - LIGHT * GRAVITY * sm.cos(swing) + m.heavy * GRAVITY
    )
    m.across = si.Equation(m.r**2 * m.w.dot + 2 * m.r * m.v * m.w + GRAVITY * m.r * sm.sin(swing))
    m.radius, m.angle = si.Output(m.r, channel="radius"), si.Output(m.q, channel="angle")
    return m


def recorded() -> si.Recording:
    def motion(_, x):
        r, q, v, w = x
        pull = LIGHT * r * w**2 + LIGHT * GRAVITY * np.cos(q) - HEAVY * GRAVITY
        return [v, w, pull / (HEAVY + LIGHT), -(2 * v * w + GRAVITY * np.sin(q)) / r]

    time = np.arange(0, 9, 1 / 60)
    path = solve_ivp(motion, (0, 9), [0.6, 1.9, 0, 0], "DOP853", t_eval=time, rtol=1e-10, atol=1e-12).y[:2].T
    path = path + NOISE * np.random.default_rng(1).standard_normal(path.shape)
    return si.Recording("atwood", time, {"radius": path[:, 0], "angle": path[:, 1]}, {"radius": "m", "angle": "rad"})


def test_a_run_that_does_not_last_from_rest_finds_its_rates_by_and_by():
    model, recording = atwood(), recorded()
    fitted, held_out = (
        Data(segments_of(model, recording, window, None), NOISE, driven=False) for window in ((0, 3), (3.5, 6.1))
    )
    fit = fit_model(model, fitted, {"heavy": HEAVY})
    assert np.all(free_run(fit, held_out).errors < 2 * NOISE)


def test_each_segment_begins_where_its_own_run_is_best(monkeypatch):
    """One beginning for all of them left pieces of a balancing robot to fall: 2.6 deg instead of 0.03."""
    data = Data(segments_of(atwood(), recorded(), (0, 3), 1.5), NOISE, driven=False)
    fit = fit_model(atwood(), data, {"heavy": HEAVY})
    begun = [fit.initial * np.array([[1.0], [3.0]]), fit.initial * np.array([[3.0], [1.0]])]
    monkeypatch.setattr("symid.estimation.free_run.beginnings", lambda *a: begun)
    monkeypatch.setattr("symid.estimation.free_run.Fitter.fit", stays)
    np.testing.assert_array_equal(with_states_of(fit, data).initial, fit.initial)


def stays(fitter, values, initial, process):
    """The run from a state that is not improved."""
    runs = fitter.run(np.array(list(values.values())), initial, None, False, process=process)
    return SimpleNamespace(initial=initial, innovations=fitter.innovations(runs, process))


def test_a_run_is_integrated_in_steps_as_small_as_its_fit_came_to_need():
    """With long ones the sharp friction of a geared robot axis let no fit of its states begin: 13.5 for 0.1 deg."""
    model, data = atwood(), Data(segments_of(atwood(), recorded(), (0, 3), None), NOISE, driven=False)
    fit = replace(fit_model(model, data, {"heavy": HEAVY}), substeps=4)
    assert with_states_of(fit, data).substeps == 4
