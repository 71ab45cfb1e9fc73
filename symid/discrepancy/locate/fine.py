"""Do errors of prediction follow where a joint is, or how fast, more finely than splines of a few knots can?

What magnets or teeth do to a motor comes back several times in a turn. Under random forces each error is what acted
since the sample before, so that it is white, and is told by where it happened.
"""

from __future__ import annotations

import numpy as np

from symid.discrepancy.locate.chance import Chance
from symid.discrepancy.locate.projection import Projection
from symid.estimation.fitting.path import along, fitted_signals

BINS = 48
"""Parts of a signal with as many samples each: ten waves of a force in its range have five each."""
FEWEST = 20
"""Samples of a part, so that a few large errors are no mean."""
STEPS = 8
"""Of an encoder, that a part is wide: in one step its rounding errors follow the position."""


def followed(projection: Projection, chance: Chance) -> list[tuple[int, float, int, int]]:
    """Output, largest gain of twice the log-likelihood of its errors, coefficients, and how many signals were tried.

    The errors have a mean of their own in each part of the range of a joint's position or rate. Nothing where random
    forces do not act: errors of a free run follow from earlier ones.
    """
    data, model = projection.data, projection.fit.model
    if not data.driven:
        return []
    signals = fitted_signals(projection.fit, data)
    motions = {e for p in model.ports.values() if p.role == "joint" for e in (p.position, p.rate) if e != 0}
    courses = [along(signals, e, model) for e in sorted(motions, key=str)]
    rounding, found = np.broadcast_to(data.rounding, projection.outputs), []
    for output, step in enumerate(rounding):
        gains = [chance.scored(_means(projection, x, output, step)) for x in courses if np.ptp(x) > 0]
        if gains:
            gain, size = max(gains)
            found.append((output, gain, size, len(gains)))
    return found


def _means(projection: Projection, course: np.ndarray, output: int, step: float) -> np.ndarray:
    """(N m, parts) columns of which each is 1 for one output in one part of a signal's range."""
    count = min(BINS, len(course) // FEWEST)
    if step > 0:
        count = min(count, int(np.ptp(course) / (STEPS * step)))
    edges = np.quantile(course, np.linspace(0, 1, max(count, 1) + 1))[1:-1]
    part = np.searchsorted(edges, course, side="right")
    columns = np.zeros((len(course), projection.outputs, max(count, 1)))
    columns[np.arange(len(course)), output, part] = 1.0
    return columns.reshape(len(course) * projection.outputs, -1)
