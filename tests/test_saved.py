"""A saved solution comes back as it was, and as the solution of no other problem."""

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import SolveError


def test_a_saved_solution_comes_back(tmp_path):
    problem = si.Identification(pendulum(), pendulum_recording(duration=2, noise=0.01))
    solution = problem.solve()
    solution.save(tmp_path / "fit")
    again = si.Identification(pendulum(), pendulum_recording(duration=2, noise=0.01)).load(tmp_path / "fit")
    assert again.values == solution.values and np.array_equal(again.result.z, solution.result.z)
    assert again.parameters.std_error["damping"] == solution.parameters.std_error["damping"]
    assert not list((tmp_path / "fit").glob("*.pickle")) and (tmp_path / "fit" / "summary.json").exists()
    with pytest.raises(SolveError, match="differs in recordings"):
        si.Identification(pendulum(), pendulum_recording(duration=2, noise=0.02)).load(tmp_path / "fit")
    (next((tmp_path / "fit").glob("solution.npz"))).write_bytes(b"cut")
    with pytest.raises(SolveError, match="removed or damaged"):
        problem.load(tmp_path / "fit")
    with pytest.raises(SolveError, match="holds no saved solution"):
        problem.load(tmp_path / "nowhere")
    assert not (tmp_path / "nowhere").exists()


def test_estimated_noise_is_kept_with_a_solution(tmp_path):
    recordings = [pendulum_recording(duration=2, noise=0.01), pendulum_recording(duration=3, noise=0.03, seed=1)]
    solution = si.Identification(pendulum(), recordings).solve()
    solution.save(tmp_path / "two")
    again = si.Identification(pendulum(), recordings).load(tmp_path / "two")
    assert again.values == solution.values and again.problem.noise == solution.problem.noise
