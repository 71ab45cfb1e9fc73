"""What a user writes, for mypy (`make lint`): parts keep their types, and m.angle.dot stays natural. Never run."""

from typing import assert_type

import numpy as np
import pandas as pd

import symid as si


class Pendulum(si.Model):
    """Parts that are annotated have their types; of others, which any text may name, nothing is known."""

    angle: si.State
    rate: si.State
    damping: si.Parameter


def declared() -> Pendulum:
    m = Pendulum("damped pendulum")
    m.angle = si.State(unit="rad", bounds=(-3, 3))
    m.rate = si.State(unit="rad/s")
    m.damping = si.Parameter(unit="1/s", bounds=(0, 5), prior=si.Normal(0.3, 0.1))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + 2 * m.damping * m.rate + 4.0 * m.angle)
    m.measured = si.Output(m.angle)
    m.track = si.Constraint(abs(m.angle) <= 1.0)
    return m


def typed_access(m: Pendulum, free: si.Model) -> None:
    assert_type(m.angle, si.State)
    assert_type(m.states["angle"], si.State)
    assert_type(m.damping.bounds, tuple[float, float])
    assert_type(free.parameters, dict[str, si.Parameter])
    free.mass = si.Constant(2.0, unit="kg")
    free.weight = si.Expression(free.mass * 9.81, unit="N")
    assert_type(free.with_constants(mass=3.0), si.Model)


def identified(m: si.Model, recording: si.Recording) -> si.Solution:
    problem = si.Identification(m, recording, window=(0, 20), scheme=si.HermiteSimpson())
    assert_type(problem.recordings, tuple[si.Recording, ...])
    several = si.Identification(m, [recording, recording], episodes=si.Episodes(3, torque=0.25))
    solution = several.solve(starts=3, executor=si.LocalPool(2))
    assert_type(solution.values, dict[str, float])
    table: pd.DataFrame = solution.parameters
    assert_type(problem.start("random", seed=1), np.ndarray)
    return solution if len(table) else problem.solve()


def planned(m: si.Model) -> si.Plan:
    return si.Optimization(m, duration=si.Free(1, 20), nodes=100).solve(starts=2)


def diagnosed(solution: si.Solution) -> dict[str, object]:
    found = si.diagnose(solution, held_out=(20, 30))
    assert_type(found, si.Diagnosis)
    return found.answer()
