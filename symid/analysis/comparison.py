"""Which of several models of the same recording to prefer: information criteria, likelihood ratio, held-out error."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
import scipy

from symid import checked
from symid.errors import ModelError
from symid.identification import Solution
from symid.identification.uncertainty.sensitivity import outputs_and_targets

ALIKE, REFUTED = 2.0, 10.0
"""Distances in AIC up to which a model has as good as the same support as the best, and from which it has none."""


def compare(solutions: Mapping[str, Solution], *, held_out: tuple[float, float] | None = None) -> pd.DataFrame:
    """Solved models of the same data, side by side, the smallest AIC first.

    The error of each output is taken as Gaussian with its own unknown variance. Process noise
    colours it, so that samples repeat each other: the log-likelihood counts as many of them as
    are independent in the residual of the best model (Bartlett 1946: N / sum of squared
    autocorrelations), the same for every model.

    Parameters
    ----------
    solutions : name -> Solution, all of one episode, of the same recordings, windows and outputs.
    held_out : (start, end) [s] of the first recording for the error of a free run there.

    Returns
    -------
    DataFrame
        One row per model: parameters (free, not at a bound), log_likelihood, aic and bic
        (Akaike 1974, Schwarz 1978) with the least taken as zero, evidence in words (from aic), rms [SI, all outputs],
        held_out_rms where asked for; ``attrs["independent_samples"]`` by output.

    Raises
    ------
    ModelError
        If a model was not solved, has several episodes, or saw other data than the first.

    Examples
    --------
    >>> two = {"free": problem.solve(), "fixed": si.Identification(model.fixed(damping=0.1), recording).solve()}
    >>> list(si.compare(two).index)
    ['free', 'fixed']
    """
    if not isinstance(solutions, Mapping) or not solutions:
        raise ModelError('compare: give solutions by name, as in {"PD": solution, "with delay": other}')
    for s in solutions.values():
        checked.kind(s, Solution, "compare", ModelError)
    held_out = held_out if held_out is None else checked.window(held_out, "compare: held_out", ModelError)
    errors = {name: _errors(name, s) for name, s in solutions.items()}
    _refuse_other_data(solutions)
    count = independent_samples(min(errors.values(), key=lambda e: float(np.mean(e**2))))
    rows = {}
    for name, s in solutions.items():
        free = int((~s.parameters["at_bound"]).sum())
        likelihood = -0.5 * float(np.sum(count * (np.log(2 * np.pi * np.mean(errors[name] ** 2, axis=0)) + 1)))
        rows[name] = {
            "parameters": free,
            "log_likelihood": likelihood,
            "aic": 2 * free - 2 * likelihood,
            "bic": free * np.log(count.sum()) - 2 * likelihood,
            "rms": s.fit["rms"]["all"],
        }
        if held_out is not None:
            rows[name]["held_out_rms"] = s.fit_on(held_out)["rms"]["all"]
    table = pd.DataFrame.from_dict(rows, orient="index").sort_values("aic")
    table[["aic", "bic"]] -= table[["aic", "bic"]].min()
    table.insert(list(table).index("bic") + 1, "evidence", [_words(x, i == 0) for i, x in enumerate(table["aic"])])
    table.attrs["independent_samples"] = dict(zip(next(iter(solutions.values())).model.outputs, count, strict=True))
    return table


def likelihood_ratio(smaller: str, larger: str, table: pd.DataFrame) -> dict[str, float]:
    """Does the larger of two nested models fit better than chance would let it (Wilks 1938)?

    `table` is what `compare` returned. Gives ``statistic``, ``degrees`` of freedom and ``p_value``,
    the probability of such a gain if the smaller model is true.
    """
    for name in (smaller, larger):
        if name not in table.index:
            raise ModelError(f"likelihood ratio: no model '{name}' was compared; there are {', '.join(table.index)}")
    degrees = int(table["parameters"][larger] - table["parameters"][smaller])
    if degrees < 1:
        raise ModelError(
            f"likelihood ratio: '{larger}' has {table['parameters'][larger]} free parameters and '{smaller}' "
            f"{table['parameters'][smaller]}: the first must be the smaller model, nested in the second"
        )
    statistic = max(0.0, 2 * float(table["log_likelihood"][larger] - table["log_likelihood"][smaller]))
    return {"statistic": statistic, "degrees": degrees, "p_value": float(scipy.special.chdtrc(degrees, statistic))}


def independent_samples(error: np.ndarray) -> np.ndarray:
    """(m,) how many independent samples a coloured error (N, m) is worth for its variance.

    N / (1 + 2 sum rho_k^2) over the lags up to a quarter of the samples whose autocorrelation
    rho_k stands out of its own noise, which is 1 / sqrt(independent samples) (Bartlett 1946).
    """
    n = len(error)
    spectrum = np.abs(np.fft.rfft(error, 2 * n, axis=0)) ** 2
    covariance = np.fft.irfft(spectrum, axis=0)[: n // 4]
    rho = covariance[1:] / covariance[0]
    count = np.full(error.shape[1], float(n))
    for _ in range(5):
        count = n / (1 + 2 * np.sum(np.where(np.abs(rho) > 2 / np.sqrt(count), rho**2, 0.0), axis=0))
    return count


def _errors(name: str, s: Solution) -> np.ndarray:
    """(samples, m) output errors of all recordings."""
    if not s.solved:
        raise ModelError(f"compare: '{name}' was not solved: {s.message}")
    if s.problem.episodes.count > 1:
        raise ModelError(
            f"compare: '{name}' has {s.problem.episodes.count} episodes, which repeat the same data; "
            "compare fits of one episode"
        )
    errors = np.concatenate([y - d for y, d in outputs_and_targets(s.transcription, s.result.z)])
    complete: np.ndarray = np.isfinite(errors).all(axis=1)
    return np.asarray(errors[complete])


def _words(aic: float, best: bool) -> str:
    """What a distance in AIC says (Burnham & Anderson 2002, section 2.6)."""
    return "best" if best else "cannot be told apart" if aic < ALIKE else "weaker" if aic < REFUTED else "refuted"


def _refuse_other_data(solutions: Mapping[str, Solution]) -> None:
    def data(s: Solution) -> list[tuple[str, int, int, bytes]]:
        return [(m.name, m.first, m.last, np.asarray(m.targets).tobytes()) for m in s.transcription.measured]

    names = list(solutions)
    for other in names[1:]:
        if data(solutions[other]) != data(solutions[names[0]]):
            raise ModelError(
                f"compare: '{other}' and '{names[0]}' were fitted to different recordings, windows or outputs, "
                "so that their likelihoods cannot be compared"
            )
