"""A local optimum is said to be one; noise with a memory, process noise and a wrong law are not taken for it."""

import numpy as np
import pytest
from error_systems import oscillator, spring
from small_systems import van_der_pol
from test_verify import swing
from unseen_systems import lorenz

import symid as si
from symid.identification.starts.shooting import Shooting
from symid.mechanics import PD, FullStatePD
from symid.recording.signals.smooth import beside_inputs, left_by_smoother
from symid.synthetic import BODY, GAINS, standing_recording

CRY = "local optimum"


@pytest.mark.parametrize("seed", range(3))
def test_a_smoother_leaves_the_noise(seed):
    time, rng = np.linspace(0, 10, 401), np.random.default_rng(seed)
    values = np.column_stack([np.sin(2 * time), 1e6 * np.exp(-time), np.full(401, 3.0)])
    noise = np.array([0.1, 2e4, 0.0]) * rng.standard_normal((401, 3))
    assert left_by_smoother(values + noise) == pytest.approx([0.1, 2e4, 0.0], rel=0.12)


def test_what_an_input_that_is_held_makes_jump_or_bend_is_not_left_by_a_smoother():
    """A voltage that jumps with the current hid an optimum that erred by seven times the noise."""
    rng = np.random.default_rng(0)
    u = np.repeat(rng.choice([-1.0, 0.0, 2.0], 20), 20)
    y = np.column_stack([0.5 * u, 0.02 * np.cumsum(u)]) + 0.01 * rng.standard_normal((400, 2))
    assert np.all(left_by_smoother(y)[0] > 0.03)
    assert left_by_smoother(beside_inputs(y, [u])) == pytest.approx(0.01 * np.ones(2), rel=0.15)
    assert np.array_equal(beside_inputs(y[:20], [u[:20]]), y[:20])  # too few for a regression


@pytest.mark.parametrize(("system", "wrong"), [("swing", {"p": 14.0}), ("lorenz", {"s": 12.0, "r": 25.0, "b": 2.5})])
def test_a_planted_local_optimum_is_said_to_be_one(system, wrong):
    """The motion that a simulation with wrong parameters makes, and the optimum of the collocation beside it."""
    problem = swing(20) if system == "swing" else lorenz(np.random.default_rng([1, 7])).problem()
    shooting = Shooting(problem.transcription)
    end = shooting.fit(shooting.unknowns(np.array(list(wrong.values()))))
    runs = [shooting.run(end.x, 0).x]
    z = problem.transcription.start((end.x * shooting.scale)[: len(wrong)], runs)
    planted, best = problem.solve(start=z, near=True, check=False), problem.solve(check=False)
    assert planted.solved and planted.result.objective > 10 * best.result.objective
    assert CRY not in str(best)
    name = next(iter(wrong))
    assert f"This is a {CRY}" in str(planted) and f"({name} {best.values[name]:.4g}" in str(planted)


def coloured(seed: int) -> si.Identification:
    """An oscillator whose sensor's noise has a memory of twenty samples."""
    rng, model = np.random.default_rng(seed), spring()
    model.y = si.Output(model.x)
    _, recording, _, _ = oscillator(samples=801, noise=1e-9)
    noise = rng.standard_normal(1000)
    for i in range(1, len(noise)):
        noise[i] += 0.95 * noise[i - 1]
    channels = {"x": recording["x"] + 0.02 * noise[-801:]}
    return si.Identification(model, si.Recording("coloured", recording.time, channels, {"x": "m"}))


def process_noise(law) -> si.Identification:
    model = BODY.with_feedback(FullStatePD())
    return si.Identification(BODY.with_feedback(law), standing_recording(model, GAINS, seed=3, duration=12))


@pytest.mark.slow
@pytest.mark.parametrize(
    "problem",
    [
        pytest.param(coloured(0), id="coloured"),
        *(
            pytest.param(process_noise(law), id=name, marks=pytest.mark.compiled)  # minutes each in Python
            for name, law in (("process noise", FullStatePD()), ("process noise, another law", PD()))
        ),
    ],
)
def test_what_is_no_local_optimum_is_not_called_one(problem):
    solution = problem.solve(check=False)
    assert CRY not in str(solution)
    assert "times what a free smoother leaves" in str(solution)


def test_a_good_fit_has_no_remark_at_all():
    solution = van_der_pol(np.random.default_rng([1, 7])).problem().solve(check=False)
    assert "smoother" not in str(solution) and CRY not in str(solution)
