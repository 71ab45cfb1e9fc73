"""A filter that a fine sensor or a slow motion may have feigned: the recording is explained with it and without."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import savgol_filter

import symid as si
import symid.discrepancy.explained as steps
from symid.discrepancy.locate.audit import Audit, audit
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError
from symid.estimation.sensors.smoothing import Smoothing
from symid.estimation.signals.windows import segments_of


def swing() -> si.Model:
    m = si.Model("swing")
    m.a, m.w = si.State(unit="rad"), si.State(unit="rad/s")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 1000))
    m.push = si.Noise(unit="1/s^2")
    m.kinematics, m.balance = si.Equation(m.a.dot - m.w), si.Equation(m.w.dot + m.k * m.a - m.push)
    m.angle = si.Output(m.a, channel="angle")
    return m


def smoothed() -> si.Recording:
    """A swing after a mean of eleven samples, which leaves no floor."""
    time = np.arange(0, 20, 0.01)
    angle = np.sin(4.4 * time) + 1e-3 * np.random.default_rng(0).standard_normal(len(time))
    return si.Recording("swing", time, {"angle": savgol_filter(angle, 11, 0)}, {"angle": "rad"})


@pytest.fixture(scope="module")
def found() -> Audit:
    recording = smoothed()
    return audit(swing(), recording, segments_of(swing(), recording, recording.interval), None)


def explained(
    monkeypatch, found: Audit, errors: tuple, driven: bool = False, memories: tuple = (0, 0), white: bool = False
):
    """What is chosen and the filters that it was explained under, from errors of free runs, None of what is unfitted.

    errors, memories : with the filter and without, memories in samples of the noise.
    white : whether what is found without a filter leaves white noise alone.
    """
    asked = []

    def under(possible, *_):
        asked.append(possible.filter)
        error, memory = (both[possible.filter is None] for both in (errors, memories))
        if error is None:
            raise DiagnosisError(f"explanation {len(asked)} cannot be fitted")
        return SimpleNamespace(
            filter=possible.filter,
            plain="as it is",
            found=SimpleNamespace(fit=error),
            search=SimpleNamespace(data=SimpleNamespace(memory=memory)),
            leaves_white_noise=white,
        )

    def run(fit, data):
        assert data == "as it is"
        return SimpleNamespace(relative=fit)

    monkeypatch.setattr(steps, "audit", lambda *_: found)
    monkeypatch.setattr(steps, "_under", under)
    monkeypatch.setattr(steps, "free_run", run)
    task = Task(swing(), smoothed(), (0.0, 20.0), None, driven=driven)
    return steps.explained(task, None, None, None, lambda text: None), asked


def test_a_smoothing_is_doubted_unless_it_was_stated(found):
    recording = smoothed()
    assert isinstance(found.filter, Smoothing) and found.filter.samples == 11 and found.doubtful
    pieces = segments_of(swing(), recording, recording.interval)
    assert not audit(swing(), recording, pieces, None, found.filter).doubtful


@pytest.mark.parametrize(
    ("errors", "filtered"),
    [
        ((0.1, 0.06), False),
        ((0.1, 0.08), True),  # no clear difference: the spectra are believed
        ((np.nan, 0.5), False),  # a free run that diverges
        ((0.1, np.nan), True),
        ((None, 0.5), False),
        ((0.1, None), True),
    ],
)
def test_free_runs_choose_between_a_doubted_filter_and_none(monkeypatch, found, errors, filtered):
    chosen, asked = explained(monkeypatch, found, errors)
    assert [f is not None for f in asked] == [False, True]
    assert (chosen.filter is not None) == filtered


@pytest.mark.parametrize(
    ("memories", "errors", "filtered"),
    [
        ((1, 0), (0.1, 0.09), False),
        ((1, 0), (0.1, 0.11), True),
        ((0, 1), (0.1, 0.09), True),
        ((1, 1), (0.1, 0.09), True),
    ],
)
def test_noise_that_is_coloured_only_where_a_filter_is_undone_speaks_against_it(
    monkeypatch, found, memories, errors, filtered
):
    chosen, _ = explained(monkeypatch, found, errors, memories=memories)
    assert (chosen.filter is not None) == filtered


def test_what_is_explained_without_a_filter_is_not_searched_with_one(monkeypatch, found):
    chosen, asked = explained(monkeypatch, found, (0.001, 0.1), white=True)
    assert asked == [None] and chosen.filter is None


def test_white_noise_that_remembers_nothing_is_all_that_may_be_left():
    def left(memory: int, quiet: bool) -> bool:
        search = SimpleNamespace(data=SimpleNamespace(memory=memory), quiet=lambda found: quiet)
        return steps.Explained(None, None, None, search, None, []).leaves_white_noise

    assert left(0, True) and not left(1, True) and not left(0, False)


def test_a_recording_that_nothing_explains_says_why(monkeypatch, found):
    with pytest.raises(DiagnosisError, match="explanation 2 cannot be fitted"):
        explained(monkeypatch, found, (None, None))


def test_random_forces_let_no_free_run_choose(monkeypatch, found):
    chosen, asked = explained(monkeypatch, found, (0.1, 0.001), driven=True)
    assert len(asked) == 1 and chosen.filter is not None
