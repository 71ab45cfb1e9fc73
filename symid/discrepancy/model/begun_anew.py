"""A way out of the wrong optimum that a fit reaches from a model that lacks what matters."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace

from symid.discrepancy.model.hypothesis import Hypothesis, is_met, polished, refit
from symid.discrepancy.policy import POLICY
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.fit import Fit
from symid.model import Model

Regression = Callable[[Model], dict[str, float]]
"""Values [SI] of a model's parameters, and of states where segments begin, with which the recorded motion satisfies its
equations best; empty where nobody knows. SymidError where there are none."""
BETTER = 1.0
"""Of twice the log-likelihood: less is where the same fit ends twice."""


def nowhere(model: Model) -> dict[str, float]:
    """The `Regression` of a motion of which nobody knows the equations' values."""
    return {}


def begun_anew(found: Hypothesis, regression: Regression) -> Hypothesis:
    """What was found, fitted as if nothing were known but what regression knows, where that explains more.

    Only of a free motion that is not met: without what it lacks a model ends at values that are wrong for it, beside
    which the likelihood of a long motion has other optima. An arm on a spring, with a pendulum at its end, stayed in
    one (tests/discrepancy/search/test_begun_anew.py); a drive whose load a spring holds stayed in one from the middle
    of its bounds, too, where regression knew its optimum within a percent
    (tests/discrepancy/machines/test_far_from_the_model.py).
    """
    if found.fit.kalman_gain is not None or not found.suspects or is_met(found.fit, found.data, POLICY.sensors):
        return found
    start: dict[str, float] = {}
    with suppress(SymidError):
        start = regression(found.fit.model)
    try:
        fit = fit_model(found.fit.model, found.data, start, exact=False)
        return polished(replace(found, fit=fit)) if fit.loglik2 > found.fit.loglik2 + BETTER else found
    except SymidError:
        return found


def given_anew(found: Hypothesis) -> Fit | None:
    """The model without what was found, from where that ended; None unless it explains more there than it did.

    A suspect of no size, fitted from nothing, may lead a free motion out of the wrong optimum of the model as given:
    what it then explains more is none of its doing. A late input of 0.26 +- 0.19 ms was found so.
    """
    if found.fit.kalman_gain is not None or not found.suspects:
        return None
    fit = refit((), found.fit, found.base, found.data)
    return fit if fit is not None and fit.loglik2 > found.base.loglik2 + POLICY.accept else None
