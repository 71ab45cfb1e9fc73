"""Outputs of coarse steps are corrected by what fine ones change of them, and lead a fit to where fine ones do."""

from dataclasses import replace

import numpy as np
import pytest

import symid as si
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.simulation import simulator

TRUE, NOISE = {"stiffness": 40.0, "hardening": 30.0, "damping": 0.02}, 1e-6
FINE = 16


def swing() -> si.Model:
    m = si.Model("hardening swing")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.stiffness, m.hardening = si.Parameter(unit="1/s^2", bounds=(0, 200)), si.Parameter(unit="1/(m^2*s^2)")
    m.damping = si.Parameter(unit="1/s", bounds=(0, 5))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.damping * m.v + m.stiffness * m.x + m.hardening * m.x**3)
    m.seen = si.Output(m.x)
    return m


def fitted(seed: int) -> tuple[Fit, Data]:
    time, model = np.arange(0, 20, 0.02), swing()
    run = simulator(model).simulate(TRUE, [0.6, 0.0], time, substeps=64)
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(time))
    segments = segments_between(model, time, {"x": run.y[:, 0] + noise}, (0, 19.9), None)
    data = Data(segments, np.array([NOISE]), driven=False)
    return fit_model(model, data, {k: 1.1 * v for k, v in TRUE.items()}), data


@pytest.mark.parametrize("seed", [1, 2])
def test_a_fit_of_coarse_steps_ends_where_one_of_fine_steps_does(seed):
    fit, data = fitted(seed)
    assert fit.coarse < fit.substeps
    exact = Fitter.of(replace(fit, coarse=FINE, substeps=FINE), data).again(fit)
    assert exact.coarse == exact.substeps == FINE
    for k, v in exact.values.items():
        assert abs(fit.values[k] - v) < 0.2 * exact.errors[k]
        assert fit.errors[k] == pytest.approx(exact.errors[k], rel=0.02)
        assert abs(v - TRUE[k]) < 4 * exact.errors[k]
    assert fit.loglik2 == pytest.approx(exact.loglik2, abs=1.0)


def test_without_a_correction_the_same_steps_mislead():
    fit, data = fitted(1)
    plain = Fitter.of(replace(fit, substeps=fit.coarse), data).again(fit, exact=False)
    assert plain.loglik2 < fit.loglik2 - 10
    assert max(abs(plain.values[k] - v) / fit.errors[k] for k, v in fit.values.items()) > 1
