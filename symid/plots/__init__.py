"""Figures. The only room that knows matplotlib.

Each function returns a figure that shows itself in a notebook and has matplotlib's own methods
(``savefig``). No global state of pyplot is touched.
"""

from symid.plots.diagnosis import plot_before_after, plot_latent, plot_scores, plot_spectra
from symid.plots.solution import plot_fit, plot_parameters, plot_starts
from symid.plots.style import Picture

__all__ = ["Picture", "plot_before_after", "plot_fit", "plot_latent", "plot_parameters", "plot_scores", "plot_spectra",
           "plot_starts"]
