"""Mistakes of people who know what they do: each is refused in a sentence, or warned of, and none gives a result."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import (
    DiagnosisError,
    ModelError,
    RecordingError,
    RecordingWarning,
    SolveError,
    SymidError,
    TranscriptionError,
)

RECORDING = pendulum_recording(duration=2)


def problem(model=None, **channels) -> si.Identification:
    return si.Identification(model or pendulum(), replace(RECORDING, channels={**RECORDING.channels, **channels}))


def more(model: si.Model, term) -> None:
    """One more term in the balance."""
    model.components["balance"] = replace(model.balance, expr=model.balance.expr + term)


@pytest.mark.parametrize("size", [1e200, 1e-200, 5e-324])
def test_sizes_that_cannot_be_squared_are_refused(size):
    with pytest.raises(TranscriptionError, match="channel 'angle' of pendulum reaches .* rad, whose square is beyond"):
        problem(angle=RECORDING["angle"] / np.abs(RECORDING["angle"]).max() * size).transcription  # noqa: B018


def test_a_sensor_that_stands_still_is_remarked():
    assert "angle is 0 rad in all 101 samples; was its sensor connected" in problem(angle=np.zeros(101)).remarks[0]
    assert not [text for text in problem().remarks if "in all" in text]


@pytest.mark.parametrize(
    ("model", "words"),
    [
        (lambda m: m.with_bounds(damping=(0.4, 0.4)), r"leave it one value; say model.fixed\(damping=0.4\)"),
        (lambda m: m.with_bounds(damping=(np.inf, np.inf)), "'damping' are not an interval"),
        (lambda m: m.with_bounds(angle=(-np.inf, -np.inf)), "'angle' are not an interval"),
        (lambda m: prior(m, si.Normal(50, 0.1)), "the prior 50 ± 0.1 of 'damping' and its bounds .* contradict"),
    ],
)
def test_bounds_and_priors_that_leave_nothing_are_named_by_check(model, words):
    with pytest.raises(ModelError, match=words):
        model(pendulum()).check()


def prior(model: si.Model, given) -> si.Model:
    model.components["damping"] = replace(model.damping, prior=given)
    return model


def test_a_prior_that_reaches_into_the_bounds_is_none_of_these():
    prior(pendulum(), si.Normal(-1.0, 0.5)).check()


@pytest.mark.parametrize("lag", [-0.1, float("nan"), sm.oo])
def test_no_signal_is_early(lag):
    m = pendulum()
    with pytest.raises(ModelError, match="give a lag of at least 0"):
        m.delayed(m.angle, lag)


def test_a_lag_in_milliseconds_is_longer_than_the_recording():
    m = pendulum()
    more(m, 0.1 * m.stiffness * m.delayed(m.angle, 100))
    with pytest.raises(TranscriptionError, match="delays 'angle' by up to 100 s, and pendulum has only 2 s"):
        problem(m).transcription  # noqa: B018


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"ridge": -1}, "ridge=-1: give a number of at least 0"),
        ({"ridge": np.inf}, "ridge=inf: give a finite number"),
        ({"noise": [{"measured": 1e200}]}, "1e.200 of 'measured' must be a positive number, 1e.100 at most"),
    ],
)
def test_options_that_ruin_an_objective_are_refused(options, words):
    with pytest.raises(TranscriptionError, match=words):
        replace(problem(), **options).transcription  # noqa: B018


def test_ten_million_episodes_are_a_slip():
    with pytest.raises(TranscriptionError, match="episodes: the count=10000000: .* 1000 at most"):
        si.Episodes(10**7, push=1.0)


def test_an_index_that_occurs_twice_is_refused():
    with pytest.raises(ModelError, match=r"index=\[1, 2, 1\]: an index occurs twice"):
        si.Model("masses").x = si.State(unit="m", index=[1, 2, 1])


def test_a_problem_does_not_outlive_its_model():
    """The equations that were compiled are the old ones, and values and bounds were read from the old parts."""
    used = problem()
    used.transcription  # noqa: B018
    used.model.components["stiffness"] = replace(used.model.stiffness, value=3.0)
    with pytest.raises(TranscriptionError, match="changed since this problem was first used"):
        used.solve()


def test_one_recording_given_twice_is_remarked():
    twice = si.Identification(pendulum(), [RECORDING, pendulum_recording(duration=2)])
    assert "recordings 1 and 2 are the same from 0 to 2 s" in twice.remarks[0]
    parted = si.Identification(pendulum(), [RECORDING, RECORDING], window=[(0, 1), (1, 2)])
    other = si.Identification(pendulum(), [RECORDING, pendulum_recording(duration=2, noise=1e-3)])
    assert not [text for p in (parted, other) for text in p.remarks if "counts twice" in text]


def test_held_out_data_that_were_fitted_are_warned_of():
    solution = si.Identification(pendulum(), RECORDING, window=(0, 1)).solve()
    with pytest.warns(RecordingWarning, match="0.5 to 1.5 s holds samples that were fitted"):
        solution.fit_on((0.5, 1.5))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RecordingWarning)
        solution.fit_on((1, 2))


@pytest.mark.parametrize(
    ("windows", "words"),
    [
        ({"fit_window": (0, 1.5), "held_out": (1, 2)}, "share 1 to 1.5 s: what was fitted proves nothing"),
        ({"fit_window": (0, 2), "held_out": (0, 2)}, "share 0 to 2 s"),
        ({"fit_window": "fit", "held_out": "fit"}, "share 'fit'"),
        ({"fit_window": (0, 1), "held_out": (1, 40)}, "held_out=1 to 40 s does not lie in pendulum, .* 0 to 2 s"),
        ({"fit_window": (-3, 1), "held_out": (1, 2)}, "fit_window=-3 to 1 s does not lie in pendulum"),
    ],
)
def test_windows_of_a_diagnosis_that_prove_nothing_are_refused(windows, words):
    with pytest.raises(DiagnosisError, match=words):
        si.diagnose(pendulum(), RECORDING, **windows)


def test_a_diagnosis_of_nothing_is_refused():
    empty = replace(RECORDING, channels={**RECORDING.channels, "angle": np.full(101, np.nan)})
    with pytest.raises(DiagnosisError, match="no two samples in which angle, drive were all measured"):
        si.diagnose(pendulum(), empty, fit_window=(0, 1), held_out=(1, 2))


@pytest.mark.parametrize("asked", [lambda m: si.diagnose(m, RECORDING, fit_window=(0, 1)), si.identifiability])
def test_a_model_that_cannot_be_used_is_refused_in_its_own_words(asked):
    model = pendulum()
    model.components["drive"] = replace(model.components["drive"], hold="held")
    with pytest.raises(ModelError, match="the input 'drive' has hold='held'; known: 'smooth', "):
        asked(model)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"name": None}, "the name of a Recording: give a str, not None"),
        ({"noise": {"angle": -1.0}}, "noise of 'angle'=-1.0: give a number of at least 0"),
        ({"noise": {"angle": np.inf}}, "noise of 'angle'=inf: give a finite number"),
        ({"noise": {"angle": "low"}}, "noise of 'angle'='low': give a number"),
    ],
)
def test_recordings_with_odd_fields_are_refused(change, words):
    with pytest.raises(RecordingError, match=words):
        replace(RECORDING, **change)


def test_a_window_in_words_is_refused():
    with pytest.raises(SymidError, match="an end of the window='a': give a number"):
        RECORDING.window("a", "b")


@pytest.mark.parametrize("step", [sm.sign, sm.Heaviside, sm.floor])
def test_steps_in_equations_are_simulated_too(step):
    """The default start simulates, and SymPy's own derivative of a step is no number."""
    m = pendulum()
    m.friction = si.Parameter(unit="1/s^2", bounds=(-1, 1))
    more(m, m.friction * step(m.rate))
    solution = problem(m).solve()
    assert solution.solved and abs(solution.values["friction"]) < 0.01


def test_states_are_found_in_channels_of_their_own_names():
    solution = problem().solve()
    assert si.stability(solution, per_state=3).eigenvalue_percent == 100


def test_an_option_that_ipopt_refuses_is_refused_at_the_first_start(capfd):
    """Ipopt prints what it does not like, whatever it may print."""
    with pytest.raises(SolveError, match="Ipopt refused the option nonsense=3"):
        problem().solve(options={"nonsense": 3})
    assert capfd.readouterr().out.count("nonsense") == 1
