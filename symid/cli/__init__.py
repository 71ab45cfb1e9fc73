"""The command line: `symid COMMAND`, one file for each command."""

import sys

try:
    from symid.cli.main import main
except KeyboardInterrupt:  # before `main` can say so
    print("symid: interrupted", file=sys.stderr)
    sys.exit(130)

__all__ = ["main"]
