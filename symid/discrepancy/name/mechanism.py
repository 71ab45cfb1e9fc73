"""What a real mechanism loses and bears: several laws at once, none of them exact.

A recording of one mechanism has a dozen small causes. Errors far above the sensors' noise make every
law look significant, so a law is asked for a share of the error instead, and laws that follow a clock
come last: a motion that nothing drives explains itself by its own state if it can.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from symid.discrepancy.model.hypothesis import Candidate, extended
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.search import LIGHT, explore
from symid.errors import SymidError
from symid.estimation.data import Data
from symid.estimation.fit import Fit, Fitter

SHARE = 0.02
"""A law must lower the error by this part, where that is far above the noise of the sensors."""
LEAST = 25.0
"""And in any case gain this much of twice the log-likelihood beyond its penalty."""
UNESTABLISHED = 0.1
"""A law without an established name is preferred only if it lowers the error by this part more."""
MOST = 6
RIVALS = 4
NEAR = 2.0
"""Errors within this many times the sensors' noise are judged by likelihood alone."""


def explain_mechanism(base: Fit, data: Data, pool: Sequence[Suspect], threads: int,
                      progress: Callable[[str], None]) -> tuple[tuple[Suspect, ...], Fit, float, list[Candidate]]:
    """The laws that are needed together, the fit with them, their score, and all single laws by score."""
    timeless, clocks = [s for s in pool if s.scanned is None], [s for s in pool if s.scanned is not None]
    single = explore(base, data, timeless, threads=threads, progress=progress)
    chosen, fit = [], base
    first = _chosen(single, base, data)
    if first is not None:
        chosen, fit = [first.suspect], first.fit
        chosen, fit = _grown(chosen, fit, single, base, data, timeless, threads, progress)
    if clocks:
        progress("looking for forces that follow a clock")
        chosen, fit = _grown(chosen, fit, single, base, data, clocks, threads, progress)
    return tuple(chosen), fit, fit.loglik2 - base.loglik2, single


def _grown(chosen: list[Suspect], fit: Fit, single: list[Candidate], base: Fit, data: Data, pool, threads, progress):
    """One law after the other from `pool`, until none is worth it; earlier ones are put to the test again."""
    while len(chosen) < MOST:
        others = [s for s in pool if s.term not in {t.term for t in chosen}]
        found = explore(fit, data, others, effort=LIGHT, threads=threads, progress=progress)
        more = _chosen(found, fit, data)
        if more is None:
            break
        before = fit
        chosen, fit = _pruned([*chosen, more.suspect], more.fit, base, data)
        chosen, fit = _exchanged(chosen, fit, single, base, data)
        progress(f"found {', '.join(str(s.term) for s in chosen)}")
        if fit.loglik2 < before.loglik2 + LEAST:
            break
    return chosen, fit


def _chosen(found: list[Candidate], before: Fit, data: Data) -> Candidate | None:
    """The established law that gains most, or a hypothesis that is clearly better; None where none is worth it."""
    worth = [c for c in found if c.score > LEAST and c.log_ratio > asked(before, data)]
    named = max((c for c in worth if c.suspect.established), key=lambda c: c.log_ratio, default=None)
    unestablished = max((c for c in worth if not c.suspect.established), key=lambda c: c.log_ratio, default=None)
    if named is None or unestablished is not None and unestablished.log_ratio > named.log_ratio + _ratio_of(UNESTABLISHED, data):
        return unestablished
    return named


def asked(fit: Fit, data: Data) -> float:
    """Gain of twice the log-likelihood that another law must bring on top of `fit`."""
    rms = np.sqrt(np.mean(np.vstack(fit.innovations) ** 2, axis=0))
    return 0.0 if np.all(rms < NEAR * data.sensor_noise) else _ratio_of(SHARE, data)


def _ratio_of(share: float, data: Data) -> float:
    """Gain of twice the log-likelihood where the error of every output falls by this part."""
    return -2 * np.log1p(-share) * data.weight * data.samples * len(data.sensor_noise)


def _pruned(chosen: list[Suspect], fit: Fit, base: Fit, data: Data) -> tuple[list[Suspect], Fit]:
    """Without the earlier laws that the newest has made needless."""
    for s in chosen[:-1]:
        less = fitted([t for t in chosen if t is not s], fit, base, data)
        if less is not None and fit.loglik2 - less.loglik2 < max(LEAST, asked(fit, data)):
            chosen, fit = [t for t in chosen if t is not s], less
    return chosen, fit


def _exchanged(chosen: list[Suspect], fit: Fit, single: list[Candidate], base: Fit, data: Data) -> tuple[list[Suspect], Fit]:
    """With a rival in the place of the first law where that is better: greedy choices mislead."""
    taken = {s.term for s in chosen}
    for c in [c for c in single if c.suspect.established and c.suspect.term not in taken][:RIVALS]:
        other = fitted([c.suspect, *chosen[1:]], fit, base, data, c.fit.values)
        if other is not None and other.loglik2 > fit.loglik2 + max(LEAST, 0.5 * asked(fit, data)):
            chosen, fit = [c.suspect, *chosen[1:]], other
    return chosen, fit


def fitted(chosen: Sequence[Suspect], near: Fit, base: Fit, data: Data, more: dict[str, float] | None = None) -> Fit | None:
    """The base model with these laws, from the values of a fit nearby (and `more`)."""
    model = base.model
    for s in chosen:
        model = model.with_term(s.term)
    fitter, values = Fitter(model, data), (more or {}) | near.values
    columns = {k: i for i, k in enumerate(near.simulator.states)}
    start = extended(base.initial, fitter.sim)
    for i, k in enumerate(fitter.sim.states):
        if k in columns:
            start[:, i] = near.initial[:, columns[k]]
    try:
        return fitter.fit({k: values[k] for k in fitter.sim.parameters}, start, near.process)
    except SymidError:
        return None
