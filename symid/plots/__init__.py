"""Figures. The only room that knows matplotlib.

Each function returns a figure that shows itself in a notebook and has matplotlib's own methods
(``savefig``). No global state of pyplot is touched.
"""

from symid.plots.diagnosis import plot_before_after, plot_latent, plot_scores, plot_spectra
from symid.plots.likelihood import plot_profile, plot_region
from symid.plots.live import LivePlot
from symid.plots.plan import plot_plan
from symid.plots.rest import plot_rest
from symid.plots.solution import (
    plot_fit,
    plot_inputs,
    plot_parameters,
    plot_residual_spectra,
    plot_starts,
    typical_stretch,
)
from symid.plots.stick import Animation, animate, plot_poses
from symid.plots.study import plot_study
from symid.plots.style import Picture

__all__ = [
    "Animation",
    "LivePlot",
    "Picture",
    "animate",
    "plot_before_after",
    "plot_fit",
    "plot_inputs",
    "plot_latent",
    "plot_parameters",
    "plot_plan",
    "plot_poses",
    "plot_profile",
    "plot_region",
    "plot_residual_spectra",
    "plot_rest",
    "plot_scores",
    "plot_spectra",
    "plot_starts",
    "plot_study",
    "typical_stretch",
]
