"""How far values hang on what inputs do between their samples, where neither a user nor the recording says it.

An input that is held comes half a sample later than straight lines through its samples. Where the recording hardly
tells, as of a slow input, delays and losses that were found hang on it, and the standard errors that the fit alone
gives take for known what is not: the difference of the two answers is added to them, as independent errors are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.held import STRONG, delays_of, later, promise
from symid.errors import SymidError
from symid.estimation.between_samples import with_likeliest_holds
from symid.estimation.fitting.fitter import Fitter


def otherwise(found: Hypothesis, unstated: Sequence[str]) -> Hypothesis | None:
    """`found` with inputs held that are not, or else free that are; None where the recording tells, or nothing hangs
    on it: no value of an effect moves by more than its standard error.

    unstated : inputs of which nobody said what they do between their samples.
    """
    fit, data = found.fit, found.data
    if not (found.suspects and unstated):
        return None
    free = [k for k in unstated if fit.model.inputs[k].hold == "zero"]
    names, hold = (free, "either") if free else (list(unstated), "zero")
    half = (0.5 if free else -0.5) * data.segments[0].input_step
    begin = later(fit, delays_of(found.suspects, fit.model, names), half)
    model = fit.model.with_holds(**dict.fromkeys(names, hold))
    if promise(begin, (), model, data) < fit.loglik2 - STRONG:
        return None
    try:
        other = with_likeliest_holds(Fitter(model, data, near=begin).again(begin), data)
    except SymidError:
        return None  # what cannot be followed is not as likely
    own = [s.term.parameter_name(q.key) for s in found.suspects for q in s.law.parameters]
    moves = any(abs(other.values[k] - fit.values[k]) > fit.errors[k] for k in own if k in fit.errors)
    return replace(found, fit=other) if moves and other.loglik2 >= fit.loglik2 - STRONG else None


def widened(found: Hypothesis, other: Hypothesis) -> Hypothesis:
    """`found` with standard errors that reach as far as the values of the `other`."""
    values = other.fit.values
    errors = {k: float(np.hypot(e, values[k] - found.fit.values[k])) for k, e in found.fit.errors.items()}
    return replace(found, fit=replace(found.fit, errors=errors))
