"""Transcription: order of the schemes, derivatives, layout, delays, episodes, bad input."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from hypothesis import given, settings, strategies as st
from scipy import sparse
from scipy.sparse.linalg import spsolve

import symid.model as si
from symid.errors import TranscriptionError
from symid.nlp import check_derivatives
from symid.transcription import SCHEMES, Episodes, measure, scheme_by_name, transcribe
from symid.transcription.delays import SUPPORT, weights
from symid.transcription.layout import Layout


def transcribed(model, recording, scheme="midpoint", episodes=None, backend="numpy", window=None):
    return transcribe(
        model,
        [measure(model, recording, window)],
        scheme_by_name(scheme),
        episodes or Episodes(),
        np.ones((1, len(model.outputs))),
        (),
        backend,
    )


def follow(model, recording, scheme, values) -> np.ndarray:
    """The states at the nodes that satisfy the constraints from the recorded initial state (Newton)."""
    t = transcribed(model, recording, scheme)
    z, p = t.start(np.array(values)), t.program
    free = np.r_[t.layout.n : t.layout.offsets[-1]]
    for _ in range(8):
        jacobian = sparse.csc_matrix((p.jacobian(z), (p.jacobian_rows, p.jacobian_cols)), shape=(p.rows, t.layout.size))
        z[free] -= spsolve(jacobian[:, free], p.constraints(z))
    assert np.abs(p.constraints(z)).max() < 1e-9
    return t.layout.states(z, 0)


@pytest.mark.parametrize("name", SCHEMES)
def test_observed_order_is_the_declared_order(name):
    errors = []
    for step in (0.2, 0.1, 0.05):
        recording = pendulum_recording(step=step)
        x = follow(pendulum(), recording, name, [0.4])
        errors.append(np.abs(x[:, 0] - recording["angle"]).max())
    observed = np.log2(np.array(errors[:-1]) / errors[1:])
    assert observed[-1] == pytest.approx(scheme_by_name(name).order, abs=0.25)


@pytest.mark.parametrize("backend", ["c", "numpy"])
@pytest.mark.parametrize("name", SCHEMES)
def test_derivatives_agree_with_central_differences(name, backend):
    t = transcribed(pendulum(), pendulum_recording(duration=0.6, step=0.05), name, Episodes(2, amplitude=0.1), backend)
    z = t.start(np.array([0.7])) + np.random.default_rng(1).normal(0, 0.1, t.layout.size)
    assert check_derivatives(t.nonlinear_program(t.start(np.array([0.7]))), z).worst_error < 1e-6


def late_pendulum(lag) -> si.Model:
    """The pendulum with feedback of its late angle and of a late drive."""
    m = pendulum()
    m.gain = si.Parameter(unit="1/s^2", bounds=(0, 10))
    m.lag = lag
    m.redefine("measured", m.angle)
    late = m.copy("late pendulum")
    late.components["balance"] = si.Equation(
        m.balance.expr + late.gain * late.delayed(late.angle, late.lag) - 0.3 * late.delayed(late.drive, late.lag),
        name="balance",
    )
    return late


@pytest.mark.parametrize("name", SCHEMES)
@pytest.mark.parametrize("lag", [si.Parameter(unit="s", bounds=(0.0, 0.2)), si.Constant(0.07, unit="s")])
def test_derivatives_with_delays_agree_with_central_differences(name, lag):
    model = late_pendulum(lag)
    t = transcribed(model, pendulum_recording(duration=1.5, step=0.05), name, window=(0.3, 1.5))
    values = np.array([0.7, 2.0, 0.083][: len(model.parameters)])
    z = t.start(values) + np.random.default_rng(1).normal(0, 0.02, t.layout.size)
    assert check_derivatives(t.nonlinear_program(t.start(values)), z).worst_error < 1e-6


@given(st.floats(-2, 2), st.integers(0, 3))
def test_delay_weights_reproduce_cubics_everywhere(s, power):
    nodes = np.arange(-8, 9)
    assert weights(s - nodes) @ nodes.astype(float) ** power == pytest.approx(s**power, abs=1e-9)


@given(st.floats(-4, 4))
def test_delay_weights_have_the_stated_derivatives_and_support(s):
    step = 1e-5
    for d in (0, 1):
        slope = (weights(np.array(s + step), d) - weights(np.array(s - step), d)) / (2 * step)
        assert slope == pytest.approx(float(weights(np.array(s), d + 1)), abs=1e-4)
    if abs(s) > SUPPORT:
        assert weights(np.array(s)) == 0


def test_layout_names_every_unknown_once_and_gives_states_back():
    model = late_pendulum(si.Parameter(unit="s", bounds=(0.0, 0.2)))
    recording = pendulum_recording(duration=1.5, step=0.05)
    t = transcribed(model, recording, "hermite_simpson", Episodes(2, amplitude=0.1), window=(0.3, 1.5))
    z = t.start(np.array([0.7, 2.0, 0.08]))
    described = [t.layout.describe(i) for i in range(t.layout.size)]
    assert described[0] == "state angle at node 0 of episode 1"
    assert described[-1] == "parameter lag"
    nodes = [d for d in described if d.startswith("state")]
    assert len(set(nodes)) == len(nodes) == 2 * 2 * 25
    assert np.allclose(t.layout.states(z, 1)[:, 0], recording.window(0.3, 1.5)["angle"])
    assert np.allclose(t.layout.parameters(z), [0.7, 2.0, 0.08])


def test_constraints_are_named_in_words():
    t = transcribed(pendulum(), pendulum_recording(), episodes=Episodes(2, amplitude=0.1), window=(1, 2))
    words = [t.program.describe_constraint(i) for i in range(t.program.rows)]
    assert words[1] == "equation balance at 1.000 s of episode 1"
    assert words[-1] == "initial state rate of episodes 1 and 2 equal"


@pytest.mark.parametrize("distribution", ["uniform", "gaussian"])
def test_independent_noise_of_an_episode_does_not_depend_on_their_number(distribution):
    two, five = (Episodes(n, amplitude=0.25, seed=3, distribution=distribution).draw(pendulum(), 5000) for n in (2, 5))
    assert np.array_equal(two[1], five[1]) and not np.array_equal(five[0], five[1])
    all_five = np.concatenate(five)
    if distribution == "uniform":
        assert 0.249 < np.abs(all_five).max() <= 0.25
    assert all_five.std() == pytest.approx(0.25 / (np.sqrt(3) if distribution == "uniform" else 1), rel=0.01)


@settings(max_examples=50, deadline=None)
@given(count=st.integers(2, 7), noises=st.integers(1, 5), intervals=st.integers(2, 400), seed=st.integers(0, 99))
def test_multisines_are_alike_sum_to_zero_and_are_orthogonal(count, noises, intervals, seed):
    model = si.Model("shaken")
    model.x = si.State(unit="m")
    for j in range(noises):
        setattr(model, f"push_{j}", si.Noise(unit="m/s"))
    drawn = np.array(Episodes(count, amplitude=0.3, seed=seed).draw(model, intervals))
    assert drawn.shape == (count, intervals, noises)
    assert np.allclose((drawn**2).mean(axis=1), 0.03) and np.allclose(drawn.sum(axis=0), 0)
    lines = intervals // 2
    twice = np.fft.fft(np.concatenate([drawn, -drawn], axis=1), axis=1)
    power = (
        np.abs(twice[:, 1 : 2 * lines : 2]) ** 2
    )  # with its sign changed it goes on: lines half way between the window's
    assert np.allclose(power, power[0, 0, 0]) and np.allclose(twice[:, ::2], 0)
    # Noises beyond episodes - 1 take turns over neighbouring lines: what is left of the last turn is not orthogonal.
    together = -(-noises // (count - 1))
    common = np.einsum("eij,eik->jk", drawn, drawn) / (0.03 * count * intervals)
    assert np.abs(common - np.eye(noises)).max() <= (lines % together) / lines + 1e-12


def test_the_mean_of_a_multisine_varies_as_that_of_white_noise():
    means = [np.mean(Episodes(3, amplitude=np.sqrt(3), seed=seed).draw(pendulum(), 100), axis=1) for seed in range(500)]
    assert np.std(means) == pytest.approx(0.1, rel=0.1)


def test_multisines_follow_their_seed():
    def draw(seed):
        return np.array(Episodes(3, amplitude=0.3, seed=seed).draw(pendulum(), 50))

    assert np.array_equal(draw(4), draw(4)) and not np.allclose(draw(4), draw(5))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Episodes(0), "whole number of at least 1"),
        (lambda: Episodes(2, distribution="cauchy"), "no distribution 'cauchy'"),
        (lambda: Episodes(2, amplitude=-1), "finite amplitude"),
        (lambda: Episodes(2).draw(pendulum(), 5), "without any noise"),
        (lambda: Episodes(2, torque=1.0).draw(pendulum(), 5), "no noise of model 'driven pendulum' has 'torque'"),
        (lambda: scheme_by_name("euler"), "no collocation scheme 'euler'"),
        (lambda: transcribed(pendulum(), pendulum_recording(), window=(1, 100)), "does not lie in pendulum"),
        (lambda: transcribed(pendulum(), pendulum_recording(), window=(1, 1.02)), "holds only 2 samples"),
        (lambda: transcribed(pendulum(), pendulum_recording().rename({"drive": "driver"})), "did you mean 'driver'"),
        (
            lambda: transcribed(late_pendulum(si.Parameter(unit="s")), pendulum_recording()),
            "needs bounds of at least 0 s",
        ),
    ],
)
def test_bad_input_is_refused_in_words(make, words):
    with pytest.raises(TranscriptionError, match=words):
        make()


def test_what_stands_within_an_interval_begins_between_its_nodes():
    one, none = np.ones(1), np.zeros(0)
    layout = Layout(
        state_names=("x",),
        parameter_names=(),
        late_names=(),
        interior=0,
        points=1,
        intervals=(3,),
        parameter_index=np.zeros((1, 0), dtype=int),
        state_scale=one,
        parameter_scale=none,
        late_scale=none,
        refine=1,
        beside_names=("a",),
        beside_scale=one,
        own_names=("a",),
        own_scale=one,
        own_points=1,
    )
    nodes = np.column_stack([np.zeros(4), [0.0, 1.0, 4.0, 9.0]])
    local = layout.local_view(layout.fill([nodes], none), 0)
    assert local[:, layout.width : layout.width + 1].ravel().tolist() == [0.5, 2.5, 6.5]
