"""A disturbance that is estimated with the motion follows a part of the noise, and makes parameters less certain."""

import numpy as np
import pytest

import symid as si
from symid.identification.uncertainty.covariance import _errors, _told, bound_active, determined
from symid.identification.uncertainty.disturbances import Disturbances
from symid.identification.uncertainty.sensitivity import Sensitivity

STEP, COUNT, NOISE, RATE, FITTING = 0.05, 121, 0.01, 1.0, 0.05 * 0.01**2
"""Penalty of squared rates that fits: of a unit of time and a disturbance of size one, STEP * NOISE^2."""


def drift(seed: int, count: int = COUNT, disturbance: str = "walk") -> si.Recording:
    """x' = u + d - RATE x by the midpoint rule, so that its mesh has no error; d is a random walk, or a slow wave."""
    rng, time = np.random.default_rng(seed), np.arange(count) * STEP
    u = np.sum([3 * np.sin(2 * np.pi * f * time + p) for f, p in rng.uniform([0.1, 0], [2, 6.3], (6, 2))], axis=0) / 2
    d = np.cumsum(np.sqrt(STEP) * rng.standard_normal(count))
    if disturbance == "wave":
        d = 0.7 * np.sin(2 * np.pi * rng.uniform(0.05, 0.3) * time + rng.uniform(0, 6.3))
    x, f = np.zeros(count), STEP * (u + d)
    for k in range(count - 1):
        x[k + 1] = ((1 - RATE * STEP / 2) * x[k] + (f[k] + f[k + 1]) / 2) / (1 + RATE * STEP / 2)
    seen = x + NOISE * rng.standard_normal(count)
    return si.Recording("drift", time, {"x": seen, "u": u}, {"x": "m", "u": "m/s"})


def problem(recordings, stiff: float | None = 1.0, **more) -> si.Identification:
    """stiff : penalty of the control over the one that fits; None for process noise of unknown size."""
    m = si.Model("drift")
    m.x, m.u, m.c = si.State(unit="m"), si.Input(unit="m/s"), si.Parameter(unit="1/s", bounds=(-5, 20))
    if stiff is None:
        m.d, m.w = si.State(unit="m/s"), si.Process(unit="m/s^2", size=1.0)
        m.walk = si.Equation(m.d.dot - m.w)
    else:
        m.d = si.Control(unit="m/s", smooth=stiff * FITTING)
    m.push = si.Noise(unit="m/s")
    m.motion, m.seen = si.Equation(m.x.dot + m.c * m.x - m.u - m.d - m.push), si.Output(m.x)
    return si.Identification(m, recordings, **more)


def distance(solution: si.Solution) -> float:
    """Of the parameter from the truth, in standard errors."""
    return float((solution.values["c"] - RATE) / solution.errors.std_errors[0])


@pytest.mark.parametrize("stiff", [30.0, 1 / 30])
def test_the_truth_is_within_three_standard_errors_whatever_the_penalty(stiff):
    far = [distance(problem(drift(seed), stiff).solve(check=False)) for seed in range(3)]
    assert np.max(np.abs(far)) < 3.5


def test_sizes_are_found_whatever_the_penalty():
    recordings = [drift(seed) for seed in range(3)]
    for stiff in (8.0, 0.2):
        errors = problem(recordings, stiff).solve(check=False).errors
        assert errors.misfit["d"] == pytest.approx(stiff, rel=0.5)
        assert np.sqrt(np.mean(errors.noise**2)) == pytest.approx(NOISE, rel=0.1) and errors.model == "white"


def test_a_penalty_that_does_not_fit_is_said():
    stiff, fits, loose = (problem(drift(3), s).solve(check=False) for s in (1000.0, 1.0, 1e-3))
    assert "times too stiff" in stiff.warnings[0] and "too loose" in loose.warnings[0] and not fits.warnings
    assert "so free that it follows the noise" in str(loose) and loose.errors.model == "coloured"


def test_a_smooth_control_is_a_walk_that_process_noise_drives():
    """The same likelihood in two notations: the same values and standard errors."""
    recording = drift(2)
    tables = {"noise": [{"seen": NOISE}]}
    walk = problem(recording, None, **tables).solve(check=False)
    control = problem(recording, 1 / FITTING, **tables).solve(check=False)
    assert control.values["c"] == pytest.approx(walk.values["c"], abs=0.1 * walk.errors.std_errors[0])
    assert control.errors.std_errors == pytest.approx(walk.errors.std_errors, rel=0.1)  # its size is estimated


def test_what_is_left_is_a_projection_that_keeps_the_solution():
    recording = drift(2, 61)
    gaps = recording["x"].copy()
    gaps[20:24] = np.nan
    gappy = si.Recording("gaps", recording.time, {"x": gaps, "u": recording["u"]}, {"x": "m", "u": "m/s"})
    solution = problem([recording, gappy], 1.0).solve(check=False)
    s = Sensitivity(solution.transcription, solution.result.z, solution.result.multipliers,
                    bound_active(solution.transcription, solution.result))  # fmt: skip
    white = s.gauss_newton()
    d = Disturbances(white, determined(white)[0])
    drawn = [np.random.default_rng(0).standard_normal((*p.shape, 2)) * p[:, :, None] for p in d.present]
    once = d.left(drawn)
    for x, again in zip(once, d.left(once), strict=True):
        np.testing.assert_allclose(again, x, atol=1e-4 * np.abs(x).max())


@pytest.mark.parametrize("count", [1, 2])
def test_directions_of_the_parameters_are_orthonormal_over_outputs_and_disturbances(count):
    """Episodes are added, of which a linear model has the same slopes in each."""
    solution = problem(drift(4, 61), 100.0, episodes=si.Episodes(count, push=0.01)).solve(check=False)
    t, result = solution.transcription, solution.result
    white = Sensitivity(t, result.z, result.multipliers, bound_active(t, result)).gauss_newton()
    inverse, _, shared = determined(white)
    for scale in (1.0, 1e-6):  # of both: in what unit the parameter is
        d = Disturbances(white, scale * inverse)
        (told,) = _told(d, _errors(white, shared, np.full((1, 1), NOISE)))
        gram = np.einsum("kjd,j,kje->de", told.shared, told.weights, told.shared)
        np.testing.assert_allclose(gram, scale * np.eye(1), rtol=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("disturbance", ["walk", "wave"])
@pytest.mark.parametrize("stiff", [8.0, 1.0, 0.2, 0.01])
def test_coverage_beside_an_estimated_disturbance(stiff, disturbance):
    far = [distance(problem(drift(seed, 201, disturbance), stiff).solve(check=False)) for seed in range(100)]
    covered = np.mean(np.abs(far) < 1.96)
    print(f"{disturbance}, {stiff:g} times the penalty that fits: {covered:.0%}")
    assert covered >= 0.85
