"""What an identified model is worth: stability, uncertainty, comparison."""

from symid.analysis.stability import Stability, stability, stability_of

__all__ = ["Stability", "stability", "stability_of"]
