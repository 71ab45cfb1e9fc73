"""Rates: a smoothing spline gives a channel, its velocity and acceleration together, a polynomial one derivative.

Meant for starting guesses and for looking, not for the fit itself: a smoothed channel is a
mixture of past and future.
"""

from dataclasses import replace

import numpy as np
import scipy

from symid import checked
from symid.errors import RecordingError
from symid.recording.prepare import even
from symid.recording.recording import Recording
from symid.recording.table.names import rate_name, rate_unit
from symid.units import FloatArray

SAMPLES_A_TERM = 10
"""Samples for each number that is regressed: fewer would be explained by chance."""


def smooth_states(recording: Recording, *channels: str, noise: float | None = None) -> Recording:
    """Each channel smoothed, with its velocity and acceleration added.

    A cubic smoothing spline over each segment. How much it smooths follows from the noise: from
    `noise`, else from the recording's own figure for that channel, by the unbiased risk (Mallows
    1973); where neither is known, by generalised cross-validation (Craven & Wahba 1979), which
    assumes white noise. Filtered data are left nearly as they are.

    Parameters
    ----------
    channels : such as "ankle_angle"; its smoothed values replace it, and "ankle_velocity" and
        "ankle_acceleration" are added or replaced
    noise : rms of the white noise on these channels, in their SI unit

    Returns
    -------
    Recording with these three channels for each that was named, and all others unchanged

    Raises
    ------
    RecordingError
        If no channel is named, samples are uneven, missing, or fewer than five in a segment.

    Examples
    --------
    >>> list(smooth_states(recording.select("angle"), "angle").channels)
    ['angle', 'velocity', 'acceleration']
    """
    checked.kind(recording, Recording, "smooth_states", RecordingError)
    noise = None if noise is None else checked.number(noise, "smooth_states: noise", RecordingError, least=0.0)
    if not channels:
        raise RecordingError(f"{recording.name}: smooth_states needs the name of a channel")
    for channel in channels:
        recording[channel]
        level = recording.noise.get(channel) if noise is None else noise
        recording = _smoothed(recording, channel, level)
    return recording


def differentiate(recording: Recording, channel: str, name: str | None = None) -> Recording:
    """With the time derivative of a channel added, by a Savitzky-Golay cubic over seven samples.

    ``ankle_angle`` gives ``ankle_velocity``, that ``ankle_acceleration``, and anything else
    ``<name>_rate``, unless a name is given. Source: Savitzky & Golay 1964.

    Parameters
    ----------
    channel : of any unit; what is added has that unit per second.
    name : of what is added.

    Raises
    ------
    RecordingError
        If samples are uneven, missing, or fewer than seven in a segment.

    Examples
    --------
    >>> differentiate(recording, "angle", "turning").units["turning"]
    'rad/s'
    """
    from scipy.signal import savgol_filter

    checked.kind(recording, Recording, "differentiate", RecordingError)
    checked.kind("" if name is None else name, str, "differentiate: name", RecordingError)
    step = even(recording, "differentiate")
    values = np.empty(len(recording))
    for run in recording.runs:
        if run.stop - run.start < 7:
            raise RecordingError(
                f"{recording.name}: {run.stop - run.start} samples are too few to differentiate; seven are needed"
            )
        values[run] = savgol_filter(recording[channel][run], 7, 3, deriv=1, delta=step)
    name = name or rate_name(channel)
    unit = rate_unit(recording.units[channel])
    note = f"{name} is the derivative of {channel}, Savitzky-Golay cubic over 7 samples"
    return recording.with_channel(name, values, unit, note=note)


def smooth_curves(values: FloatArray, step: float) -> FloatArray:
    """Even samples, shape(N,), smoothed by cross-validation, their rate and its rate, shape(3, N), per second."""
    if values.size < 5 or not np.ptp(values) > 0:
        return np.stack([values, np.zeros(values.size), np.zeros(values.size)])
    size = float(np.std(values))
    return size * _spline(values / size, _smoothing_weight([values / size], None), step)


def left_by_smoother(values: FloatArray) -> FloatArray:
    """Standard deviation of the white noise in each column of values, shape(N, m), that cross-validation sees.

    The residual's sum of squares over the trace of one minus the smoother (Wahba 1990, section 4.7). Noise with a
    memory is taken for motion: what is left of it is less.
    """
    return np.array([_noise_of(column) for column in values.T])


def beside_inputs(values: FloatArray, inputs: list[FloatArray]) -> FloatArray:
    """values, shape(N, m), without the part that inputs, their integrals or the integrals of these explain.

    By a regression of second differences, where what is smooth hardly shows. A voltage that is held makes a current
    jump, a speed bend and an angle curve suddenly, and no smoother follows that.
    """
    moving = [u / np.ptp(u) for u in inputs if np.ptp(u) > 0]
    terms = [column for u in moving for column in (u, np.cumsum(u), np.cumsum(np.cumsum(u)))]
    if not terms or len(values) < SAMPLES_A_TERM * len(terms):
        return values
    bends = np.diff(np.column_stack(terms), 2, axis=0)
    found = np.linalg.lstsq(bends, np.diff(values, 2, axis=0), rcond=None)[0]
    return values - np.column_stack(terms) @ found


def _noise_of(values: FloatArray) -> float:
    if values.size < 5 or not np.ptp(values) > 0:
        return 0.0
    size = float(np.std(values))
    bend, power = _spectrum([values / size])
    gain = 1 / (1 + _smoothing_weight([values / size], None) * bend)
    return size * float(np.sqrt(np.sum((1 - gain) ** 2 * power) / np.sum(1 - gain)))


def _smoothed(recording: Recording, channel: str, noise: float | None) -> Recording:
    values = recording[channel]
    step = recording.even_step("smooth_states")
    shortest = min(run.stop - run.start for run in recording.runs)
    if shortest < 5 or not np.isfinite(values).all():
        raise RecordingError(
            f"{recording.name}: '{channel}' cannot be smoothed: "
            + ("values are missing" if shortest >= 5 else f"a segment has {shortest} samples")
        )
    curves = np.hstack(spline_of([values[run] for run in recording.runs], step, noise))
    how = "by cross-validation" if noise is None else f"for noise of {noise:.3g} rms"
    residual = float(np.sqrt(np.mean((curves[0] - values) ** 2)))
    unit = recording.units[channel]
    sign, new = recording.signs.get(channel), recording
    names = (channel, rate_name(channel), rate_name(rate_name(channel)))
    units = (unit, rate_unit(unit), rate_unit(rate_unit(unit)))
    for name, curve, of in zip(names, curves, units, strict=True):
        new = new.with_channel(name, curve, of, sign=sign)
    note = (
        f"{', '.join(names)} from a cubic smoothing spline of {channel} {how}; "
        f"it differs from the samples by {residual:.3g} {unit} rms"
    )
    return replace(new, history=(*recording.history, note))


def spline_of(pieces: list[FloatArray], step: float, noise: float | None = None) -> list[FloatArray]:
    """Value, rate and its rate, shape(3, N), of each piece of one channel, all smoothed alike; see `smooth_states`."""
    weight = _smoothing_weight(pieces, noise)
    return [_spline(piece, weight, step) for piece in pieces]


def _smoothing_weight(pieces: list[FloatArray], noise: float | None) -> float:
    """Weight of the bending penalty, in units of samples^3, shared by all pieces.

    Chosen in the frequency domain, where a smoothing spline is a low-pass with the gain
    1 / (1 + weight w^4) (Garcia 2010): milliseconds where the exact trace takes seconds.
    """
    from scipy.optimize import minimize_scalar

    bend, power = _spectrum(pieces)

    def risk(log_weight: float) -> float:
        gain = 1 / (1 + 10**log_weight * bend)
        misfit = float(np.mean((1 - gain) ** 2 * power))
        if noise is None:
            return misfit / float(np.mean(1 - gain)) ** 2
        return misfit + 2 * noise * noise * float(np.mean(gain))

    grid = np.linspace(-3.0, 10.0, 53)
    start = grid[int(np.argmin([risk(point) for point in grid]))]
    best = minimize_scalar(risk, bounds=(start - 0.5, start + 0.5), method="bounded")
    return 10.0 ** float(best.x)


def _spectrum(pieces: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """w^4 and power of each component of the pieces in the basis of cosines."""
    from scipy.fft import dct

    bends, powers = [], []
    for piece in pieces:
        # A straight line from end to end is free of bending; without it, what is left mirrors well.
        rest = piece - np.linspace(piece[0], piece[-1], piece.size)
        powers.append(dct(rest, type=2, norm="ortho") ** 2)
        bends.append((2 - 2 * np.cos(np.pi * np.arange(piece.size) / piece.size)) ** 2)
    return np.concatenate(bends), np.concatenate(powers)


def _spline(values: FloatArray, weight: float, step: float) -> FloatArray:
    """Smoothed values, their rate and its rate, shape(3, N), per second.

    The natural cubic spline by Reinsch's band system for its second derivatives (Green & Silverman 1994, section
    2.3), for even samples: a hundredth of the time of one for any samples.
    """
    bands = np.zeros((3, values.size - 2))
    bands[0, 2:], bands[1, 1:], bands[2] = weight, 1 / 6 - 4 * weight, 2 / 3 + 6 * weight
    bend = np.zeros(values.size)
    bend[1:-1] = scipy.linalg.solveh_banded(bands, np.diff(values, 2))
    curve = values - weight * np.diff(np.concatenate([[0.0], bend, [0.0]]), 2)
    rise = np.diff(curve)
    rate = np.append(rise - (2 * bend[:-1] + bend[1:]) / 6, rise[-1] + (bend[-2] + 2 * bend[-1]) / 6)
    return np.stack([curve, rate / step, bend / step**2])
