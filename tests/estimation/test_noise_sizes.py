"""Sizes of random forces at which the recording is likelier than where a fit ended."""

from dataclasses import replace

import numpy as np
import pytest
from driven_cart import cart, data_of, recorded

from symid.estimation.fitting import cold_start
from symid.estimation.fitting.cold_start import _with_likeliest_noise, fit_model
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.noise_sizes import likeliest_sizes


def test_a_fit_that_ended_at_a_wrong_size_of_a_force_goes_on_from_a_likelier_one():
    data = data_of(recorded())
    fit = fit_model(cart(), data)
    value, process = likeliest_sizes(Fitter.of(fit, data), fit, [np.array([17.0])])
    assert value < fit.loglik2 - 10 and process == pytest.approx(17 * fit.process)
    wrong = replace(fit, process=process, loglik2=value)
    found = _with_likeliest_noise(wrong, data, exact=True)
    assert found.loglik2 == pytest.approx(fit.loglik2, abs=0.1)
    assert found.process == pytest.approx(fit.process, rel=0.05)


def test_a_fit_at_the_maximum_stays_as_it_is():
    data = data_of(recorded())
    fit = fit_model(cart(), data)
    assert _with_likeliest_noise(fit, data, exact=True) is fit


def test_a_size_that_is_hardly_likelier_is_none_to_go_to(monkeypatch):
    data = data_of(recorded())
    fit = fit_model(cart(), data)
    monkeypatch.setattr(cold_start, "likeliest_sizes", lambda *_: (fit.loglik2 + 1.0, 16 * fit.process))
    assert _with_likeliest_noise(fit, data, exact=True) is fit
