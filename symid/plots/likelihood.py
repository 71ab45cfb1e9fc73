"""Figures of likelihood profiles and regions."""

from __future__ import annotations

import numpy as np
import pandas as pd

from symid.plots.style import MODEL, QUIET, Picture, opened


def plot_profile(profile: pd.DataFrame) -> Picture:
    """The deviance over the parameter, with its 95 % limit and interval; a parabola is what standard errors suppose.

    Parameters
    ----------
    profile : what `symid.profile` gives.

    Examples
    --------
    >>> table = si.profile(solution, "damping", [0.38, 0.40, 0.42])
    >>> plot_profile(table).savefig("profile.png")
    """
    figure = Picture(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    values, deviance = profile.index.to_numpy(), profile["deviance"].to_numpy()
    axes.plot(values, deviance, "o-", color=MODEL, lw=1.2, ms=4)
    axes.axhline(3.841, color=QUIET, lw=1)
    for end in profile.attrs["interval"]:
        if np.isfinite(end):
            axes.axvline(end, color=QUIET, lw=1, ls=":")
    axes.set_xlabel(f"{profile.index.name} [{profile.attrs['unit']}]")
    axes.set_ylabel("deviance (95 % below 3.84)")
    axes.set_ylim(bottom=0)
    opened(axes)
    return figure


def plot_region(region: pd.DataFrame) -> Picture:
    """Lines of equal deviance of two parameters, the 95 % region filled.

    Parameters
    ----------
    region : what `symid.likelihood_region` gives.

    Examples
    --------
    >>> two = si.Identification(model.free(stiffness=(1, 9)), recording).solve()
    >>> plot_region(si.likelihood_region(two, "damping", "stiffness", points=3)).savefig("region.png")
    """
    figure = Picture(figsize=(5, 4), layout="constrained")
    axes, limit = figure.subplots(), region.attrs["limit"]
    x, y, z = region.columns.to_numpy(), region.index.to_numpy(), np.ma.masked_invalid(region.to_numpy())
    axes.contourf(x, y, z, levels=[-np.inf, limit], colors=[MODEL], alpha=0.25)
    lines = axes.contour(x, y, z, levels=[2.3, limit, 12], colors=[MODEL], linewidths=1)
    axes.clabel(lines, fmt="%.3g", fontsize=8)
    axes.plot(*region.attrs["values"][::-1], "+", color=MODEL)
    axes.set_xlabel(f"{region.columns.name} [{region.attrs['units'][1]}]")
    axes.set_ylabel(f"{region.index.name} [{region.attrs['units'][0]}]")
    opened(axes)
    return figure
