"""The twelve identifications as one study, and the stability of the best of each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from symid import mechanics
from symid.analysis import Stability, stability_of
from symid.errors import SolveError
from symid.identification import Finished, Identification, Solution, Solve, StartRow, Study
from symid.identification.starts.search import EXPLODED
from symid.identification.starts.stable import SOLVED_SURVIVES, survives
from symid.model import Model
from symid.recording import Recording
from symid.reproduce.article import HELD_OUT, RANGE, TORQUE_NOISE, WINDOW, Case
from symid.transcription import Episodes

LAWS = {"PD": mechanics.PD, "FPD": mechanics.FullStatePD, "NN": mechanics.NeuralNetwork}
NETWORK_RIDGE = 4e-4
"""Weight of the network's squared weights: w/20 have a standard deviation of a few tenths, and Ipopt a Hessian."""
START_RIDGE = 0.1
"""Weight of their squared distance from the start where there is process noise: they stay near a surviving loop."""
SOLVER = {
    kind: {"max_iterations": 200, "dual_limit": EXPLODED, "time_limit_s": 3600.0}
    for kind in ("search", "relaxed", "stable")
} | {"random": {"max_iterations": 500}}
SHARED = ("search", "stable")
"""Kinds whose first steps are those of one episode: start k begins alike for all numbers of episodes."""
DRAWS = 1000
"""Draws of process noise that belong to one seed: start k has number seed * DRAWS + k."""


@dataclass(frozen=True, eq=False)
class Finding:
    """One case with one draw of process noise: all starts, the best solution, its stability."""

    case: Case
    seed: int
    starts: pd.DataFrame
    best: Solution
    stability: Stability


@dataclass(frozen=True, eq=False)
class Reproduction:
    """What `reproduce` found, which cases gave no solution (case name and seed -> why), and how the noise was drawn."""

    findings: tuple[Finding, ...]
    failed: dict[str, str]
    distribution: str


def problem(
    case: Case, body: mechanics.DoubleLinkPendulum, recording: Recording, draw: int = 0, distribution: str = "multisine"
) -> Identification:
    """The identification of one case, with process noise number `draw` of a distribution of `Episodes`."""
    model: Model = body.with_feedback(LAWS[case.controller]())
    episodes = Episodes(case.episodes, torque=TORQUE_NOISE, seed=draw, distribution=distribution)
    ridge = {}
    if case.controller == "NN":
        ridge = {"ridge": START_RIDGE, "ridge_about": "start"} if case.episodes > 1 else {"ridge": NETWORK_RIDGE}
    return Identification(model, recording, WINDOW[case.controller], episodes=episodes, **ridge)


def reproduce(
    cases: Sequence[Case],
    body: mechanics.DoubleLinkPendulum,
    recording: Recording,
    *,
    starts: int = 10,
    seeds: Sequence[int] = (0,),
    distribution: str = "multisine",
    executor: Executor | None = None,
    jobs: int = 1,
    store: str | Path | None = None,
    on_finished: Callable[[Finished], None] | None = None,
) -> Reproduction:
    """Identify every case from several starts, and test the best solution of each for stability.

    PD and full-state PD without noise begin with random gains, as in the article; all others with
    `identification.search`, because random ones seldom end at all. With two episodes the starts are
    those of `search.relaxed_start`: an unstable loop can still win there, and would never be met.
    Every start has a process noise of its own: the spread of the article's starts is the spread over
    draws, while all starts of one draw end in the same optimum. The network with noise begins with
    `stable.stable_start`, and its best start is the best of those whose loop survives the
    displaced states: ten fitted seconds do not say whether a loop stands elsewhere, the model does.

    Parameters
    ----------
    starts : of each case; start number k is the same however many there are.
    seeds : of the process noise; deterministic cases are solved for the first of them only.
    distribution : of the process noise, one of `Episodes`.
    executor, jobs, store : as for `Study.run`; `jobs` are also the threads of the simulations.
    """
    solves = {}
    for case in sorted(cases, key=lambda case: -case.episodes):  # the long ones first: none is left alone at the end
        for seed in seeds if case.episodes > 1 else seeds[:1]:
            labels = {"controller": case.controller, "episodes": case.episodes, "noise seed": seed}
            for k in range(starts):
                one, kind = problem(case, body, recording, DRAWS * seed + k, distribution), _start_kind(case)
                shared = f"{case.controller}/{seed}/{k}" if kind in SHARED else ""
                solves[f"{case.name}/{seed}/{k}"] = Solve(one, kind, k, 0, SOLVER[kind], labels, shared)
    study = Study(solves, store)
    result = study.run_here(on_finished) if executor is None else study.run(executor, on_finished=on_finished)
    table, findings, failed = result.table, [], {}
    for case in cases:
        for seed in seeds if case.episodes > 1 else seeds[:1]:
            labels = {"controller": case.controller, "episodes": case.episodes, "noise seed": seed}
            try:
                best = result.best(_survives(problem(case, body, recording)), **labels)
            except SolveError as none:
                failed[f"{case.name}/{seed}"] = str(none)
                continue
            rows = table[(table[list(labels)] == pd.Series(labels)).all(axis=1)]
            tested = stability_of(best.model, best.values, recording, window=RANGE, held_out=HELD_OUT, threads=jobs)
            findings.append(Finding(case, seed, rows, best, tested))
    return Reproduction(tuple(findings), failed, distribution)


def _survives(one: Identification) -> Callable[[StartRow], bool]:
    """Whether the loop of a start survives displaced states, where starts are stable ones; else every start does."""
    if one.ridge_about != "start":
        return lambda row: True
    names = one.transcription.layout.parameter_names
    return lambda row: survives(one.transcription, np.array([row.parameters[k] for k in names]), SOLVED_SURVIVES)


def _start_kind(case: Case) -> str:
    if case.controller == "NN" and case.episodes > 1:
        return "stable"
    if case.episodes == 1 and case.controller != "NN":
        return "random"
    return "relaxed" if case.episodes == 2 else "search"
