"""Try suspects on top of a fitted model: forecast all, refit the promising ones completely."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import log

import numpy as np

from symid.discrepancy.data import Data
from symid.discrepancy.fit import Fit, Fitter
from symid.discrepancy.screen import Screen, extended, padded
from symid.discrepancy.suspects import Suspect
from symid.errors import SymidError
from symid.simulation import simulator

WORTH_REFITTING = 8.0
"""A suspect with a smaller forecast gain than this is refitted only if it is among the best few."""
ALWAYS_REFITTED = 6


@dataclass(frozen=True, eq=False)
class Candidate:
    """One suspect added to a model and refitted with all of the model's own unknowns.

    Attributes
    ----------
    gain : growth of twice the log-likelihood over the model without the suspect.
    score : gain less the price of its parameters (BIC; Schwarz 1978).
    """

    suspect: Suspect
    fit: Fit
    gain: float
    score: float
    forecast: float

    def __str__(self) -> str:
        return f"{self.suspect.term} gain {self.gain:.1f} score {self.score:.1f} (forecast {self.forecast:.1f})"


@dataclass(frozen=True, eq=False)
class Start:
    forecast: float
    suspect: Suspect
    values: dict[str, float]


def price(suspect: Suspect, data: Data) -> float:
    """What the parameters of a suspect cost: log N each, twice for one that was scanned for."""
    return log(data.samples) * (suspect.size + (suspect.scanned is not None))


def explore(fit: Fit, data: Data, suspects: Sequence[Suspect], *, threads: int = 2,
            progress: Callable[[str], None] = lambda text: None) -> list[Candidate]:
    """All suspects on top of `fit`, best score first."""
    screen = Screen(fit, data)
    with ThreadPoolExecutor(threads) as pool:
        starts = list(pool.map(lambda s: _starts(fit, data, screen, s), suspects))
        starts = sorted((s for s in starts if s), key=lambda s: -s[0].forecast)
        chosen = [s for i, s in enumerate(starts) if s[0].forecast > WORTH_REFITTING or i < ALWAYS_REFITTED]
        progress(f"{len(chosen)} of {len(starts)} suspects are worth a full fit")
        found = list(pool.map(lambda s: _refit(fit, data, s), chosen))
    return sorted((c for c in found if c is not None), key=lambda c: -c.score)


def _starts(fit: Fit, data: Data, screen: Screen, suspect: Suspect) -> list[Start]:
    """Start values of one suspect, best forecast first; none where it cannot be simulated."""
    try:
        model = fit.model.with_term(suspect.term)
        if suspect.scanned is not None:
            return [Start(g, suspect, v) for g, v in screen.scan(suspect, model)[:1]]
        fitter = Fitter(model, data)
        found = []
        for values in suspect.starts():
            try:
                gain = forecast(fitter, fit, suspect, values)
            except SymidError:
                continue
            if gain is not None:
                found.append(Start(gain, suspect, values))
        return sorted(found, key=lambda s: -s.forecast)
    except SymidError:
        return []


def forecast(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]) -> float | None:
    """Gain after one exact Gauss-Newton step from these values, or None if the run diverges."""
    p = np.array([(fit.values | suspect.named(values))[k] for k in fitter.sim.parameters])
    x0 = extended(fit.initial, fitter.sim)
    gain = padded(fit.gain, fitter.sim)
    here = fitter.evaluate(p, x0, gain)
    system = fitter._normal(p, x0, gain, fit.process, False)
    if system is None or not np.isfinite(here):
        return None
    H, g, _ = system
    d = np.sqrt(np.maximum(np.diag(H), 1e-300))
    step = np.linalg.lstsq(H / np.outer(d, d) + 1e-9 * np.eye(len(g)), g / d, rcond=1e-12)[0]
    return float(here - fit.loglik2 + step @ (g / d))


def _refit(fit: Fit, data: Data, starts: list[Start]) -> Candidate | None:
    suspect = starts[0].suspect
    model = fit.model.with_term(suspect.term)
    fitter, best = Fitter(model, data), None
    for start in starts[:2]:
        try:
            new = fitter.fit(fit.values | suspect.named(start.values), extended(fit.initial, simulator(model)), fit.process)
        except SymidError:
            continue
        if best is None or new.loglik2 > best.loglik2:
            best = new
    if best is None:
        return None
    gain = best.loglik2 - fit.loglik2
    return Candidate(suspect, best, gain, gain - price(suspect, data), starts[0].forecast)
