"""Standard errors against the spread of repeated identifications of a known controller, from 60 s each."""

import numpy as np
import pytest

import symid as si
from symid.mechanics import FullStatePD
from symid.synthetic import BODY, GAINS, standing_recording


def repeated(seeds: range) -> tuple[np.ndarray, np.ndarray]:
    """(seeds, parameters) errors of the estimates and their standard errors."""
    model, pairs = BODY.with_feedback(FullStatePD()), []
    for seed in seeds:
        solution = si.Identification(model, standing_recording(model, GAINS, seed=seed, duration=60)).solve()
        assert solution.solved, solution.message
        table = solution.parameters
        pairs.append((table["value"] - [GAINS[name] for name in table.index], table["std_error"]))
    return tuple(np.array(pairs).transpose(1, 0, 2))


def test_truth_within_three_standard_errors():
    error, std_error = repeated(range(8))
    assert np.mean(np.abs(error) < 3 * std_error) >= 0.95, (error / std_error).round(1)


@pytest.mark.slow
def test_standard_errors_are_the_spread_over_forty_seeds():
    error, std_error = repeated(range(40))
    assert np.mean(np.abs(error) < 3 * std_error) >= 0.95, (error / std_error).round(1)
    ratio = error.std(axis=0) / np.sqrt(np.mean(std_error**2, axis=0))
    assert np.all((ratio > 0.7) & (ratio < 1.4)), ratio.round(2)
