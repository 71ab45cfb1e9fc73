"""The command line: `symid COMMAND`, one file for each command."""

from symid.cli.main import main

__all__ = ["main"]
