"""Every argument of a wrong type is refused by an exception of symid that says what to do instead."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording

import symid as si
from symid.errors import ModelError, SymidError, TranscriptionError
from symid.mechanics.chains.chain import Chain
from symid.mechanics.chains.link import ChainLink
from symid.recording import differentiate, lowpass, resample, smooth_states, unwrap

RECORDING = pendulum_recording(duration=1)
HUGE = sm.exp(sm.Float(10) ** 400)
"""A number of SymPy that Python's formats refuse."""


@pytest.mark.parametrize(
    ("recording", "words"),
    [
        ("data.csv", "read_recording"),
        (Path("data.csv"), "read_recording"),
        (pd.DataFrame({"time_s": [0, 1]}), "write the table"),
        (None, "a Recording is needed, not None"),
        ([], "no recording"),
        ([RECORDING, 3], "not 3"),
        (np.zeros(3), "a ndarray"),
    ],
)
def test_what_is_no_recording_is_refused(recording, words):
    with pytest.raises(TranscriptionError, match=words):
        si.Identification(pendulum(), recording)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"scheme": "midpoint"}, "give one of Midpoint"),
        ({"episodes": 3}, "give Episodes"),
        ({"weights": [1]}, "dictionary"),
        ({"per_recording": "damping"}, "list of names"),
        ({"window": 5}, "give \\(t0, t1\\)"),
        ({"window": (1, 2, 3)}, "give \\(t0, t1\\)"),
        ({"window": "all"}, "give \\(t0, t1\\)"),
        ({"loss": 0.1}, "dictionary"),
    ],
)
def test_options_of_a_wrong_type_are_refused(arguments, words):
    with pytest.raises(TranscriptionError, match=words):
        si.Identification(pendulum(), RECORDING, **arguments)


def test_a_model_is_needed_first():
    with pytest.raises(TranscriptionError, match="begins with a Model"):
        si.Identification(RECORDING, RECORDING)


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (lambda m: si.State(), "has no unit"),
        (lambda m: si.Constant("heavy", unit="kg"), "'heavy'; give a number"),
        (lambda m: si.Equation("x + y"), "is no expression"),
        (lambda m: si.Equation(m.angle <= 1), "belongs into a Constraint"),
        (lambda m: m.angle <= 1, "becomes a Constraint"),
        (lambda m: m.angle + 1, "becomes an Equation"),
        (lambda m: 3, "cannot attach"),
        (lambda m: si.Expression(None, unit="m"), "is no expression"),
        (lambda m: si.Objective(running="x"), "is no expression"),
        (lambda m: si.Output([1, 2]), "is no expression"),
        (lambda m: si.Parameter(unit=None), "has no unit"),
    ],
)
def test_parts_of_a_wrong_type_are_refused(part, words):
    m = pendulum()
    with pytest.raises(ModelError, match=words):
        m.odd = part(m)


@pytest.mark.parametrize("bounds", [None, 3, ("a", "b"), (1, 2, 3)])
def test_bounds_that_are_no_pair_are_refused(bounds):
    m = pendulum()
    m.odd = si.Parameter(unit="1", bounds=bounds)
    with pytest.raises(ModelError, match="are not an interval"):
        m.check()


def test_arithmetic_with_what_is_no_number_is_refused():
    with pytest.raises(SymidError, match="cannot stand in an equation"):
        pendulum().angle + object()
    assert (pendulum().angle <= 1).func is sm.Le


def cart() -> si.Model:
    m = si.Model("cart")
    m.x, m.v, m.u = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2", bounds=(-9, 9))
    m.kinematics, m.balance = si.Equation(m.x.dot - m.v), si.Equation(m.v.dot - m.u)
    m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    m.cost = si.Objective(running=m.u**2)
    return m


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (lambda m: si.Model(3), "the name of a Model: give a str, not 3"),
        (lambda m: si.Constraint(m.x <= 1, soft="very"), "soft='very': give a number"),
        (lambda m: si.Constraint(m.x <= 1, soft=-1), "of at least 0"),
        (lambda m: si.Constraint(m.x, lower="low"), "lower='low': give a number"),
        (lambda m: si.Boundary(3).rows(set()), "holds no quantity"),
        (lambda m: si.Boundary(final={m.x: 1}), "final is not known; give initial, terminal or periodic"),
        (lambda m: si.Boundary(initial={m.x: (1, 2, 3)}).rows(set()), "give a number, an expression, or"),
        (lambda m: si.Boundary(periodic=m.x), "give a list of quantities"),
        (lambda m: si.State(unit="m", index=3).copies(), "index=range"),
        (lambda m: si.Normal("a", 1), "mean='a': give a number"),
        (lambda m: si.LogNormal(None, 2), "median=None: give a number"),
        (lambda m: pendulum().fixed(damping=None), "damping=None: give a number"),
        (lambda m: pendulum().with_constants(stiffness="4"), "stiffness='4': give a number"),
        (lambda m: pendulum().free(3), "no part 3; known: "),
        (lambda m: m.with_term(3), "give a Term"),
        (lambda m: si.compare([]), "give solutions by name"),
        (lambda m: si.compare({}), "give solutions by name"),
        (lambda m: si.profile(m, "x"), "give a Solution, not a Model"),
        (lambda m: si.identifiability(3), "give a Model, not 3"),
        (lambda m: si.State("m"), "State: too many positional arguments; it takes .*unit="),
        (lambda m: si.State(units="m"), "State: .* keyword argument 'units'; it takes .*unit="),
        (lambda m: si.Constant(unit="m"), "Constant: missing .* 'value'; it takes value"),
        (lambda m: m.kinematic, "no part 'kinematic'; did you mean 'kinematics'"),
        (lambda m: math.sin(m.x), "has no number before it is solved for: use SymPy's functions"),
        (lambda m: (setattr(m, "q", si.State(unit="m", index=range(3))), m.q[7]), "no copy with the index 7"),
        (lambda m: si.Constraint(HUGE, upper=1).row, "the condition [0-9.e+]+ holds no quantity"),
        (lambda m: m.delayed(m.x, -HUGE), "delayed by -[0-9.e+]+ s; give a lag of at least 0"),
        (lambda m: m.delayed(m.x, sm.exp(sm.exp(10**40))), "the constant exp.* is larger than any float"),
        (lambda m: si.Equation(m.x + sm.sin(sm.exp(-(10**40)))), "the constant exp.* is larger than any float"),
        (lambda m: m.x * sm.pi ** (10**6), "the constant pi.* is larger than any float"),
        (lambda m: si.Constraint(m.x <= 1, soft=True), "soft=True: give a number"),
        (lambda m: setattr(m, "t", si.State(unit="s")), "reserved .time, model.time."),
    ],
)
def test_values_of_a_wrong_type_are_refused(part, words):
    with pytest.raises(ModelError, match=words):
        part(cart())


@pytest.mark.parametrize(
    ("part", "words"),
    [
        (lambda m: si.Process(unit="N", size="big"), "size='big'; give a positive number"),
        (lambda m: si.Parameter(unit="N", guess="a few"), "the guess 'a few' .* is outside its bounds .* or no number"),
        (lambda m: si.Control(unit="N", hold="smooth"), "known: 'linear', 'zero'$"),
    ],
)
def test_parts_with_a_wrong_value_are_named_by_check(part, words):
    m = cart()
    m.odd = part(m)
    with pytest.raises(ModelError, match=words.replace("$", "\n|known: 'linear', 'zero'$")):
        m.check()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: si.Optimization(cart(), duration=1, nodes=["a", "b", "c"]), "nodes=.*whole number"),
        (lambda: si.Optimization(cart(), duration=1, history={"z": 1}).solve(), "history: .* has no 'z'"),
        (lambda: si.Optimization(cart(), duration=1, history={"x": "a"}).solve(), "history of x='a': give a number"),
        (lambda: si.Optimization(cart(), duration=1, history=3).solve(), "history: give a Mapping, not 3"),
        (lambda: si.Free("a", 2), "lower='a': give a number"),
        (lambda: si.Optimization(cart(), duration=1).solve(starts=0), "starts=0: give a whole number of at least 1"),
        (lambda: si.Optimization(cart(), duration=1).solve(starts="3"), "starts='3': give a number"),
        (lambda: si.Optimization(cart(), duration=1).solve(seed=-1), "seed=-1: give a whole number"),
        (lambda: si.Optimization(cart(), duration=1).solve(options=3), "options of Ipopt: give a Mapping"),
        (lambda: si.Optimization(cart(), duration=1).solve(max_iterations="a"), "max_iterations='a'"),
        (lambda: si.Optimization(cart(), duration=1).solve({"x": lambda: 3}), "the function for 'x' gives no number"),
        (lambda: si.Identification(pendulum(), RECORDING, noise=3), "noise=3: give one dictionary for each"),
        (lambda: si.Identification(pendulum(), RECORDING, noise=[3]), "noise=3: give a dictionary"),
        (lambda: si.Identification(pendulum(), RECORDING, weights={"angle": "a"}), "weights of 'angle'='a'"),
        (lambda: si.Identification(pendulum(), RECORDING, refine=None), "refine=None: give a number"),
        (lambda: si.Identification(pendulum(), RECORDING, ridge="1"), "ridge='1': give a number"),
        (lambda: si.Identification(pendulum(), RECORDING).solve(start=None), "start=None: give 'default'"),
        (lambda: si.Identification(pendulum(), RECORDING).solve(start={"damping": "a"}), "start: damping='a'"),
        (lambda: si.Identification(pendulum(), RECORDING).solve(starts="a"), "starts='a'"),
        (lambda: si.Identification(pendulum(), RECORDING).solve(executor=4), "executor=4: give an executor"),
        (lambda: si.Identification(pendulum(), RECORDING).load(3), "load: give the path"),
        (lambda: si.read_recording(None), "read_recording: give the path of a file or a directory, not None"),
        (lambda: si.Recording("a", [0, 1], {"x": ["u", "v"]}, {"x": "m"}), "holds numbers"),
        (lambda: si.Episodes(2, torque="a"), "torque='a': give a number"),
        (lambda: Chain((ChainLink("leg", 1.0, 0.5, None),)).plant(), "'leg_inertia' is None; give a number"),
    ],
)
def test_arguments_of_a_wrong_type_are_refused(call, words):
    with pytest.raises(SymidError, match=words):
        call()


FRAME, SOLVE = pd.DataFrame(), si.Solve(si.Identification(pendulum(), RECORDING))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: si.identifiability(pendulum(), seed="x"), "identifiability: seed='x': give a number"),
        (lambda: si.suspects(3), "suspects: give a Model, not 3"),
        (lambda: si.suspects(pendulum(), FRAME), "suspects: sizes: give a Sizes, not a DataFrame"),
        (lambda: si.Optimization(cart(), duration=1, backend=FRAME).solve(), "choose one of"),
        (lambda: si.Episodes(2, push=1.0, distribution=FRAME), "no distribution"),
        (lambda: si.stability_of(3, {}, RECORDING, window=(0, 1)), "stability: give a Model, not 3"),
        (lambda: si.stability_of(pendulum(), {}, 3, window=(0, 1)), "stability: recording: give a Recording"),
        (lambda: si.stability_of(pendulum(), 3, RECORDING, window=(0, 1), per_state=1), "give a Mapping, not 3"),
        (lambda: si.stability_of(pendulum(), {1: 2}, RECORDING, window=(0, 1), per_state=1), "known: 1"),
        (lambda: si.Study({"a": SOLVE}).run(3), "executor=3: give an executor"),
        (lambda: si.Study({"a": SOLVE}).run_here(on_finished=3), "on_finished: give a function"),
        (lambda: si.Study(3), "study: solves: give a Mapping, not 3"),
        (lambda: si.Study({"a": 3}), "study: solve 'a': give a Solve, not 3"),
        (lambda: si.Solve(SOLVE.problem, "random", seed=-1), "seed=-1: give a whole number"),
        (lambda: si.Solve(SOLVE.problem, "random", number=None), "number of the start=None: give a number"),
        (lambda: si.Solve(SOLVE.problem, options=3), "options: give a Mapping, not 3"),
        (lambda: si.Solve(SOLVE.problem, options={1: 2}), "solve has no option .1."),
        (lambda: SOLVE.problem.start(FRAME), "start=a DataFrame: give 'default'"),
        (lambda: si.Term(3, "joint1"), "the law of a Term: give a Law, not 3"),
        (lambda: si.read_case(None), "read_case: give the path of a file or a directory, not None"),
        (lambda: si.read_case("9" * 500), "read_case: '9.* is longer than the name of any file"),
        (lambda: si.read_recording("a/" * 3000 + "r.csv"), "is longer than the name of any file"),
        (lambda: lowpass(RECORDING, 1e-9), "a cut-off of 1e-09 Hz is not between 5e-05 and half"),
        (lambda: lowpass(RECORDING, 5.0, order=0), "lowpass: order=0: give a whole number of at least 1"),
        (lambda: lowpass(RECORDING, 5.0, "hip"), "no channel 'hip'"),
        (lambda: resample(None, 5.0), "resample: give a Recording, not None"),
        (lambda: smooth_states(RECORDING, "angle", noise="x"), "smooth_states: noise='x': give a number"),
        (lambda: differentiate(RECORDING, "angle", FRAME), "differentiate: name: give a str, not a DataFrame"),
        (lambda: unwrap(RECORDING, "angle", period=10**400), "unwrap: period=1.*: give a number"),
        (lambda: RECORDING.rename({"angle": 3}), "pendulum: rename 'angle': give a str, not 3"),
        (lambda: RECORDING.with_channel("q", "x", "m"), "holds numbers"),
        (lambda: RECORDING.with_channel("q", RECORDING["angle"], 3), "a unit: give a str, not 3"),
        (lambda: RECORDING.with_channel("q", RECORDING["angle"], "m", noise="x"), "noise='x': give a number"),
        (lambda: RECORDING.noted(3), "history: give a str, not 3"),
        (lambda: pendulum()[FRAME], "has no part a DataFrame; known: angle"),
        (lambda: si.mechanics.NeuralNetwork(hidden=2.5), "hidden=2.5: give a whole number of at least 1"),
        (lambda: si.mechanics.DelayedFullState(lags=3), "lags: give a tuple or a list, not 3"),
        (lambda: Chain(3), "chain: links: give a tuple or a list, not 3"),
        (lambda: Chain(Chain.uniform(2).links, angle_bound="x"), "chain: angle_bound='x': give a number"),
        (lambda: Chain((ChainLink("", 1.0, 0.5, 0.1),)), "all with different names"),
        (lambda: si.mechanics.rig_model({1: 2}), "a name in a table: give a str, not 1"),
        (lambda: si.mechanics.with_places(3), "with_places: give a Model, not 3"),
        (lambda: si.mechanics.model_of(3), "model_of: give a Mapping, not 3"),
        (lambda: si.Study.product(3), "study: problems: give a Mapping, not 3"),
        (lambda: si.diagnose_case(None), "diagnose_case: give a Case, not None"),
        (lambda: si.Model("cart", 3), "the description of a Model: give a str, not 3"),
        (lambda: si.Cluster(3), "cluster: give the address of a scheduler or a Client of it, not 3"),
        (lambda: RECORDING.rows(3), "pendulum: rows: give a slice of integers, not 3"),
        (lambda: RECORDING.rows(slice("a", None)), "pendulum: rows: give a slice of integers, not a slice"),
        (lambda: RECORDING.rows(slice(9), np.zeros(2)), "history: give a str, not a ndarray"),
        (lambda: ChainLink("leg", 1.0, 0.5, 0.1, constants=3), "link: constants: give a tuple or a list, not 3"),
        (lambda: ChainLink("leg", 1.0, 0.5, 0.1, constants=("mass",)), "a pair: give a tuple or a list, not 'mass'"),
        (lambda: ChainLink("leg", 1.0, 0.5, 0.1, constants=(("mass",),)), "give pairs of quantity and name"),
        (lambda: ChainLink("leg", 1.0, 0.5, 0.1, constants=(("mas", "m"),)), "a quantity='mas': known are 'mass'"),
        (lambda: ChainLink("leg", 1.0, 0.5, 0.1, constants=(("mass", 3),)), "a name: give a str, not 3"),
        (lambda: si.mechanics.suspects(pendulum(), laws=3), "suspects: laws: give a Mapping, not 3"),
        (lambda: si.mechanics.suspects(pendulum(), laws={"a": 3}), "one of the laws: give a Law, not 3"),
        (lambda: pendulum().delayed(pendulum().rate, 1j), "delayed by .*I s; give a lag of at least 0"),
        (lambda: (m := pendulum()).delayed(m.rate.dot, 0.1), "holds the rate .*write what the equations give for it"),
        (lambda: pendulum().copy(np.zeros(2)), "the name of a Model: give a str, not a ndarray"),
        (lambda: pendulum().check(np.zeros(2)), "check: units: give a bool, not a ndarray"),
        (lambda: SOLVE.problem.solve().refined("2"), "refined: factor='2': give a number"),
        (lambda: RECORDING[FRAME], "pendulum: the name of a channel: give a str, not a DataFrame"),
    ],
)
def test_the_doors_of_the_other_calls_refuse_wrong_types(call, words):
    with pytest.raises(SymidError, match=words):
        call()


@pytest.mark.parametrize("value", ["no", 0, None, np.zeros(2), pd.DataFrame()])
def test_what_is_neither_true_nor_false_is_refused(value):
    """Python takes the text "no" for yes."""
    calls = [
        lambda: si.diagnose(pendulum(), RECORDING, fit_window=(0, 0.5), held_out=(0.5, 1), driven=value),
        lambda: si.read_recording("r.csv", allow_gaps=value),
        lambda: si.Identification(pendulum(), RECORDING).solve(check=value),
        lambda: si.Episodes(2, push=1.0, shared_initial_state=value),
    ]
    for call in calls:
        with pytest.raises(SymidError, match="(driven|allow_gaps|check|shared_initial_state): give a bool"):
            call()


def test_a_misspelt_option_of_a_solve_is_refused():
    with pytest.raises(SymidError, match="no option 'max_iter'; did you mean 'max_iterations'"):
        si.Optimization(cart(), duration=1).solve(max_iter=3)
    with pytest.raises(SymidError, match="no option 'tolerance'"):
        si.Identification(pendulum(), RECORDING).solve(tolerance=3)
    assert not hasattr(cart(), "absent")
