"""Estimated sizes of process noise: those of the exact likelihood of a linear system, in any unit, and saved."""

import numpy as np
import pytest
from scipy.optimize import minimize

import symid as si
from symid.errors import SolveError, TranscriptionError

STEP, COUNT = 0.1, 300


def walk(size: float, seed: int = 0) -> np.ndarray:
    """A random walk of this size, with noise of 0.2."""
    rng = np.random.default_rng(seed)
    steps = size * np.sqrt(STEP) * rng.standard_normal(COUNT - 1)
    return np.concatenate([[0], np.cumsum(steps)]) + 0.2 * rng.standard_normal(COUNT)


def problem(y: np.ndarray, process: si.Process, **more) -> si.Identification:
    m = si.Model("random walk")
    m.x, m.w = si.State(unit="m"), process
    m.motion, m.seen = si.Equation(m.x.dot - m.w), si.Output(m.x)
    return si.Identification(m, si.Recording("walk", np.arange(COUNT) * STEP, {"x": y}, {"x": "m"}), **more)


def exact(y: np.ndarray) -> np.ndarray:
    """Size and noise of the largest restricted likelihood: that of the walk's differences from its unknown start."""
    summed = np.tril(np.ones((COUNT, COUNT)), -1)
    walked, one = STEP * summed @ summed.T, np.ones(COUNT)

    def deviance(logs):
        root = np.linalg.cholesky(np.exp(2 * logs[0]) * walked + np.exp(2 * logs[1]) * np.eye(COUNT))
        o, b = np.linalg.solve(root, np.column_stack([one, y])).T
        return 2 * np.log(np.diag(root)).sum() + np.log(o @ o) + np.sum((b - o * (o @ b) / (o @ o)) ** 2)

    return np.exp(minimize(deviance, [-1, -1], method="Nelder-Mead", options={"xatol": 1e-4}).x)


@pytest.mark.parametrize(("size", "unit"), [(0.5, 1.0), (0.5, 1e-3), (0.05, 100.0)])
def test_sizes_are_those_of_the_exact_likelihood(size, unit):
    y = walk(size)
    solution = problem(unit * y, si.Process(unit="m/s")).solve(check=False)
    found = np.array([solution.model.w.size, solution.problem.noise[0]["seen"]]) / unit
    assert solution.solved and found == pytest.approx(
        exact(y), rel=0.03
    )  # a hundredth for the probes; the standard error is a tenth


def test_where_there_is_no_process_noise_none_is_found():
    solution = problem(walk(0.0), si.Process(unit="m/s")).solve(check=False)
    assert solution.model.w.size < 0.01 and solution.problem.noise[0]["seen"] == pytest.approx(0.2, rel=0.1)


def test_what_was_estimated_is_shown_and_saved(tmp_path):
    p = problem(walk(0.5), si.Process(unit="m/s"))
    solution = p.solve(check=False)
    assert f"w {solution.model.w.size:.3g} m/s*sqrt(s)" in str(solution)
    solution.save(tmp_path / "walk")
    assert p.load(tmp_path / "walk").model.w.size == solution.model.w.size


def test_where_it_cannot_be_estimated_is_said():
    with pytest.raises(SolveError, match="weights are not"):
        problem(walk(0.5), si.Process(unit="m/s"), weights={"seen": 1.0}).solve(check=False)
    with pytest.raises(TranscriptionError, match="'w' .* has no size"):
        si.Optimization(problem(walk(0.5), si.Process(unit="m/s")).model, duration=1)
