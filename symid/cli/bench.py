"""`symid bench`: how fast symid is here, beside CasADi and opty where they are installed."""

from __future__ import annotations

import argparse
import sys

SUMMARY = "measure symid on this machine, beside its peers where they are installed"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--recording", metavar="RECORDING.csv", help="instead of the synthetic one that ships; needs --body")
    parser.add_argument("--body", metavar="BODY.json", help="of that recording's person")
    parser.add_argument("--window", nargs=2, type=float, metavar=("T0", "T1"), default=(0.0, 100.0),
                        help="part to fit, s (default: 0 100)")
    parser.add_argument("--quick", action="store_true", help="one random start; without episodes and opty")
    parser.add_argument("--load", action="store_true", help="only long recordings: the window up to eight times")
    parser.add_argument("--json", metavar="OUT.json", help="write every run as JSON")


def run(arguments: argparse.Namespace) -> int:
    from symid.bench.measure import measure, measure_load
    from symid.bench.table import load_table, table
    from symid.bench.task import Task

    task = Task(*_files(arguments), window=tuple(arguments.window))
    if arguments.load:
        found = measure_load(task, _say)
        print(load_table(found))
    else:
        found = measure(task, arguments.quick, _say)
        print(table(found))
    if arguments.json:
        from symid.files import write_json
        write_json(arguments.json, found)
    return 0


def _files(arguments: argparse.Namespace) -> tuple[str, str]:
    from symid.errors import RecordingError

    if (arguments.recording is None) != (arguments.body is None):
        raise RecordingError("bench: --recording and --body belong together; give both or neither")
    if arguments.recording is not None:
        return arguments.recording, arguments.body
    from symid.cli.demo import data_folder
    return str(data_folder() / "recording.csv"), str(data_folder() / "body.json")


def _say(text: str) -> None:
    print(f"measured {text}", file=sys.stderr, flush=True)
