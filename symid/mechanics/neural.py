"""Feedback by a small neural network (Wang & van den Bogert 2020)."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.mechanics.delayed import check_lags
from symid.mechanics.feedback import Feedback
from symid.model import Constant, Model, Parameter

WEIGHT_BOUND = 20.0
LEAK = 0.7
"""Slope that the activation loses (or, in the article's printed form, gains) below zero."""
SHARPNESS = 50.0
ROUNDING = 1e-4


def _softplus(z: sm.Expr) -> sm.Expr:
    """log(1 + exp(z)), written so that it cannot overflow."""
    return (z + sm.Abs(z)) / 2 + sm.log(1 + sm.exp(-sm.Abs(z)))


def _leaky_relu(x: sm.Expr) -> sm.Expr:
    return x + LEAK / SHARPNESS * _softplus(-SHARPNESS * x)


def _as_printed(x: sm.Expr) -> sm.Expr:
    return x + LEAK * (x - sm.sqrt(x**2 + ROUNDING)) / 2


ACTIVATIONS = {"leaky_relu": _leaky_relu, "as_printed": _as_printed}


@dataclass(frozen=True, kw_only=True)
class NeuralNetwork(Feedback):
    """One hidden layer from all angles and rates, and a constant 1, to all joint torques.

    The weights ``w_in_<node>_<input>`` and then ``w_out_<joint>_<node>`` are declared row by
    row; the last of each row multiplies the constant. The inputs are the angles and then the
    rates of all joints; with lags, such a set for each lag.

    Parameters
    ----------
    hidden : number of hidden nodes.
    activation : ``"leaky_relu"``, x + 0.7/50 ln(1 + exp(-50 x)), slope 0.3 below zero, is what the
        authors' files used; ``"as_printed"``, x + 0.7 (x - sqrt(x^2 + 0.0001))/2, slope 1.7
        below zero, is what the article prints.
    scale : torque [N m] of an output of 1.
    lags : times before now at which the inputs are read [s].

    Raises
    ------
    ModelError : an activation that is not known, or less than one hidden node.

    Examples
    --------
    >>> len(Chain.uniform(2).with_feedback(NeuralNetwork(hidden=4)).parameters)
    30
    """

    hidden: int = 4
    activation: str = "leaky_relu"
    scale: float = 100.0
    lags: tuple[float, ...] = (0.0,)

    def __post_init__(self) -> None:
        check_lags(self.lags, type(self).__name__)
        if not isinstance(self.activation, str) or self.activation not in ACTIVATIONS:
            raise ModelError(
                f"NeuralNetwork: activation '{self.activation}' is not known; use one of {list(ACTIVATIONS)}"
            )
        checked.whole(self.hidden, "NeuralNetwork: hidden", ModelError, least=1)

    def torques(self, model: Model, joints: tuple[str, ...]) -> list[sm.Expr]:
        inputs: list[sm.Expr] = []
        units: list[str] = []
        for k, lag in enumerate(self.lags, start=1):
            suffix = f"_{k}" if len(self.lags) > 1 else ""
            signals = self.signals(model, joints, references=False, lag=lag, suffix=suffix)
            inputs += [*signals.errors, *signals.rates]
            units += ["1/rad"] * len(joints) + ["s/rad"] * len(joints)
        model.torque_scale = Constant(self.scale, unit="N*m", latex="T_0", meaning="torque of a network output of 1")
        squash = ACTIVATIONS[self.activation]
        nodes = [squash(x) for x in _layer(model, "w_in", self.hidden, inputs, units)]
        return [model.torque_scale * y for y in _layer(model, "w_out", len(joints), nodes, ["1"] * self.hidden)]


def _layer(model: Model, name: str, rows: int, inputs: list[sm.Expr], units: list[str]) -> list[sm.Expr]:
    """Declare a row of weights for each output of a layer; the weighted sums with a constant 1."""
    layer, mark = ("hidden", "in") if name == "w_in" else ("output", "out")
    sums = []
    for i in range(1, rows + 1):
        total = sm.S.Zero
        for j, (x, unit) in enumerate(zip((*inputs, sm.S.One), (*units, "1"), strict=True), start=1):
            weight = f"{name}_{i}_{j}"
            setattr(
                model,
                weight,
                Parameter(
                    unit=unit,
                    bounds=(-WEIGHT_BOUND, WEIGHT_BOUND),
                    role="weight",
                    latex=rf"w^{{\mathrm{{{mark}}}}}_{{{i},{j}}}",
                    meaning=f"weight of input {j} of node {i}, {layer} layer",
                ),
            )
            total += model[weight] * x
        sums.append(total)
    return sums
