"""Examine the diagnosis: python tests/examination/examine.py NAME FIRST:LAST ROWS.jsonl, names as in `draws.DRAWS`.

Each diagnosis appends a row to ROWS.jsonl; what is there already is not done again. `python examine.py ROWS.jsonl`
prints the counts. 200 nulls take about 40 minutes of one core, a person about two minutes. Persons need the
article's recording (`symid fetch standing`).
"""

import json
import sys
import time
import warnings
from collections import defaultdict
from pathlib import Path

from draws import DRAWS, Exam

import symid as si
from symid.conceal import Unsuitable


def row(name: str, seed: int) -> dict:
    """What a diagnosis says of one draw, beside the truth."""
    exam: Exam = DRAWS[name](seed)
    begin = time.process_time()
    found = si.diagnose_case(exam.case, threads=1)
    seconds = time.process_time() - begin
    hidden = {f"{t.name}@{t.location}": v for t, v in exam.truth.items()}
    named = {f"{e.name}@{e.location}": {k: list(v) for k, v in e.parameters.items()} for e in found.effects}
    off = [
        (named[k][p][0] - v) / named[k][p][1]
        for k in hidden.keys() & named.keys()
        for p, v in hidden[k].items()
        if named[k].get(p, (0, 0))[1] > 0 and p != "phase_rad"
    ]
    alike = sorted({f"{h.suspect.term.name}@{h.suspect.term.location}" for h in found.equivalent})
    return {
        "draw": name,
        "seed": seed,
        **exam.facts,
        "truth": hidden,
        "verdict": found.verdict,
        "confirmed": found.confirmed,
        "named": named,
        "alike": alike,
        "chance": found.false_alarm_probability,
        "standard_errors_off": off,
        "cpu_s": round(seconds, 1),
    }


def judged(r: dict) -> str:
    """One word for a row."""
    hidden, named, alike = set(r["truth"]), set(r["named"]), set(r["alike"])
    sure = r["verdict"] == "missing_physics"
    if named == hidden:
        return "right" if named or r["verdict"] == "adequate" else "unexplained"
    if not named:
        return "missed" if r["verdict"] == "adequate" else "unexplained"
    if named < hidden:
        return "some of them"
    if len(named) == len(hidden) and hidden <= named | alike or named <= hidden | alike and hidden & (named | alike):
        return "told as alike"
    return ("wrong, confirmed" if r["confirmed"] else "wrong, not confirmed") if sure else "wrong, unexplained"


def counts(rows: list[dict]) -> None:
    """Print how the rows of each kind were answered, and how far the values are off."""
    of = defaultdict(list)
    for r in rows:
        kind = r.get("aim") or r.get("spoilt") or ("delay" if r.get("delay") else "no delay")
        of[r["draw"], r.get("system", ""), str(kind)].append(r)
    for key, group in sorted(of.items()):
        said = defaultdict(int)
        for r in group:
            said[judged(r)] += 1
        print(*key, len(group), dict(said), f"{sum(r['cpu_s'] for r in group) / len(group):.0f} s of CPU each")
    off = [abs(z) for r in rows for z in r["standard_errors_off"]]
    if off:
        print(f"values within two standard errors: {sum(z <= 2 for z in off)} of {len(off)}")
    for r in rows:
        if "wrong" in judged(r):
            print(judged(r), json.dumps({k: r[k] for k in ("draw", "seed", "truth", "named", "alike", "chance")}))


def main(name: str, span: str, path: str) -> None:
    file, (first, last) = Path(path), map(int, span.split(":"))
    done = {(r["draw"], r["seed"]) for r in _rows(file)}
    for seed in range(first, last):
        if (name, seed) in done:
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                found = row(name, seed)
            except Unsuitable as error:  # a draw that nobody would record
                print(name, seed, f"no case: {error}", flush=True)
                continue
        with file.open("a", encoding="utf-8") as out:
            out.write(json.dumps(found) + "\n")
        print(name, seed, judged(found), found["verdict"], *found["named"], f"{found['cpu_s']} s", flush=True)


def _rows(file: Path) -> list[dict]:
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.is_file() else []


if __name__ == "__main__":
    if len(sys.argv) == 2:
        counts(_rows(Path(sys.argv[1])))
    else:
        main(*sys.argv[1:4])
