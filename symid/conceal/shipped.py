"""The cases that ship in ``data/concealed``: ``python -m symid.conceal.shipped [FOLDER]`` writes them anew."""

from __future__ import annotations

import sys
from pathlib import Path

from symid.conceal.conceal import Concealed
from symid.conceal.draw import draw_case
from symid.conceal.write import write_case

SHIPPED = {
    "s01": ("standing", "two", 2053),
    "s02": ("standing", "none", 2080),
    "s03": ("standing", "single", 2028),
    "r01": ("rig", "single", 2026),
    "r02": ("rig", "two", 2027),
    "r03": ("rig", "none", 2023),
}
"""Name -> system, kind, seed. What is concealed stands in the sealed answers alone."""


def shipped_case(name: str) -> Concealed:
    """One of `SHIPPED`, made anew."""
    system, kind, seed = SHIPPED[name]
    return draw_case(system, None, (seed, 0), kind)


def write_shipped(folder: str | Path) -> None:
    """Write all of them below `folder`."""
    for name in SHIPPED:
        write_case(shipped_case(name), folder, name)


if __name__ == "__main__":
    write_shipped(sys.argv[1] if len(sys.argv) > 1 else "data/concealed")
