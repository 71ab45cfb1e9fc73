"""Standard errors against the spread of repeated identifications: how often 95 % intervals hold the truth.

``python tests/test_coverage.py 400 [NAME ...]`` prints the table.
"""

import sys

import numpy as np
import pytest
from coverage_systems import SYSTEMS, WHITE

NORMAL = 1.96


def counted(name: str, seeds: range) -> dict:
    """Coverage by parameter, mean error over spread, share of coloured verdicts, and of variance per likelihood."""
    rows, coloured = [], 0
    for seed in seeds:
        problem, truth = SYSTEMS[name](seed)
        solution = problem.solve(
            start=truth | {n: 1.0 for n in problem.model.parameters if n not in truth}
        )  # no study of starts
        assert solution.solved, solution.message
        table = solution.parameters.loc[[n for n in solution.values if n in truth]]
        rows.append((table["value"] - [truth[n] for n in table.index], table["std_error"]))
        coloured += solution.errors.model == "coloured"
    error, std_error = np.array(rows).transpose(1, 0, 2)
    return {
        "names": list(table.index),
        "coverage": np.mean(np.abs(error) < NORMAL * std_error, axis=0),
        "ratio": np.median(std_error, axis=0) / error.std(axis=0),
        "bias": error.mean(axis=0) / error.std(axis=0),
        "coloured": coloured / len(rows),
    }


def line(name: str, found: dict) -> str:
    cells = "  ".join(
        f"{n} {100 * c:.1f} ({r:.2f})"
        for n, c, r in zip(found["names"], found["coverage"], found["ratio"], strict=True)
    )
    return f"{name:<30} mean {100 * found['coverage'].mean():.1f} %  coloured {100 * found['coloured']:.0f} %  {cells}"


@pytest.mark.parametrize("name", ["integrator", "algebraic, channels together"])
def test_intervals_hold_the_truth(name):
    found = counted(name, range(8))
    assert found["coverage"].mean() >= 0.6, line(name, found)  # 4 of 8 wrong at 95 % are four chances in ten thousand
    assert np.all((found["ratio"] > 0.4) & (found["ratio"] < 2.5)), line(name, found)


def test_truth_within_three_standard_errors_with_process_noise():
    problems = [SYSTEMS["standing, process noise"](seed) for seed in range(4)]
    tables = [(p.solve().parameters, truth) for p, truth in problems]
    far = [abs(t["value"][n] - truth[n]) / t["std_error"][n] for t, truth in tables for n in t.index]
    assert np.mean(np.array(far) < 3) >= 0.95


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_coverage_is_ninety_five_per_cent(name):
    found = counted(name, range(400))
    print(line(name, found))
    assert np.all((found["coverage"] >= 0.92) & (found["coverage"] <= 0.98)), line(name, found)
    if name in WHITE:
        assert np.all(np.abs(found["ratio"] - 1) < 0.08), line(name, found)  # the spread of 400 has an error of 3.5 %


if __name__ == "__main__":
    for system in sys.argv[2:] or SYSTEMS:
        print(line(system, counted(system, range(int(sys.argv[1])))), flush=True)
