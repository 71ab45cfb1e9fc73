"""A delay of an input by part of a sample, where the input is held from each sample to the next instead.

What a computer puts out stays until its next turn, so it comes half a sample later than the straight lines through its
samples (Astrom & Wittenmark 1997, section 2.3). Nothing was left out of such a model.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.discrepancy.model.suspects import Suspect
from symid.errors import SymidError
from symid.estimation.fitting.fit import Fitter
from symid.estimation.signals.data import Data

DELAY = "input_delay"
"""The law that may be none."""


def held(
    found: Hypothesis, data: Data, unstated: Sequence[str], better: Callable[[Hypothesis, Hypothesis], Hypothesis]
) -> Hypothesis:
    """`found`, or the same without delays by part of a sample, with those inputs held, where that is believed more.

    Longer delays stay as they are: a held input that is late answers to no small change of its delay.

    Parameters
    ----------
    unstated : inputs of which nobody said what they do between their samples. better : the one of two that is believed
        more.
    """
    step = data.segments[0].step / data.segments[0].ratio
    late = [s for s in found.suspects if s.term.name == DELAY and 0 < _delay(found, s) < step]
    inputs = [u.name for s in late for u in found.base.model.find("excitation", s.term.location)]
    names = [k for k in inputs if k in unstated and found.base.model.inputs[k].hold != "zero"]
    if not names:
        return found
    rest = tuple(s for s in found.suspects if s not in late)
    model = found.base.model.with_holds(**dict.fromkeys(names, "zero"))
    try:
        base = Fitter(model, data, near=found.base).again(found.base)
    except SymidError:
        return found  # what cannot be followed is not likelier
    fit = refit(rest, found.fit, base, data) if rest else base
    # Both against one base: how much likelier a held input is by itself must count.
    return found if fit is None else better(found, Hypothesis(rest, fit, found.base, data))


def _delay(found: Hypothesis, suspect: Suspect) -> float:
    return found.fit.values[suspect.term.parameter_name(suspect.law.parameters[0].key)]
