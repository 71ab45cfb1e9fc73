"""What an identified model is worth: stability, uncertainty, comparison."""

from symid.analysis.bootstrap import Bootstrap, bootstrap
from symid.analysis.comparison import compare, likelihood_ratio
from symid.analysis.design import Design, design
from symid.analysis.identifiability import Identifiability, identifiability
from symid.analysis.profile import profile
from symid.analysis.stability import Stability, stability, stability_of
from symid.analysis.uncertainty import Uncertainty, uncertainty

__all__ = [
    "Bootstrap",
    "Design",
    "Identifiability",
    "Stability",
    "Uncertainty",
    "bootstrap",
    "compare",
    "design",
    "identifiability",
    "likelihood_ratio",
    "profile",
    "stability",
    "stability_of",
    "uncertainty",
]
