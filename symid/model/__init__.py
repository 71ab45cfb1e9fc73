"""What we believe about a system: named parts, implicit residuals, conditions, and terms to add to them."""

from symid.model.expressions.c_function import CFunction, c_function, c_texts
from symid.model.expressions.quantity import free_symbols, initial, symbol, terminal
from symid.model.expressions.table import table
from symid.model.model import TIME, Model
from symid.model.parts.component import Component
from symid.model.parts.conditions import Boundary, Constraint, Objective, Row
from symid.model.parts.equations import Delay, Equation, Expression, Output, Port
from symid.model.parts.kinds import parts_of, same_parts
from symid.model.parts.prior import LogNormal, Normal, Prior
from symid.model.parts.quantities import WHITE, Algebraic, Constant, Control, Input, Noise, Parameter, Process, State
from symid.model.shown import as_shown, shown_states
from symid.model.solved import solved
from symid.model.term import Law, LawParameter, Term
from symid.model.variants import explicit

__all__ = [
    "WHITE",
    "TIME",
    "Algebraic",
    "Boundary",
    "CFunction",
    "Component",
    "Constant",
    "Constraint",
    "Control",
    "Delay",
    "Equation",
    "Expression",
    "Input",
    "Law",
    "LawParameter",
    "LogNormal",
    "Model",
    "Noise",
    "Normal",
    "Objective",
    "Output",
    "Parameter",
    "Port",
    "Prior",
    "Process",
    "Row",
    "State",
    "Term",
    "as_shown",
    "c_function",
    "c_texts",
    "explicit",
    "free_symbols",
    "initial",
    "parts_of",
    "same_parts",
    "shown_states",
    "solved",
    "symbol",
    "table",
    "terminal",
]
