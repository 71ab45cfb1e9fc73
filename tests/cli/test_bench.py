"""`symid bench`: it runs, and its tables say what was measured; times are not asserted."""

import json
from dataclasses import replace
from importlib import import_module

import numpy as np
import pandas as pd
import pytest

from symid.bench.formulations import FORMULATIONS
from symid.bench.growth import exponents, growth_table, measure_load
from symid.bench.measure import _solves
from symid.bench.peers import TORQUE, for_peers
from symid.bench.runs import run_fresh
from symid.bench.starts import starts_table
from symid.bench.table import ratio, table
from symid.bench.task import Task
from symid.cli.main import main
from symid.errors import SymidError
from symid.plots.bench import plot_formulations
from symid.synthetic import write_standing


@pytest.fixture(scope="module")
def tiny(tmp_path_factory) -> Task:
    """Four seconds of the synthetic recording."""
    folder = tmp_path_factory.mktemp("data")
    write_standing(folder)
    return Task(str(folder / "recording.csv"), str(folder / "body.json"), (0.0, 4.0))


@pytest.fixture
def run_here(monkeypatch):
    """Measurements in this process: fresh ones import for a second each."""

    def run(call, task, *arguments, cache=None, limit_s=None):
        module, function = call.split(".")
        return getattr(import_module(f"symid.bench.{module}"), function)(task, *arguments)

    monkeypatch.setattr("symid.bench.measure.run_fresh", run)


@pytest.mark.slow
@pytest.mark.compiled
def test_the_command_prints_ratios_and_targets(tiny, tmp_path, capsys, run_here):
    arguments = ["bench", "--quick", "--recording", tiny.recording, "--body", tiny.body, "--window", "0", "4"]
    assert main([*arguments, "--json", str(tmp_path / "bench.json")]) == 0
    printed = capsys.readouterr().out
    assert "one evaluation, 200 intervals" in printed
    found = json.loads((tmp_path / "bench.json").read_text())
    for name in found["absent"]:
        assert f"{name} is not installed" in printed
    assert ("CasADi's best / symid" in printed) == ("casadi" not in found["absent"])
    (sides,) = found["solves"].values()
    solved = [run["rms"] for runs in sides.values() for run in runs if run["status"] == "Solve_Succeeded"]
    assert {"symid, random start", "symid, default start"} <= sides.keys()
    assert min(solved) > 0 and "memory above the interpreter's start" in printed


def test_peers_solve_the_same_program(tiny):
    """Scaled rows of the peers at the recorded motion are the constraints of symid's program there."""
    task = replace(tiny, controller="pd", episodes=2)
    peer, problem = for_peers(task), task.identification()
    t, z = problem.transcription, problem.start("random", 0, 0)
    middle, rate = (peer.recorded[1:] + peer.recorded[:-1]) / 2, np.diff(peer.recorded, axis=0) / peer.step
    acceleration = (peer.acceleration[1:] + peer.acceleration[:-1]) / 2
    for e, noise in enumerate(peer.noises):
        values = peer.function({"sin": np.sin, "cos": np.cos})(*middle.T, *rate.T, *peer.start, acceleration, *noise.T)
        equations = t.program.constants[e][-len(peer.row_scale) :]
        own = t.program.interval.residual(*t.program.interval_arguments(z, e)) * equations
        np.testing.assert_allclose(np.column_stack(values) * peer.row_scale, own, rtol=1e-9, atol=1e-9)
    assert peer.row_scale.tolist() == [1, 1, TORQUE, TORQUE]
    assert peer.rms(np.stack([peer.recorded] * 2)) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("setup", ["map + JIT", "expand"])
def test_casadi_finds_the_same_optimum(tiny, setup):
    pytest.importorskip("casadi", reason="casadi is not installed")
    from symid.bench import casadi_side, symid_side

    task = replace(tiny, controller="pd", window=(0.0, 10.0))
    peer, own = casadi_side.identification(task, setup), symid_side.identification(task, "random")
    assert peer["status"] == own["status"] == "Solve_Succeeded"
    assert peer["rms"] == pytest.approx(own["rms"], rel=1e-4)


ENDED = {
    "build": 1.0,
    "solve": 1.0,
    "total": 2.0,
    "iterations": 5,
    "rms": 0.01,
    "functions_share": 0.5,
    "memory_mb": 900.0,
    "import": 1.0,
    "status": "Solve_Succeeded",
}


def measured(solves: dict) -> dict:
    """What `measure` gives, with these solves."""
    rates = {"residual_ms": 1.0, "jacobian_ms": 1.0, "hessian_ms": 1.0, "intervals": 10}
    return {
        "absent": ["casadi", "opty"],
        "evaluations": {"symid, C": rates, "symid, NumPy": rates},
        "first_use": [{"seconds": 0.2}],
        "linear": {"chain": {"ms": 10.0}, "mumps": {"ms": 25.0}},
        "first_identification": ENDED,
        "solves": solves,
    }


@pytest.mark.slow
def test_growth_of_the_cost_is_measured_and_drawn(monkeypatch, tmp_path, capsys, run_here):
    for name, value in {"SECONDS": (4, 8), "EPISODES": (1, 2), "EPISODE_SECONDS": 4, "RUNS": 1}.items():
        monkeypatch.setattr(f"symid.bench.growth.{name}", value)
    monkeypatch.setattr("symid.bench.growth.run_fresh", import_module("symid.bench.measure").run_fresh)
    assert main(["bench", "--growth", str(tmp_path / "growth.png"), "--json", str(tmp_path / "growth.json")]) == 0
    found = json.loads((tmp_path / "growth.json").read_text())
    assert [(r["nodes"], r["episodes"]) for by in ("nodes", "episodes") for r in found[by]] == [
        (201, 1),
        (401, 1),
        (201, 1),
        (402, 2),
    ]
    assert (tmp_path / "growth.png").read_bytes().startswith(b"\x89PNG")
    assert capsys.readouterr().out.count("n log n would be") == 2


PARTS = {
    "linear": {
        "NODES": (200, 400),
        "EPISODES": (1, 2),
        "EPISODE_SECONDS": 2.0,
        "ROUNDS": 1,
        "NETWORK_EPISODES": 2,
        "ITERATIONS": 2,
    },
    "starts": {"CASES": (("pd", 1), ("fpd", 2)), "STARTS": 1},
    "growth": {"HOUR": 4.0},
}


@pytest.mark.compiled
def test_parts_are_measured_by_name(tiny, monkeypatch, tmp_path, capsys):
    def here(call, task, *arguments, cache=None, threads=1, limit_s=None):
        module, function = call.split(".")
        return getattr(import_module(f"symid.bench.{module}"), function)(task, *arguments)

    for module, names in PARTS.items():
        for name, value in ({"run_fresh": here} | names).items():
            monkeypatch.setattr(f"symid.bench.{module}.{name}", value)
    files = ["--recording", tiny.recording, "--body", tiny.body, "--window", "0", "4"]
    parts = ["factorisation", "starts", "growth", "hour"]
    assert main(["bench", *parts, *files, "--json", str(tmp_path / "bench.json")]) == 0
    found, printed = json.loads((tmp_path / "bench.json").read_text()), capsys.readouterr().out
    assert list(found) == parts and printed.splitlines()[0].endswith("the same point)")
    assert [r["episodes"] for r in found["growth"]["episodes"]] == [1, 2]
    assert [r["nodes"] for r in found["growth"]["nodes"]] == [200, 400] and found["hour"]["nodes"] == 401
    starts = [r for of in found["starts"].values() for r in of["starts"]]
    assert all(r["solved"] and r["mumps"] < 1e-6 for r in starts)
    for target in ("MUMPS / symid", "exponent of a factorisation's time in nodes", "slowest start", "memory of its"):
        assert target in printed


def test_a_part_that_is_not_there(capsys):
    assert main(["bench", "factorization"]) == 2
    assert "there is no part 'factorization'" in capsys.readouterr().err


def test_a_start_that_is_refused_is_told():
    row = {"number": 3, "status": "Multipliers_Ran_Away", "solved": False, "objective": 1.0, "iterations": 9}
    text = starts_table({"FPD-4": {"starts": [row | {"seconds": 31.0, "silence": 1.0}], "memory_mb": 500.0}})
    assert "start 3: Multipliers_Ran_Away, 31.0 s" in text and text.count("NOT MET") == 1


def test_exponents_are_those_of_the_law():
    runs = [{"nodes": n, "total": 3 * n**1.5, "iteration": n, "iterations": n**0.5} for n in (100, 1000, 10000)]
    found = exponents(runs, "nodes")
    assert found["total"] == pytest.approx(1.5) and found["iteration"] == pytest.approx(1.0)
    assert 1.1 < found["n log n"] < 1.2
    assert "NOT MET" in growth_table({"nodes": [r | {"memory_mb": 1.0} for r in runs]})


@pytest.mark.slow
def test_long_recordings(monkeypatch, run_here):
    monkeypatch.setattr("symid.bench.growth.LOAD", (4, 8))
    monkeypatch.setattr("symid.bench.growth.run_fresh", import_module("symid.bench.measure").run_fresh)
    assert [r["nodes"] for r in measure_load()["nodes"]] == [201, 401]


def test_measurements_of_their_own_are_not_mixed(capsys):
    assert main(["bench", "--load", "--formulations", "2"]) == 2
    assert "--load and --formulations are measurements of their own" in capsys.readouterr().err


def test_formulations_head_to_head(monkeypatch, tmp_path, capsys):
    """One short recording: every formulation ends, and those that may not be unstable are not."""
    monkeypatch.setattr("symid.bench.formulations.FIT", 8.0)
    assert main(["bench", "--formulations", "1", "--json", str(tmp_path / "rows.json")]) == 0
    rows = {row["formulation"]: row for row in json.loads((tmp_path / "rows.json").read_text())}
    assert rows.keys() == FORMULATIONS.keys() and rows["prediction error"]["solved"]
    assert rows["eigenvalue constraint"]["growth_1_s"] < 0
    best = min(rows, key=lambda name: rows[name]["gain_error"])
    assert best in ("prediction error", "estimated process noise", "three times the data")
    assert "gain_error_percent" in capsys.readouterr().out
    assert plot_formulations(pd.DataFrame(rows.values())).png().startswith(b"\x89PNG")


def test_a_fresh_process_gives_its_numbers(tiny):
    assert run_fresh("symid_side.evaluations", tiny, "numpy")["intervals"] == 200


def test_a_failed_run_is_told(tiny):
    with pytest.raises(SymidError, match="symid_side.evaluations.*backend 'fortran'"):
        run_fresh("symid_side.evaluations", tiny, "fortran")


def test_a_peer_without_end_is_stopped_and_the_table_goes_on(tiny, monkeypatch):
    run = run_fresh("symid_side.evaluations", tiny, "numpy", limit_s=0.05)
    assert run == {"total": 0.05, "status": "stopped"}
    limits, said, peer = {}, [], "casadi_side.identification"

    def fresh(call, task, *arguments, cache=None, limit_s=None):
        limits[call] = limit_s
        return {"total": limit_s, "status": "stopped"} if arguments == ("expand",) else ENDED

    monkeypatch.setattr("symid.bench.measure.run_fresh", fresh)
    sides = {"symid, random start": ("symid_side.identification", "random")}
    sides |= {f"CasADi, {setup}": (peer, setup) for setup in ("map + JIT", "expand")}
    solves = {"FPD": _solves(replace(tiny, episodes=3), sides, 1, "", said.append)}
    assert limits == {"symid_side.identification": None, peer: 600.0}
    assert said[-1].endswith("CasADi, expand: > 600 s, stopped")
    lines = table(measured(solves)).splitlines()
    assert sum(line.endswith("> 600 s, stopped") for line in lines) == 1
    assert any("CasADi's best / symid" in line and " 1 x" in line for line in lines)


def test_recording_and_body_belong_together(tiny, capsys):
    assert main(["bench", "--recording", tiny.recording]) == 2
    assert "--recording and --body belong together" in capsys.readouterr().err


def test_ratio_is_the_median_over_starts_of_the_best_peer():
    peers = [[{"total": t} for t in row] for row in ([4.0, 9.0, 5.0], [6.0, 3.0, 7.0])]
    assert ratio(peers, [{"total": t} for t in (2.0, 1.0, 1.0)]) == 3.0


def test_a_missed_target_is_said():
    lines = table(measured({"FPD": {"symid, random start": [ENDED], "symid, default start": [ENDED]}})).splitlines()
    missed = [line for line in lines if "NOT MET" in line]
    assert [line.split("  ")[0] for line in missed] == [
        "slowest evaluation, symid, C",
        "generated functions' share of the solve",
        "memory above the interpreter's start",
    ]
    assert sum("is not installed" in line for line in lines) == 2
