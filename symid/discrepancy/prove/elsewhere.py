"""What only the held-out data show: a stop that larger motion reaches, a machine that has changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import log_ndtr

from symid.discrepancy.locate.remainder import Test, located, remainder
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.trial.jump import with_fitted_jumps
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.sensitive import MOST_GROWTH, largest_growth
from symid.estimation.free_run import with_states_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.pieces import cut
from symid.estimation.signals.segment import FEWEST

ITERATIONS = 40
"""Of the fit to the held-out data, as of any complete refit."""


def elsewhere(found: Hypothesis, jumps: Sequence[str], held_out: Data) -> Test | None:
    """What a model that explains the fitted data does not explain in the held-out ones; None where it explains both.

    Asked of free motion whose error is much larger there: the model is refitted to the held-out data alone. Either it
    leaves something systematic there, too, or it needs values that those of the fitted data exclude. Dry friction may
    set in less abruptly than fast motion shows.

    Parameters
    ----------
    jumps : constants of the model that say how abruptly, and that nobody stated.
    """
    fit = found.fit
    begin, held_out = _begun(fit, held_out) if fit.kalman_gain is None else (None, held_out)
    if begin is None or np.all(begin.rms_errors < POLICY.sensors * np.maximum(fit.rms_errors, held_out.sensor_noise)):
        return None
    try:
        own = Fitter.of(fit, held_out).fit(fit.values, begin.initial, fit.process, ITERATIONS)
    except SymidError:
        return None
    if left := _left(own, held_out):
        # It begins at the fitted values: those of `own` went with an abruptness that may be wrong, and lead astray.
        slower = replace(found, fit=begin, data=held_out)
        other = with_fitted_jumps(slower, jumps, found.base.model, moves=found.data).fit
        own, left = (other, _left(other, held_out)) if other.loglik2 > own.loglik2 else (own, left)
    if left:
        return located(left)
    changed = _changed(fit, own)
    return Test("", f"other values of {', '.join(changed)}", 0.0, 1) if changed else None


def _left(fit: Fit, data: Data) -> list[Test]:
    """The tests for something systematic that is left; none where nothing is."""
    left = remainder(fit, data)
    return left if left and left[0].minus_log10_p > POLICY.remainder else []


def _begun(fit: Fit, held_out: Data) -> tuple[Fit | None, Data]:
    """The fit with states that the held-out data ask for, in pieces through which their motion can be followed.

    Where a pendulum is pushed over the top a small difference of its parameters soon is a large one of its motion.
    """
    begin = with_states_of(fit, held_out)
    length = max(e.time[-1] - e.time[0] for e in held_out.segments) / 2
    shortest = FEWEST * held_out.segments[0].step
    while begin is not None and length > shortest and largest_growth(begin, held_out) > MOST_GROWTH:
        held_out = held_out.with_segments(part for e in held_out.segments for part in cut(e, length))
        begin, length = with_states_of(fit, held_out), length / 2
    return begin, held_out


def _changed(fit: Fit, other: Fit) -> list[str]:
    """Parameters of which two fits exclude each other's values, where chance does not make the largest difference.

    Of five parameters of a flexible joint, with noise that remembers, one differed by 3.6 standard errors.
    """
    known = {k: np.hypot(error, other.errors.get(k, np.inf)) for k, error in fit.errors.items() if error > 0}
    away = {k: float(abs(fit.values[k] - other.values[k]) / error) for k, error in known.items()}
    if not away:
        return []
    minus_log10_p = -(np.log(2 * len(away)) + log_ndtr(-max(away.values()))) / np.log(10)  # Bonferroni
    return [k for k, times in away.items() if times > POLICY.apart] if minus_log10_p > POLICY.remainder else []
