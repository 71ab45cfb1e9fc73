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
FIRST_ITERATIONS = 6
CONVERGED_FULLY = 8
"""So many suspects, the best after the first iterations, are fitted to convergence from two starts."""


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
        starts = [s for s in pool.map(lambda s: _starts(fit, data, screen, s), suspects) if s]
        starts.sort(key=lambda s: -s[0].forecast)
        chosen = [s for i, s in enumerate(starts) if s[0].forecast > WORTH_REFITTING or i < ALWAYS_REFITTED]
        progress(f"{len(chosen)} of {len(starts)} suspects are worth a full fit")
        first = [c for c in pool.map(lambda s: _begin(fit, data, s), chosen) if c is not None]
        first.sort(key=lambda c: -c.score)
        others = {s[0].suspect: s[1:3] for s in chosen}
        found = list(pool.map(lambda c: _converge(fit, data, c, others[c.suspect]), first[:CONVERGED_FULLY]))
    return sorted(found + first[CONVERGED_FULLY:], key=lambda c: -c.score)


def _starts(fit: Fit, data: Data, screen: Screen, suspect: Suspect) -> list[Start]:
    """Start values of one suspect, best forecast first; none where it cannot be simulated."""
    model = fit.model.with_term(suspect.term)
    if suspect.scanned is not None:
        found = screen.scan(suspect, model)
        return [Start(g, suspect, v) for g, v in found[:1] + [f for f in found[1:] if f[0] > 0.7 * found[0][0]][:2]]
    fitter, found = Fitter(model, data), []
    for values in suspect.starts():
        gain = forecast(fitter, fit, suspect, values) if suspect.strength is not None else None
        if gain is not None:
            found.append(Start(gain, suspect, values))
    found.sort(key=lambda s: -s.forecast)
    # A law that cannot be switched off, or is not seen at zero, begins where it disturbs least.
    finite = sorted(((_here(fitter, fit, suspect, v), v) for v in suspect.starts(off=False)), key=lambda s: -s[0])
    finite = [v for here, v in finite if np.isfinite(here)]
    if found:
        return found[:1] + [Start(found[0].forecast, suspect, v) for v in finite[:2] if v != found[0].values]
    tried = [_refit(fit, data, Start(0.0, suspect, v), 4) for v in finite[:1]]
    forecasts = [c.gain for c in tried if c is not None]
    return [Start(forecasts[0] if forecasts else 0.0, suspect, v) for v in finite[:2]]


def _point(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]):
    p = np.array([(fit.values | suspect.named(values))[k] for k in fitter.sim.parameters])
    return p, extended(fit.initial, fitter.sim), padded(fit.gain, fitter.sim)


def _here(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]) -> float:
    return fitter.evaluate(*_point(fitter, fit, suspect, values))


def forecast(fitter: Fitter, fit: Fit, suspect: Suspect, values: dict[str, float]) -> float | None:
    """Gain after one exact Gauss-Newton step from these values, or None if the run diverges."""
    p, x0, gain = _point(fitter, fit, suspect, values)
    here, system = fitter.evaluate(p, x0, gain), fitter.normal(p, x0, gain, fit.process, False)
    if system is None or not np.isfinite(here):
        return None
    H, g, _ = system
    d = np.sqrt(np.maximum(np.diag(H), 1e-300))
    step = np.linalg.lstsq(H / np.outer(d, d) + 1e-9 * np.eye(len(g)), g / d, rcond=1e-12)[0]
    return float(here - fit.loglik2 + step @ (g / d))


def _refit(fit: Fit, data: Data, start: Start, iterations: int = 40) -> Candidate | None:
    suspect = start.suspect
    fitter = Fitter(fit.model.with_term(suspect.term), data)
    try:
        new = fitter.fit(fit.values | suspect.named(start.values), extended(fit.initial, fitter.sim), fit.process, iterations)
    except SymidError:
        return None
    gain = new.loglik2 - fit.loglik2
    return Candidate(suspect, new, gain, gain - price(suspect, data), start.forecast)


def _begin(fit: Fit, data: Data, starts: list[Start]) -> Candidate | None:
    """A few iterations from the best start, and from the others where it does not keep its promise."""
    best = None
    for start in starts:
        new = _refit(fit, data, start, FIRST_ITERATIONS)
        if new is not None and (best is None or new.gain > best.gain):
            best = new
        if best is not None and best.gain > 0.5 * start.forecast:
            break
    return best


def _converge(fit: Fit, data: Data, first: Candidate, others: list[Start]) -> Candidate:
    """The candidate fitted to convergence, or what another start leads to if that is better."""
    begun = first.fit
    new = Fitter(begun.model, data).fit(begun.values, begun.initial, begun.process)
    gain = new.loglik2 - fit.loglik2
    found = [Candidate(first.suspect, new, gain, gain - price(first.suspect, data), first.forecast)]
    found += [c for c in (_refit(fit, data, s) for s in others) if c is not None]
    return max(found, key=lambda c: c.gain)
