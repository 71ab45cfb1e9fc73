"""Of what parameters change, an autoregression of the innovations takes up a part, and so does each initial state."""

import numpy as np
import pytest

from symid.estimation.fitting.gauss_newton.memory import Memory
from symid.estimation.sensors.whitening import past_of


@pytest.mark.parametrize("m", [1, 2])
@pytest.mark.parametrize("seen", [True, False], ids=["seen", "partly unseen"])
def test_information_is_that_of_all_unknowns_together(m, seen):
    """Against the Schur complement of one matrix with the coefficients and all initial states as unknowns, too."""
    rng, memory, shared, states, lengths = np.random.default_rng(3), 2, 3, 2, (25, 31, 28)
    lags = memory * m * m
    columns = shared + lags + states * len(lengths)
    H, found = np.zeros((columns, columns)), Memory(memory)
    for i, n in enumerate(lengths):
        errors, slopes = rng.standard_normal((n, m)), rng.standard_normal((n, m, shared))
        begins = rng.standard_normal((n, m, states))
        begins[:, :, 1] *= seen
        before = past_of(errors, memory)
        J = np.zeros((n, m, columns))
        J[:, :, :shared] = slopes
        for j, column in enumerate(before.T):
            for o in range(m):
                J[memory:, o, shared + j * m + o] = column
        J[:, :, shared + lags + i * states : shared + lags + (i + 1) * states] = begins
        H += np.tensordot(J, J, ((0, 1), (0, 1)))
        found.add(before, slopes, begins)
    rest = slice(shared, None)
    whole = H[:shared, :shared] - H[:shared, rest] @ np.linalg.pinv(H[rest, rest]) @ H[rest, :shared]
    own = slice(shared + lags, None)
    without = H[:shared, :shared] - H[:shared, own] @ np.linalg.pinv(H[own, own]) @ H[own, :shared]
    assert without - found.taken() == pytest.approx(whole, rel=1e-9)
    assert np.all(np.linalg.eigvalsh(whole) > 0)


def test_without_initial_states_of_their_own_nothing_else_takes_up():
    rng, found = np.random.default_rng(4), Memory(1)
    errors, slopes = rng.standard_normal((40, 1)), rng.standard_normal((40, 1, 2))
    before = past_of(errors, 1)
    found.add(before, slopes, np.zeros((40, 1, 0)))
    told = before.T @ slopes[1:, 0]
    assert found.taken() == pytest.approx(told.T @ told / (before.T @ before)[0, 0])
