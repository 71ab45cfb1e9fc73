"""Agreement of files made on different machines: bits are promised on one, the last written digit between two."""

import json
from decimal import Decimal
from pathlib import Path

DIGITS = 6
"""Significant digits of the numbers in a sealed answer."""


def assert_same_table(made: Path, shipped: Path) -> None:
    """Two CSV files with the same header, rows and decimals, whose numbers differ by a unit of the last at most."""
    rows = [[line.split(",") for line in file.read_text().splitlines()] for file in (made, shipped)]
    assert [len(r) for r in rows[0]] == [len(r) for r in rows[1]] and rows[0][0] == rows[1][0]
    for number, (new, old) in enumerate(zip(*(r[1:] for r in rows), strict=True), start=1):
        for a, b in zip(map(Decimal, new), map(Decimal, old), strict=True):
            unit = Decimal(1).scaleb(b.as_tuple().exponent)
            assert a == b or (a.as_tuple().exponent == b.as_tuple().exponent and abs(a - b) <= unit), (number, new, old)


def assert_same_document(made: Path, shipped: Path) -> None:
    """Two JSON files that are equal but for one unit of the last of `DIGITS` digits of their numbers."""
    _same(json.loads(made.read_text()), json.loads(shipped.read_text()), shipped.name)


def _same(new, old, place: str) -> None:
    if isinstance(old, dict):
        assert list(new) == list(old), place
        for key in old:
            _same(new[key], old[key], f"{place}: {key}")
    elif isinstance(old, list):
        assert len(new) == len(old), place
        for k, (a, b) in enumerate(zip(new, old, strict=True)):
            _same(a, b, f"{place}[{k}]")
    elif isinstance(old, float) and old:
        unit = Decimal(1).scaleb(Decimal(repr(old)).adjusted() - DIGITS + 1)
        assert abs(Decimal(repr(new)) - Decimal(repr(old))) <= unit, (place, new, old)
    else:
        assert new == old, place
