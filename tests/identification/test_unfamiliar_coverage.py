"""How often 95 % intervals hold the truth for `UNFAMILIAR` systems and ugly noise.

``PYTHONPATH=tests:tests/identification python tests/identification/test_unfamiliar_coverage.py 0:12 ROWS.jsonl`` does
the draws of these seeds that the file does not hold yet, appends them, and prints the coverage by noise and by system;
names of noises may follow. As a user who reads the warnings does, a solution whose mesh errs by `COARSE` standard
errors is refined. Of draws with a parameter that is more than `FAR` standard errors off it says of how many intervals
that are not symmetric warn, and of how many of all others.
"""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from ugly_noise import NOISES, measured
from unfamiliar_systems import UNFAMILIAR

from symid.identification.checks.curved import said_of_intervals
from symid.identification.checks.verify import COARSE, mesh_error

NORMAL = 1.96
FAR = 4.0
"""Standard errors that chance makes of one parameter in 16,000."""


def drawn(system, noise: str, seed: int) -> dict:
    """Errors over standard errors of one identification, None for a parameter at its bound, and its error model."""
    draw = measured(system, noise, seed)
    solution = draw.problem().solve(check=False)
    row = {"system": system.__name__, "noise": noise, "seed": seed, "failure": draw.failure(solution, allowed=1.5)}
    if row["failure"]:
        return row
    mesh = mesh_error(solution)
    if mesh is not None and mesh["std_errors"].abs().max() > COARSE:
        solution = solution.refined()
    table = solution.parameters
    ratios = (table["value"] - [draw.truth[n] for n in table.index]) / table["std_error"]
    z = [float(x) if np.isfinite(x) else None for x in ratios]
    bent = bool(said_of_intervals(solution))
    return row | {"z": z, "model": solution.errors.model, "refined": solution.problem.refine > 1, "bent": bent}


def is_far(row: dict) -> bool:
    return any(abs(x) > FAR for x in row.get("z", ()) if x is not None)


def held(rows: list[dict]) -> tuple[float, int]:
    """Share of the intervals that hold the truth, and how many there are."""
    z = np.array([x for r in rows for x in r.get("z", ()) if x is not None])
    return float(np.mean(np.abs(z) < NORMAL)), len(z)


@pytest.mark.slow
@pytest.mark.parametrize("noise", NOISES)
def test_intervals_of_unfamiliar_systems_hold_the_truth(noise):
    rows = [drawn(system, noise, seed) for system in UNFAMILIAR for seed in range(6)]
    share, count = held(rows)
    assert share > 0.86, (share, count)
    if noise != "remembering":  # a memory of thirty samples in sixty is not always seen
        assert [r for r in rows if is_far(r) and not r["bent"]] == []


if __name__ == "__main__":
    first, last = map(int, sys.argv[1].split(":"))
    kept = Path(sys.argv[2])
    done = [json.loads(text) for text in kept.read_text().splitlines()] if kept.exists() else []
    there = {(r["system"], r["noise"], r["seed"]) for r in done}
    noises = sys.argv[3:] or list(NOISES)
    for number in range(first, last):
        for kind, of in ((k, s) for k in noises for s in UNFAMILIAR if (s.__name__, k, number) not in there):
            done.append(drawn(of, kind, number))
            with kept.open("a") as file:
                file.write(json.dumps(done[-1]) + "\n")
    for kind in noises:
        rows = [r for r in done if r["noise"] == kind]
        parts = {s.__name__: held([r for r in rows if r["system"] == s.__name__]) for s in UNFAMILIAR}
        share, count = held(rows)
        told = ", ".join(f"{name} {100 * s:.0f}" for name, (s, _) in parts.items())
        warned = [sum(r.get("bent", False) for r in rows if is_far(r) == far) for far in (True, False)]
        print(f"{kind:<13} {sum(map(is_far, rows))} of {len(rows)} far off: {warned[0]} warned; of others {warned[1]}")
        print(f"{kind:<13} {100 * share:.1f} % of {count}, {sum(bool(r['failure']) for r in rows)} failed; {told}")
