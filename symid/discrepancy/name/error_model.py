"""Which error model belongs to a recording: what was filtered, and how long the noise remembers.

What is missing in a model colours its innovations, too. So the search for what is missing comes first, with
white innovations; only colour that outlasts the best explanation is taken for the sensors', and the search
begins anew with noise that remembers as much.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.search import Search
from symid.estimation.data import Data
from symid.estimation.fit import Fit, Fitter
from symid.estimation.whitening import remembered


def with_error_model(possible: list[tuple[Data, Fit]], searched: Callable[[Fit, Data], Search],
                     progress: Callable[[str], None]) -> tuple[Search, Hypothesis, list[Hypothesis]]:
    """The search under the error model that belongs to the recording, what it found, and each suspect alone.

    Parameters
    ----------
    possible : what may have been measured, and the fit of the model as given to it.
    searched : makes a search.
    """
    searches = [searched(base, data) for data, base in possible]
    search, found, ranking = max(((s, *s.run()) for s in searches), key=lambda done: done[1].fit.loglik2)
    fit = found.fit
    memory = remembered(fit.innovations) if fit.kalman_gain is not None else 0
    if memory == 0:
        return search, found, ranking
    progress(f"the noise remembers {memory} samples; looking again")
    sharpness = float(fit.process[-1]) if search.data.cutoff_free else 1.0
    data = search.data.sharpened(sharpness).remembering(memory)
    search = searched(_refitted(search.base, fit, data), data)
    return search, *search.run()


def _refitted(base: Fit, explained: Fit, data: Data) -> Fit:
    """The model as given under another error model, from its own values or from those that go with what was found."""
    fitter = Fitter(base.model, data)
    kept = [explained.simulator.states.index(s) for s in fitter.sim.states]
    near = replace(base, values={k: explained.values[k] for k in base.values}, initial=explained.initial[:, kept],
                   process=explained.process, kalman_gain=None)
    return max((fitter.again(start) for start in _usable(fitter, (base, near))), key=lambda fit: fit.loglik2)


def _usable(fitter: Fitter, starts) -> list[Fit]:
    """Those from which the model can be simulated; the first one can."""
    return [s for i, s in enumerate(starts) if i == 0 or np.isfinite(fitter.evaluate(
        np.array([s.values[k] for k in fitter.sim.parameters]), s.initial, None))]
