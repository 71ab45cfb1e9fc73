"""`symid demo`: the main job on the synthetic recording that ships with symid."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from symid.cli.options import build_model, refuse_bad_outputs, show_iteration
from symid.errors import RecordingError
from symid.progress import say
from symid.units import unit_symbol, with_error

SUMMARY = "identify the synthetic recording in data/ and compare with what it was made with"
FIT, HELD_OUT = (0.0, 100.0), (100.0, 120.0)
EXAMPLES = ("symid demo", "symid demo --report first.html")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--report",
        metavar="OUT.html",
        default="symid_demo.html",
        help="where to write the report (default: symid_demo.html)",
    )


def run(arguments: argparse.Namespace) -> int:
    from symid.identification import Identification
    from symid.identification.show import errors_of_outputs, headline
    from symid.recording import read_recording
    from symid.report import write_report

    refuse_bad_outputs(arguments.report)
    folder = data_folder()
    truth = json.loads((folder / "truth.json").read_text())["parameters"]
    problem = Identification(build_model(folder / "body.json", "fpd"), read_recording(folder / "recording.csv"), FIT)
    say(f"Identifying 10 parameters from {FIT[1] - FIT[0]:g} s of {folder / 'recording.csv'} ...")
    solution = problem.solve(on_iteration=show_iteration)
    if not solution.solved:
        print(solution)
        return 1
    held_out = solution.free_run(HELD_OUT)
    report = write_report(solution, arguments.report, held_out, truth)
    print(headline(solution), solution.message, sep="\n", end="\n\n")
    print(_beside_truth(solution, truth), end="\n\n")
    print(f"Held-out {HELD_OUT[0]:g} to {HELD_OUT[1]:g} s, free run: RMS error: {errors_of_outputs(held_out)}")
    print(f"Report with figures: {report}")
    return 0


def data_folder() -> Path:
    """The recording in the checkout, or made anew (the same bytes) where symid is installed without it."""
    from symid.synthetic import write_standing

    shipped = Path(__file__).parents[2] / "data" / "standing_synthetic"
    if (shipped / "recording.csv").is_file():
        return shipped
    made = Path("symid_demo_data")
    try:
        write_standing(made)
    except OSError as error:
        raise RecordingError(f"{made}: the demo's recording cannot be written here: {error.strerror}") from error
    return made


def _beside_truth(solution, truth: dict[str, float]) -> str:
    lines = [f"{'parameter':<12}{'found ± std. error':<24}{'truth':>8}   {'unit':<12}off by"]
    for name, row in solution.parameters.iterrows():
        off = (row.value - truth[name]) / row.std_error
        lines.append(
            f"{name:<12}{with_error(row.value, row.std_error):<24}{truth[name]:>8.5g}   {unit_symbol(row.unit):<12}"
            f"{off:+.1f} std. errors"
        )
    return "\n".join(lines)
