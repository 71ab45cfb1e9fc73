"""What was measured, before it was filtered: the filter undone, and its cutoff estimated with the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from symid.estimation.cold_start import fit_model
from symid.estimation.data import Data, segments_of
from symid.estimation.fit import Fit, Fitter
from symid.estimation.pieces import free_pieces
from symid.estimation.whitening import remembered
from symid.estimation.zero_phase import ZeroPhase
from symid.model import Model
from symid.recording import Recording


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
) -> list[tuple[Data, Fit]]:
    """What may have been measured, and the fit of `model` to each: `plain` data, or those with a filter undone.

    The cutoff is estimated with the model, which the outputs' answer to the inputs shows. Where the inputs went
    through the same filter it shows nothing there, and the cutoff keeps its value.

    Parameters
    ----------
    part, length : as for `segments_of`.
    inputs : whether the inputs may have gone through the filter, too; that is then a second possibility, whose
        log-likelihood compares with that of the first.
    known : whether the filter is, so that its cutoff keeps its value.

    Raises
    ------
    DiagnosisError : the model cannot be fitted.
    """
    if filter is None:
        return [(plain, fit_model(model, plain, dict(start)))]
    ratio = filter.ratio(plain.segments[0].step)
    data = _undone(model, recording, part, length, plain, filter, ratio, inputs=False, known=known)
    fit = fit_model(model, data, dict(start))
    found = [(data, fit)]
    if inputs:
        both = _undone(model, recording, part, length, plain, filter, ratio, inputs=True)
        found.append((both, fit_model(model, both, fit.values)))
    return found


def with_memory(fit: Fit, data: Data) -> tuple[Data, Fit]:
    """The data with noise that remembers as much as leaves white innovations, and the fit to them.

    The same data and fit where the innovations are white already, or nothing random drives.
    """
    memory = remembered(fit.innovations) if fit.kalman_gain is not None else 0
    if memory <= data.memory:
        return data, fit
    sharpness = float(fit.process[-1]) if data.cutoff_free else 1.0
    more = data.sharpened(sharpness).remembering(memory)
    # The fit that took its innovations for white leaves the model something to correct, and then more to remember.
    return with_memory(Fitter.of(fit, more).again(fit), more)


def _undone(
    model: Model,
    recording: Recording,
    part,
    length,
    plain: Data,
    filter: ZeroPhase,
    ratio: int,
    inputs: bool,
    known: bool = False,
) -> Data:
    outputs = [y.channel for y in model.outputs.values()]
    whole, added = _restored(recording, outputs + [u.channel for u in model.inputs.values()] * inputs, filter, ratio)
    pieces = segments_of(model, whole, part, length)
    if not (inputs or known):
        pieces = [
            replace(e, undone=a.recorded) for e, a in zip(pieces, segments_of(model, added, part, length), strict=True)
        ]
    pieces = pieces if plain.driven else free_pieces(pieces, len(model.states))
    return replace(
        plain,
        segments=tuple(e.sparser(ratio) for e in pieces),
        filter=filter,
        sensor_noise=plain.sensor_noise / np.sqrt(ratio),
    )


def _restored(recording: Recording, names: list[str], filter: ZeroPhase, ratio: int) -> tuple[Recording, Recording]:
    """The recording with these channels as before the filter, and what undoing it added to each."""
    whole, added = ({c: np.array(x) for c, x in recording.channels.items()} for _ in range(2))
    for c in names:
        for run in recording.runs:
            step = float(np.median(np.diff(recording.time[run])))
            whole[c][run], added[c][run] = filter.undone(recording[c][run], step, ratio)
    return replace(recording, channels=whole), replace(recording, channels=added)
