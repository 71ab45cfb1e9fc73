"""Arguments that several commands share, and what they stand for."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from symid.errors import ModelError, SolveError
from symid.progress import NORMAL, QUIET, VERBOSE, level, put, said, say

LARGEST = {
    "episodes": 1000,
    "jobs": 1024,
    "threads": 1024,
    "starts": 10**5,
    "count": 10**5,
    "formulations": 1000,
    "max_iterations": 10**9,
    "duration": 1e6,
    "rate": 1e6,
}
"""Numbers above these are slips of the keyboard: more than any machine holds or does in a year."""
SAMPLES = 10**8
"""Likewise for the samples of one simulation: a gigabyte a channel."""
CONTROLLERS = ("pd", "fpd", "fpd-delay", "nn")


def refuse_absurd(arguments: argparse.Namespace) -> None:
    """SolveError for a number that is not finite, or so large that the command would never end; for a null character,
    which stands in the name of no file.
    """
    given = vars(arguments)
    for name, value in given.items():
        option = f"--{name.replace('_', '-')}"
        for number in value if isinstance(value, (list, tuple)) else [value]:
            if isinstance(number, str) and "\0" in number:
                raise SolveError(f"{number[:80]!r} holds a null character, which is not possible; leave it out")
            if (
                isinstance(number, float) and not math.isfinite(number) and name not in ("window", "held_out")
            ):  # said by measure
                raise SolveError(f"{option} {number} is not possible; give a finite number")
            if name in ("seed", "seeds") and isinstance(number, int) and not 0 <= number < 2**63:
                raise SolveError(f"{option} {str(number)[:30]} is not possible; give a whole number from 0 to 2^63 - 1")
            if name in LARGEST and number is not None and number > LARGEST[name]:
                raise SolveError(f"{option} {str(number)[:30]} is not possible; give at most {LARGEST[name]:g}")
    if (given.get("duration") or 0) * (given.get("rate") or 0) > SAMPLES:
        raise SolveError(
            f"--duration {given['duration']:g} at --rate {given['rate']:g} are more than {SAMPLES:g} samples; give less"
        )


def add_recording_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--columns",
        metavar="MAP.toml",
        help='what the file calls its columns: lines such as ankle_angle_deg = "Ankle Flexion", time_s = "t"; '
        "a minus before the file's name turns the sign",
    )
    parser.add_argument(
        "--allow-gaps",
        action="store_true",
        help="accept blank cells, missing rows and uneven times, and give what is missing no weight",
    )
    parser.add_argument(
        "--fill-inputs",
        type=float,
        metavar="S",
        help="interpolate what drives the model where it is missing, for at most so long, s (needs --allow-gaps)",
    )


def with_inputs(recording, model, seconds: float | None):
    """The recording with the gaps of what drives the model filled, where that was asked for."""
    from symid.recording import fill_gaps

    channels = [u.channel for u in model.inputs.values() if u.channel in recording.channels]
    return recording if seconds is None or not channels else fill_gaps(recording, seconds, *channels)


def add_model_arguments(parser: argparse.ArgumentParser, required: bool = True) -> None:
    parser.add_argument(
        "--body", metavar="BODY.json", required=required, help="body parameters with units in their names"
    )
    parser.add_argument("--controller", choices=CONTROLLERS, default="fpd", help="feedback law (default: fpd)")


def add_episode_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--episodes",
        type=int,
        default=1,
        metavar="M",
        help="noisy repetitions that share the parameters (default: 1, without noise)",
    )
    parser.add_argument(
        "--noise",
        type=float,
        default=0.25,
        metavar="NM",
        help="joint-torque noise of the episodes: half width of uniform noise (a multisine has the same "
        "power), standard deviation of gaussian noise, N m (default: 0.25)",
    )
    add_distribution_argument(parser)
    parser.add_argument("--seed", type=int, default=0, help="of random starts and noise (default: 0)")


def add_distribution_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--distribution",
        default="multisine",
        metavar="NAME",
        help="how the noise is drawn: multisine (default; flat spectrum, orthogonal, zero in sum over the "
        "episodes, so that the parameters depend little on the draw), uniform or gaussian (independent)",
    )


def build_model(body: str, controller: str):
    """The standing model of a body file under one of CONTROLLERS."""
    from symid import mechanics

    laws = {
        "pd": mechanics.PD,
        "fpd": mechanics.FullStatePD,
        "nn": mechanics.NeuralNetwork,
        "fpd-delay": lambda: mechanics.FullStatePD(delay=(0.0, 0.3)),
    }
    if controller not in laws:
        raise ModelError(f"no controller '{controller}'; known: {', '.join(laws)}")
    return mechanics.DoubleLinkPendulum.from_json(body).with_feedback(laws[controller]())


def add_executor_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="processes for the solves (default: 1)")
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="solve on the workers of the dask scheduler there, tcp://HOST:PORT (needs symid[dask])",
    )
    parser.add_argument(
        "--store",
        metavar="DIRECTORY",
        help="keep each finished solve there; the same command again resumes after a kill",
    )


def chosen_executor(jobs: int, cluster: str | None) -> AbstractContextManager[Executor | None]:
    """A cluster, or `jobs` local processes, or None for this process alone; to be used in a with statement."""
    from symid.identification import Cluster, LocalPool

    if jobs < 1:
        raise SolveError(f"--jobs {jobs} is not possible; give at least 1 process")
    if cluster is not None:
        return Cluster(cluster)
    return LocalPool(jobs) if jobs > 1 else nullcontext()


def show_iteration(iteration) -> None:
    """Progress on stderr: in place on a terminal, every tenth iteration otherwise, all of them where asked for."""
    if level() == QUIET:
        return
    end = "\r" if sys.stderr.isatty() and level() == NORMAL else ""
    if end or level() == VERBOSE or iteration.number % 10 == 0:
        put(
            f"iteration {iteration.number:4d}  objective {iteration.objective:.6g}  infeasibility "
            f"{iteration.infeasibility:.1e} ",
            end or "\n",
        )
        said()


def add_level_arguments(parser: argparse.ArgumentParser) -> None:
    choice = parser.add_mutually_exclusive_group()
    choice.add_argument("-q", "--quiet", action="store_true", help="no progress on stderr, only results and errors")
    choice.add_argument(
        "-v", "--verbose", action="store_true", help="every iteration, and where in symid an error comes from"
    )


def refuse_bad_outputs(*paths: str | None, read: Sequence[str | Path | None] = ()) -> None:
    """SolveError before the work for a file that cannot be written after it: its folder does not exist, or it would
    replace one of those that are `read`, or another result.
    """
    taken = {os.path.realpath(path): f"{path}, which is read" for path in read if path}
    for path in paths:
        if path is None:
            continue
        if not path:
            raise SolveError("the name of a file to write is empty; give one")
        if not Path(path).parent.is_dir():
            raise SolveError(f"{path} cannot be written: the folder {Path(path).parent} does not exist; make it first")
        if Path(path).is_file() or not Path(path).exists():  # a device takes all
            place = os.path.realpath(path)  # a link to itself is none, and is replaced
            if place in taken:
                raise SolveError(f"{path} would replace {taken[place]}; give another file")
            taken[place] = f"another result, {path}"


def show(result: str) -> None:
    """Print on stdout; a reader that has enough (`| head`) closes the pipe, and nothing else changes."""
    try:
        print(result, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def tell_files(**written: str | None) -> None:
    """Where the files went, on stderr: what is on stdout is for programs, too."""
    for what, path in written.items():
        if path:
            say(f"{what.replace('_', ' ')}: {path}")
