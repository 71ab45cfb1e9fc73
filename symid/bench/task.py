"""What is measured: one identification, which symid and its peers solve from the same start."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symid.identification import Identification
    from symid.recording import Recording

NOISE = 0.25  # half width of the joint-torque noise of several episodes, as in the article [N m]


@dataclass(frozen=True)
class Task:
    """An identification by midpoint collocation of a person standing on a moving platform.

    Parameters
    ----------
    recording, body : files.
    window : (t0, t1) [s].
    controller : "pd" or "fpd".
    episodes : repetitions with process noise; 1 is without.
    number : of the random start.
    """

    recording: str
    body: str
    window: tuple[float, float]
    controller: str = "fpd"
    episodes: int = 1
    number: int = 0

    @cached_property
    def data(self) -> Recording:
        """The recording; reading it is not measured."""
        from symid.recording import read_recording

        return read_recording(self.recording)

    def identification(self) -> Identification:
        """The problem as a user of symid states it, the model derived anew."""
        from symid.cli.options import build_model
        from symid.identification import Identification
        from symid.transcription import Episodes

        noise = {"torque": NOISE} if self.episodes > 1 else {}
        return Identification(
            build_model(self.body, self.controller), self.data, self.window, episodes=Episodes(self.episodes, **noise)
        )
