"""A filter's cutoff is estimated with the model, round by round, until it stays where it is."""

from types import SimpleNamespace

import numpy as np
import pytest

import symid.estimation.measurement as measurement


@pytest.mark.parametrize(
    ("liked", "kept"),
    [
        ({3.1: 2.5, 2.5: 2.0, 2.0: 2.0}, 2.0),
        # A person with 0.1 s of delay, filtered at 4 Hz, with a model that lacks the delay.
        ({3.1: 2.3, 2.3: 3.3, 3.3: 2.3}, 3.1),
    ],
)
def test_a_cutoff_that_does_not_settle_stays_where_the_spectra_put_it(monkeypatch, liked, kept):
    """`liked` is the cutoff in Hz that the fit wants next; data and fits are stood for by the cutoff."""
    monkeypatch.setattr(measurement, "_noise", lambda plain, filter: 1.0)
    monkeypatch.setattr(measurement, "replace", lambda plain, **_: plain)
    monkeypatch.setattr(measurement, "_undone", lambda m, r, part, length, own, filter, inputs: filter)
    monkeypatch.setattr(measurement, "_fitted", lambda m, data, start: SimpleNamespace(cutoff=data, values={}, model=m))
    monkeypatch.setattr(measurement, "has_settled", lambda fit, data: liked[data] == data)
    monkeypatch.setattr(measurement, "sharpened_filter", lambda fit, data: liked[data])
    plain = SimpleNamespace(sensor_noise=np.ones(1))
    data, fit = measurement.settled(None, None, None, None, plain, 3.1, {})
    assert data == fit.cutoff == kept
