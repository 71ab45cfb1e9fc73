"""Controls, algebraic variables, constraints, boundaries and objectives: derivatives, orders, closed forms."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.errors import ModelError, TranscriptionError
from symid.nlp import check_derivatives
from symid.transcription import SCHEMES, scheme_by_name


def everything(hold: str = "linear") -> si.Model:
    """A cart with drag as an algebraic variable and every kind of condition."""
    m = si.Model("cart with everything")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s", bounds=(-9, 9))
    m.drag = si.Algebraic(unit="N")
    m.push = si.Control(unit="N", bounds=(-20, 20), hold=hold, smooth=0.01)
    m.mass = si.Constant(2.0, unit="kg")
    m.c = si.Parameter(unit="N*s^2/m^2", bounds=(0.1, 2))
    m.k = si.Parameter(unit="N*s^2/m^2", bounds=(0.1, 2))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.drag - m.push)
    m.law = si.Equation(m.drag - m.c * m.v**2 - 0.1 * m.k * m.v * sm.sin(m.time))
    m.track = si.Constraint(abs(m.x) <= 4)
    m.power = si.Constraint(m.push * m.v, upper=30, soft=0.1)
    m.share = si.Constraint(m.c + m.k <= 3)
    m.ends = si.Boundary(m.v.terminal + m.v.initial <= 5, initial={m.x: 0}, terminal={m.x: (1, 3), m.x + 2 * m.v: 4})
    m.cycle = si.Boundary(periodic={m.push: 2 * m.push})
    m.cost = si.Objective(running=m.push**2 + m.x * m.drag * m.time, terminal=m.time**2 + m.v * m.x.initial + m.c**2)
    return m


@pytest.mark.parametrize(
    ("hold", "duration", "nodes"), [("linear", 2.0, 5), ("zero", si.Free(1, 3), [0, 0.1, 0.4, 0.5, 1])]
)
@pytest.mark.parametrize("name", SCHEMES)
def test_derivatives_of_all_kinds_of_parts_agree_with_central_differences(name, hold, duration, nodes):
    problem = si.Optimization(
        everything(hold), duration=duration, nodes=nodes, scheme=scheme_by_name(name), backend="numpy"
    )
    t = problem.transcription
    z = np.random.default_rng(1).uniform(0.2, 0.9, t.layout.size)
    assert check_derivatives(t.nonlinear_program(problem.start()), z).worst_error < 1e-6
    words = [t.layout.describe(i) for i in range(t.layout.size)] + [
        t.program.describe_constraint(i) for i in range(t.program.rows)
    ]
    assert len(words) == t.layout.size + t.program.rows


@pytest.mark.compiled
def test_both_backends_find_the_same_plan():
    plans = [si.Optimization(everything(), duration=si.Free(1, 3), nodes=21, backend=b).solve() for b in ("c", "numpy")]
    assert plans[0].solved and plans[0].objective == pytest.approx(plans[1].objective, rel=1e-9)
    p = plans[0]
    assert p["x"][0] == 0 and 1 <= p["x"][-1] <= 3 and p["x"][-1] + 2 * p["v"][-1] == pytest.approx(4)
    assert p["push"][-1] == pytest.approx(2 * p["push"][0], abs=1e-6) and p.values["c"] + p.values["k"] <= 3 + 1e-6
    drag = p.values["c"] * p["v"] ** 2 + 0.1 * p.values["k"] * p["v"] * np.sin(p.trajectories.index)
    assert np.allclose(p["drag"], drag, atol=1e-7)


def double_integrator(**control) -> si.Model:
    m = si.Model("double integrator")
    m.x, m.v = si.State(unit="m"), si.State(unit="m/s")
    m.u = si.Control(unit="m/s^2", **control)
    m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot - m.u)
    m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    return m


def test_a_graded_mesh_gives_the_plan_of_an_even_one():
    m = double_integrator()
    m.cost = si.Objective(running=m.u**2)
    plan = si.Optimization(m, duration=1, nodes=np.linspace(0, 1, 31) ** 1.5).solve()
    assert plan.objective == pytest.approx(12, abs=1e-6)
    again = si.Optimization(m, duration=1, nodes=11).solve(plan)
    assert again.objective == pytest.approx(12, abs=1e-6) and again.result.iterations <= 2


def test_least_effort_of_a_double_integrator_is_the_closed_form():
    m = double_integrator()
    m.cost = si.Objective(running=m.u**2)
    plan = si.Optimization(m, duration=1, nodes=11).solve()  # u = 6 - 12 t: cost 12
    assert plan.objective == pytest.approx(12, abs=1e-6)
    assert np.allclose(plan["u"], 6 - 12 * plan.trajectories.index, atol=1e-5)


@pytest.mark.parametrize("hold", ["linear", "zero"])
def test_least_time_of_a_double_integrator_is_bang_bang(hold):
    m = double_integrator(bounds=(-1, 1), hold=hold)
    m.cost = si.Objective(terminal=m.time)
    plan = si.Optimization(m, duration=si.Free(0.5, 9), nodes=201, scheme=si.Trapezoid()).solve()
    assert plan.duration == pytest.approx(2, abs=0.01) and plan.objective == pytest.approx(plan.duration)


def test_a_speed_limit_along_the_path_holds_and_costs_the_closed_form():
    m = double_integrator(bounds=(-10, 10))
    m.limit = si.Constraint(m.v <= 1.25)
    m.cost = si.Objective(running=m.u**2)
    plan = si.Optimization(m, duration=1, nodes=101).solve()
    # Parabolas of the speed to its limit w and from it, of length a each: a = 3 (1 - 1 / w) / 2, cost 8 w^2 / (3 a).
    a = 1.5 * (1 - 1 / 1.25)
    assert plan["v"].max() <= 1.25 + 1e-6 and plan.objective == pytest.approx(8 * 1.25**2 / (3 * a), rel=1e-3)


@pytest.mark.parametrize("name", SCHEMES)
def test_an_algebraic_variable_keeps_the_order_of_the_scheme(name):
    def miss(nodes):
        m = si.Model("decay through a logarithm")
        m.x, m.y = si.State(unit="1", bounds=(0.1, 2)), si.Algebraic(unit="1/s")
        m.rate, m.law = si.Equation(m.x.dot + m.y), si.Equation(sm.log(1 + 2 * m.y) - sm.log(1 + 2 * m.x) + 0 * m.time)
        m.begin = si.Boundary(initial={m.x: 1})
        plan = si.Optimization(m, duration=2, nodes=nodes, scheme=scheme_by_name(name), backend="numpy").solve(
            {"x": 1, "y": 1}, options={"tol": 1e-12}
        )
        return abs(plan["x"][-1] - np.exp(-2))

    assert np.log2(miss(11) / miss(21)) == pytest.approx(scheme_by_name(name).order, abs=0.25)


def accelerated(scheme) -> si.Optimization:
    """A reaction force that keeps a point on a line: determined by an equation with rates alone."""
    m = si.Model("bead on a slope")
    m.x, m.y = si.State(unit="m"), si.State(unit="m")
    m.vx, m.vy = si.State(unit="m/s"), si.State(unit="m/s")
    m.force = si.Algebraic(unit="m/s^2")
    m.kx, m.ky = si.Equation(m.x.dot - m.vx), si.Equation(m.y.dot - m.vy)
    m.dx, m.dy = si.Equation(m.vx.dot - m.force), si.Equation(m.vy.dot - m.force + 9.81)
    m.line = si.Equation(m.vx.dot + m.vy.dot)
    m.begin = si.Boundary(initial={m.x: 0, m.y: 0, m.vx: 0, m.vy: 0})
    return si.Optimization(m, duration=1, nodes=6, scheme=scheme, backend="numpy")


def test_an_algebraic_force_that_only_accelerations_determine_is_found_at_the_points():
    plan = accelerated(si.Midpoint()).solve()
    assert plan["y"][-1] == pytest.approx(-9.81 / 4) and plan["x"][-1] == pytest.approx(9.81 / 4)
    with pytest.raises(TranscriptionError, match="use Midpoint or HermiteSimpson"):
        accelerated(si.Trapezoid()).solve()


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        (lambda m: si.Constraint(m.x == 1), "always False"),
        (lambda m: si.Constraint("far"), "far"),
        (lambda m: si.Constraint(sm.Ne(m.x.symbol, 1)), "cannot be a constraint"),
        (lambda m: si.Constraint(m.x.dot <= 1), "which have no rates"),
        (lambda m: si.Objective(running=m.x.terminal), "objective's end"),
        (lambda m: si.Boundary(initial=[m.x]), "needs a dictionary"),
        (lambda m: si.Boundary(terminal={m.x: 5}), "outside its bounds"),
    ],
)
def test_conditions_that_make_no_sense_are_refused_in_words(condition, words):
    m = double_integrator()
    m.components["x"] = si.State(unit="m", bounds=(0, 2), name="x")
    with pytest.raises((ModelError, TranscriptionError), match=words):
        m.odd = condition(m)
        si.Optimization(m, duration=1, nodes=5, backend="numpy").transcription  # noqa: B018 - made when first asked for


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"duration": "long"}, "positive number of seconds"),
        ({"duration": -1}, "positive number"),
        ({"duration": 1, "nodes": 2.5}, "whole number"),
        ({"duration": 1, "scheme": "midpoint"}, "give a scheme"),
    ],
)
def test_a_problem_that_makes_no_sense_is_refused_in_words(arguments, words):
    with pytest.raises(TranscriptionError, match=words):
        si.Optimization(double_integrator(), **arguments)
    with pytest.raises(TranscriptionError, match="finite bounds above 0 s"):
        si.Free(3, 1)


def test_a_duration_may_be_a_parameter_of_the_model():
    m = double_integrator(bounds=(-1, 1))
    m.length = si.Parameter(unit="s", bounds=(0.5, 9))
    m.cost = si.Objective(terminal=m.length)
    plan = si.Optimization(m, duration=m.length, nodes=101, scheme=si.Trapezoid()).solve()
    assert plan.duration == plan.values["length"] == pytest.approx(2, abs=0.02)
    m.components["length"] = si.Parameter(unit="s", name="length")
    with pytest.raises(TranscriptionError, match="finite bounds above 0 s"):
        si.Optimization(m, duration=m.length)
