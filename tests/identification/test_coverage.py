"""Standard errors against the spread of repeated identifications: how often 95 % intervals hold the truth.

``PYTHONPATH=tests python tests/identification/test_coverage.py 0:400 ROWS.jsonl [NAME ...]`` does the repeats of these
seeds that the file does not hold yet, appends them, and prints for each system its coverage and, for each parameter,
the standard error over what it should be, over the spread of the estimates, and the mean error over that spread.
"""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from coverage_systems import SYSTEMS, WHITE, expected_errors

NORMAL = 1.96


def repeat(name: str, seed: int) -> dict:
    """One identification: error and standard error of each parameter, what the latter should be, the error model."""
    problem, truth = SYSTEMS[name](seed)
    solution = problem.solve(check=False)
    assert solution.solved, solution.message
    table = solution.parameters.loc[[n for n in solution.values if n in truth]]
    expected = expected_errors(solution, WHITE[name]) if name in WHITE else {}
    return {
        "name": name,
        "seed": seed,
        "parameters": list(table.index),
        "error": list(table["value"] - [truth[n] for n in table.index]),
        "std_error": list(table["std_error"]),
        "expected": [expected.get(n, np.nan) for n in table.index],
        "coloured": solution.errors.model == "coloured",
    }


def counted(rows: list[dict]) -> dict:
    """By parameter coverage, median standard error over its expectation and over the spread; coloured verdicts."""
    error, std_error, expected = (np.array([r[k] for r in rows]) for k in ("error", "std_error", "expected"))
    return {
        "count": len(rows),
        "names": rows[0]["parameters"],
        "coverage": np.mean(np.abs(error) < NORMAL * std_error, axis=0),
        "ratio": np.median(std_error / expected, axis=0),
        "to_spread": np.median(std_error, axis=0) / error.std(axis=0),
        "bias": error.mean(axis=0) / error.std(axis=0),
        "coloured": np.mean([r["coloured"] for r in rows]),
    }


def line(name: str, found: dict) -> str:
    cells = "  ".join(
        f"{n} {100 * c:.1f} ({r:.3f}, {s:.2f}, {b:+.2f})"
        for n, c, r, s, b in zip(*(found[k] for k in ("names", "coverage", "ratio", "to_spread", "bias")), strict=True)
    )
    return f"{name:<30} {found['count']} repeats  coloured {100 * found['coloured']:.1f} %  {cells}"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["integrator", "algebraic, channels together"])
def test_intervals_hold_the_truth(name):
    found = counted([repeat(name, seed) for seed in range(8)])
    assert found["coverage"].mean() >= 0.6, line(name, found)  # 4 of 8 wrong at 95 % are four chances in ten thousand
    assert np.all(np.abs(found["ratio"] - 1) < 0.1), line(name, found)


@pytest.mark.slow
def test_truth_within_three_standard_errors_with_process_noise():
    problems = [SYSTEMS["standing, process noise"](seed) for seed in range(4)]
    tables = [(p.solve().parameters, truth) for p, truth in problems]
    far = [abs(t["value"][n] - truth[n]) / t["std_error"][n] for t, truth in tables for n in t.index]
    assert np.mean(np.array(far) < 3) >= 0.95


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_coverage_is_ninety_five_per_cent(name):
    found = counted([repeat(name, seed) for seed in range(400)])
    print(line(name, found))
    assert np.all((found["coverage"] >= 0.92) & (found["coverage"] <= 0.98)), line(name, found)
    if name in WHITE:
        assert np.all(np.abs(found["ratio"] - 1) < 0.03), line(name, found)


if __name__ == "__main__":
    first, last = map(int, sys.argv[1].split(":"))
    kept = Path(sys.argv[2])
    done = [json.loads(text) for text in kept.read_text().splitlines()] if kept.exists() else []
    for system in sys.argv[3:] or SYSTEMS:
        there = {r["seed"] for r in done if r["name"] == system}
        for number in sorted(set(range(first, last)) - there):
            done.append(repeat(system, number))
            with kept.open("a") as file:
                file.write(json.dumps(done[-1]) + "\n")
        print(line(system, counted([r for r in done if r["name"] == system])), flush=True)
