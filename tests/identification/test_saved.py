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


def motion(limit=2.0, nodes=11, duration=None) -> si.Optimization:
    m = si.Model("cart")
    m.x, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2", bounds=(-limit, limit))
    m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot - m.u)
    m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    m.quick = si.Objective(terminal=m.time)
    return si.Optimization(m, duration=duration or si.Free(0.5, 10), nodes=nodes)


def test_a_saved_plan_comes_back_and_as_that_of_no_other_problem(tmp_path):
    plan = motion().solve()
    plan.save(tmp_path / "plan")
    again = motion().load(tmp_path / "plan")
    assert again.duration == plan.duration and np.array_equal(again["u"], plan["u"]) and repr(again) == repr(plan)
    for other, words in (
        (motion(limit=3.0), "constants or bounds"),
        (motion(nodes=12), "nodes"),
        (motion(duration=3), "duration"),
    ):
        with pytest.raises(SolveError, match=f"differs in .*{words}"):
            other.load(tmp_path / "plan")
    whole = (tmp_path / "plan").read_bytes()
    for damage in (
        b"",
        whole[:300],
        whole.replace("plan 1".encode("utf-32-le"), "plan 9".encode("utf-32-le")),
        b"no plan",
    ):
        (tmp_path / "bad").write_bytes(damage)
        with pytest.raises(SolveError, match="bad "):
            motion().load(tmp_path / "bad")
    with pytest.raises(SolveError, match="cannot be read"):
        motion().load(tmp_path / "nowhere")
