"""All that is implausible about a model and its recording, in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from symid.model import Model, shown_states
from symid.plausibility.body import PERSON, body_remarks
from symid.plausibility.channels import channel_remarks
from symid.plausibility.mistakes import model_remarks
from symid.recording import Recording
from symid.recording.signals.smooth import left_by_smoother
from symid.threads import one_blas_thread

OUTSIDE, NOISE = 0.01, 4.0
"""Share of the samples that may lie outside the bounds of a state by more than so many times what a smoother leaves."""
STEPS = 1e-4, 1.0
"""Steps between samples [s] of a person's motion, shorter and longer than which nobody records it."""
STILL = {True: 0.004, False: 0.02}
"""Range [rad] below which an angle hardly moves, of a standing person (who sways by half a degree or more; Winter,
Patla, Prince, Ishac & Gielo-Perczak 1998) and of a rig that somebody lets swing. Radians labelled as degrees
are less."""


@one_blas_thread
def remarks(model: Model, recording: Recording, window: tuple[float, float] | None = None) -> list[str]:
    """What cannot be, or is unlikely, about this recording of this model: one sentence each, the likely cause named.

    Parameters
    ----------
    window : (start, end) [s] of what is looked at; all of it where left out.

    Returns
    -------
    Sentences without a full stop: on the body, the channels by themselves, and the channels in the equations.
    """
    found = [*body_remarks(model), *channel_remarks(recording), *_pace(model, recording), *_ranges(model, recording)]
    return found + model_remarks(model, recording, window)


def _pace(model: Model, recording: Recording) -> Iterator[str]:
    """Times between samples of a person's motion; other systems are slow or fast as they are."""
    step = float(np.median(np.diff(recording.time[recording.runs[0]])))
    if not all(name in model.constants for name in PERSON) or STEPS[0] < step < STEPS[1]:
        return
    held, label = ("milliseconds", "time_ms") if step >= STEPS[1] else ("seconds", "time_s")
    yield f"{recording.name}: samples are {step:.3g} s apart; if the time column holds {held}, call it {label}"


def _ranges(model: Model, recording: Recording) -> Iterator[str]:
    """Recorded states that leave the bounds of their states, or that hardly move, or not at all."""
    person = all(name in model.constants for name in PERSON)
    for state, channel in shown_states(model).items():
        if channel not in recording.channels or not recording.valid[channel].any():
            continue
        values, (low, high), unit = recording[channel], model.states[state].bounds, model.states[state].unit
        values = values[np.isfinite(values)]
        outside = float(np.mean((values < low) | (values > high)))
        if outside > OUTSIDE:
            room = NOISE * float(left_by_smoother(values[:, None])[0])
            outside = float(np.mean((values < low - room) | (values > high + room)))
        if outside > OUTSIDE:
            hint = "; if the file holds degrees, end the column's name in _deg" if unit == "rad" else ""
            yield (
                f"{recording.name}: {channel} leaves the bounds of the model ({low:g} to {high:g} {unit}) in "
                f"{100 * outside:.0f} % of the samples{hint}"
            )
        reach = float(np.ptp(values))
        if reach == 0:
            yield (
                f"{recording.name}: {channel} is {values[0]:g} {unit} in all {len(values)} samples; was its sensor "
                "connected, and is it the right column?"
            )
        if unit == "rad" and 0 < reach < STILL[person] and _maybe_degrees(recording, channel):
            yield (
                f"{recording.name}: {channel} varies by only {np.degrees(reach):.2g} deg; if the file holds radians, "
                "end the column's name in _rad"
            )


def _maybe_degrees(recording: Recording, channel: str) -> bool:
    """Whether a file may have called the channel's numbers degrees: not where it said radians or milliradians."""
    return recording.source is None or any(h.startswith(f"{channel} converted from deg") for h in recording.history)
