"""Noise that is not white, of the sensors or of random forces, and how much more it explains."""

from __future__ import annotations

from collections.abc import Sequence
from math import log

from symid.errors import SymidError
from symid.estimation.fitting.correlated import is_correlated, with_correlated_forces
from symid.estimation.fitting.fit import Fit
from symid.estimation.noise_memory import with_memory
from symid.estimation.sensors.whitening import is_coloured, remembered
from symid.estimation.signals.data import Data
from symid.model.variants import CORRELATION_TIME
from symid.threads import in_threads


def coloured(fit: Fit, data: Data) -> tuple[Data, Fit]:
    """The likeliest of what leaves white innovations: sensors with a memory, correlated random forces, or both.

    The same data and fit where the innovations are white already, or nothing makes them so.
    """
    return each_coloured([fit], data)[0]


def each_coloured(fits: Sequence[Fit], data: Data) -> list[tuple[Data, Fit]]:
    """`coloured` of each of several fits to the same data."""
    left = [f for f in fits if remembered(f.innovations) > data.memory or is_coloured(f.innovations, data.memory)]
    ways = [(make, fit) for fit in left for make in (_with_forces, _with_memory)]
    made = in_threads(lambda way: way[0](way[1], data), ways)
    possible = {f: [p for (_, of), found in zip(ways, made, strict=True) if of is f for p in found] for f in left}
    return [max(possible.get(f, []), key=lambda p: gain(*p, data, f), default=(data, f)) for f in fits]


def _with_forces(fit: Fit, data: Data) -> list[tuple[Data, Fit]]:
    """A fit with correlated random forces, and the same with sensors that have a memory, too."""
    forces = with_correlated_forces(fit, data)
    return [] if forces is None else [(data, forces), *_with_memory(forces, data)]


def _with_memory(fit: Fit, data: Data) -> list[tuple[Data, Fit]]:
    """A fit with sensors that have a memory; none where that cannot be followed: it is not likelier."""
    try:
        return [with_memory(fit, data)]
    except SymidError:
        return []


def in_words(fit: Fit, data: Data) -> str:
    """What of the noise is not white, in words."""
    words = []
    if is_correlated(fit):
        words.append(f"random forces are correlated over {fit.values[CORRELATION_TIME]:.2g} s")
    if data.memory:
        words.append(f"the noise remembers {data.memory} samples")
    return " and ".join(words)


def gain(data: Data, fit: Fit, before: Data, white: Fit) -> float:
    """Evidence for an error model beyond an earlier one, with the penalty of BIC for each coefficient."""
    coefficients = (data.memory - before.memory) * len(data.sensor_noise) ** 2 + len(fit.values) - len(white.values)
    return fit.loglik2 - white.loglik2 - coefficients * log(data.samples)
