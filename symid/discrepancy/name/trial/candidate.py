"""One suspect fitted on top of a model: begun from its starts, continued, and brought to convergence."""

from __future__ import annotations

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis, extended, is_met
from symid.discrepancy.name.trial.scan import moment_profile
from symid.discrepancy.name.trial.short_pieces import ShortPieces
from symid.discrepancy.name.trial.starts import Start
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data

FIRST_ITERATIONS, CONVERGING_ITERATIONS = 6, 20
KEPT = 0.5
"""A fit that explains less than this part of its forecast may have gone astray: the next start is tried."""
MOMENTS = 0.3
"""Spacing [s] at the pace of a second of the moments at which a lasting change is tried."""


def refit_from(fit: Fit, data: Data, start: Start, iterations: int = 40) -> Hypothesis | None:
    """The suspect fitted from a start on top of `fit`; not exact (see `Fitter.fit`), and without standard errors.

    In the first few iterations the cutoff of a filter keeps its value: from a finite delay it went astray, and took the
    delay along.
    """
    suspect, model = start.suspect, fit.model.with_term(start.suspect.term)
    fitter = Fitter(model, data, near=fit, tune="all" if iterations > FIRST_ITERATIONS else "noise")
    try:
        new = (
            fit_model(model, data, suspect.named(start.values), exact=False)
            if start.afresh
            else fitter.fit(
                fit.values | suspect.named(start.values),
                extended(fit.initial, fitter.sim),
                fit.process,
                iterations,
                errors=False,
                exact=False,
            )
        )
    except SymidError:
        return None
    return Hypothesis((suspect,), new, fit, data, start.forecast)


def _begun(fit: Fit, data: Data, start: Start) -> Hypothesis | None:
    """A few iterations from there, made once: convergence is sought from the same starts."""
    if not start.begun:
        start.begun.append(refit_from(fit, data, start, FIRST_ITERATIONS))
    return start.begun[0]


def begin(fit: Fit, data: Data, starts: list[Start]) -> Hypothesis | None:
    """A few iterations from the best start, and from the others where it does not keep its promise.

    A law of which a slope at zero sees little also begins at one finite size.
    """
    best, least = None, 2 if starts[0].suspect.bypasses else 1
    others = [s for s in starts[1:] if not s.afresh] or starts[1:]
    for tried, start in enumerate([*starts[:1], *others], 1):
        new = _begun(fit, data, start)
        if new is not None and (best is None or new.log_ratio > best.log_ratio):
            best = new
        if best is not None and best.log_ratio > KEPT * start.forecast and tried >= least:
            break
    return best


def converged_from(fit: Fit, data: Data, first: Hypothesis, others: list[Start], short: ShortPieces) -> Hypothesis:
    """The candidate fitted to convergence, or what another start leads to if that is better; not exact."""
    found = [continued(data, first) or first]
    for start in others:
        other = _begun(fit, data, start)
        if other is not None and other.log_ratio > found[0].log_ratio + 1.0:
            found.append(continued(data, other) or other)
    best = max(found, key=lambda c: c.log_ratio)
    values = _in_short_pieces(best, data, short)
    if values is not None:
        eased = short.fitted(best.suspect, values, best.forecast, [best.fit])
        best = eased if eased and eased.log_ratio > best.log_ratio else best
    moved = _profiled(best, data)
    again = refit_from(fit, data, moved) if moved is not None else None
    return again if again is not None and again.log_ratio > best.log_ratio else best


def _in_short_pieces(best: Hypothesis, data: Data, short: ShortPieces) -> dict[str, float] | None:
    """Where a fit in short pieces begins that may lead to more; None where none is asked for.

    A torque that comes back in each turn is looked for anew in such pieces: over a long one the model without it may
    be whole teeth beside what was recorded.
    """
    scanned = best.suspect.scanned
    if scanned is not None:
        return None if scanned.clock != "turn" or is_met(best.fit, data) else short.scanned(best.suspect)
    if best.fit.converged:
        return None
    return best.suspect.keyed(best.fit.values)


def continued(data: Data, begun: Hypothesis, exact: bool = False) -> Hypothesis | None:
    """The same candidate after more iterations, with standard errors; None where it diverges."""
    try:
        new = Fitter.of(begun.fit, data).again(begun.fit, CONVERGING_ITERATIONS, exact)
    except SymidError:
        return None
    return Hypothesis(begun.suspects, new, begun.base, data, begun.forecast)


def _profiled(best: Hypothesis, data: Data) -> Start | None:
    """A better moment for a lasting change: its likelihood has a peak for every swing of the motion."""
    q = best.suspect.scanned
    if q is None or q.clock != "moment" or best.log_ratio < POLICY.worth_refitting:
        return None
    fit, name = best.fit, best.suspect.term.parameter_name(q.key)
    moments, values = moment_profile(fit, data, name, data.span, MOMENTS * data.pace)
    value, moment = values.max(), float(moments[np.argmax(values)])
    return (
        Start(best.forecast, best.suspect, best.suspect.keyed(fit.values) | {q.key: moment})
        if value > fit.loglik2 + 0.1
        else None
    )
