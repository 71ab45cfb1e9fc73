"""Beyond the article: its full-state PD, and the same with a feedback that comes late by an unknown delay."""

from __future__ import annotations

import pandas as pd

from symid.identification import Identification
from symid.mechanics import DoubleLinkPendulum, FullStatePD
from symid.recording import Recording
from symid.reproduce.article import HELD_OUT, WINDOW

LONGEST = 0.3
"""Bound of the delay [s]."""


def late_feedback(body: DoubleLinkPendulum, recording: Recording) -> pd.DataFrame:
    """One row for each law: delay and its standard error [ms], RMS error of the fit and of a held-out free run [deg].

    Both are identified without process noise on the article's window; the free run starts from a fitted
    initial state of the article's held-out window.
    """
    rows = []
    for name, law in (("FPD", FullStatePD()), ("FPD with delay", FullStatePD(delay=(0.0, LONGEST)))):
        solution = Identification(body.with_feedback(law), recording, WINDOW["FPD"]).solve()
        delay = 1e3 * solution.parameters[["value", "std_error"]].reindex(["feedback_delay"]).iloc[0]
        rows.append(
            (
                name,
                solution.solved,
                delay["value"],
                delay["std_error"],
                solution.fit["rms_deg"]["all"],
                solution.fit_on(HELD_OUT)["rms_deg"]["all"],
            )
        )
    columns = ["law", "solved", "delay_ms", "std_error_ms", "rms_deg", "held_out_rms_deg"]
    return pd.DataFrame(rows, columns=columns)


def late_feedback_text(table: pd.DataFrame) -> str:
    """The table for a person to read."""
    shown = table.to_string(index=False, na_rep="", float_format=lambda x: f"{x:.5g}")
    window = f"held out: {HELD_OUT[0]:g} to {HELD_OUT[1]:g} s, free run"
    return f"Beyond the article: a feedback that comes late ({window})\n{shown}"
