"""Bootstrap: the same identification on recordings whose residuals are drawn again, in blocks."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import cast

import numpy as np
import pandas as pd

from symid import checked
from symid.errors import ModelError
from symid.identification import Identification, Solution, Solve, Study
from symid.identification.noise import Errors
from symid.identification.noise.hac import bandwidth
from symid.identification.studies.study import Finished, tell
from symid.identification.uncertainty.covariance import ParameterErrors
from symid.recording import Recording

MOST_DRAWS = 100_000
"""Each is an identification, and its recording is drawn before the first begins."""
LEAST_DRAWS = 20
"""Solved draws below which a spread is not given: its own error would be a sixth."""


LEAST_RECORDINGS = 4
"""Recordings from which is drawn: of fewer there are hardly a dozen different draws."""


@dataclass(frozen=True, eq=False)
class Bootstrap:
    """Estimates from drawn recordings.

    Attributes
    ----------
    draws : one row for each draw that was solved, one column for each parameter [SI].
    parameters : value of the solution, std_error and 95 % interval (lower, upper; percentiles of the draws).
    failed : draws without a solution.
    block : samples that stay together, of each recording.
    """

    draws: pd.DataFrame
    parameters: pd.DataFrame
    failed: int
    block: tuple[int, ...]

    def __repr__(self) -> str:
        lost = f", {self.failed} more were not solved" if self.failed else ""
        blocks = ", ".join(map(str, sorted(set(self.block))))
        return (
            f"{self.parameters.to_string(float_format='%.5g')}\n"
            f"Error model: bootstrap, {len(self.draws)} draws of blocks of {blocks} samples{lost}."
        )


def bootstrap(
    solution: Solution,
    count: int = 200,
    *,
    seed: int = 0,
    over: str = "blocks",
    block: int | None = None,
    executor: Executor | None = None,
    store: str | Path | None = None,
    on_finished: Callable[[Finished], None] | None = tell,
) -> Bootstrap:
    """Standard errors and intervals from `count` identifications of drawn recordings.

    A draw is the fitted motion plus the residual in another order: circular blocks of it begin at random
    (Politis & Romano 1992), made as large as the noise by the degrees of freedom that the fit used up. Blocks keep
    the noise's memory; channels stay together. Over recordings, a draw is as many of the recordings, with repetition:
    that asks nothing of the noise, and counts what differs from recording to recording.

    Parameters
    ----------
    solution : of a problem that was solved. count : draws. seed : of the draws.
    over : "blocks" or "recordings".
    block : samples of a block; by default 1 where the solution's error model is white, else as many
        as the noise's memory asks for (`noise.hac.bandwidth`).
    executor, store, on_finished : as for `Study.run`.

    Raises
    ------
    ModelError
        If the problem was not solved, too few of the draws were, or there are too few recordings to draw from.

    Examples
    --------
    >>> drawn = si.bootstrap(problem.solve(), 8, on_finished=None)
    >>> drawn.parameters.index.tolist()
    ['damping']
    """
    checked.kind(solution, Solution, "bootstrap", ModelError)
    count = checked.whole(count, "bootstrap: count", ModelError, least=1, most=MOST_DRAWS)
    seed = checked.whole(seed, "bootstrap: seed", ModelError)
    if block is not None:
        shortest = min(m.intervals + 1 for m in solution.transcription.measured)
        block = checked.whole(block, "bootstrap: block", ModelError, least=1, most=shortest)
    if not solution.solved:
        raise ModelError(f"bootstrap: the problem was not solved: {solution.message}")
    checked.choice(over, ("blocks", "recordings"), "bootstrap: over", ModelError)
    errors = cast("ParameterErrors", solution.errors)  # it was solved
    residuals = errors.residuals
    blocks = tuple(block or (1 if errors.model == "white" else max(1, bandwidth(r.error))) for r in residuals)
    rng = np.random.default_rng(seed)
    solves = {}
    for k in range(count):
        if over == "recordings":
            solves[f"draw {k + 1}"] = Solve(_chosen(solution, rng), solution.values, k)
            continue
        drawn = [_drawn(solution, r, residuals[r], blocks[r], rng) for r in range(len(residuals))]
        solves[f"draw {k + 1}"] = Solve(replace(solution.problem, recordings=drawn), solution, k)
    study = Study(solves, store)
    ended = study.run_here(on_finished) if executor is None else study.run(executor, on_finished=on_finished)
    table = ended.table
    draws = table.loc[table["solved"]].reindex(columns=list(solution.values))
    if len(draws) < min(LEAST_DRAWS, count):
        raise ModelError(
            f"bootstrap: only {len(draws)} of {count} draws were solved; the first that was not says: "
            f"{table.loc[~table['solved'], 'message'].iloc[0]}"
        )
    low, high = draws.quantile(0.025), draws.quantile(0.975)
    parameters = pd.DataFrame({"value": solution.values, "std_error": draws.std(), "lower": low, "upper": high})
    return Bootstrap(draws, parameters.loc[list(solution.values)], count - len(draws), blocks)


def _chosen(solution: Solution, rng: np.random.Generator) -> Identification:
    """The problem of as many recordings, drawn from those that there are."""
    p = solution.problem
    if len(p.recordings) < LEAST_RECORDINGS or p.per_recording:
        raise ModelError(
            f"bootstrap: {len(p.recordings)} recordings{' with parameters of their own' if p.per_recording else ''} "
            f"cannot be drawn from; give at least {LEAST_RECORDINGS} that share all parameters"
        )
    chosen = rng.integers(0, len(p.recordings), len(p.recordings))
    return replace(
        p,
        recordings=[p.recordings[k] for k in chosen],
        window=[p.windows[k] for k in chosen],
        noise=p.noise and [p.noise[k] for k in chosen],
    )


def _drawn(solution: Solution, r: int, residual: Errors, block: int, rng: np.random.Generator) -> Recording:
    """Recording `r` with its outputs drawn anew inside the window."""
    recording: Recording = solution.problem.recordings[r]
    m = solution.transcription.measured[r]
    samples = len(residual.error)
    begins = rng.integers(0, samples, -(-samples // block))
    order = ((begins[:, None] + np.arange(block)) % samples).ravel()[:samples]
    error = residual.error / np.sqrt(residual.freedom / np.maximum(residual.present.sum(axis=0), 1))
    for j, y in enumerate(solution.model.outputs.values()):
        values = recording[y.channel].copy()
        values[m.nodes] = (
            values[m.nodes] + residual.error[:, j] - error[order, j]
        )  # recorded + (model - recorded) - noise
        recording = recording.with_channel(
            y.channel, values, recording.units[y.channel], noise=recording.noise.get(y.channel)
        )
    return recording
