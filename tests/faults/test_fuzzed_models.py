"""Declarations, expressions and arguments of any kind: a model or a result, or one sentence of symid's own."""

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording
from fuzz import few, odd, told
from hypothesis import given
from hypothesis import strategies as st

import symid as si
from symid.cli import main

units = st.one_of(
    st.sampled_from(["m", "rad", "1", "N*m", "kg^2", "m//s", "deg", "m m", "^", "1e999*m", "m^9999"]), odd
)
bounds = st.one_of(st.tuples(st.floats(), st.floats()), odd)
plain = st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.just(10**400), st.just(-(10**400)))
names = st.one_of(st.sampled_from(["x", "angle", "t", "__init__", "copy", "e", "I", "lambda"]), st.text(max_size=6))


def endless(argument) -> bool:
    """Whether SymPy itself, before symid is called, would count to a number that no memory holds: 10**40 factorial."""
    argument = sm.sympify(argument)
    return bool(argument.is_number and argument.is_extended_real and (abs(argument) > 1000) == sm.true)


@st.composite
def expressions(draw, symbols, depth=3):
    """Trees of what SymPy knows, sensible and not."""
    if depth == 0 or draw(st.integers(0, 4)) == 0:
        numbers = [0, 1, -2, 0.5, sm.Rational(1, 3), sm.pi, sm.oo, sm.nan, sm.zoo, sm.I, 1e308, 10**40]
        return draw(st.sampled_from([*symbols, *numbers]))
    inner = lambda: draw(expressions(symbols, depth - 1))  # noqa: E731
    one = [sm.sin, sm.cos, sm.tan, sm.exp, sm.log, sm.sqrt, sm.Abs, sm.sign, sm.floor, sm.tanh, sm.gamma, sm.Heaviside]
    one += [sm.asin, sm.erf, sm.conjugate, sm.re, sm.factorial, sm.DiracDelta, sm.ceiling, sm.sinc]
    two = [sm.Add, sm.Mul, sm.Pow, sm.Max, sm.Min, sm.atan2, sm.Mod, lambda a, b: a / b, lambda a, b: a - b]
    two += [lambda a, b: sm.Piecewise((a, b > 0), (b, True)), lambda a, b: sm.Piecewise((a, b > 0))]
    two += [lambda a, b: sm.Derivative(a, symbols[0]), lambda a, b: sm.Integral(a, symbols[0]), sm.Function("f")]
    kind = draw(st.sampled_from([*one, *two]))
    given = [inner()] if kind in one else [inner(), inner()]
    if kind in (sm.factorial, sm.gamma, sm.Pow) and endless(given[-1]):
        return sm.Integer(1)
    try:
        return kind(*given)
    except (TypeError, ValueError, ArithmeticError, AttributeError, RecursionError, NotImplementedError):
        return sm.Integer(1)  # SymPy itself refuses it


def symbols_of(model):
    return [model.angle.symbol, model.rate.symbol, model.angle.dot, model.damping.symbol, model.drive.symbol]


@st.composite
def parts(draw, model):
    """One part, with odd things in one of its places or two."""
    expr = st.one_of(expressions(symbols_of(model), 2), odd)
    kinds = {
        si.State: {"bounds": bounds},
        si.Algebraic: {"bounds": bounds},
        si.Control: {"bounds": bounds, "hold": odd, "smooth": odd},
        si.Process: {"size": odd},
        si.Input: {"channel": odd, "hold": odd},
        si.Parameter: {"bounds": bounds, "guess": odd, "prior": odd},
        si.Constant: {"value": odd},
        si.Noise: {},
        si.Expression: {"expr": expr},
        si.Equation: {"expr": expr},
        si.Output: {"expr": expr, "channel": odd},
        si.Port: {"position": expr, "rate": expr, "into": odd},
        si.Constraint: {"condition": expr, "lower": odd, "upper": odd, "soft": odd},
        si.Objective: {"running": expr, "terminal": expr},
        si.Boundary: {"initial": odd, "terminal": odd, "periodic": odd},
    }
    kind = draw(st.sampled_from(list(kinds)))
    needed = {"value": 1.0, "expr": model.angle.symbol, "condition": model.angle.symbol}
    needed |= {"position": model.angle.symbol, "rate": model.rate.symbol, "into": {"balance": 1}}
    if kind not in (si.Equation, si.Constraint, si.Objective, si.Boundary):
        needed["unit"] = "rad"
        kinds[kind]["unit"] = units
    fields = kinds[kind] | {"meaning": odd, "role": odd, "at": odd, "latex": odd, "index": odd}
    spoiled = draw(st.lists(st.sampled_from(sorted(fields)), min_size=1, max_size=2, unique=True))
    given = {k: v for k, v in needed.items() if k in fields or k == "unit"} | {k: draw(fields[k]) for k in spoiled}
    return kind, given


@few
@given(st.data())
def test_declarations(data):
    model = pendulum()
    kind, given = data.draw(parts(model))
    name = data.draw(names)

    def declare():
        setattr(model, name, kind(**given))
        model.check()
        assert repr(model) and model._repr_html_() and model._repr_latex_() and model.fingerprint

    told(declare)


@few
@given(st.data())
def test_expressions(data):
    """A residual of any form has values and derivatives, or is refused with its name."""
    model = pendulum()
    expr = data.draw(expressions(symbols_of(model)))
    place = data.draw(st.sampled_from(["equation", "output", "constraint", "objective"]))

    def evaluate():
        if place == "equation":
            model.extra = si.Algebraic(unit="1")
            model.more = si.Equation(model.extra - expr)
        elif place == "output":
            model.redefine("measured", expr)
        elif place == "constraint":
            model.limit = si.Constraint(expr, lower=-1, upper=1)
        else:
            model.cost = si.Objective(running=expr)
        problem = si.Identification(model, pendulum_recording(duration=0.2), backend="numpy")
        t = problem.transcription
        nlp = t.nonlinear_program(np.full(t.layout.size, 0.1))
        with np.errstate(all="ignore"):
            nlp.objective(nlp.start), nlp.constraints(nlp.start), nlp.jacobian(nlp.start)

    told(evaluate)


RECORDING = pendulum_recording(duration=0.3)
PROBLEM = si.Identification(pendulum(), RECORDING)
OPTIONS = ("window", "scheme", "episodes", "weights", "noise", "loss", "per_recording", "backend", "refine", "ridge")


@few
@given(st.sampled_from(["model", "recordings", *OPTIONS, "ridge_about"]), odd)
def test_arguments_of_an_identification(name, value):
    given = {"model": pendulum(), "recordings": RECORDING, "backend": "numpy"} | {name: value}
    told(lambda: si.Identification(**given).transcription)


@few
@given(st.sampled_from(["starts", "seed", "time_limit_s", "max_iterations", "options"]), odd)
def test_arguments_of_a_solve(tmp_path, monkeypatch, name, value):
    monkeypatch.chdir(tmp_path)
    if not (name == "starts" and isinstance(value, (int, float)) and value > 3):  # that many are solved
        told(lambda: PROBLEM.solve(**{"max_iterations": 1, "start": "random", "check": False} | {name: value}))


@few
@given(st.data())
def test_arguments_of_other_calls(data):
    value, more = data.draw(plain), data.draw(plain)
    act = data.draw(
        st.sampled_from(
            [
                lambda: si.Episodes(value, amplitude=more),
                lambda: si.Episodes(2, torque=value, seed=more),
                lambda: si.Free(value, more),
                lambda: si.Normal(value, more),
                lambda: si.LogNormal(value, more),
                lambda: si.Optimization(pendulum(), duration=value, nodes=more),
                lambda: si.Recording(value, RECORDING.time, {"a": more}, {"a": "m"}),
                lambda: si.Recording("r", value, {"a": RECORDING["angle"]}, {"a": more}),
                lambda: RECORDING.window(value, more),
                lambda: pendulum().with_constants(stiffness=value),
                lambda: pendulum().with_bounds(damping=value),
                lambda: pendulum().fixed(damping=value),
                lambda: pendulum().free(stiffness=value),
                lambda: si.LocalPool(value),
                lambda: si.mechanics.Chain.uniform(value, more),
                lambda: si.mechanics.rig_model(value, more),
            ]
        )
    )
    told(act, also=(TypeError,))


WORDS = st.one_of(
    st.sampled_from(
        [
            "r.csv",
            "--body",
            "b.json",
            "--controller",
            "pd",
            "fpd",
            "--window",
            "0",
            "1",
            "-1",
            "nan",
            "--starts",
            "--jobs",
        ]
        + ["--json", "/nope/x", "--noise", "--episodes", "--scheme", "--rig", "--held-out", "--columns", "--", "-", ""]
        + [
            "identify",
            "simulate",
            "diagnose",
            "regenerate",
            "completion",
            "--help",
            "--allow-gaps",
            "--parameters",
            "1e99",
        ]
    ),
    st.text(max_size=5),
)


@few
@given(st.lists(WORDS, max_size=7))
def test_words_on_the_command_line(tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    try:
        assert told(main, words) in (0, 1, 2)
    except SystemExit as done:
        assert done.code in (0, 2)
    except KeyboardInterrupt:
        pytest.fail("a command that was not interrupted says so")
