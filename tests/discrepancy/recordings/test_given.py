"""The model as given is fitted in pieces that it can follow."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.discrepancy.locate import given
from symid.discrepancy.task import task_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import FEWEST
from symid.estimation.signals.windows import segments_of


def test_a_motion_that_cannot_be_followed_at_all_is_fitted_in_shorter_pieces(monkeypatch):
    """What a wrong model does in the end may have no equations, as a load that swings into its pulley."""
    monkeypatch.setattr(given, "regressed", lambda task, plain: {})
    recording = pendulum_recording(duration=24.0)
    task = task_of(pendulum(), recording, (0, 24), None, held_out=None, driven=False)
    plain = Data(segments_of(task.model, recording, (0, 24), None), np.array([5e-4]), driven=False)

    def fits(task, plain, start):
        if any(e.time[-1] - e.time[0] > 7 for e in plain.segments):
            raise si.DiagnosisError("diverges")
        return [(plain, SimpleNamespace(kalman_gain=1, rms_errors=np.zeros(2), loglik2=0.0))]

    task, plain, found = given.fitted_as_given(task, plain, fits)
    assert task.segment_length == pytest.approx(6, rel=0.01) and found[0][0] is plain


def test_pieces_of_few_samples_are_no_shorter_than_a_window_may_be(monkeypatch):
    """Errors are told of windows that are cut alike; at the end of a search it would be too late to refuse them."""
    monkeypatch.setattr(given, "regressed", lambda task, plain: {})
    recording = pendulum_recording(duration=24.0)
    task = task_of(pendulum(), recording, (0, 24), None, held_out=None, driven=False)
    coarse = Data(segments_of(task.model, recording, (0, 24), None), np.array([5e-4]), driven=False)
    coarse = coarse.with_segments(e.part(slice(None, None, 60)) for e in coarse.segments)
    lengths = []

    def fits(task, plain, start):
        lengths.append(min(len(e.time) for e in plain.segments))
        raise si.DiagnosisError("diverges")

    with pytest.raises(si.DiagnosisError, match="diverges"):
        given.fitted_as_given(task, coarse, fits)
    assert len(set(lengths)) > 1 and min(lengths) >= FEWEST


@pytest.mark.parametrize(
    ("driven", "start", "lost", "asked"),
    [
        pytest.param(False, {}, {"regression": False}, ["regression"], id="regression comes first"),
        pytest.param(False, {}, {"regression": True, "start": True}, ["regression", "start"], id="it is lost"),
        pytest.param(False, {"damping": 0.4}, {"start": True}, ["start"], id="all values are known"),
        pytest.param(True, {}, {"start": True}, ["start"], id="random forces hold it together"),
        pytest.param(True, {}, {"start": None, "regression": False}, ["start", "regression"], id="the start fails"),
        pytest.param(False, {}, {"regression": None, "start": False}, ["regression", "start"], id="regression fails"),
    ],
)
def test_regression_leads_to_the_model_as_given_where_nothing_else_does(monkeypatch, driven, start, lost, asked):
    monkeypatch.setattr(given, "regressed", lambda task, plain: {"regression": 1.0})
    monkeypatch.setattr(given, "lost", lambda fit, data: fit.lost)
    task = SimpleNamespace(model=pendulum(), start=start)
    tried = []

    def fits(task, plain, start):
        name = "regression" if "regression" in start else "start"
        tried.append(name)
        if lost[name] is None:
            raise si.DiagnosisError("diverges")
        return [(plain, SimpleNamespace(lost=lost[name], loglik2=float(name == "start")))]

    ((_, fit),) = given.fitted_in_pieces(task, SimpleNamespace(driven=driven), fits)
    assert tried == asked and fit.lost == lost[asked[-1]]


def test_what_cannot_be_fitted_from_anywhere_says_how_its_start_ended(monkeypatch):
    def unknown(task, plain):
        raise si.SymidError("no equation is linear")

    def fits(task, plain, start):
        raise si.DiagnosisError("diverges from the start values")

    monkeypatch.setattr(given, "regressed", unknown)
    with pytest.raises(si.DiagnosisError, match="diverges from the start values"):
        given.fitted_in_pieces(SimpleNamespace(model=pendulum(), start={}), SimpleNamespace(driven=False), fits)


def test_a_recorded_input_keeps_a_motion_in_its_pieces_without_random_forces_too():
    task = task_of(pendulum(), pendulum_recording(duration=4.0), (0, 4), None, held_out=None, driven=False)
    assert task.model.inputs and task.moved and not task.random


@pytest.mark.parametrize("again", [False, True], ids=["times go on", "times begin anew"])
def test_runs_of_one_recording_are_regressed_each_by_itself(again):
    """From the middle of the bounds, which were all that was left of an error, a bob on a spring led nowhere."""
    whole = pendulum_recording(duration=24.0)
    half = len(whole.time) // 2
    rows = np.concatenate([np.arange(half), np.arange(half + 40, len(whole.time))])
    run = (rows >= half).astype(int)
    recording = si.Recording(
        "two runs",
        whole.time[rows] - again * run * 10.0,
        {k: v[rows] for k, v in whole.channels.items()},
        whole.units,
        segment=run,
        split=np.repeat("fit", len(rows)),
    )
    task = task_of(pendulum(), recording, "fit", None, held_out=None, driven=False)
    plain = Data(segments_of(task.model, recording, "fit", None), np.array([5e-4]), driven=False)
    assert given.regressed(task, plain)["damping"] == pytest.approx(0.4, rel=0.01)
