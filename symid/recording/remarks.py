"""What stands out in the channels of a file, in words: spikes, dropouts, angles and counters that begin again."""

from collections.abc import Callable
from dataclasses import dataclass

from symid.recording.recording import Recording
from symid.recording.signals.spikes import find_dropouts, find_spikes
from symid.recording.signals.turns import find_wraps
from symid.recording.table.names import CELSIUS, Column
from symid.units import FloatArray, IntArray, KnownUnit

MOST_PLACES = 5


@dataclass(frozen=True)
class _Channel:
    """One channel, and where its samples stand in the file."""

    name: str
    unit: KnownUnit
    recording: Recording
    rows: IntArray
    place: Callable[[int, str], str]

    @property
    def values(self) -> FloatArray:
        return self.recording.channels[self.name]

    def shown(self, *samples: int) -> list[str]:
        """Values as they stand in the file."""
        zero = CELSIUS if self.unit.text == "degC" else 0.0
        return [f"{(self.values[i] - zero) / self.unit.factor:.4g}" for i in samples]

    def at(self, sample: int) -> str:
        return self.place(self.rows[sample], f"time {self.recording.time[sample]:g} s")


def remarks_on(
    columns: list[Column], recording: Recording, rows: IntArray, place: Callable[[int, str], str]
) -> list[str]:
    """A sentence for each thing that stands out in a channel.

    Parameters
    ----------
    rows : shape(N,), row of each sample in the file, from 1. place : of a row, with one more fact about it, in words.
    """
    remarks = []
    for column in columns:
        if column.unit and column.name in recording.channels:
            channel = _Channel(column.name, column.unit, recording, rows, place)
            wraps = _wraps(channel)
            found = [_dropouts(channel), wraps or _spikes(channel)]  # one that begins again looks like a spike
            remarks += [f"column '{column.text}', {text}" for text in found if text]
    return remarks


def _dropouts(c: _Channel) -> str:
    runs = c.recording.runs
    gone = [(run.start + d.start, run.start + d.stop) for run in runs for d in find_dropouts(c.values[run])]
    if not gone:
        return ""
    first, last = gone[0]
    more = f", and at {len(gone) - 1} more places" if gone[1:] else ""
    return (
        f"{c.at(first)} to row {c.rows[last - 1]}{more}: jumps to {c.shown(first)[0]} {c.unit.text} and back, as where "
        "a value is missing; leave such cells empty and read with allow_gaps=True (--allow-gaps)"
    )


def _wraps(c: _Channel) -> str:
    found = [(run.start, *find_wraps(c.values[run], c.unit.si)) for run in c.recording.runs]
    at = [(start + int(i), period) for start, index, period in found for i in index]
    if not at:
        return ""
    first, period = at[0]
    angle = c.unit.si == "rad"
    before, after = (f"{c.values[i] / c.unit.factor:g}" for i in (first - 1, first))
    unit = f" {c.unit.text}" if angle else ""
    more = f", and at {len(at) - 1} more places" if at[1:] else ""
    what = "a full turn" if angle else f"a count of {period:.0f}"
    return (
        f"{c.at(first)}{more}: goes on at {after}{unit} behind {before}, as where {what} begins again; let it "
        f"run on: rec = symid.recording.unwrap(rec, '{c.name}')"
    )


def _spikes(c: _Channel) -> str:
    runs = c.recording.runs
    spikes = [
        (float(ratio), run.start + int(i)) for run in runs for i, ratio in zip(*find_spikes(c.values[run]), strict=True)
    ]
    if not spikes:
        return ""
    ratio, worst = max(spikes)
    others = sorted(c.rows[i] for _, i in spikes if i != worst)
    more = f"; likewise row {', '.join(map(str, others[:MOST_PLACES]))}" if others else ""
    more += f" and {len(others) - MOST_PLACES} more" if others[MOST_PLACES:] else ""
    there, before, after = c.shown(worst, worst - 1, worst + 1)
    return (
        f"{c.at(worst)}: {there} {c.unit.text} stands out between {before} and {after}, {ratio:.0f} times more "
        f"than is usual there{more}; keep it out of the window, or correct it"
    )
