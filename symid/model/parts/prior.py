"""What is known of a parameter or an initial value before the data: a distribution as a penalty.

A penalty is -2 log of the density but for a constant, so that it adds to the sum of squared errors
divided by their variances (maximum a posteriori estimate; Gelman et al. 2013, section 13).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, log

import sympy as sm

from symid import checked
from symid.errors import ModelError


@dataclass(frozen=True)
class Normal:
    """Gaussian with this mean and standard deviation, in the unit of what it is about.

    Raises
    ------
    ModelError : no finite mean, or a deviation that is not positive.

    Examples
    --------
    >>> m.mass = Parameter(unit="kg", bounds=(0, 5), prior=Normal(2.0, 0.1))
    """

    mean: float
    deviation: float

    def __post_init__(self) -> None:
        checked.number(self.mean, "Normal: mean", ModelError)
        checked.number(self.deviation, "Normal: deviation", ModelError)
        if not (isfinite(self.mean) and isfinite(self.deviation) and self.deviation > 0):
            raise ModelError(f"{self}: a prior needs a finite mean and a positive standard deviation")

    def penalty(self, expr: sm.Expr) -> sm.Expr:
        """What it adds to minus twice the log-likelihood for an expression of the quantity.

        Parameters
        ----------
        expr : the quantity, as declared, in the prior's unit.
        """
        return ((expr - sm.Float(self.mean)) / sm.Float(self.deviation)) ** 2


@dataclass(frozen=True)
class LogNormal:
    """Positive, with this median; two thirds lie within a `factor` of it: LogNormal(2, 1.5) is 1.33 to 3.

    Raises
    ------
    ModelError : a median that is not positive, or a factor that is not above 1.

    Examples
    --------
    >>> m.stiffness = Parameter(unit="N/m", bounds=(0, 1e5), prior=LogNormal(1000.0, 1.3))
    """

    median: float
    factor: float

    def __post_init__(self) -> None:
        checked.number(self.median, "LogNormal: median", ModelError)
        checked.number(self.factor, "LogNormal: factor", ModelError)
        if not (self.median > 0 and isfinite(self.median) and isfinite(self.factor) and self.factor > 1):
            raise ModelError(f"{self}: a log-normal prior needs a positive median and a factor above 1")

    def penalty(self, expr: sm.Expr) -> sm.Expr:
        """The density is that of the logarithm, so that the median is also where it is largest.

        Parameters
        ----------
        expr : the quantity, as declared, in the prior's unit.
        """
        return (sm.log(expr / sm.Float(self.median)) / sm.Float(log(self.factor))) ** 2


Prior = Normal | LogNormal
