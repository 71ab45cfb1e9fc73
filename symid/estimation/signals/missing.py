"""A recording without the samples that are missing, which nothing can be compared with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.errors import DiagnosisError
from symid.model import Model
from symid.recording import Recording

BRIDGED = 4.0
"""Over a gap of fewer steps inputs are followed as between any two samples; of a longer one nobody knows them."""


def without_missing(recording: Recording, model: Model, moved: bool) -> Recording:
    """The samples in which every channel of `model` was measured.

    Parameters
    ----------
    moved : whether anything moves the system besides its own state: it then begins anew, in a segment of its own, after
        a gap of more than `BRIDGED` steps.

    Raises
    ------
    DiagnosisError : not even two samples are left.
    """
    channels = [c.channel for c in (*model.outputs.values(), *model.inputs.values())]
    valid = [recording.valid[c] for c in channels if c in recording.channels]
    kept = np.flatnonzero(np.all(valid, axis=0)) if valid else np.arange(len(recording))
    if len(kept) < 2:
        raise DiagnosisError(
            f"{recording.name}: there are no two samples in which {', '.join(channels)} were all measured"
        )
    run = np.repeat(np.arange(len(recording.runs)), [r.stop - r.start for r in recording.runs])[kept]
    steps = np.diff(recording.time[kept])
    begins = np.diff(run) != 0
    if moved and not begins.all():
        begins |= steps > BRIDGED * np.median(steps[~begins])
    if len(kept) == len(recording) and begins.sum() == len(recording.runs) - 1:
        return recording
    return replace(
        recording,
        time=recording.time[kept],
        channels={k: x[kept] for k, x in recording.channels.items()},
        segment=np.concatenate([[0], np.cumsum(begins)]),
        split=None if recording.split is None else recording.split[kept],
    )
