"""What was measured, before it was filtered: the filter undone, and its cutoff estimated with the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import log
from typing import cast

import numpy as np

from symid.errors import DiagnosisError
from symid.estimation.between_samples import with_likeliest_holds
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.sensors.sensor_noise import noise_before
from symid.estimation.sensors.smoothing import Smoothing
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.data import Data
from symid.estimation.signals.known_past import with_known_past
from symid.estimation.signals.pieces import free_pieces
from symid.estimation.signals.segment import FEWEST, Segment
from symid.estimation.signals.windows import segments_of
from symid.model import Model
from symid.recording import Recording

SETTLED, MOST_ROUNDS = 1.1, 4
"""A cutoff has settled when the sharpness changes by less than this factor: the cutoff of order 2 by 2.5 %. What one
leaves that is 3 % too low looks like a muscle lag of 7 ms (person 24 of tests/examination). In a round it moves by a
factor of 1.4 at most."""
ENDS = 2.0
"""Periods of the cutoff at either end of a run in which a filter of order 2 still feels, by 1e-4, that nothing was
recorded beyond."""


def fits_of(
    model: Model,
    recording: Recording,
    part,
    length: float | None,
    plain: Data,
    filter: ZeroPhase | None,
    inputs: bool,
    start: Mapping[str, float],
    known: bool = False,
    stated: np.ndarray | bool = True,
) -> list[tuple[Data, Fit]]:
    """What may have been measured, and the fit of `model` to each: `plain` data, or those with a filter undone.

    The cutoff is estimated with the model, which the outputs' answer to the inputs shows. Where the inputs went
    through the same filter it shows nothing there, and the cutoff keeps its value. How far a filter can be undone, and
    how much noise the sensors had before it, hang on the cutoff: where that moves, both are found anew.

    Parameters
    ----------
    part, length : as for `segments_of`. stated : (m,) whether a sensor's noise is, so that it keeps its value.
    inputs : whether the inputs may have gone through the filter, too; that is then a second possibility, whose
        log-likelihood compares with that of the first.
    known : whether the filter is, so that its cutoff keeps its value.

    Raises
    ------
    DiagnosisError : the model cannot be fitted.
    """
    if filter is None:
        return [(plain, _fitted(model, plain, start))]
    plain = replace(plain, ratios_free=not np.any(stated))
    if known or isinstance(filter, Smoothing):
        data = _undone(model, recording, part, length, plain, filter, inputs=False, known=True)
        return [(data, _fitted(model, data, start))]
    found = [settled(model, recording, part, length, plain, filter, start, stated)]
    return [*found, inputs_too(recording, part, length, plain, filter, *found[0])] if inputs else found


def inputs_too(
    recording: Recording, part, length: float | None, plain: Data, filter: ZeroPhase, data: Data, fit: Fit
) -> tuple[Data, Fit]:
    """The data with a filter undone of the inputs, too, and the fit to them of the model of `fit`, which is one to
    `data`; both hold the same frequencies, so that their log-likelihoods compare. The others are as for `fits_of`."""
    both = _undone(fit.model, recording, part, length, plain, filter, inputs=True, ratio=data.segments[0].ratio)
    return both, _fitted(fit.model, both, fit.values)


def settled(
    model: Model,
    recording: Recording,
    part,
    length: float | None,
    plain: Data,
    filter: ZeroPhase,
    start: Mapping[str, float],
    stated: np.ndarray | bool = True,
) -> tuple[Data, Fit]:
    """The data with a filter undone and the fit of `model` to them, found anew until the cutoff has settled.

    Where it does not, as where a model that lacks much likes a lower one and from there a higher one, it stays where it
    began: the spectra that it began with do not depend on the model.

    Parameters
    ----------
    filter : where the cutoff begins. The others are as for `fits_of`.
    """
    found: list[tuple[Data, Fit]] = []
    while len(found) < MOST_ROUNDS:
        noise = np.where(stated, plain.sensor_noise, _noise(plain, filter))
        own = replace(plain, sensor_noise=noise, ratios_free=not np.any(stated))
        data = _undone(model, recording, part, length, own, filter, inputs=False)
        fit = _fitted(model, data, start)
        found.append((data, fit))
        if has_settled(fit, data):
            return found[-1]
        filter, start, model = sharpened_filter(fit, data), fit.values, fit.model
    return found[0]


def _fitted(model: Model, data: Data, start: Mapping[str, float]) -> Fit:
    return with_likeliest_holds(fit_model(model, data, dict(start)), data)


def sharpened_filter(fit: Fit, data: Data) -> ZeroPhase:
    """The filter that was undone, with the cutoff that a fit likes.

    Raises
    ------
    ValueError : none was undone.
    """
    if data.filter is None:
        raise ValueError("these data were not filtered")
    return data.filter.sharpened(Fitter.of(fit, data).sharpness(fit.process))


def has_settled(fit: Fit, data: Data) -> bool:
    """Whether the cutoff that a fit likes is the one with which the filter was undone."""
    return not data.cutoff_free or abs(log(fit.process[len(fit.model.noises)])) < log(SETTLED)


def _undone(
    model: Model,
    recording: Recording,
    part,
    length,
    plain: Data,
    filter: ZeroPhase,
    inputs: bool,
    known: bool = False,
    ratio: int | None = None,
) -> Data:
    ratio = ratio or filter.ratio(plain.segments[0].step)
    outputs = [y.channel for y in model.outputs.values()]
    whole, added = _restored(recording, outputs + [u.channel for u in model.inputs.values()] * inputs, filter, ratio)
    pieces = segments_of(model, whole, part, length)
    if not (inputs or known):
        pieces = [
            replace(e, undone=a.recorded) for e, a in zip(pieces, segments_of(model, added, part, length), strict=True)
        ]
    pieces = away_from_ends(with_known_past(pieces, plain.pace), recording, filter)
    pieces = pieces if plain.driven else free_pieces(pieces, len(model.states))
    sparse = tuple(s for s in (e.sparser(ratio) for e in pieces) if len(s.time) >= FEWEST)
    if not sparse:
        raise DiagnosisError(
            f"the recording looks as if it had gone through {filter}: then no piece of it holds {FEWEST} samples that "
            "say something new; give longer pieces, or the filter that it went through"
        )
    noise = plain.sensor_noise / np.sqrt(ratio)
    return replace(plain, segments=sparse, filter=filter, inputs_filtered=inputs, sensor_noise=noise)


def of_window(model: Model, recording: Recording, part, length: float | None, data: Data) -> Data:
    """Another window of the recording that `data` are of, with the same error model.

    Raises
    ------
    DiagnosisError : too little of it is left where a filter is undone.
    """
    if data.filter is None:
        return data.with_segments(with_known_past(segments_of(model, recording, part, length), data.pace))
    ratio, known = data.segments[0].ratio, not data.cutoff_free
    fine = replace(data, sensor_noise=data.sensor_noise * np.sqrt(ratio))
    return _undone(model, recording, part, length, fine, data.filter, data.inputs_filtered, known, ratio)


def restored(model: Model, recording: Recording, data: Data) -> Recording:
    """The recording with the outputs of a model as they were before the filter that was undone in `data`."""
    filter = cast("ZeroPhase", data.filter)
    outputs = [y.channel for y in model.outputs.values()]
    return _restored(recording, outputs, filter, filter.ratio(float(np.median(np.diff(recording.time)))))[0]


def away_from_ends(pieces: Sequence[Segment], recording: Recording, filter: ZeroPhase) -> list[Segment]:
    """The pieces without the samples so near to the ends of a run that the filter knew nothing beyond them."""
    found, seconds = [], ENDS / filter.cutoff
    for e in pieces:
        run = next(recording.time[r] for r in recording.runs if recording.time[r][-1] >= e.time[0])
        rows = np.flatnonzero((e.time >= run[0] + seconds) & (e.time <= run[-1] - seconds))
        if len(rows) >= FEWEST:
            found.append(e.part(slice(int(rows[0]), int(rows[-1]) + 1)))
    return found or list(pieces)


def _noise(plain: Data, filter: ZeroPhase) -> np.ndarray:
    """(m,) noise of the sensors before the filter."""
    step, channels = plain.segments[0].step, range(len(plain.sensor_noise))
    return np.array([noise_before([e.recorded[:, i] for e in plain.segments], step, filter) for i in channels])


def _restored(recording: Recording, names: list[str], filter: ZeroPhase, ratio: int) -> tuple[Recording, Recording]:
    """The recording with these channels as before the filter, and what undoing it added to each."""
    whole, added = ({c: np.array(x) for c, x in recording.channels.items()} for _ in range(2))
    for c in names:
        for run in recording.runs:
            step = float(np.median(np.diff(recording.time[run])))
            whole[c][run], added[c][run] = filter.undone(recording[c][run], step, ratio)
    return replace(recording, channels=whole), replace(recording, channels=added)
