"""The model as given is fitted in pieces that it can follow."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.discrepancy.locate import given
from symid.discrepancy.task import task_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of


def test_a_motion_that_cannot_be_followed_at_all_is_fitted_in_shorter_pieces(monkeypatch):
    """What a wrong model does in the end may have no equations, as a load that swings into its pulley."""
    monkeypatch.setattr(given, "_start", lambda task, plain: {})
    recording = pendulum_recording(duration=24.0)
    task = task_of(pendulum(), recording, (0, 24), None, held_out=None, driven=False)
    plain = Data(segments_of(task.model, recording, (0, 24), None), np.array([5e-4]), driven=False)

    def fits(task, plain, start):
        if any(e.time[-1] - e.time[0] > 7 for e in plain.segments):
            raise si.DiagnosisError("diverges")
        return [(plain, SimpleNamespace(kalman_gain=1))]

    task, plain, found = given.fitted_as_given(task, plain, fits)
    assert task.segment_length == pytest.approx(6, rel=0.01) and found[0][0] is plain


def test_a_recorded_input_keeps_a_motion_in_its_pieces_without_random_forces_too():
    task = task_of(pendulum(), pendulum_recording(duration=4.0), (0, 4), None, held_out=None, driven=False)
    assert task.model.inputs and task.moved and not task.random
