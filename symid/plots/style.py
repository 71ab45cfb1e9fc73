"""How all figures look: colours, axes, units that a person reads."""

from __future__ import annotations

import io
import re

import numpy as np
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator
from PIL import Image

from symid.units import time_unit

INK, RECORDED, MODEL, WARN, QUIET = "#222222", "#9a9a9a", "#1f5fa8", "#c0392b", "#d9d9d9"
WARN_PALE = "#e8aaa2"
SWINGS = 8.0
"""Of a stretch in which the single swings of a motion can be told apart."""
NOTEBOOK = 5.0
"""Width [inch] at most of a figure in a notebook: its letters are read where a phone shows it half as wide."""
BANDS = 30
"""Of a spectrum in each decade of frequency: more run together into one dark area."""
_POWER = re.compile(r"\$\\mathdefault\{[-+−0-9.^{}]*\}\$")
"""What matplotlib writes at the ticks of a logarithmic axis."""


class Picture(Figure):
    """A figure without pyplot, which a notebook shows as PNG; dollars in names are dollars, no formulas.

    Examples
    --------
    >>> figure = solution.plot()
    >>> figure.axes[0].set_xlim(1, 2)
    (1.0, 2.0)
    >>> figure.savefig("fit.pdf")
    """

    def draw(self, renderer: RendererBase) -> None:
        """What matplotlib calls to draw the figure with its `renderer`."""
        for text in self.findobj(Text):
            text.set_parse_math(bool(_POWER.fullmatch(text.get_text())) or not text.get_text())
        super().draw(renderer)

    def png(self, dpi: float = 130, width: float | None = None) -> bytes:
        """The figure as PNG with `dpi` pixels an inch; of a `width` [inch] of its own its letters stay as large."""
        own, buffer = self.get_size_inches().copy(), io.BytesIO()
        self.set_size_inches(width or own[0], own[1])
        try:
            self.savefig(buffer, format="png", dpi=dpi)
        finally:
            self.set_size_inches(*own)
        return buffer.getvalue()

    def _repr_png_(self) -> bytes:
        """Small, since notebooks are kept with their pictures: few colours are enough for lines."""
        buffer = io.BytesIO()
        width = min(self.get_figwidth(), NOTEBOOK)
        Image.open(io.BytesIO(self.png(dpi=120, width=width))).convert("RGB").quantize(48).save(
            buffer, format="png", optimize=True
        )
        return buffer.getvalue()


def opened(*all_axes) -> None:
    """Quieter axes: no frame above and to the right, small ticks, a light grid."""
    for axes in all_axes:
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8.5)
        axes.grid(True, axis="x", color="#eeeeee", lw=0.8)
        axes.set_axisbelow(True)


def size_of(*signals: np.ndarray) -> float:
    """Largest magnitude of signals; what is missing has none."""
    return max((float(np.nanmax(np.abs(s))) for s in signals if np.isfinite(s).any()), default=0.0)


def swing(time: np.ndarray, signals: np.ndarray) -> float:
    """Time [s] of one swing of the signals (rows): between two that cross their mean upwards (Rice 1944)."""
    above = signals > np.nanmean(signals, axis=1, keepdims=True)
    crossings = (above[:, 1:] & ~above[:, :-1]).sum(axis=1).max(initial=0)
    return float(time[-1] - time[0]) / max(int(crossings), 1)


def banded(frequency: np.ndarray, power: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A spectrum by its means over bands of one width on a logarithmic axis, where its points are denser than those."""
    _, starts = np.unique(np.floor(BANDS * np.log10(frequency)), return_index=True)
    count = np.diff([*starts, len(frequency)])
    return np.add.reduceat(frequency, starts) / count, np.add.reduceat(power, starts) / count


def bridged(values: np.ndarray) -> np.ndarray:
    """Values with straight lines over what is missing: zeros there would be noise at every frequency."""
    known = np.isfinite(values)
    return np.interp(np.arange(len(values)), np.flatnonzero(known), values[known]) if known.any() else values


def over_time(axes, time: np.ndarray) -> float:
    """Name the time axis by the unit in which the span of `time` [s] is read; the factor to that unit."""
    unit, factor = time_unit(float(np.ptp(time)))
    axes.xaxis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10]))  # no steps of 2.5: long labels
    axes.set(xlabel=f"time [{unit}]", xlim=(time[0] * factor, time[-1] * factor))
    return factor


def plain_ticks(axis) -> None:
    """A logarithmic axis whose ticks are plain numbers: 0.5, 2, 100."""
    axis.set_major_formatter(lambda x, _: f"{x:g}")
    axis.set_minor_formatter(lambda x, _: "")
    if axis.get_view_interval()[0] > 0 and axis.get_view_interval()[1] < 10 * axis.get_view_interval()[0]:
        axis.set_minor_formatter(lambda x, _: f"{x:.3g}")
