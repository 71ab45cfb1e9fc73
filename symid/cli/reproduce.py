"""`symid reproduce`: the identifications, tables and figure of Wang & van den Bogert 2020."""

from __future__ import annotations

import argparse
from pathlib import Path

from symid.cli.options import add_distribution_argument, add_executor_arguments, chosen_executor, show
from symid.errors import SolveError

SUMMARY = "run the article's twelve identifications and print every number beside the article's"
EXAMPLES = ("symid reproduce --quick", "symid reproduce --starts 10 --jobs 2")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--only", nargs="+", metavar="NAME", help="cases (PD-3) or controllers (PD, FPD, NN); default: all"
    )
    parser.add_argument(
        "--recordings",
        metavar="DIRECTORY",
        help="with recording_50hz.csv and body.json (default: where `symid fetch standing` puts them)",
    )
    parser.add_argument("--starts", type=int, default=10, metavar="K", help="starts of each case (default: 10)")
    parser.add_argument(
        "--seeds",
        nargs="+",
        type=int,
        default=[0],
        metavar="S",
        help="of the process noise, each reported (default: 0)",
    )
    parser.add_argument("--quick", action="store_true", help="one start of each case")
    parser.add_argument(
        "--output",
        default="reproduction",
        metavar="DIRECTORY",
        help="for the CSV and the figures (default: reproduction)",
    )
    add_distribution_argument(parser)
    add_executor_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    from symid import mechanics
    from symid.fetch import standing
    from symid.files import write_atomically
    from symid.identification.studies.study import tell
    from symid.plots.article import plot_stable_share, plot_starts_spread
    from symid.recording import read_recording
    from symid.reproduce import CASES, comparison, late_feedback, late_feedback_text, reproduce, text
    from symid.reproduce.article import chosen

    if arguments.starts < 1:
        raise SolveError(f"--starts {arguments.starts} is not possible; give at least 1")
    cases, folder = chosen(arguments.only), standing(arguments.recordings)
    recording = read_recording(folder / "recording_50hz.csv")
    body = mechanics.DoubleLinkPendulum.from_json(folder / "body.json")
    with chosen_executor(arguments.jobs, arguments.cluster) as executor:
        found = reproduce(
            cases,
            body,
            recording,
            starts=1 if arguments.quick else arguments.starts,
            seeds=arguments.seeds,
            distribution=arguments.distribution,
            executor=executor,
            jobs=arguments.jobs,
            store=arguments.store,
            on_finished=tell,
        )
    lines = [text(found)]
    files: dict[str, str | bytes] = {}
    if found.findings:  # an empty comparison would pass for a finished one
        files["comparison.csv"] = comparison(found).to_csv(index=False)
        files["figure_2.png"] = plot_stable_share(found.findings).png()
        files["starts.png"] = plot_starts_spread(found.findings).png()
    if CASES["FPD-1"] in cases:
        late = late_feedback(body, recording)
        lines.append(late_feedback_text(late))
        files["late_feedback.csv"] = late.to_csv(index=False)
    for name, content in files.items():
        write_atomically(Path(arguments.output) / name, content)
    lines += [f"Written: {', '.join(files)} in {arguments.output}"] if files else []
    show("\n\n".join(lines))
    return 1 if found.failed or not all(f.best.solved for f in found.findings) else 0
