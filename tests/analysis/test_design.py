"""Experiments that tell most: published designs, and what an identification of the experiment then finds."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.errors import ModelError


def box_lucas() -> si.Model:
    """Two reactions one after the other; the second species is seen."""
    m = si.Model("consecutive reactions")
    m.a, m.b = si.State(unit="1"), si.State(unit="1")
    m.k1, m.k2 = si.Parameter(unit="1/s", bounds=(0.01, 5)), si.Parameter(unit="1/s", bounds=(0.01, 5))
    m.first, m.second = si.Equation(m.a.dot + m.k1 * m.a), si.Equation(m.b.dot - m.k1 * m.a + m.k2 * m.b)
    m.begin = si.Boundary(initial={m.a: 1, m.b: 0})
    m.seen = si.Output(m.b)
    return m


def test_the_times_of_box_and_lucas_are_found():
    """Box & Lucas (1959), Biometrika 46: for k1 = 0.7, k2 = 0.2 samples at 1.23 and 6.86."""
    best = si.design(
        box_lucas(), {"k1": 0.7, "k2": 0.2}, duration=12, noise={"seen": 0.1}, rate=20, samples=2, nodes=241
    )
    rate = best.sampling.to_numpy()[:-1]
    time = best.sampling.index.to_numpy()
    middle, early = 0.5 * (time[:-1] + time[1:]), time[:-1] < 4
    assert best.plan.solved and rate.sum() * time[1] == pytest.approx(2, rel=1e-6)
    for part, published in ((early, 1.23), (~early, 6.86)):
        assert rate[part].sum() * time[1] == pytest.approx(1, abs=0.02)
        assert np.sum(middle[part] * rate[part]) / rate[part].sum() == pytest.approx(published, abs=0.03)


@pytest.mark.parametrize("criterion", ["D", "A", "E"])
def test_the_designed_input_beats_others_by_its_own_criterion(criterion):
    m = si.Model("motor")
    m.speed, m.volt = si.State(unit="rad/s"), si.Control(unit="V", bounds=(-1, 1))
    m.gain, m.lag = si.Parameter(unit="rad/(s*V)", bounds=(0.1, 9)), si.Parameter(unit="s", bounds=(0.01, 9))
    m.balance = si.Equation(m.lag * m.speed.dot + m.speed - m.gain * m.volt)
    m.begin = si.Boundary(initial={m.speed: 0})
    m.seen = si.Output(m.speed)
    values, sigma, step = {"gain": 2.0, "lag": 0.5}, 0.1, 0.05
    best = si.design(
        m, values, duration=4, noise={"seen": sigma}, rate=1 / step, criterion=criterion, nodes=81, start={"volt": 0.5}
    )
    assert best.plan.solved and abs(best.plan["volt"]).max() <= 1 + 1e-6
    p = np.array(list(values.values()))

    def worth(volt):
        """The criterion by central differences of another simulation."""

        def motion(gain, lag):
            x, keep = 0.0, []
            for a, b in zip(volt[:-1], volt[1:], strict=True):
                for k in range(10):
                    u = a + (b - a) * (k + 0.5) / 10
                    x = gain * u + (x - gain * u) * np.exp(-step / 10 / lag)
                keep.append(x)
            return np.array(keep)

        h = 1e-5
        slopes = [
            (motion(*(p + h * e)) - motion(*(p - h * e))) / (2 * h) * v for e, v in zip(np.eye(2), p, strict=True)
        ]
        matrix = np.array(slopes) @ np.transpose(slopes) / sigma**2
        eigen = np.linalg.eigvalsh(matrix)
        return {"D": np.log(eigen).sum(), "A": -np.sum(1 / eigen), "E": eigen[0]}[criterion], matrix

    found, matrix = worth(np.interp(np.arange(0, 4.01, step), best.plan.trajectories.index, best.plan["volt"]))
    assert np.linalg.inv(matrix) * np.outer(p, p) == pytest.approx(best.covariance.to_numpy(), rel=0.05, abs=1e-6)
    time = np.arange(0, 4.01, step)
    others = [np.ones_like(time), np.sin(2 * time), np.where(time < 2, 1.0, -1.0), np.sign(np.sin(3 * time))]
    assert found > max(worth(volt)[0] for volt in others)


def test_what_cannot_be_designed_is_refused():
    m = box_lucas()
    with pytest.raises(ModelError, match="values lacks 'k2'"):
        si.design(m, {"k1": 1.0}, duration=1, noise={"seen": 0.1}, rate=1)
    with pytest.raises(ModelError, match="of 'k1' is zero"):
        si.design(m, {"k1": 0.0, "k2": 1.0}, duration=1, noise={"seen": 0.1}, rate=1)
    with pytest.raises(ModelError, match="known are 'D', 'A', 'E'"):
        si.design(m, {"k1": 1.0, "k2": 1.0}, duration=1, noise={"seen": 0.1}, rate=1, criterion="G")
    with pytest.raises(ModelError, match="has no 'sen'; did you mean 'seen'"):
        si.design(m, {"k1": 1.0, "k2": 1.0}, duration=1, noise={"sen": 0.1}, rate=1)
    with pytest.raises(ModelError, match="duration=0: give a number above zero"):
        si.design(m, {"k1": 1.0, "k2": 1.0}, duration=0, noise={"seen": 0.1}, rate=1)
    m.late = si.Equation(m.a - m.delayed(m.b, sm.Float(0.1)))
    with pytest.raises(ModelError, match="delayed signals"):
        si.design(m, {"k1": 1.0, "k2": 1.0}, duration=1, noise={"seen": 0.1}, rate=1)


def swung() -> si.Model:
    """A rod on a motor shaft: the nearer it comes to standing upright, the more every parameter matters."""
    m = si.Model("driven pendulum")
    m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.drive, m.weight = si.Control(unit="N*m", bounds=(-0.2, 0.2)), si.Constant(0.49, unit="N*m")
    m.inertia = si.Parameter(unit="kg*m^2", bounds=(0.001, 0.1))
    m.damping = si.Parameter(unit="N*m*s/rad", bounds=(0, 0.1))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.inertia * m.rate.dot + m.damping * m.rate + m.weight * sm.sin(m.angle) - m.drive)
    m.begin = si.Boundary(initial={m.angle: 0, m.rate: 0})
    m.seen = si.Output(m.angle)
    return m


SWUNG = {"duration": 4, "noise": {"seen": 0.002}, "rate": 100, "nodes": 81, "start": {"drive": 0.1}}
VALUES = {"inertia": 0.0125, "damping": 0.006}


@pytest.mark.parametrize("criterion", ["D", *(pytest.param(c, marks=pytest.mark.slow) for c in "AE")])
def test_an_experiment_within_a_path_constraint_is_found(criterion):
    m = swung()
    m.cage = si.Constraint(abs(m.angle) <= 2)
    best = si.design(m, VALUES, criterion=criterion, **SWUNG)
    assert best.is_optimum and best.plan.solved and abs(best.plan["angle"]).max() <= 2 + 1e-6
    times = best.plan.trajectories.index.to_numpy()
    drive = np.interp(np.arange(0, 4.001, 0.01), times, best.plan["drive"])
    assert simulated_errors(m, drive) == pytest.approx(best.std_errors.to_numpy(), rel=0.05)


def simulated_errors(m: si.Model, drive: np.ndarray) -> np.ndarray:
    """Standard errors by central differences of simulations, every sample seen."""
    from scipy.integrate import solve_ivp

    time = np.arange(0, 4.001, 0.01)

    def angle(inertia, damping):
        def rates(t, x):
            return [x[1], (np.interp(t, time, drive) - damping * x[1] - 0.49 * np.sin(x[0])) / inertia]

        return solve_ivp(rates, (0, 4), [0, 0], t_eval=time, rtol=1e-9, atol=1e-11, max_step=0.05).y[0]

    p, h = np.array([VALUES["inertia"], VALUES["damping"]]), 1e-4
    slopes = [(angle(*(p * (1 + h * e))) - angle(*(p * (1 - h * e)))) / (2 * h * 0.002) for e in np.eye(2)]
    return p * np.sqrt(np.diag(np.linalg.inv(np.array(slopes) @ np.transpose(slopes))))


@pytest.mark.slow
def test_an_information_without_limit_is_no_optimum():
    best = si.design(swung(), VALUES, **SWUNG)
    assert not best.is_optimum and best.plan.solved and "not an optimum" in repr(best)
    assert best.std_errors["inertia"] < 1e-6


@pytest.mark.slow
def test_what_is_not_told_at_all_has_no_finite_error():
    """Without a drive nothing moves, and no small drive tells anything in the first order."""
    best = si.design(swung(), VALUES, **(SWUNG | {"start": None}))
    assert np.isinf(best.std_errors).all() and "tells nothing" in repr(best)


def test_a_feasible_motion_keeps_the_controls_of_its_start():
    """Where only the initial state is given any controls are feasible; with an end the nearest ones are the least."""
    m = swung().fixed(**VALUES)
    kept = si.Optimization(m, duration=2, nodes=41).feasible({"drive": lambda t: 0.1 * np.sin(t)})
    assert kept.solved and kept["drive"] == pytest.approx(0.1 * np.sin(np.linspace(0, 2, 41)), abs=1e-6)
    m.end = si.Boundary(terminal={m.angle: 0.5})
    near = si.Optimization(m, duration=2, nodes=41).feasible()
    m.effort = si.Objective(running=m.drive**2)
    least = si.Optimization(m, duration=2, nodes=41).solve()
    assert near.solved and near["angle"][-1] == pytest.approx(0.5)
    assert near["drive"][1:-1] == pytest.approx(least["drive"][1:-1], abs=0.02)
