"""Recordings of other length, rate and noise, with shared and own parameters: one weighted least-squares problem."""

import numpy as np
import pytest
from scipy.optimize import least_squares

import symid as si


def test_estimate_and_covariance_are_those_of_the_weighted_problem_written_by_hand():
    rng = np.random.default_rng(4)
    times, sigma, bias, slope = (
        (np.arange(0, 2, 0.01), np.arange(0, 6, 0.05)),
        (0.02, 0.3),
        ((1.0, 0.5), (-2.0, 0.1)),
        0.7,
    )
    model = si.Model("a line and a wave")
    model.slope = si.Parameter(unit="m/s", bounds=(-5, 5))
    model.offset, model.swing = si.Parameter(unit="m", bounds=(-5, 5)), si.Parameter(unit="m/s^2", bounds=(-5, 5))
    model.y = si.Output(model.slope * model.time + model.offset + model.swing * model.time**2, unit="m")
    data = [
        b[0] + slope * t + b[1] * t**2 + s * rng.standard_normal(len(t))
        for t, s, b in zip(times, sigma, bias, strict=True)
    ]
    recordings = [
        si.Recording(f"run {k}", t, {"y": y}, {"y": "m"}, noise={"y": s})
        for k, (t, y, s) in enumerate(zip(times, data, sigma, strict=True))
    ]
    solution = (
        si.Identification(model, recordings, per_recording=["offset", "swing"])
        .solve(options={"tol": 1e-10})
        .with_errors("white")
    )
    zero = [np.zeros((len(t), 2)) for t in times]
    own = [np.column_stack([np.ones(len(t)), t**2]) for t in times]
    rows = [np.hstack([times[0][:, None], own[0], zero[0]]), np.hstack([times[1][:, None], zero[1], own[1]])]
    weighted = np.vstack([r / s for r, s in zip(rows, sigma, strict=True)])
    target = np.concatenate([y / s for y, s in zip(data, sigma, strict=True)])
    covariance = np.linalg.inv(weighted.T @ weighted)
    names = ["slope", "offset[1]", "swing[1]", "offset[2]", "swing[2]"]
    assert [solution.values[n] for n in names] == pytest.approx(covariance @ weighted.T @ target, rel=1e-6)
    assert solution.covariance.loc[names, names].to_numpy() == pytest.approx(covariance, rel=1e-6, abs=1e-12)


def test_a_gain_is_determined_where_the_state_that_it_shows_begins_at_a_known_value():
    """The multiplier of the fixed value is zero at the optimum, as gain and state can stand for one another."""
    time = np.arange(0, 5, 0.1)
    noisy = 3 * np.exp(-0.5 * time) + 0.01 * np.random.default_rng(0).standard_normal(len(time))
    model = si.Model("decay")
    model.x, model.rate = si.State(unit="m"), si.Parameter(unit="1/s", bounds=(0, 5))
    model.gain = si.Parameter(unit="1", bounds=(0.1, 10))
    model.motion, model.begin = si.Equation(model.x.dot + model.rate * model.x), si.Boundary(initial={model.x: 1})
    model.seen = si.Output(model.gain * model.x, unit="m", channel="y")
    recording = si.Recording("decay", time, {"y": noisy}, {"y": "m"})
    solution = si.Identification(model, recording, scheme=si.HermiteSimpson()).solve(check=False).with_errors("white")
    slopes = np.column_stack([np.exp(-0.5 * time), -3 * time * np.exp(-0.5 * time)])  # by gain and rate
    expected = 0.01 * np.sqrt(np.diag(np.linalg.inv(slopes.T @ slopes)))
    assert solution.parameters.std_error[["gain", "rate"]].to_numpy() == pytest.approx(expected, rel=0.2)


def test_a_motion_of_two_recordings_is_that_of_the_weighted_problem_written_by_hand():
    """Of x' = u - k x by the midpoint rule, with a common rate k, own u and begin: estimate and covariance."""
    rng = np.random.default_rng(1)
    times, sigma, own = (np.arange(0, 3, 0.05), np.arange(0, 8, 0.2)), (0.01, 0.1), ((2.0, 0.5), (-1.0, 3.0))

    def motion(k: float, u: float, begin: float, t: np.ndarray) -> np.ndarray:
        h = t[1] - t[0]
        shrink = (1 - k * h / 2) / (1 + k * h / 2)
        return u / k + (begin - u / k) * shrink ** np.arange(len(t))

    data = [motion(0.8, *own[r], t) + sigma[r] * rng.standard_normal(len(t)) for r, t in enumerate(times)]
    model = si.Model("relaxation")
    model.x, model.k = si.State(unit="m"), si.Parameter(unit="1/s", bounds=(0.1, 5))
    model.u, model.start = si.Parameter(unit="m/s", bounds=(-9, 9)), si.Parameter(unit="m", bounds=(-9, 9))
    model.motion, model.seen = si.Equation(model.x.dot - model.u + model.k * model.x), si.Output(model.x)
    model.begin = si.Boundary(initial={model.x: model.start})
    recordings = [
        si.Recording(f"run {r}", t, {"x": data[r]}, {"x": "m"}, noise={"x": sigma[r]}) for r, t in enumerate(times)
    ]
    problem = si.Identification(model, recordings, per_recording=["u", "start"], noise=[{}, {}])
    solution = problem.solve(check=False, options={"tol": 1e-10}).with_errors("white")

    def errors(p: np.ndarray) -> np.ndarray:
        return np.concatenate(
            [(motion(p[0], *p[1 + 2 * r : 3 + 2 * r], t) - data[r]) / sigma[r] for r, t in enumerate(times)]
        )

    by_hand = least_squares(errors, [1, 1, 1, 1, 1], x_scale=0.1, xtol=1e-15, ftol=1e-15, gtol=1e-15, jac="3-point")
    names = ["k", "u[1]", "start[1]", "u[2]", "start[2]"]
    covariance = np.linalg.inv(by_hand.jac.T @ by_hand.jac)
    assert [solution.values[n] for n in names] == pytest.approx(by_hand.x, rel=1e-6)
    found = solution.covariance.loc[names, names].to_numpy()
    assert np.abs(found - covariance).max() < 1e-6 * np.abs(covariance).max()
