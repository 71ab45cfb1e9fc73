"""`symid conceal`: make cases with concealed physics, and their sealed answers."""

from __future__ import annotations

import argparse
from pathlib import Path

from symid.cli.options import show
from symid.progress import say

SUMMARY = "write recordings with concealed physics, and sealed answers, to test a diagnosis"
EXAMPLES = ("symid conceal practice --system standing --random --count 4",)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("folder", metavar="OUT_DIR", help="gets cases/<id>/ and sealed/<id>.json")
    parser.add_argument(
        "--system",
        default="standing",
        metavar="standing|rig|CASE.json",
        help="a person on a platform (default), a double pendulum, or one like that of a case file",
    )
    parser.add_argument(
        "--effect",
        action="append",
        default=[],
        metavar="NAME@PLACE[:KEY=VALUE,...]",
        help="what to conceal, twice for two; sizes that are not given are drawn",
    )
    parser.add_argument(
        "--random", action="store_true", help="conceal one random effect, two, none, or an unlisted one"
    )
    parser.add_argument(
        "--equivalents",
        action="store_true",
        help="also establish which other answers the recording cannot tell from the truth (up to a minute each)",
    )
    parser.add_argument("--seed", type=int, default=0, help="the same seed gives the same files (default: 0)")
    parser.add_argument("--count", type=int, default=1, metavar="N", help="how many cases (default: 1)")


def run(arguments: argparse.Namespace) -> int:
    from symid.conceal import draw_case, with_equivalents, write_case
    from symid.conceal.magnitudes import parse_effect
    from symid.conceal.setup import SYSTEMS
    from symid.conceal.write import next_name
    from symid.errors import SymidError

    if arguments.count < 1 or arguments.seed < 0:
        raise SymidError(
            f"conceal: --count {arguments.count} --seed {arguments.seed} is not possible; give at least one case, "
            "and a seed that is not negative"
        )
    if arguments.random and arguments.effect:
        raise SymidError("conceal: give --effect or --random, not both")
    effects = None if arguments.random else [parse_effect(text) for text in arguments.effect]
    system = arguments.system if arguments.system in SYSTEMS else _imitated(arguments.system)
    for number in range(arguments.count):
        case = draw_case(system, effects, (arguments.seed, number))
        case = with_equivalents(case) if arguments.equivalents else case
        name = next_name(arguments.folder, case.setup.system)
        directory = write_case(case, arguments.folder, name)
        show(f"{directory}: {len(case.recording)} samples")
        say(f"case {number + 1} of {arguments.count} is made")
    return 0


def _imitated(path: str) -> dict:
    from symid.errors import SymidError
    from symid.files import read_json

    if not Path(path).is_file():
        raise SymidError(f"conceal: no system '{path}' and no such file; give standing, rig or a case.json")
    content = read_json(path)
    if not isinstance(content, dict):
        raise SymidError(f"{path}: a case.json with its JSON object is expected")
    return content
