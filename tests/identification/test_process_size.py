"""Estimated sizes of process noise: those of the exact likelihood of a linear system, in any unit, and saved."""

import numpy as np
import pytest
from scipy.linalg import expm
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


def driven(rates: np.ndarray, seed: int, noise: float = 0.05, count: int = 400) -> np.ndarray:
    """The first state of x' = rates x, the last of which white noise of size one drives; sampled every STEP."""
    rng, step = np.random.default_rng(seed), expm(rates * STEP / 10)
    x, seen = np.zeros(len(rates)), []
    for k in range(10 * (count + 100)):
        x = step @ x
        x[-1] += np.sqrt(STEP / 10) * rng.standard_normal()
        seen += [x[0]] * (k % 10 == 0)
    return np.array(seen[100:]) + noise * rng.standard_normal(count)


def deviance(rates: np.ndarray, size: float, noise: float, y: np.ndarray) -> float:
    """-2 log likelihood by the Kalman filter, sampled exactly (Van Loan 1978)."""
    n = len(rates)
    both = np.block([[-rates, np.diag([0.0] * (n - 1) + [size**2])], [np.zeros((n, n)), rates.T]])
    both = expm(both * STEP)
    step, x, p, total = both[n:, n:].T, np.zeros(n), 100 * np.eye(n), 0.0
    added = step @ both[:n, n:]
    for value in y:
        spread, error = p[0, 0] + noise**2, value - x[0]
        total += np.log(spread) + error**2 / spread
        x, p = x + p[0] * error / spread, p - np.outer(p[0], p[0]) / spread
        x, p = step @ x, step @ p @ step.T + added
    return total


def strung(y: np.ndarray, order: int, size: float | None, **more) -> si.Identification:
    """A mass that noise drives, of first order (a drifting speed) or second (on a spring)."""
    m = si.Model("driven by noise")
    m.x, m.c = si.State(unit="m"), si.Parameter(unit="1/s", bounds=(-5, 10))
    if order == 1:
        m.gust = si.Process(unit="m/s", size=size)
        m.motion = si.Equation(m.x.dot + m.c * m.x - m.gust)
    else:
        m.v, m.k = si.State(unit="m/s"), si.Parameter(unit="1/s^2", bounds=(0, 50))
        m.gust = si.Process(unit="m/s^2", size=size)
        m.moves, m.motion = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot + m.c * m.v + m.k * m.x - m.gust)
    m.seen = si.Output(m.x)
    time = np.arange(len(y)) * STEP
    return si.Identification(m, si.Recording("driven", time, {"x": y}, {"x": "m"}), **more)


@pytest.mark.parametrize(("known", "seed"), [(True, 0), (True, 1), pytest.param(False, 1, marks=pytest.mark.slow)])
def test_damping_beside_process_noise_is_that_of_the_kalman_filter(known, seed):
    """The largest joint density has no damping at all here: what noise drives has the rate that it likes."""
    y = driven(np.array([[-1.0]]), seed, count=200)
    given = {"noise": [{"seen": 0.05}]} if known else {}
    solution = strung(y, 1, 1.0 if known else None, **given).solve(check=False)
    wanted = minimize(
        lambda p: deviance(np.array([[-p[0]]]), *([1.0, 0.05] if known else np.exp(p[1:])), y),
        [1.0] if known else [1.0, 0.0, -3.0],
        method="Nelder-Mead",
    ).x
    assert solution.solved and solution.values["c"] == pytest.approx(
        wanted[0], abs=0.25 * solution.parameters["std_error"]["c"]
    )


def test_an_oscillation_that_noise_drives_has_the_damping_of_the_kalman_filter():
    y = driven(np.array([[0.0, 1.0], [-9.0, -0.6]]), 3)
    p = strung(y, 2, 1.0, noise=[{"seen": 0.05}], scheme=si.HermiteSimpson())
    solution = p.solve(check=False)
    wanted = minimize(
        lambda q: deviance(np.array([[0.0, 1.0], [-q[0], -q[1]]]), 1.0, 0.05, y), [9.0, 0.6], method="Nelder-Mead"
    ).x
    std = solution.parameters["std_error"]
    assert abs(solution.values["c"] - wanted[1]) < 0.25 * std["c"]
    assert abs(solution.values["k"] - wanted[0]) < 0.25 * std["k"]
    assert abs(solution.values["c"] - 0.6) < 3 * std["c"] and solution.problem.tilt["c"] < 0


def test_conditions_on_the_motion_are_counted_or_leave_the_joint_density():
    y = driven(np.array([[-1.0]]), 4, count=200)
    free, given, tied = (strung(y, 1, 1.0, noise=[{"seen": 0.05}]) for _ in range(3))
    given.model.begin = si.Boundary(initial={given.model.x: float(y[0])})
    tied.model.again = si.Boundary(periodic=[tied.model.x])
    one, two, three = (p.solve(check=False).values["c"] for p in (free, given, tied))
    assert two == pytest.approx(one, abs=0.1) and three == pytest.approx(one, abs=0.1) and one > 0.5
    half = strung(y, 2, 1.0, noise=[{"seen": 0.05}])
    half.model.end = si.Boundary(terminal={half.model.x + half.model.v: 0.1})
    solution = half.solve(check=False)
    assert solution.solved and solution.problem.tilt == {}
    assert "c, k: of the largest joint density" in str(solution) and "Boundary" in solution.warnings[-1]
    assert "joint density" not in str(free.solve(check=False))


def test_the_tilt_is_saved_and_refused_where_it_is_none(tmp_path):
    p = strung(driven(np.array([[-1.0]]), 0, count=100), 1, 1.0, noise=[{"seen": 0.05}])
    solution = p.solve(check=False)
    solution.save(tmp_path / "driven")
    again = p.load(tmp_path / "driven")
    assert again.values == solution.values and again.problem.tilt == solution.problem.tilt
    assert solution.verification.optimality.ok
    with pytest.raises(TranscriptionError, match="tilt"):
        strung(np.zeros(9), 1, 1.0, tilt={"c": "much"})
    with pytest.raises(SolveError, match="no parameter 'd'"):
        strung(driven(np.array([[-1.0]]), 0, count=50), 1, 1.0, tilt={"d": 1.0}, noise=[{"seen": 1.0}]).solve(
            check=False
        )
