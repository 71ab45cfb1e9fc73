"""Parse the command line, run the command, turn errors into one sentence and an exit code."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from pkgutil import iter_modules

import symid.cli as cli
from symid.cli.options import add_level_arguments, refuse_absurd
from symid.errors import SymidError
from symid.progress import NORMAL, QUIET, VERBOSE, alive, put, set_level
from symid.threads import room_for

# Every module of this package but these is a command: SUMMARY, EXAMPLES, add_arguments(parser), run(arguments) -> code.
NOT_COMMANDS = ("__main__", "main", "options")
SOLVED, NOT_SOLVED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
EXAMPLES = """examples:
  symid demo
  symid identify recording.csv --body body.json --controller fpd --window 0 100 --report fit.html
  symid identify --help"""
LEAST_BYTES = 700 * 2**20
"""Addresses that the libraries take before the first number is read: 510 to 600 MB, and a small problem's."""
TOO_LITTLE = (
    f"this process may take less than {LEAST_BYTES / 1e6:.0f} MB more memory; symid needs that much to begin with. "
    "Raise the limit (`ulimit -v`, the memory of the container or of the job), or free memory"
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command: exit code 0 done or solved, 1 not solved, 2 bad input."""
    _open_closed_streams()
    try:
        return _done(build_parser().parse_args(arguments))
    except KeyboardInterrupt:
        put("symid: interrupted")
        return INTERRUPTED


def _done(parsed: argparse.Namespace) -> int:
    """Run what was asked for; its exit code."""
    set_level(QUIET if parsed.quiet else VERBOSE if parsed.verbose else NORMAL)
    warnings.showwarning = _show_warning
    if not room_for(LEAST_BYTES):
        put(f"symid: error: {TOO_LITTLE}")
        return BAD_INPUT
    try:
        refuse_absurd(parsed)
        with alive(lambda: f"symid {parsed.command} is at work"):
            code = parsed.run(parsed)
        sys.stdout.flush()
        return code
    except SymidError as error:
        if parsed.verbose:
            traceback.print_exc()
        put(f"symid: error: {error}")
        return BAD_INPUT
    except BrokenPipeError:  # `| head` has read enough; the files are written
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return SOLVED
    except OSError as error:
        place = "" if error.filename is None else f": {error.filename}"
        put(f"symid: error: {error.strerror or error}{place}")
        return BAD_INPUT
    except ModuleNotFoundError as absent:
        put(f"symid: error: {absent}: the installation is not whole; install symid again")
        return BAD_INPUT
    except (MemoryError, ImportError) as failure:  # a library that finds no memory cannot be imported
        said = " ".join(str(failure).split())[:300]
        put(f"symid: error: {type(failure).__name__}: {said}. Is there memory enough (`ulimit -v`)?")
        return BAD_INPUT


def _open_closed_streams() -> None:
    """Where the shell closed stdout or stderr (`>&-`) nothing is said: else a file that is opened takes its place, and
    what is printed on the one comes out of the other.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))


def command_names() -> list[str]:
    """The commands, in alphabetical order: one module each."""
    return sorted(m.name for m in iter_modules(cli.__path__) if m.name not in NOT_COMMANDS)


def build_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="symid",
        description="Identify mechanical systems and their feedback controllers from recordings, "
        "and find the physics that a model left out.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"symid {version('symid')}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name in command_names():
        module = import_module(f"symid.cli.{name}")
        examples = "\n".join(["examples:", *(f"  {example}" for example in module.EXAMPLES)])
        command = commands.add_parser(
            name,
            help=module.SUMMARY,
            description=module.SUMMARY,
            epilog=examples,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(command)
        add_level_arguments(command)
        command.set_defaults(run=module.run, command=name)
    return parser


def _show_warning(message, category, filename, lineno, file=None, line=None) -> None:
    put(f"symid: warning: {message}")
