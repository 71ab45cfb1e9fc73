"""Tasks on a made-up recording, whose length and rate can be chosen."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from symid.bench.task import Task
from symid.files import write_atomically, write_json
from symid.mechanics import FullStatePD
from symid.synthetic import BODY, GAINS, RATE, body_table, csv_text, standing_recording


@contextmanager
def made_up(seconds: float, rate: float = RATE) -> Iterator[Task]:
    """The task of a recording of so many seconds at a rate [Hz], on files that are gone afterwards."""
    recording = standing_recording(BODY.with_feedback(FullStatePD()), GAINS, duration=seconds, rate=rate)
    with TemporaryDirectory(prefix="symid-bench-") as folder:
        files = Path(folder) / "recording.csv", Path(folder) / "body.json"
        write_atomically(files[0], csv_text(recording))
        write_json(files[1], body_table(BODY))
        yield Task(str(files[0]), str(files[1]), (0.0, float(seconds)))
