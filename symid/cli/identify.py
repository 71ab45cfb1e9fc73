"""`symid identify`: find the parameters of a standing model from a recording."""

from __future__ import annotations

import argparse

from symid.cli.options import (
    add_episode_arguments,
    add_executor_arguments,
    add_model_arguments,
    add_recording_arguments,
    build_model,
    chosen_executor,
    refuse_bad_outputs,
    show,
    show_iteration,
    tell_files,
    with_inputs,
)
from symid.deadline import LIMIT_NODES, START_LIMIT_S
from symid.progress import say

SUMMARY = "identify the parameters of a model from a recording"
EXAMPLES = (
    "symid identify recording.csv --body body.json --controller fpd --window 0 100 --held-out 100 120 --report a.html",
    "symid identify recording.csv --body body.json --controller pd --episodes 3 --starts 10 --jobs 2 --store folder",
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "recording",
        metavar="RECORDING",
        help="samples with units in the column names: CSV, TSV, Excel, Parquet, C3D, TRC, MOT, STO, MAT, HDF5",
    )
    add_recording_arguments(parser)
    add_model_arguments(parser)
    parser.add_argument("--window", nargs=2, type=float, metavar=("T0", "T1"), help="part to fit, s (default: all)")
    parser.add_argument(
        "--held-out",
        nargs=2,
        type=float,
        metavar=("T0", "T1"),
        help="part to judge the fit on: a free run from a fitted initial state, s",
    )
    add_episode_arguments(parser)
    parser.add_argument(
        "--starts",
        type=int,
        default=1,
        metavar="K",
        help="1: one start made from the recording (default); more: K random starts",
    )
    parser.add_argument(
        "--scheme",
        default="midpoint",
        help="midpoint, backward_euler, trapezoid or hermite_simpson (default: midpoint)",
    )
    add_executor_arguments(parser)
    parser.add_argument("--max-iterations", type=int, default=3000, metavar="N", help="of each solve (default: 3000)")
    parser.add_argument(
        "--time-limit",
        type=float,
        metavar="S",
        help=f"of each start, s (default: {START_LIMIT_S:g}, more beyond {LIMIT_NODES:,} samples)",
    )
    parser.add_argument("--json", metavar="OUT.json", help="write everything as JSON")
    parser.add_argument("--report", metavar="OUT.html", help="write a report with figures")


def run(arguments: argparse.Namespace) -> int:
    from symid.files import write_json
    from symid.identification import Identification
    from symid.identification.show import errors_of_outputs
    from symid.recording import read_recording
    from symid.transcription import Episodes, measure, scheme_by_name

    refuse_bad_outputs(arguments.json, arguments.report, read=(arguments.recording, arguments.body, arguments.columns))
    scheme = scheme_by_name(arguments.scheme)
    model = build_model(arguments.body, arguments.controller)
    recording = read_recording(arguments.recording, allow_gaps=arguments.allow_gaps, columns=arguments.columns)
    recording = with_inputs(recording, model, arguments.fill_inputs)
    if arguments.held_out:
        measure(model, recording, arguments.held_out)  # refused now, not after the solve
    noise = {"torque": arguments.noise} if arguments.episodes > 1 else {}
    problem = Identification(
        model,
        recording,
        arguments.window,
        scheme=scheme,
        episodes=Episodes(arguments.episodes, seed=arguments.seed, distribution=arguments.distribution, **noise),
    )
    with chosen_executor(min(arguments.jobs, max(arguments.starts, 1)), arguments.cluster) as executor:
        solution = problem.solve(
            arguments.starts,
            seed=arguments.seed,
            executor=executor,
            store=arguments.store,
            on_iteration=show_iteration if arguments.starts == 1 else None,
            on_start=_tell_start(model) if arguments.starts > 1 else None,
            max_iterations=arguments.max_iterations,
            time_limit_s=arguments.time_limit,
        )
    document, held_out, lines = solution.to_dict(), None, [str(solution)]
    if arguments.held_out and solution.solved:
        held_out = solution.free_run(tuple(arguments.held_out))
        document["fit"]["held_out"] = held_out.fit
        lines.append(
            f"Held-out {arguments.held_out[0]:g} to {arguments.held_out[1]:g} s, free run: RMS error: "
            + errors_of_outputs(held_out)
        )
    if arguments.json:
        write_json(arguments.json, document)
    if arguments.report:
        from symid.report import write_report

        write_report(solution, arguments.report, held_out)
    tell_files(report=arguments.report, json=arguments.json)
    show("\n".join(lines))
    return 0 if solution.solved else 1


def _tell_start(model):
    from symid.identification.fit import common_unit, rms_text

    unit = common_unit(y.unit for y in model.outputs.values())

    def tell(row) -> None:
        say(
            f"start {row.number + 1:3d}  {row.status}  RMS {rms_text(row.rms, unit)}  {row.iterations} iterations  "
            f"{row.seconds:.1f} s"
        )

    return tell
