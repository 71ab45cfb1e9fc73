"""`symid completion`: a script with which the shell completes commands and options."""

from __future__ import annotations

import argparse

SUMMARY = "print a script with which bash, zsh or tcsh completes commands and options"
EXAMPLES = ('eval "$(symid completion bash)"',)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("shell", choices=("bash", "zsh", "tcsh"))


def run(arguments: argparse.Namespace) -> int:
    import shtab

    from symid.cli.main import build_parser

    print(shtab.complete(build_parser(), arguments.shell))
    return 0
