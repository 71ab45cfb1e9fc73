"""Recordings of other length, rate and noise, with shared and own parameters: one weighted least-squares problem."""

import numpy as np
import pytest

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
