"""The filter that a recording went through is told from its spectra: recordings that were filtered in a known way.

The study that set the window of `estimation/sensors/spectrum.py`: spectra of differences told order and rate of
42 filters of 42, Blackman-Harris windows of what was recorded 37, Kaiser windows (beta 14 and 20) 39 and 42 with
worse cutoffs.
"""

import os

import draws
import pytest

from symid.estimation.sensors.cutoff import estimated_filter
from symid.estimation.signals.swings import pace_of
from symid.estimation.signals.windows import segments_of

pytestmark = pytest.mark.slow

FILTERED = [
    *(("null", seed) for seed in range(1, 64, 8)),
    *(("machine", seed) for seed in range(80) if draws.MACHINES_SPOILT[seed // 5 % 4] == "filtered"),
    *(("person", seed) for seed in range(0, 40, 3)),
]
NEAR = 2.5
"""A cutoff is told within this factor, which the fit of the model can make up for: it moves by 1.4 in each of three
rounds (`estimation.measurement.MOST_ROUNDS`)."""


@pytest.mark.parametrize(("draw", "seed"), FILTERED)
def test_order_and_rate_of_a_known_filter_are_told(draw, seed):
    if draw == "person" and "SYMID_STANDING" not in os.environ:
        pytest.skip("needs the recording of a standing person: SYMID_STANDING")
    exam = draws.DRAWS[draw](seed)
    case, (order, cutoff, rate) = exam.case, exam.facts["filter"]
    pieces = segments_of(case.model, case.recording, case.fit_window, None)
    longest = max(pieces, key=lambda e: len(e.time))
    inputs = [longest.inputs[u] for u in case.model.inputs]
    found = estimated_filter(list(longest.recorded.T), inputs, longest.step, pace_of(pieces), True)
    assert (found.order, round(found.rate)) == (order, round(rate)), found
    assert cutoff / NEAR < found.cutoff < NEAR * cutoff
