"""Suspects tried on top of a fitted model: which are worth a fit, and from where it begins."""

import numpy as np
import pytest
from driven_cart import cart, data_of, few, recorded

import symid.discrepancy.name.trial.explore as steps
import symid.discrepancy.name.trial.starts as begins
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.families import is_alike
from symid.discrepancy.model.suspects import Suspect, suspects
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.name.trial.scan import scan
from symid.discrepancy.prove.nulls import false_alarm_probability, largest, null_maxima
from symid.estimation.fitting.cold_start import fit_model
from symid.mechanics import LIBRARY


def test_hopeless_suspects_gain_nothing():
    data = data_of(recorded(8))
    fit = fit_model(cart(), data)
    found = explore(fit, data, few())
    assert found and max(c.score for c in found) < 5
    # What the model's own unknowns say already is never an explanation.
    own = [c for c in found if c.suspect.term.name in ("viscous_friction", "torsional_spring")]
    assert all(abs(c.log_ratio) < 1.0 for c in own)


def test_what_all_muscles_do_is_alike_to_what_those_at_one_joint_do():
    everywhere, elbow, wrist = (
        Suspect(LIBRARY[name].at(place))
        for name, place in (("muscle_lag", "global"), ("joint_muscle_lag", "elbow"), ("joint_feedback_delay", "wrist"))
    )
    assert is_alike(everywhere, elbow) and is_alike(wrist, everywhere)
    assert not is_alike(elbow, wrist)


def test_a_delay_that_no_value_of_a_wrong_model_survives_begins_from_nothing(monkeypatch):
    data = data_of(recorded(term=LIBRARY["input_delay"].at("input"), values={"delay_s": 0.06}))
    fit = fit_model(cart(), data)
    late = next(s for s in few() if s.term.name == "input_delay")
    monkeypatch.setattr(begins, "_here", lambda *a: -np.inf)
    starts = begins.starts_of(fit, data, Projection(fit, data), late)
    assert [s.afresh for s in starts] == [False, True]
    begun = steps.refit_from(fit, data, starts[1], 6)
    assert begun.fit.values[late.term.parameter_name("delay_s")] == pytest.approx(0.06, abs=0.005)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "gust", "length"),
    [("periodic_torque", 0.05, None), ("periodic_torque", 0.0, 8.0), ("external_push", 0.05, None)],
)
def test_the_best_moment_or_frequency_in_noise_is_no_rare_one(name, gust, length):
    suspect, found = next(s for s in suspects(cart()) if s.term.name == name), []
    for seed in range(4):
        data = data_of(recorded(seed, gust=gust), driven=gust > 0, length=length)
        fit = fit_model(cart(), data)
        projection = Projection(fit, data)
        scan(projection, suspect, fit.model.with_term(suspect.term))
        best = float(largest(projection, projection.rest[:, None])[0])
        found.append(false_alarm_probability(best, null_maxima(projection, fit)))
    assert min(found) > 0.01 and max(found) > 0.1
