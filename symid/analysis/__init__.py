"""What an identified model is worth: stability, uncertainty, comparison."""

from symid.analysis.comparison import compare, likelihood_ratio
from symid.analysis.stability import Stability, stability, stability_of
from symid.analysis.uncertainty import Uncertainty, profile, uncertainty

__all__ = ["Stability", "Uncertainty", "compare", "likelihood_ratio", "profile", "stability", "stability_of", "uncertainty"]
