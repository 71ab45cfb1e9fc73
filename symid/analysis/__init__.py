"""What an identified model is worth: stability, uncertainty, comparison."""

from symid.analysis.bootstrap import Bootstrap, bootstrap
from symid.analysis.comparison import compare, likelihood_ratio
from symid.analysis.design import Design, design
from symid.analysis.identifiability import Identifiability, identifiability
from symid.analysis.profile import profile
from symid.analysis.region import likelihood_region
from symid.analysis.stability import Stability, stability, stability_of
from symid.analysis.uncertainty import Uncertainty, uncertainty
from symid.analysis.validation import cross_validate

__all__ = [
    "Bootstrap",
    "Design",
    "Identifiability",
    "Stability",
    "Uncertainty",
    "bootstrap",
    "compare",
    "cross_validate",
    "design",
    "identifiability",
    "likelihood_ratio",
    "likelihood_region",
    "profile",
    "stability",
    "stability_of",
    "uncertainty",
]
