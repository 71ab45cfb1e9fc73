"""Declarations and expressions of any kind: a model, or one sentence of symid's own."""

import numpy as np
import sympy as sm
from conftest import pendulum, pendulum_recording
from fuzz import few, odd, told
from hypothesis import given, strategies as st

import symid as si

units = st.one_of(
    st.sampled_from(["m", "rad", "1", "N*m", "kg^2", "m//s", "deg", "m m", "^", "1e999*m", "m^9999"]), odd
)
bounds = st.one_of(st.tuples(st.floats(), st.floats()), odd)
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
    if kind in (sm.exp, sm.factorial, sm.gamma, sm.Pow) and endless(given[-1]):
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
