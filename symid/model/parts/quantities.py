"""The named quantities from which a model is declared: states, inputs, parameters, constants, noise.

A part is written without a name and gets it from the attribute to which it is attached:
``m.angle = State(unit="rad")``. What ``m.angle`` gives back behaves as a SymPy symbol in
arithmetic and in SymPy functions. Parts never change; attaching makes a named copy.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf
from typing import Any

import sympy as sm

from symid.model.expressions.quantity import AlongTime, Quantity, symbol
from symid.model.parts.component import Component
from symid.model.parts.prior import Prior

Bounds = tuple[float, float]
HOLDS = ("smooth", "either", "band-limited", "cubic", "linear", "zero")
WHITE = "white"
NOISE_HOLDS = ("either", "held", WHITE)
REQUIRED: Any = None
"""A unit that was not given: attaching the part to a model refuses it, with the part's name."""


@dataclass(frozen=True, kw_only=True)
class State(AlongTime, Component):
    """A quantity with a time derivative, unknown at every node. Bounds in its unit.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.lean = State(unit="rad", bounds=(-1, 1), meaning="from the vertical")
    >>> m.lean.dot
    lean'
    """

    unit: str = REQUIRED
    bounds: Bounds = (-inf, inf)

    @property
    def dot(self) -> sm.Symbol:
        """The symbol of the time derivative; its unit is the state's unit per second."""
        return symbol(self.symbol.name + "'")


@dataclass(frozen=True, kw_only=True)
class Algebraic(AlongTime, Component):
    """A quantity without a time derivative, given by an equation at every instant (index-1 DAE); bounds in its unit.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.lift = Algebraic(unit="N")
    >>> m.aerodynamics = Equation(m.lift - m.c * m.speed**2)
    """

    unit: str = REQUIRED
    bounds: Bounds = (-inf, inf)


@dataclass(frozen=True, kw_only=True)
class Control(AlongTime, Component):
    """An unknown input, to be chosen by an Optimization or estimated by an Identification.

    Parameters
    ----------
    bounds : in its unit.
    hold : "linear" from node to node, or "zero": constant from each node to the next (zero-order hold).
    smooth : weight [objective's unit / (unit/s)^2 / s] of the integral of its squared rate, added to the
        objective: it makes the control an estimated disturbance that is as smooth as the data allow. The objective is
        the integral of squared errors, or -2 log of the likelihood where the noise is given. Standard errors count
        what the control takes up, whatever its weight, and a Solution warns of one that is far from what fits.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.force = Control(unit="N", bounds=(-20, 20))
    """

    unit: str = REQUIRED
    bounds: Bounds = (-inf, inf)
    hold: str = "linear"
    smooth: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Process(Control):
    """Process noise that is estimated along with the motion: white, constant from node to node.

    The parameters are those of the likelihood of the recordings alone, over all motions (`identification.marginal`), to
    first order where the system is not linear, and the motion is the likeliest beside them.

    Parameters
    ----------
    size : square root of the noise's spectral density [unit * sqrt(s)]: its mean over a time T has the
        standard deviation size / sqrt(T). The objective gets the integral of (noise / size)^2, that is -2 log of
        its likelihood (Jazwinski 1970, section 5.3). `Identification.solve` estimates it where it is left out; a
        Study and an Optimization need it.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.gust = Process(unit="N", size=0.3)            # or Process(unit="N"), whose size is estimated, too
    """

    hold: str = "zero"
    size: float | None = None


@dataclass(frozen=True, kw_only=True)
class Input(AlongTime, Component):
    """A signal known from a recording.

    Parameters
    ----------
    channel : names the column, by default the input's name.
    hold : what the signal does between its samples. "zero" keeps each sample until the next one, as a
        digital-to-analogue converter does (zero-order hold; Astrom & Wittenmark 1997, section 2.3);
        "linear" joins them by straight lines; "cubic" by the cubic spline through them (not-a-knot; de Boor
        1978, chapter IV); "band-limited" by one of degree 9, which loses 0.2 % of what is sampled three times a period
        where a cubic one loses 6 %. "smooth" stands for "cubic" wherever nothing can tell; a scheme of second order
        whose nodes are the samples takes the means of neighbours, which is the same to its order. In a diagnosis
        "smooth" becomes "either": straight lines, or such curves where these are likelier.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.push = Input(unit="N", channel="recorded_force")
    """

    unit: str = REQUIRED
    channel: str = ""
    hold: str = "smooth"


@dataclass(frozen=True, kw_only=True)
class Parameter(Quantity, Component):
    """A constant of the system that is to be identified.

    Parameters
    ----------
    bounds : in its unit; the larger one scales it.
    guess : used as a start if given.
    prior : what is known before the data: `Normal` or `LogNormal`.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its values.

    Examples
    --------
    >>> m.damping = Parameter(unit="N*s/m", bounds=(0, 10), meaning="of the bearing")
    """

    unit: str = REQUIRED
    bounds: Bounds = (-inf, inf)
    guess: float | None = None
    prior: Prior | None = None


@dataclass(frozen=True)
class Constant(Quantity, Component):
    """A known number, in its unit. Changing the value never needs new code.

    Raises
    ------
    ModelError : an argument that it does not take, or no value; `Model.check` tells what is wrong with it.

    Examples
    --------
    >>> m.mass = Constant(2.0, unit="kg")
    """

    value: float
    unit: str = field(default=REQUIRED, kw_only=True)


@dataclass(frozen=True, kw_only=True)
class Noise(Quantity, Component):
    """Process noise: drawn for an episode, then known. Zero in a deterministic problem.

    Parameters
    ----------
    hold : what it does between the samples of a recording. "held" keeps a value for about 10 ms, and for a whole part
        of a sample; "white" changes all the time; "either" becomes in a diagnosis "white" where that is likelier.

    Raises
    ------
    ModelError : an argument that it does not take; `Model.check` tells what is wrong with its unit.

    Examples
    --------
    >>> m.jitter = Noise(unit="N")          # its size is given by Episodes
    """

    unit: str = REQUIRED
    hold: str = "either"
