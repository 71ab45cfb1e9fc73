"""A damped step is that of the whole normal matrix, however many segments have initial states of their own."""

import numpy as np
import pytest

from symid.estimation.fitting.gauss_newton.step import damped_step


def normal(rng, shared, segments, states, unseen=0):
    """Normal equations of random slopes; the first `unseen` states of each segment move nothing."""
    size = shared + segments * states
    H, g = np.zeros((size, size)), np.zeros(size)
    for i in range(segments):
        J = rng.normal(size=(30, shared + states)) * 10.0 ** rng.uniform(-6, 6, shared + states)
        J[:, shared : shared + unseen] = 0.0
        where = np.r_[0:shared, shared + i * states : shared + (i + 1) * states]
        H[np.ix_(where, where)] += J.T @ J
        g[where] += J.T @ rng.normal(size=30)
    return H, g


@pytest.mark.parametrize("shared, segments, states, unseen", [(3, 5, 2, 0), (0, 4, 3, 0), (2, 1, 4, 0), (4, 6, 2, 1)])
@pytest.mark.parametrize("damping", [0.0, 1e-3])
def test_a_step_is_that_of_the_whole_matrix(shared, segments, states, unseen, damping):
    H, g = normal(np.random.default_rng(segments), shared, segments, states, unseen)
    step = damped_step(
        (H, g, shared), damping, np.full((shared, 2), [-np.inf, np.inf]), np.zeros(shared), (segments, states)
    )
    d = np.where(np.diag(H) > 0, np.diag(H), 1.0)
    scale = np.sqrt(d)
    whole = np.linalg.pinv(H / np.outer(scale, scale) + damping * np.eye(len(g)), rcond=1e-13) @ (g / scale) / scale
    assert step * scale == pytest.approx(whole * scale, rel=1e-7, abs=1e-9)
