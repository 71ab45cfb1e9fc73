"""Units: text to SI factor, dimension checks, units in column names, numbers as a person reads them.

A thin layer over pint. Inside symid every number is SI; units are converted once, where a
file or a user's number enters. The units that column names may carry stand in one table
with their factors, so that reading a recording never waits for pint (0.5 s to import);
every other unit text goes through pint.

Legend of letters, used in all docstrings and array shapes:

====  =======================================  ====  =======================================
N     samples or nodes of a time grid          M     episodes
n     states of a model                        m     channels that are compared (outputs)
k     inputs known from a recording            q     unknown parameters
w     noise inputs (process noise)             h     sampling interval or mesh step [s]
x     state                                    x'    time derivative of the state
u     known input                              p     parameter
====  =======================================  ====  =======================================
"""

from symid.units.columns import HOW_NAMED, column_name, known_suffixes, split_column_name, without_unit
from symid.units.show import (
    in_unit,
    prefix_for,
    quantity,
    rough,
    shown_unit,
    time_unit,
    typeset,
    unit_for,
    unit_symbol,
    with_error,
)
from symid.units.si import (
    STANDARD_GRAVITY,
    FloatArray,
    IntArray,
    KnownUnit,
    base_unit,
    dimension,
    known_unit,
    nearest,
    reduced,
    same_dimension,
    si_factor,
)

__all__ = [
    "HOW_NAMED",
    "STANDARD_GRAVITY",
    "FloatArray",
    "IntArray",
    "KnownUnit",
    "base_unit",
    "column_name",
    "dimension",
    "known_suffixes",
    "known_unit",
    "nearest",
    "prefix_for",
    "quantity",
    "reduced",
    "in_unit",
    "rough",
    "same_dimension",
    "shown_unit",
    "si_factor",
    "split_column_name",
    "time_unit",
    "typeset",
    "unit_for",
    "unit_symbol",
    "with_error",
    "without_unit",
]
