"""`symid bench`: how fast symid is here, beside CasADi and opty where they are installed."""

from __future__ import annotations

import argparse

from symid.cli.options import refuse_bad_outputs
from symid.errors import SymidError
from symid.progress import say

SUMMARY = "measure symid on this machine, beside its peers where they are installed"
EXAMPLES = (
    "symid bench --quick",
    "symid bench starts factorisation",
    "symid bench --recording walk.csv --body body.json --window 0 60 --json bench.json",
)
PARTS = {
    "solves": "evaluations and whole identifications beside CasADi and opty",
    "factorisation": "linear systems beside MUMPS, on one thread and on two",
    "starts": "ten random starts of eight cases: time, memory, optima",
    "growth": "a factorisation's time against nodes and episodes",
    "hour": "an hour at 100 Hz: time and memory",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "parts",
        nargs="*",
        metavar="PART",
        help="; ".join(f"{name}: {what}" for name, what in PARTS.items()) + "; all: all of these (default: solves)",
    )
    parser.add_argument(
        "--recording", metavar="RECORDING.csv", help="instead of the synthetic one that ships; needs --body"
    )
    parser.add_argument("--body", metavar="BODY.json", help="of that recording's person")
    parser.add_argument(
        "--window",
        nargs=2,
        type=float,
        metavar=("T0", "T1"),
        default=(0.0, 100.0),
        help="part to fit, s (default: 0 100)",
    )
    parser.add_argument("--quick", action="store_true", help="one random start; without episodes and opty")
    parser.add_argument("--load", action="store_true", help="only long made-up recordings, 100 to 800 s")
    parser.add_argument(
        "--growth",
        metavar="OUT.png",
        help="only the growth of the cost: 500 to 20000 nodes, 1 to 10 episodes, and its figure",
    )
    parser.add_argument(
        "--formulations",
        type=int,
        metavar="K",
        help="only formulations head to head, on K made-up recordings whose gains are known",
    )
    parser.add_argument("--json", metavar="OUT.json", help="write every run as JSON")


def run(arguments: argparse.Namespace) -> int:
    from symid.bench.task import Task

    refuse_bad_outputs(arguments.json, arguments.growth)
    parts = _parts(arguments.parts)
    chosen = [name for name in ("load", "growth", "formulations") if getattr(arguments, name)]
    if len(chosen) > 1:
        raise SymidError(f"bench: --{chosen[0]} and --{chosen[1]} are measurements of their own; give one")
    if chosen and parts:
        raise SymidError(f"bench: --{chosen[0]} and the part '{parts[0]}' are measurements of their own; give one")
    task = Task(*_files(arguments), window=tuple(arguments.window))
    if chosen:
        found = {"load": _load, "growth": _growth, "formulations": _formulations}[chosen[0]](task, arguments)
    elif parts:
        found = {name: _part(name, task, arguments) for name in parts}
    else:
        found = _solves(task, arguments)
    if arguments.json:
        from symid.files import write_json

        write_json(arguments.json, found)
    return 0


def _parts(names: list[str]) -> list[str]:
    from symid.checked import nearest

    for name in names:
        if name not in (*PARTS, "all"):
            raise SymidError(f"bench: there is no part '{name}'; {nearest(name, [*PARTS, 'all'])}")
    return list(PARTS) if "all" in names else list(dict.fromkeys(names))


def _part(name: str, task, arguments: argparse.Namespace) -> dict:
    from symid.bench import growth, linear, starts

    if name == "solves":
        return _solves(task, arguments)
    measured, table = {
        "factorisation": (lambda: linear.measure_factorisation(task, _say), linear.factorisation_table),
        "starts": (lambda: starts.measure_starts(task, _say), starts.starts_table),
        "growth": (lambda: linear.measure_growth_of_factorisation(_say), linear.factorisation_growth_table),
        "hour": (lambda: growth.measure_hour(_say), growth.hour_table),
    }[name]
    found = measured()
    print(table(found), end="\n\n")
    return found


def _solves(task, arguments: argparse.Namespace) -> dict:
    from symid.bench.measure import measure
    from symid.bench.table import table

    found = measure(task, arguments.quick, _say)
    print(table(found))
    return found


def _load(task, arguments: argparse.Namespace) -> dict:
    from symid.bench.growth import growth_table, measure_load

    found = measure_load(_say)
    print(growth_table(found))
    return found


def _growth(task, arguments: argparse.Namespace) -> dict:
    from symid.bench.growth import growth_table, measure_growth
    from symid.files import write_atomically
    from symid.plots.bench import plot_growth

    found = measure_growth(_say)
    print(growth_table(found))
    write_atomically(arguments.growth, plot_growth(found).png())
    return found


def _formulations(task, arguments: argparse.Namespace) -> list[dict]:
    from symid.bench.formulations import head_to_head, summary

    if arguments.formulations < 1:
        raise SymidError(f"bench: --formulations {arguments.formulations} is not possible; give at least 1 recording")
    rows = head_to_head(
        range(arguments.formulations),
        on_row=lambda row: _say(
            f"recording {row['seed']}, {row['formulation']}: "
            f"{'stable' if row['stable'] else 'unstable'}, {row['seconds']:.2f} s"
        ),
    )
    print(summary(rows).to_string(float_format=lambda x: f"{x:.3g}"))
    return rows.to_dict("records")


def _files(arguments: argparse.Namespace) -> tuple[str, str]:
    from symid.errors import RecordingError

    if (arguments.recording is None) != (arguments.body is None):
        raise RecordingError("bench: --recording and --body belong together; give both or neither")
    if arguments.recording is not None:
        return arguments.recording, arguments.body
    from symid.cli.demo import data_folder

    return str(data_folder() / "recording.csv"), str(data_folder() / "body.json")


def _say(text: str) -> None:
    say(f"measured {text}")
