"""Whether channels can be what they are called: magnitudes, rates of each other, time between samples."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations

import numpy as np

from symid.plausibility.motion import even_pieces
from symid.recording import Recording, rate_name
from symid.units import rough, unit_symbol

WAY = 1e3
"""Distance [m] over which an acceleration that comes and goes moves a body to and fro: no farther. The steps between
samples by themselves say nothing: tides are recorded every ten minutes, cantilevers every microsecond."""
FARTHEST = 50.0
"""Positions of one recording [m] lie no farther apart; a hundred metres of an air track are millimetres."""
STRONGEST = 50.0
"""Rms of a recorded acceleration [m/s^2]; what shakes a body stays below five times gravity."""
ALIKE = 0.9
"""A channel is the rate of another where it correlates with its derivative as well as this."""
UNLIKE = 0.5
"""A channel that correlates less with a derivative is not the rate."""
WITHIN = 1.5
"""A ratio this near to a factor of units is taken for it."""
FACTORS = {
    "rad": ((180 / np.pi, "degrees and radians"), (np.pi / 180, "degrees and radians")),
    "m": (
        (1e3, "millimetres and metres"),
        (1e-3, "millimetres and metres"),
        (1e2, "centimetres and metres"),
        (1e-2, "centimetres and metres"),
    ),
}


def channel_remarks(recording: Recording) -> list[str]:
    """A sentence for each channel that is hardly what its name and unit say."""
    return [f"{recording.name}: {remark}" for remark in (*_time(recording), *_sizes(recording), *_rates(recording))]


def _time(recording: Recording) -> Iterator[str]:
    """Accelerations that would lead far away: the times are too long."""
    step = float(np.median(np.diff(recording.time[recording.runs[0]])))
    for name in recording.channels:
        if recording.units[name] != "m/s^2":
            continue
        values = recording[name][recording.valid[name]]
        power, change = (
            np.var(values) if values.size else 0.0,
            np.mean(np.diff(values) ** 2) if values.size > 1 else 0.0,
        )
        if change > 0 and (way := np.sqrt(power) * power / change * step**2) > WAY:
            yield (
                f"{name} would move a body to and fro by {rough(way)} m with samples {step:.3g} s apart; if the time "
                "column holds milliseconds, call it time_ms"
            )
            return


def _sizes(recording: Recording) -> Iterator[str]:
    for name, values in recording.channels.items():
        if not recording.valid[name].any():
            continue
        if recording.units[name] == "m" and np.nanmax(values) - np.nanmin(values) > FARTHEST:
            yield (
                f"{name} moves over {np.nanmax(values) - np.nanmin(values):.3g} m; "
                "if the file holds millimetres, end the column's name in _mm"
            )
        if recording.units[name] == "m/s^2" and np.sqrt(np.nanmean(values**2)) > STRONGEST:
            yield (
                f"{name} has an rms of {np.sqrt(np.nanmean(values**2)):.3g} m/s²; "
                "if the file holds mm/s², end the column's name in _mm_s2"
            )


def _rates(recording: Recording) -> Iterator[str]:
    """Each channel beside the derivative of the one that it should be the rate of."""
    pairs = {
        name: rate
        for name in recording.channels
        if (rate := rate_name(name)) in recording.channels
        and recording.units[rate].split("/")[0] == recording.units[name].split("/")[0]
    }
    pieces = even_pieces(recording, tuple({*pairs, *pairs.values()})) if pairs else []
    if not pieces:
        return
    slopes = {name: np.concatenate([np.gradient(p[name], p.step) for p in pieces]) for name in pairs}
    values = {rate: np.concatenate([p[rate] for p in pieces]) for rate in pairs.values()}
    slopes, values = ({k: _smooth(v) for k, v in table.items()} for table in (slopes, values))
    likeness = {(a, b): _correlation(slopes[a], values[b]) for a in slopes for b in values}
    swapped = {
        a: b
        for (a, x), (b, y) in permutations(pairs.items(), 2)
        if abs(likeness[a, x]) < UNLIKE < ALIKE < abs(likeness[a, y]) and abs(likeness[b, x]) > ALIKE
    }
    if swapped:
        a, b = next(iter(swapped.items()))
        yield f"{pairs[a]} is the rate of {b} and {pairs[b]} that of {a}: two columns are swapped"
        return
    yield from _unlike(recording, pairs, slopes, values, likeness)


def _unlike(recording: Recording, pairs, slopes, values, likeness) -> Iterator[str]:
    ratios = {
        name: float(np.sqrt(np.mean(values[rate] ** 2) / np.mean(slopes[name] ** 2)))
        for name, rate in pairs.items()
        if abs(likeness[name, rate]) > ALIKE and np.any(slopes[name])
    }
    slow = [name for name, ratio in ratios.items() if _near(ratio, 1e3)]
    fast = [name for name, ratio in ratios.items() if _near(ratio, 1e-3)]
    for some, unit in ((slow, "milliseconds"), (fast, "seconds labelled as milliseconds")):
        if len(some) > 1 and len(some) == len(ratios):
            named = ", ".join(f"{pairs[n]} of {n}" for n in some)
            yield f"all rates are those of a time column that holds {unit}: {named}"
            return
    for name, ratio in ratios.items():
        if likeness[name, pairs[name]] < 0:
            yield f"{pairs[name]} is the rate of {name} with the opposite sign: one of the two columns is reversed"
        cause = next((c for f, c in FACTORS.get(recording.units[name].split("/")[0], ()) if _near(ratio, f)), None)
        if cause is None and (_near(ratio, 1e3) or _near(ratio, 1e-3)):
            cause = "units that differ by a thousand"
        if cause is not None:
            yield (
                f"{pairs[name]} is {ratio:.3g} times the rate of {name} [{unit_symbol(recording.units[pairs[name]])}]: "
                f"{cause} are confused in one of the two columns' names"
            )


def _smooth(x: np.ndarray, width: int = 5) -> np.ndarray:
    """A running mean, against the noise of a difference."""
    return np.convolve(x, np.ones(width) / width, mode="valid") if len(x) > 2 * width else x


def _correlation(a: np.ndarray, b: np.ndarray) -> float:
    size = float(np.sqrt(np.sum((a - a.mean()) ** 2) * np.sum((b - b.mean()) ** 2)))
    return float(np.sum((a - a.mean()) * (b - b.mean()))) / size if size > 0 else 0.0


def _near(ratio: float, factor: float) -> bool:
    return factor / WITHIN < ratio < factor * WITHIN
