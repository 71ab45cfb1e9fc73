"""Error models: how the errors of samples go together, and what covariance of an estimate follows."""

from symid.identification.noise.beside import UNFIT, Beside
from symid.identification.noise.choice import CHOICES, ErrorModel, choose
from symid.identification.noise.residual import Errors

__all__ = ["CHOICES", "UNFIT", "Beside", "ErrorModel", "Errors", "choose"]
