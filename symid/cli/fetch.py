"""`symid fetch`: public recordings that are not shipped."""

from __future__ import annotations

import argparse

SUMMARY = "download a public recording, check it, and say where it is"
EXAMPLES = ("symid fetch standing", "symid fetch standing --folder recordings/subject05", "symid fetch standing-raw")
WHAT = {
    "standing": "the article's recording: one standing person on a moving platform, 310 s, with body parameters",
    "standing-raw": "all that was measured: markers, forces and EMG of eight persons (Zenodo record 3819630, large)",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    told = "; ".join(f"{name}: {words}" for name, words in WHAT.items())
    parser.add_argument("what", choices=tuple(WHAT), metavar="WHAT", help=told)
    parser.add_argument(
        "--folder",
        metavar="DIRECTORY",
        help="where it is, or is to be put (default: what SYMID_STANDING names, else a folder of your cache)",
    )


def run(arguments: argparse.Namespace) -> int:
    from symid import fetch

    print({"standing": fetch.standing, "standing-raw": fetch.standing_raw}[arguments.what](arguments.folder))
    return 0
