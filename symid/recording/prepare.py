"""Verbs that turn one recording into another before it is used: mend, resample, filter, differentiate.

Each works on every segment by itself, returns a new Recording, and says in its history what it
did. SciPy is imported where it is used, so that reading a recording does not wait for it.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symid import checked
from symid.errors import RecordingError
from symid.recording.recording import Recording
from symid.recording.signals.timing import MOST_SAMPLES
from symid.units import FloatArray

_PASSBAND = 0.8  # of the new Nyquist frequency is kept when downsampling
_HIGHEST_ORDER, _LOWEST_CUTOFF = 16, 1e-6
"""Of a low-pass filter, the cut-off as a share of the sampling rate: beyond, its coefficients are rounding."""
_ANTI_ALIAS_ORDER = 8  # of the Butterworth filter, before it runs in both directions
_SAME_RATE = 0.01  # part by which a clock may be slow, so that nothing but its highest hundredth could be aliased


def fill_gaps(recording: Recording, max_gap_s: float, *channels: str) -> Recording:
    """Fill missing rows and blank cells by cubic Hermite interpolation (PCHIP), onto an even grid.

    Parameters
    ----------
    max_gap_s : longest stretch without a value [s] that may be filled
    channels : of which; all, if none is named. What is missing in the others stays so: an input must be known
        throughout, an output need not be

    Raises
    ------
    RecordingError
        If there is no such channel, a gap is longer, or a channel begins or ends with a missing value.

    Examples
    --------
    >>> fill_gaps(recording, 0.1, "angle").history[-1]
    'gaps of angle up to 0.1 s filled by PCHIP: 0 value(s)'
    """
    chosen = channels or tuple(checked.kind(recording, Recording, "fill_gaps", RecordingError).channels)
    for name in chosen:
        recording[name]
    max_gap_s = checked.number(max_gap_s, "fill_gaps: max_gap_s", RecordingError)
    filled = 0

    def mend(part: Recording) -> Recording:
        nonlocal filled
        step = float(np.median(np.diff(part.time)))
        time = _grid(part.time, step, part.name)
        channels = {}
        for name in part.channels:
            good = np.isfinite(part[name])
            channels[name] = np.full(time.size, np.nan)
            if name in chosen:
                _check_gaps(part, name, good, max_gap_s)
                channels[name] = _pchip(part.time[good], part[name][good], time)
                filled += time.size - int(good.sum())
            kept = np.searchsorted(time, part.time[good] - step / 2)
            channels[name][kept] = part[name][good]  # a value that was measured stays as it was
        return _resampled(part, time, channels)

    mended = _by_segment(recording, mend)
    of = f" of {', '.join(channels)}" if channels else ""
    return mended.noted(f"gaps{of} up to {max_gap_s:g} s filled by PCHIP: {filled} value(s)")


def resample(recording: Recording, rate_hz: float) -> Recording:
    """The recording at another rate, from its first time on, by cubic splines.

    Going down in rate, a zero-phase Butterworth low-pass (order 8, run in both directions) at
    80 % of the new Nyquist frequency comes first, against aliasing. Unevenly sampled times are
    put onto an even grid of their own median rate before.

    Parameters
    ----------
    rate_hz : samples a second afterwards [Hz].

    Raises
    ------
    RecordingError
        If the rate is not positive, values are missing, or a gap in time is wider than one and a
        half steps (`fill_gaps` first).

    Examples
    --------
    >>> 1 / resample(recording, 25.0).sampling_interval
    25.0
    """
    checked.kind(recording, Recording, "resample", RecordingError)
    rate_hz = checked.number(rate_hz, "resample: rate_hz", RecordingError)
    if not rate_hz > 0 or not np.isfinite(rate_hz):
        raise RecordingError(f"{recording.name}: a rate of {rate_hz:g} Hz is not possible")

    def change(part: Recording) -> Recording:
        _require_values(part, "resample")
        old = float(np.median(np.diff(part.time)))
        even = part if part.sampling_interval else _evened(part, old)
        if rate_hz < (1 - _SAME_RATE) / old:
            even = lowpass(even, _PASSBAND * rate_hz / 2, order=_ANTI_ALIAS_ORDER)
        start, end = even.interval
        count = int(np.floor(_few_enough(part.name, (end - start) * rate_hz) * (1 + 1e-12) + 1e-6)) + 1
        if count < 2:
            raise RecordingError(f"{part.name}: too short for a rate of {rate_hz:g} Hz")
        time = start + np.arange(count) / rate_hz
        values = {name: _spline(even.time, even[name], time) for name in even.channels}
        return _resampled(even, time, values)

    rates = [1 / np.median(np.diff(recording.time[run])) for run in recording.runs]
    note = f"resampled from {np.median(rates):g} Hz to {rate_hz:g} Hz by cubic splines"
    if recording.sampling_interval is None:
        note += ", after putting uneven times onto an even grid"
    if rate_hz < (1 - _SAME_RATE) * max(rates):
        note += f", after a zero-phase Butterworth low-pass at {_PASSBAND * rate_hz / 2:g} Hz against aliasing"
    return _by_segment(recording, change).noted(note)


def lowpass(recording: Recording, cutoff_hz: float, *channels: str, order: int = 2) -> Recording:
    """Low-pass some channels (all, if none is named) by a Butterworth filter without phase shift.

    The filter runs forward and backward, so the attenuation at the cut-off is 6 dB and nothing
    is late. The price: every sample then also contains the future, and the noise is no longer
    white, which a later diagnosis has to know; the history says so.

    Parameters
    ----------
    cutoff_hz : cut-off of the single pass [Hz]
    order : of the single pass

    Raises
    ------
    RecordingError
        If samples are uneven or missing, too few, or the cut-off is not below Nyquist.

    Examples
    --------
    >>> lowpass(recording, 6.0, "angle").history[-1][:28]
    'angle low-passed at 6 Hz, Bu'
    """
    from scipy.signal import butter, sosfiltfilt

    chosen = channels or tuple(checked.kind(recording, Recording, "lowpass", RecordingError).channels)
    for name in chosen:
        recording[name]
    step = even(recording, "lowpass")
    order = checked.whole(order, "lowpass: order", RecordingError, least=1, most=_HIGHEST_ORDER)
    cutoff_hz = checked.number(cutoff_hz, "lowpass: cutoff_hz", RecordingError)
    if not _LOWEST_CUTOFF / step < cutoff_hz < 0.5 / step:
        raise RecordingError(
            f"{recording.name}: a cut-off of {cutoff_hz:g} Hz is not between {_LOWEST_CUTOFF / step:g} and half the "
            f"sampling rate, {0.5 / step:g} Hz"
        )
    sections = butter(order, cutoff_hz, fs=1 / step, output="sos")
    shortest = 3 * (2 * len(sections) + 1)  # the padding that sosfiltfilt asks for

    def smooth(values: FloatArray) -> FloatArray:
        if values.size <= shortest:
            raise RecordingError(
                f"{recording.name}: {values.size} samples are too few to filter; more than {shortest} are needed"
            )
        return sosfiltfilt(sections, values)

    note = (
        f"{', '.join(chosen)} low-passed at {cutoff_hz:g} Hz, Butterworth order {order} forward "
        f"and backward (zero phase: samples contain the future, noise is not white)"
    )
    return _mapped(recording, chosen, smooth, note)


def _by_segment(recording: Recording, verb: Callable[[Recording], Recording]) -> Recording:
    """The verb on every segment, and the results in one recording again."""
    parts = [verb(recording.rows(run)) for run in recording.runs]
    if len(parts) == 1:
        return replace(parts[0], history=recording.history)
    return replace(
        recording,
        time=np.concatenate([part.time for part in parts]),
        channels={name: np.concatenate([part[name] for part in parts]) for name in recording.channels},
        noise=parts[0].noise,
        segment=_joined(part.segment for part in parts),
        split=_joined(part.split for part in parts),
    )


def _joined(labels) -> np.ndarray | None:
    labels = list(labels)
    return None if labels[0] is None else np.concatenate(labels)


def _mapped(recording: Recording, names, verb, note: str) -> Recording:
    """The verb on the values of each segment of the named channels; their noise is then unknown."""
    channels = dict(recording.channels)
    for name in names:
        channels[name] = np.concatenate([verb(recording[name][run]) for run in recording.runs])
    noise = {name: rms for name, rms in recording.noise.items() if name not in names}
    return replace(recording, channels=channels, noise=noise).noted(note)


def _resampled(part: Recording, time: FloatArray, channels: dict) -> Recording:
    """One segment at other times; its labels are the same in all rows."""
    label = lambda old: None if old is None else np.repeat(old[:1], time.size)  # noqa: E731
    return replace(part, time=time, channels=channels, segment=label(part.segment), split=label(part.split))


def _grid(time: FloatArray, step: float, name: str) -> FloatArray:
    """Even grid through the first and last time, with as many steps as the median step asks."""
    count = round(_few_enough(name, float(time[-1] - time[0]) / step))
    grid = time[0] + (time[-1] - time[0]) / count * np.arange(count + 1)
    places = np.searchsorted(grid, time - step / 2)
    if np.any(np.diff(places) == 0) or np.abs(grid[places] - time).max() > 0.1 * step:
        raise RecordingError(
            f"{name}: the times do not lie on an even grid of {step:g} s, even with gaps; use resample()"
        )
    return grid


def _few_enough(name: str, count: float) -> float:
    """The number of samples of an even grid; RecordingError where they would not fit into memory."""
    if not count <= MOST_SAMPLES:
        raise RecordingError(
            f"{name}: {count:.3g} samples would be needed, more than {MOST_SAMPLES:.0e}; look at the unit and the "
            f"jumps of the time column, or take a lower rate"
        )
    return count


def _check_gaps(part: Recording, name: str, good: np.ndarray, max_gap_s: float):
    """Refuse what cannot or must not be filled."""
    if good.sum() < 2 or not (good[0] and good[-1]):
        raise RecordingError(
            f"{part.name}: '{name}' begins or ends with a missing value, or has fewer than two; "
            f"take a window without them"
        )
    known = part.time[good]
    widest = int(np.argmax(np.diff(known)))
    gap = float(known[widest + 1] - known[widest])
    usual = float(np.median(np.diff(part.time)))
    if gap > 1.5 * usual and gap > max_gap_s * (1 + 1e-9):
        raise RecordingError(
            f"{part.name}: '{name}' has no value from {known[widest]:g} s to "
            f"{known[widest + 1]:g} s, longer than max_gap_s = {max_gap_s:g} s; allow more, or "
            f"cut the recording there"
        )


def _evened(part: Recording, step: float) -> Recording:
    """Unevenly timed samples interpolated onto an even grid of about this step [s]."""
    widest = int(np.argmax(np.diff(part.time)))
    if np.diff(part.time)[widest] > 1.5 * step:
        raise RecordingError(f"{part.name}: samples are missing after {part.time[widest]:g} s; use fill_gaps() first")
    count = round(_few_enough(part.name, float(part.time[-1] - part.time[0]) / step))
    time = np.linspace(part.time[0], part.time[-1], count + 1)
    values = {name: _spline(part.time, part[name], time) for name in part.channels}
    return _resampled(part, time, values)


def _require_values(recording: Recording, verb: str):
    for name, values in recording.channels.items():
        missing = np.flatnonzero(~np.isfinite(values))
        if missing.size:
            raise RecordingError(
                f"{recording.name}: {verb} needs all values, but '{name}' has none at "
                f"{recording.time[missing[0]]:g} s; use fill_gaps() first"
            )


def even(recording: Recording, verb: str) -> float:
    """Sampling interval [s] of a recording without gaps."""
    _require_values(recording, verb)
    return recording.even_step(verb)


def _spline(old: FloatArray, values: FloatArray, new: FloatArray) -> FloatArray:
    from scipy.interpolate import make_interp_spline

    return make_interp_spline(old, values, k=min(3, old.size - 1))(new)


def _pchip(old: FloatArray, values: FloatArray, new: FloatArray) -> FloatArray:
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(old, values)(new)
