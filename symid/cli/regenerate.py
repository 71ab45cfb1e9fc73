"""`symid regenerate`: bring the generated sources of the shipped models up to date, or check them."""

from __future__ import annotations

import argparse

SUMMARY = "rewrite the generated C sources of the shipped models, or check that they are current"
EXAMPLES = ("symid regenerate --check",)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 if a source is not current")


def run(arguments: argparse.Namespace) -> int:
    import symid.regenerate

    return symid.regenerate.main(["--check"] if arguments.check else [])
