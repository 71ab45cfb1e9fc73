"""Every number beside the article's: as a table, as text, and what was chosen where the sources disagree."""

from __future__ import annotations

from textwrap import fill

import numpy as np
import pandas as pd

from symid.reproduce.run import NETWORK_RIDGE, START_RIDGE, Finding, Reproduction

NOTE_WIDTH = 100
"""Characters in a line of the notes."""
NOISE = {
    "multisine": "orthogonal random-phase multisines of the power of the latter, around whose means their gains "
    "scatter far less from draw to draw (`transcription.episodes`)",
    "uniform": "uniform",
    "gaussian": "Gaussian with a standard deviation of 0.25 N m",
}
NOTES = (
    ("activation of the network", "slope 1.7 below zero as printed, 0.3 in the result files", "that of the files"),
    ("initial state", "free for each episode in the text, shared by all in the result files", "free, shared"),
    ("pi", "3.1416 in the authors' files", "as exact as the computer has it"),
    (
        "draws of noise",
        "not said; tables 1 and 2 spread as uniform draws do, not as starts of one draw",
        "one for each start",
    ),
    (
        "starts of noisy episodes",
        "random within the bounds",
        "random, then searched until simulations follow; "
        "with two episodes after an identification with estimated process noise, so that unstable loops are met",
    ),
    (
        "weights of the network",
        "within 5 of fitted ones",
        f"within 20, ridge {NETWORK_RIDGE:g} on (w/20)^2 without "
        f"noise; with noise ridge {START_RIDGE:g} on their distance from the start",
    ),
    (
        "best start of the network",
        "least RMS",
        "with noise least RMS among those whose loop, simulated with the input of "
        "the fitted window, as it is and made larger, from states around its own, does not fall "
        "(`identification.starts.stable`)",
    ),
)

GOOD = 1.01
"""A start is a good one up to this multiple of the least RMS."""


def comparison(reproduction: Reproduction) -> pd.DataFrame:
    """One row per number: table or figure, case, noise seed, quantity, article, here, deviation, spread, sd, best.

    Gains are means over the good starts (`GOOD`), as in the article's tables; `spread` is the article's standard
    deviation over its good starts, `sd` that of those here, and `best` the gain of the best start.
    """
    rows = [row for finding in reproduction.findings for row in _rows(finding)]
    columns = [
        "where",
        "case",
        "noise_seed",
        "quantity",
        "unit",
        "article",
        "here",
        "deviation",
        "spread",
        "sd",
        "best",
    ]
    return pd.DataFrame(rows, columns=columns)


def _rows(f: Finding) -> list[tuple]:
    case = f.case
    gains_in = {"PD": "table 1", "FPD": "table 2"}.get(case.controller, "figure 2")
    stable_in = {"PD": "table 3", "FPD": "table 4"}.get(case.controller, "figure 2")
    solved = f.starts[f.starts["solved"]]
    good = solved[solved["rms_deg"] <= GOOD * solved["rms_deg"].min()]

    def row(where, quantity, unit, article, here, spread=np.nan, sd=np.nan, best=np.nan):
        return where, case.name, f.seed, quantity, unit, article, here, here - article, spread, sd, best

    rows = [
        row(gains_in, "rms of the best start", "deg", case.rms_deg[0], f.best.fit["rms_deg"]["all"]),
        row(
            gains_in,
            "median rms of the solved starts",
            "deg",
            float(np.median(case.rms_deg)),
            float(solved["rms_deg"].median()),
        ),
        row("text", "solved starts", "%", np.nan, 100 * float(f.starts["solved"].mean())),
    ]
    units = f.best.model.parameters
    rows += [
        row(
            gains_in,
            name,
            units[name].unit,
            mean,
            good[name].mean(),
            spread,
            good[name].std(ddof=0),
            f.best.values[name],
        )
        for name, (mean, spread) in case.gains.items()
    ]
    rows += [
        row(stable_in, "stable by eigenvalues", "%", case.eigenvalue_percent, f.stability.eigenvalue_percent),
        row(stable_in, "stable by simulation", "%", case.forward_percent, f.stability.forward_percent),
    ]
    return rows


def text(reproduction: Reproduction) -> str:
    """All tables for a person to read, then what failed, then the choices."""
    table = comparison(reproduction)
    parts = []
    for where, rows in table.groupby("where", sort=True):
        shown = rows.drop(columns="where").to_string(index=False, na_rep="", float_format=lambda x: f"{x:.5g}")
        parts.append(f"{where[0].upper()}{where[1:]}\n{shown}")
    parts += [f"{name} gave no solution: {why}" for name, why in reproduction.failed.items()]
    return "\n\n".join([*parts, notes(reproduction.distribution)])


def notes(distribution: str = "multisine") -> str:
    """Where the article's text, its files and symid differ, and what was used here with noise of that distribution."""
    noise = "process noise", "Gaussian in the text, uniform within 0.25 N m in the result files", NOISE[distribution]
    lines = (f"{what}: {differ}; used here: {used}" for what, differ, used in (noise, *NOTES))
    wrapped = (fill(line, NOTE_WIDTH, initial_indent="  ", subsequent_indent="    ") for line in lines)
    return "\n".join(["Where the sources differ", *wrapped])
