"""Ipopt finds known answers, explains each failure, and loses neither errors nor Ctrl-C."""

import os
import signal
import threading

import numpy as np
import pytest
from nlp_problems import HS071_OBJECTIVE, HS071_SOLUTION, hs071, one_variable, tracking

from symid.deadline import TimeUp, deadline, remaining
from symid.errors import SolveError
from symid.ipopt_solver import bounded, solve as ipopt_solver, solve_nlp, through_cyipopt
from symid.ipopt_solver.evaluation import FAR, Evaluation
from symid.nlp import check_optimality

pytest.importorskip("cyipopt", reason="cyipopt is absent: run `python -m symid.setup_ipopt`")


@pytest.fixture(params=["C interface", "cyipopt"])
def either_way(request, monkeypatch):
    """Run a test through Ipopt's C interface and through cyipopt."""
    if request.param == "cyipopt":
        monkeypatch.setattr(ipopt_solver, "_runner", lambda interface: ("cyipopt", through_cyipopt.solve))
    elif ipopt_solver._runner("auto")[0] == "cyipopt":
        pytest.skip("this cyipopt hides Ipopt's C interface")


def test_hs071_has_its_published_solution(either_way):
    result = solve_nlp(hs071())
    assert result.solved
    assert result.status_name == "Solve_Succeeded"
    assert result.objective == pytest.approx(HS071_OBJECTIVE, abs=1e-6)
    np.testing.assert_allclose(result.z, HS071_SOLUTION, atol=1e-5)
    np.testing.assert_allclose(result.constraints, [25, 40], atol=1e-5)
    assert "Solve_Succeeded" in repr(result)


@pytest.mark.parametrize("hessian", ["exact", "gauss-newton first", "limited-memory"])
@pytest.mark.parametrize("scaled", [False, True])
def test_tracking_finds_the_friction_and_satisfies_the_first_order_conditions(either_way, hessian, scaled):
    nlp = tracking()
    if scaled:
        nlp = tracking(
            variable_scale=np.tile([1.0, 2.0, 0.4], nlp.n)[: nlp.n],
            constraint_scale=np.full(nlp.m, 0.05), objective_scale=10.0,
        )  # fmt: skip
    result = solve_nlp(nlp, hessian=hessian)
    assert result.solved
    assert result.z[-1] == pytest.approx(0.4, abs=1e-4)
    report = check_optimality(
        nlp, result.z, result.multipliers, result.bound_multipliers_lower, result.bound_multipliers_upper
    )
    assert report.ok, str(report)


def test_gauss_newton_is_used_far_from_an_optimum_and_not_for_ever():
    exact, right = [], tracking().hessian

    def hessian(z, multipliers, factor):
        exact.append(bool(multipliers.any()))
        return right(z, multipliers, factor)

    nlp = tracking(hessian=hessian)
    evaluation = Evaluation(nlp, None, far=2)
    for dual in (10 * FAR, 0.1 * FAR, 10 * FAR, 10 * FAR):
        evaluation.iteration(0, 1.0, 0.0, dual, 0.1)
        evaluation.hessian(nlp.start, np.ones(nlp.m), 1.0, np.zeros(nlp.hessian_rows.size))
    assert exact == [False, True, False, True]


def test_both_ways_to_ipopt_take_the_same_steps():
    direct, copied = (solve_nlp(tracking(), interface=name) for name in ("auto", "cyipopt"))
    assert copied.interface == "cyipopt"
    with pytest.raises(SolveError, match="interface='other' is unknown"):
        solve_nlp(tracking(), interface="other")
    assert direct.iterations == copied.iterations
    np.testing.assert_allclose(direct.z, copied.z, atol=1e-10)
    np.testing.assert_allclose(direct.multipliers, copied.multipliers, atol=1e-10)


def test_contradicting_constraints_are_infeasible_and_the_worst_is_named():
    nlp = hs071(constraint_lower=[700, 40], describe_constraint=["the product", "the sphere"].__getitem__)
    result = solve_nlp(nlp)
    assert not result.solved
    assert result.status_name == "Infeasible_Problem_Detected"
    assert result.worst_constraint.words in {"the product", "the sphere"}
    assert result.worst_constraint.words in result.message
    assert result.worst_constraint.violation > 1


def test_no_minimum_is_called_diverging():
    free = dict(lower=[-np.inf], upper=[np.inf])
    nlp = one_variable(
        **free, objective=lambda z: -z[0], gradient=lambda z: -np.ones(1),
        hessian=lambda z, lam, factor: np.zeros(1),
    )  # fmt: skip
    result = solve_nlp(nlp)
    assert result.status_name == "Diverging_Iterates"
    assert "finite bounds" in result.message
    assert result.worst_constraint is None


def test_iterations_run_out(either_way):
    result = solve_nlp(tracking(), max_iterations=2)
    assert (result.solved, result.iterations) == (False, 2)
    assert result.status_name == "Maximum_Iterations_Exceeded"
    assert "warm_start" in result.message


def test_time_runs_out():
    result = solve_nlp(tracking(), time_limit_s=1e-6)
    assert result.status_name == "Maximum_WallTime_Exceeded"


def test_an_end_at_a_bound_oversteps_nothing_and_starts_another_solve(either_way):
    nlp = hs071()
    end = solve_nlp(nlp, options={"tol": 1e-11}).z
    assert end[0] == pytest.approx(1, abs=1e-7) and np.all(end >= nlp.lower) and np.all(end <= nlp.upper)
    relaxed = solve_nlp(nlp, options={"tol": 1e-11, "honor_original_bounds": "no"}).z
    assert relaxed[0] < 1.0
    assert solve_nlp(nlp, start=relaxed).solved


def test_a_start_out_of_bounds_names_the_variable():
    nlp = tracking(20)
    start = nlp.start.copy()
    start[-1] = 7.0
    with pytest.raises(SolveError, match="friction starts at 7, allowed are 0 to 5"):
        solve_nlp(nlp, start=start)
    start[-1] = np.nan
    with pytest.raises(SolveError, match="friction starts at nan"):
        solve_nlp(nlp, start=start)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_an_objective_that_is_not_a_number_is_an_error(either_way, value):
    with pytest.raises(SolveError, match=f"The objective is {value} at iteration 0"):
        solve_nlp(one_variable(objective=lambda z: value))


def test_a_constraint_that_is_not_a_number_is_named(either_way):
    right = tracking(20)

    def constraints(z):
        values = right.constraints(z).copy()
        values[13] = np.nan
        return values

    nlp = tracking(20, constraints=constraints)
    with pytest.raises(SolveError, match=r"balance of interval 6 \(constraint row 13\) is nan"):
        solve_nlp(nlp)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("gradient", "The gradient for angle at node 0 is nan"),
        ("jacobian", r"The derivative of kinematics of interval 0 \(constraint row 0\) by angle at node 1 is nan"),
        ("hessian", "The second derivative by angle at node 0 and angle at node 0 is nan"),
    ],
)
def test_a_derivative_that_is_not_a_number_is_named(either_way, name, words):
    right = getattr(tracking(20), name)

    def wrong(*arguments):
        values = right(*arguments).copy()
        values[0] = np.nan
        return values

    with pytest.raises(SolveError, match=words):
        solve_nlp(tracking(20, **{name: wrong}))


def test_a_trial_point_out_of_the_domain_only_shortens_the_step(either_way):
    # log is NaN left of zero; a full Newton step from 3 overshoots to there.
    with np.errstate(invalid="ignore"):
        result = solve_nlp(one_variable(
            lower=[-np.inf], upper=[np.inf], start=[3.0],
            objective=lambda z: z[0] - np.log(z[0]), gradient=lambda z: 1 - 1 / z,
            hessian=lambda z, lam, factor: factor / z**2,
        ))  # fmt: skip
    assert result.solved
    assert result.z[0] == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("name", ["objective", "gradient", "constraints", "jacobian", "hessian"])
def test_an_exception_in_a_function_comes_out_as_it_is(either_way, name):
    def broken(*_):
        raise ZeroDivisionError("planted")

    with pytest.raises(ZeroDivisionError, match="planted"):
        solve_nlp(hs071(**{name: broken}))


def test_on_iteration_sees_each_iteration_and_can_stop(either_way):
    seen = []
    result = solve_nlp(tracking(), on_iteration=seen.append)
    assert [it.number for it in seen] == list(range(result.iterations + 1))
    assert seen[-1].objective == pytest.approx(result.objective)
    stopped = solve_nlp(tracking(), on_iteration=lambda it: it.number < 3)
    assert (stopped.status_name, stopped.iterations) == ("User_Requested_Stop", 3)


def test_an_exception_in_on_iteration_comes_out(either_way):
    def broken(_):
        raise ZeroDivisionError("planted")

    with pytest.raises(ZeroDivisionError):
        solve_nlp(hs071(), on_iteration=broken)


def test_ctrl_c_stops_the_solve_and_the_handler_is_given_back(either_way):
    def press_once(iteration):
        if iteration.number == 1:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        solve_nlp(tracking(), on_iteration=press_once)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.fixture
def stuck(monkeypatch):
    """Ipopt in the middle of a factorisation that takes long; set to let it end."""
    goes_on = threading.Event()

    def factorise(nlp, evaluation, options, scales, point):
        point["z"][:] = 7.0  # Ipopt may still write to its arrays
        goes_on.wait(30)
        return 0

    monkeypatch.setattr(ipopt_solver, "_runner", lambda interface: ("direct", factorise))
    yield goes_on
    goes_on.set()
    for thread in bounded._left:
        thread.join()
    assert not bounded.busy()


def test_the_time_limit_holds_while_a_factorisation_goes_on(stuck):
    nlp = tracking()
    result = solve_nlp(nlp, time_limit_s=0.3, linear_solver="mumps")
    assert result.status_name == "Maximum_WallTime_Exceeded" and not result.solved and bounded.busy()
    np.testing.assert_array_equal(result.z, nlp.start)
    assert result.seconds["total"] < 3.0  # far below the 30 s that the factorisation takes


def test_ctrl_c_is_heard_while_a_factorisation_goes_on(stuck):
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        solve_nlp(tracking(), linear_solver="mumps")
    assert not stuck.is_set()


def test_the_deadline_of_a_block_holds_for_its_solves():
    with deadline(1e-6), pytest.raises(TimeUp, match="allow more of it"):
        solve_nlp(tracking())
    with deadline(60), deadline(600):
        assert remaining() <= 60 and solve_nlp(tracking()).solved


@pytest.mark.parametrize("options", [{"tole": 1e-3}, {"tol": "small"}, {"max_iter": 3.0}])
def test_an_unknown_or_mistyped_option_is_refused_by_name(either_way, options):
    with pytest.raises(SolveError, match=f"refused the option {next(iter(options))}"):
        solve_nlp(hs071(), options=options)


@pytest.mark.parametrize(
    "options",
    [{"max_iter": 2**40}, {"max_iter": True}, {"tol": None}, {"tol": [1]}, {"tol": np.nan}, {3: 4}, {"sb": "n\0o"}],
)
def test_an_option_that_c_would_read_as_another_is_refused(either_way, options):
    with pytest.raises(SolveError, match="options: .* Ipopt's options have names, and are texts"):
        solve_nlp(hs071(), options=options)


def test_options_may_be_numbers_of_numpy(either_way):
    assert solve_nlp(hs071(), options={"tol": np.float64(1e-7), "max_iter": np.int64(50)}).solved


def test_hessian_choices_are_checked():
    with pytest.raises(SolveError, match="hessian='exakt' is unknown"):
        solve_nlp(hs071(), hessian="exakt")
    with pytest.raises(SolveError, match="no exact Hessian"):
        solve_nlp(hs071(hessian=None))
    without = hs071(hessian=None, hessian_rows=np.zeros(0, int), hessian_cols=np.zeros(0, int))
    assert solve_nlp(without, hessian="limited-memory").solved
