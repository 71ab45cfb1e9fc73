"""How a recording shows itself: as text, in a notebook, as a table."""

import html
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from symid.units import column_name

if TYPE_CHECKING:
    import pandas as pd

    from symid.recording.recording import Recording


def as_text(recording: "Recording") -> str:
    """Name and extent, then one line for each channel with its unit and range."""
    rows = [
        f"  {n:<24s} {u:<8s} {lo:>11s} to {hi:>11s}{f', {gone} missing' if gone else ''}"
        for n, u, lo, hi, gone in _rows(recording)
    ]
    return "\n".join([f"Recording {recording.name}: {_extent(recording)}", *rows])


def as_html(recording: "Recording") -> str:
    """The same as a table, with the history to unfold."""
    titles, rows = ("channel", "unit", "lowest", "highest", "missing"), list(_rows(recording))
    shown = len(titles) - (not any(gone for *_, gone in rows))
    head = "".join(_cell("th", text, i) for i, text in enumerate(titles[:shown]))
    body = "".join(
        "<tr>" + "".join(_cell("td", text, i) for i, text in enumerate(row[:shown])) + "</tr>" for row in rows
    )
    steps = "".join(f"<li>{html.escape(step)}</li>" for step in recording.history)
    return (
        f"<b>Recording {html.escape(recording.name)}</b>: {html.escape(_extent(recording))}"
        f"<table><tr>{head}</tr>{body}</table><details><summary>history</summary><ol>{steps}</ol></details>"
    )


def as_frame(recording: "Recording") -> "pd.DataFrame":
    """A table with time_s as index and units in the column names."""
    import pandas as pd  # here and not at the top: most runs never need it

    table = {column_name(name, recording.units[name]): v for name, v in recording.channels.items()}
    labels = {"split": recording.split, "segment": recording.segment}
    present = {name: label for name, label in labels.items() if label is not None}
    return pd.DataFrame(present | table, index=pd.Index(recording.time, name="time_s"))


def _cell(tag: str, text: str, column: int) -> str:
    """Names and units to the left, numbers to the right."""
    side = "left" if column < 2 else "right"
    return f'<{tag} style="text-align:{side}">{html.escape(text)}</{tag}>'


def _extent(recording: "Recording") -> str:
    step, (first, last) = recording.sampling_interval, recording.interval
    rate = "unevenly sampled" if step is None else f"{1 / step:g} Hz"
    runs = f", {len(recording.runs)} segments" if len(recording.runs) > 1 else ""
    return f"{len(recording)} samples, {first:g} s to {last:g} s, {rate}{runs}"


def _rows(recording: "Recording") -> Iterator[tuple[str, str, str, str, str]]:
    """Channel, unit, lowest and highest value, and how many samples have none ("" where all have one)."""
    for name, values in recording.channels.items():
        some = values[np.isfinite(values)]
        ends = (f"{some.min() + 0.0:.4g}", f"{some.max() + 0.0:.4g}") if some.size else ("none", "none")  # 0 for -0
        yield name, recording.units[name], *ends, str(len(values) - len(some) or "")
