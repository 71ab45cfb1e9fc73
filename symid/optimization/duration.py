"""How long a motion lasts: a number of seconds, or free within bounds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite

from symid import checked
from symid.errors import TranscriptionError
from symid.model import Model, Parameter

NAME = "duration"


@dataclass(frozen=True)
class Free:
    """A duration [s] to be found between `lower` and `upper`; a solve begins at `guess`, their middle by default.

    Raises
    ------
    TranscriptionError : bounds that are not positive or not in order, or a guess outside them.

    Examples
    --------
    >>> problem = si.Optimization(model, duration=si.Free(1, 20), nodes=100)
    """

    lower: float
    upper: float
    guess: float | None = None

    def __post_init__(self) -> None:
        checked.number(self.lower, "Free: lower", TranscriptionError)
        checked.number(self.upper, "Free: upper", TranscriptionError)
        if not 0 < self.lower <= self.upper < float("inf"):
            raise TranscriptionError(
                f"Free({self.lower}, {self.upper}): a free duration needs finite bounds above 0 s, the lower one first"
            )
        if self.guess is not None and not self.lower <= self.guess <= self.upper:
            raise TranscriptionError(f"Free: the guess {self.guess} s lies outside {self.lower} to {self.upper} s")


def with_duration(model: Model, duration: float | Free | Parameter) -> tuple[Model, float, str | None]:
    """(model with the duration as a parameter, length of the time axis, name of that parameter or None).

    Raises
    ------
    TranscriptionError
        `duration` is neither a positive number, nor Free, nor a Parameter of the model.
    """
    if isinstance(duration, Parameter):
        if duration.name not in model.parameters:
            raise TranscriptionError(f"duration: '{duration.name}' is no parameter of model '{model.name}'")
        lower, upper = model[duration.name].bounds
        if not 0 < lower <= upper < float("inf"):
            raise TranscriptionError(
                f"duration: the parameter '{duration.name}' needs finite bounds above 0 s, not {lower} to {upper}"
            )
        timed = model.copy()
        timed.components[duration.name] = replace(model[duration.name], role="duration")
        return timed, 1.0, duration.name
    if isinstance(duration, Free):
        timed = model.copy()
        setattr(
            timed,
            NAME,
            Parameter(
                unit="s",
                bounds=(duration.lower, duration.upper),
                guess=duration.guess,
                meaning="duration of the motion",
                role="duration",
            ),
        )
        return timed, 1.0, NAME
    if isinstance(duration, (int, float)) and isfinite(duration) and duration > 0:
        return model, float(duration), None
    raise TranscriptionError(f"duration={duration!r}: give a positive number of seconds, or Free(lower, upper)")
