"""Numbers with units as a person reads them: degrees, prefixes, and as many digits as the error allows."""

import re
from math import floor, isfinite, log10

from symid.units.si import known_unit

_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_PREFIX_BELOW = {"s": 1.0, "m": 0.1}
"""Size below which a unit is read with a prefix; 0.01 for those that are not listed."""
_PREFIXES = {"": 1.0, "m": 1e3, "µ": 1e6, "n": 1e9, "p": 1e12}
"""Of the SI, each with the factor to numbers in the unit that it makes."""
_PREFIXED = ("N", "m", "s", "V", "A", "W", "J")
"""What the first unit of a text may be to take a prefix: N m/rad becomes mN m/rad."""
UNSURE = 100.0
"""A value with an error this many times larger is not worth digits."""
PLAIN = 1e-4, 1e7
"""Numbers between these are written without a power of ten."""
COMPARED = 1e-3
"""Values that are compared have one unit down to this ratio; below it the smaller one would show no digits."""
TINY = 1e-300
"""Numbers below this one, whose power of ten a double cannot hold, are written as 0."""


def unit_symbol(unit: str) -> str:
    """A unit text as it is printed: ``"N*m*s/rad"`` as ``"N m s/rad"``, ``"1/m/s^2"`` as ``"1/(m s²)"``."""
    text = "" if unit in ("", "1") else unit.replace("**", "^").replace("*", " ")
    # There is no raised point: a root stays m^2.5.
    base = re.sub(r"\^(-?\d+)(?![\d.])", lambda power: power[1].translate(_RAISED), text)
    above, *below = base.split("/")
    return f"{above}/({' '.join(below)})" if len(below) > 1 and "(" not in base else base


def shown_unit(unit: str) -> tuple[str, float]:
    """The unit in which a person reads a signal in the SI unit `unit`, and the factor to it: degrees for angles."""
    known = known_unit(unit or "1")
    if known.si in ("rad", "rad/s", "rad/s^2"):
        degree = known_unit(known.si.replace("rad", "deg"))
        return unit_symbol(degree.text), 1 / degree.factor
    return unit_symbol(unit), 1.0


def with_error(value: float, error: float, digits: int = 3) -> str:
    """A value and its standard error, both to the second digit of the error: ``"630 ± 100"``, ``"0.0520 ± 0.0040"``.

    An error that is not known, zero, or a hundred times the value leaves the value alone, to `digits` digits or two.
    """
    if not isfinite(value):
        return "not known"
    value = value if abs(value) > TINY else 0.0
    if not (isfinite(error) and error > TINY):
        return _plain(value, digits)
    if error > UNSURE * abs(value) > 0:
        return f"{_plain(value, 2)} (hardly determined)"
    place = floor(log10(error)) - 1
    place += round(error / 10.0**place) >= 100  # 0.0996 is rounded to 0.10
    size = max(abs(value), error)
    if not PLAIN[0] <= size < PLAIN[1]:
        power = floor(log10(size))
        scaled = with_error(value / 10.0**power, error / 10.0**power)
        return f"({scaled})·10{str(power).translate(_RAISED)}"
    decimals = max(0, -place)
    return f"{_rounded(value, place):.{decimals}f} ± {_rounded(error, place):.{decimals}f}"


def in_unit(value: float, unit: str) -> str:
    """A value in the very unit in which a model states it: ``"0.3 kg m²"``."""
    return f"{value:.5g} {unit_symbol(unit)}".rstrip()


def rough(value: float, digits: int = 2) -> str:
    """A number in a sentence, to a few digits: ``120``, where Python's ``:.2g`` writes ``1.2e+02``."""
    return with_error(value, float("nan"), digits)


def quantity(value: float, error: float = float("nan"), unit: str = "1", digits: int = 3, beside: float = 0.0) -> str:
    """An SI value with its standard error in the unit that suits its size: ``"84.0 ± 3.0 ms"``, ``"5.2 ± 1.1 mN m"``.

    Parameters
    ----------
    unit : SI unit text, such as a part of a model states. Angles and their rates are told in degrees.
    digits : significant digits of a value whose error is not known.
    beside : a value that it is compared with: both are told in the unit of the larger one, unless that is far larger.
    """
    size = max(abs(value), error if isfinite(error) else 0.0)
    factor, text = _suitable(max(size, beside) if size > COMPARED * beside else size, unit)
    return f"{with_error(value * factor, error * factor, digits)} {text}".strip()


def typeset(number: str) -> str:
    """A number as Python writes it with its power raised and its minus long: ``-1e+05`` as ``−10⁵``."""

    def power(found: re.Match) -> str:
        digits, exponent = found[1], str(int(found[2])).translate(_RAISED)
        return f"10{exponent}" if digits == "1" else f"{digits}·10{exponent}"

    return re.sub(r"([\d.]+)e([+-]?\d+)", power, number).replace("-", "\N{MINUS SIGN}").replace("inf", "∞")


def unit_for(size: float, unit: str) -> tuple[str, float]:
    """The unit in which a person reads signals of up to this size in the SI unit `unit`, and the factor to it."""
    factor, text = _suitable(size, unit or "1")
    return text, factor


def time_unit(span: float) -> tuple[str, float]:
    """The unit in which a person reads a span of time [s], and the factor to it: from µs to days."""
    units = (("µs", 1e-6, 5e-4), ("ms", 1e-3, 0.5), ("s", 1.0, 3 * 3600.0), ("h", 3600.0, 10 * 86400.0))
    text, size = next(((text, size) for text, size, below in units if span < below), ("d", 86400.0))
    return text, 1 / size


def _suitable(size: float, unit: str) -> tuple[float, str]:
    """Factor to, and text of, the unit in which a number of this size is read."""
    symbol = unit_symbol(unit)
    shown, factor = shown_unit(unit)
    if factor != 1.0:
        return factor, shown
    first = symbol.replace("/", " ").split(" ")[0]
    if first not in _PREFIXED or not 0 < size < _PREFIX_BELOW.get(unit, 0.01):
        return 1.0, symbol
    prefix, factor = prefix_for(min(size, 1e-3))
    return factor, prefix + symbol


def prefix_for(size: float) -> tuple[str, float]:
    """The prefix with which numbers of this size are read, and the factor to them."""
    return next(((p, f) for p, f in _PREFIXES.items() if size * f >= 1), ("p", _PREFIXES["p"]))


def _rounded(x: float, place: int) -> float:
    """`x` to a multiple of 10^place; NumPy and Python disagree about negative digits of floats, this does not."""
    return round(x / 10.0**place) * 10.0**place if place > 0 else x


def _plain(x: float, digits: int) -> str:
    """So many significant digits, as a power of ten only where it is far from one."""
    if x == 0:
        return "0"
    if PLAIN[0] <= abs(x) < PLAIN[1]:
        decimals = digits - 1 - floor(log10(abs(x)))
        return f"{_rounded(x, -decimals):.{max(decimals, 0)}f}"
    power = floor(log10(abs(x)))
    return f"{x / 10.0**power:.{digits - 1}f}·10{str(power).translate(_RAISED)}"
