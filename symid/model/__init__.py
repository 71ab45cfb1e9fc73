"""What we believe about a system: named parts, implicit residuals, and terms to add to them."""

from symid.model.declare import (
    Component, Constant, Delay, Equation, Expression, Input, Noise, Output, Parameter, Port, State, symbol,
)
from symid.model.model import TIME, Model, nearest
from symid.model.term import Law, LawParameter, Term

__all__ = [
    "TIME", "Component", "Constant", "Delay", "Equation", "Expression", "Input", "Law", "LawParameter",
    "Model", "Noise", "Output", "Parameter", "Port", "State", "Term", "nearest", "symbol",
]
