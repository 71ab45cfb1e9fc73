"""A way out of the wrong optimum that a fit reaches from a model that lacks what matters."""

from __future__ import annotations

from dataclasses import replace

from symid.discrepancy.model.hypothesis import Hypothesis, is_met, polished
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model

BETTER = 1.0
"""Of twice the log-likelihood: less is where the same fit ends twice."""


def begun_anew(found: Hypothesis) -> Hypothesis:
    """What was found, fitted as if nothing were known, where that explains more.

    Only of a free motion that is not met: without what it lacks a model ends at values that are wrong for it, beside
    which the likelihood of a long motion has other optima. An arm on a spring, with a pendulum at its end, stayed in
    one (tests/discrepancy/test_begun_anew.py).
    """
    if found.fit.kalman_gain is not None or not found.suspects or is_met(found.fit, found.data):
        return found
    try:
        fit = fit_model(found.fit.model, found.data, exact=False)
    except SymidError:
        return found
    return polished(replace(found, fit=fit)) if fit.loglik2 > found.fit.loglik2 + BETTER else found
