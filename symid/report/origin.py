"""Where a report comes from, and whom it owes: date, version, command, papers."""

from __future__ import annotations

import platform
import shlex
import sys
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

CITATION = (
    "H. Wang and A. J. van den Bogert (2020). Identification of the human postural control system through "
    "stochastic trajectory "
    "optimization. Journal of Neuroscience Methods 334, 108580. doi:10.1016/j.jneumeth.2020.108580 (the method)",
    "A. Wächter and L. T. Biegler (2006). On the implementation of an interior-point filter line-search algorithm for "
    "large-scale nonlinear programming. Mathematical Programming 106, 25-57. "
    "doi:10.1007/s10107-004-0559-y (Ipopt, the solver)",
)


def origin() -> dict[str, str]:
    """When, with which versions and by which command this is written."""
    return {
        "written": datetime.now(UTC).isoformat(timespec="seconds"),
        "symid": version("symid"),
        "python": platform.python_version(),
        "command": command(sys.argv),
    }


def command(words: Sequence[str]) -> str:
    """A command line as one would type it, without the folder of the program."""
    program = Path(words[0] if words else "")
    if program.name == "ipykernel_launcher.py":
        return "in a notebook"
    name = "symid" if program.parts[-3:] == ("symid", "cli", "__main__.py") else program.name or "python"
    return shlex.join([name, *words[1:]])


def written() -> str:
    """Foot of a page."""
    return f"Written by symid {version('symid')} on {datetime.now(UTC):%Y-%m-%d}."
