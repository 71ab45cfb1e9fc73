"""Units: factors agree with pint, column names go both ways, dimensions can be calculated with."""

import math
import subprocess
import sys

import pytest
from hypothesis import example, given, settings, strategies as st

from symid import units
from symid.errors import RecordingError, UnitError
from symid.units import column_name, dimension, known_unit, same_dimension, si_factor, split_column_name
from symid.units.dimension import SI, Dimension


@pytest.mark.parametrize("suffix", units.si.SUFFIXES)
def test_the_table_of_column_units_agrees_with_pint(suffix):
    unit = units.si.SUFFIXES[suffix]
    factor, _ = units.si.base_of(unit.text)
    assert unit.factor == pytest.approx(factor, rel=1e-14)
    assert units.si.base_of(unit.si)[0] == 1.0
    assert dimension(unit.si) == dimension(unit.text)


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("deg", math.pi / 180),
        ("mm", 1e-3),
        ("ms", 1e-3),
        ("g", 1e-3),  # gram
        ("g0", 9.80665),
        ("deg/s^2", math.pi / 180),
        ("deg/s**2", math.pi / 180),
        ("km/hour", 1 / 3.6),
        ("kN*mm", 1.0),
        ("rpm", 2 * math.pi / 60),
        ("", 1.0),
        ("1", 1.0),
    ],
)
def test_si_factor(text, factor):
    assert si_factor(text) == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize("text", ["N*m", "Nm", "N m", "N · m", " N * m ", "N*m "])
def test_one_unit_in_many_spellings(text):
    assert known_unit(text).text == "N*m"


def test_si_text_of_a_unit_outside_the_table():
    assert known_unit("km") == ("km", "m", 1000.0)
    assert known_unit("W") == ("W", "W", 1.0)


def test_dimensions_multiply_divide_and_have_powers():
    assert dimension("N*m*s/rad") == dimension("N") * dimension("m") * dimension("s")
    assert dimension("rad/s^2") == dimension("s") ** -2 == dimension("1") / dimension("s") ** 2
    assert dimension("kg*m^2") * dimension("rad/s^2") == dimension("N*m")
    assert dimension("N*m") != dimension("N")


@given(
    st.lists(st.tuples(st.sampled_from(sorted(SI)), st.integers(1, 4), st.sampled_from("*/")), min_size=1, max_size=4)
)
@settings(max_examples=60, deadline=None)
def test_dimensions_of_products_of_the_si_agree_with_pint(parts):
    text = "1" + "".join(f"{sign}{unit}^{power}" for unit, power, sign in parts)
    found = dimension(text)
    assert found == Dimension(units.si.parsed(text).dimensionality)
    assert hash(found) == hash(Dimension(dict(found.items())))


def test_a_dimension_is_written_in_base_quantities():
    assert str(dimension("N*m")) == "[length] ** 2 * [mass] / [time] ** 2"
    assert str(dimension("1/s")) == "1 / [time]" and str(dimension("rad")) == "dimensionless"


def test_an_angle_is_dimensionless():
    assert same_dimension("deg", "rad") and same_dimension("rad", "1")
    assert not same_dimension("rad", "m")
    assert not same_dimension("g", "m/s^2") and same_dimension("g0", "m/s^2")


@pytest.mark.parametrize(
    ("column", "expected"),
    [
        ("ankle_angle_deg", ("ankle_angle", "deg")),
        ("platform_acceleration_m_s2", ("platform_acceleration", "m/s^2")),
        ("ankle_velocity_deg_s", ("ankle_velocity", "deg/s")),
        ("stiffness_Nm_rad", ("stiffness", "N*m/rad")),
        ("damping_Nm_s_rad", ("damping", "N*m*s/rad")),
        ("damping_Nms_rad", ("damping", "N*m*s/rad")),
        ("k1_N_m_s_rad", ("k1", "N*m*s/rad")),
        ("I_L_kg_m2", ("I_L", "kg*m^2")),
        ("l_L_m", ("l_L", "m")),
        ("m_T_kg", ("m_T", "kg")),
        ("g_m_s2", ("g", "m/s^2")),
        ("time_s", ("time", "s")),
        ("activation_1", ("activation", "1")),
        ("head_acceleration_g", ("head_acceleration", "g0")),
        ("finger_mass_g", ("finger_mass", "g")),
    ],
)
def test_column_names_are_taken_apart(column, expected):
    assert split_column_name(column) == expected


@given(
    st.from_regex(r"[A-Za-z][A-Za-z0-9]{0,5}(_[a-z]{4,8}){0,2}", fullmatch=True),
    st.sampled_from(sorted({u.text for u in units.si.SUFFIXES.values()})),
)
def test_column_names_go_both_ways(name, unit):
    assert split_column_name(column_name(name, unit)) == (name, unit)


def test_a_column_name_is_found_for_a_unit_in_other_order():
    assert column_name("damping", "m*N*s/rad") == "damping_Nm_s_rad"


@pytest.mark.parametrize(
    ("column", "message"),
    [
        ("ankle_angle_degrees", "'ankle_angle_degrees' does not end in a known unit.*deg"),
        ("ankle_angle_rads", "nearest known units: .*rad"),
        ("ankle_angle", "'ankle_angle' does not end in a known unit; a column is named as ankle_angle_deg"),
        ("deg", "does not end in a known unit"),
        ("_deg", "does not end in a known unit"),
        ("weight_g", "gram or standard gravity"),
    ],
)
def test_column_names_that_are_refused(column, message):
    with pytest.raises(RecordingError, match=message):
        split_column_name(column)


def test_a_unit_that_no_column_can_carry():
    with pytest.raises(RecordingError, match="'moment' has the unit kg\\*m"):
        column_name("moment", "kg*m")


@pytest.mark.parametrize(
    "ending, factor, si",
    [
        ("K", 1.0, "K"),
        ("W_per_K", 1.0, "W/K"),
        ("L_min", 1e-3 / 60, "m^3/s"),
        ("mol_per_m3", 1.0, "mol/m^3"),
        ("J_per_kg_K", 1.0, "J/(kg*K)"),
        ("kPa", 1e3, "Pa"),
        ("bar", 1e5, "Pa"),
        ("rpm", 2 * math.pi / 60, "rad/s"),
        ("mrad", 1e-3, "rad"),
        ("uNm", 1e-6, "N*m"),
        ("g_per_cm3", 1e3, "kg/m^3"),
        ("kohm", 1e3, "ohm"),
        ("1_per_s", 1.0, "1/s"),
    ],
)
def test_endings_that_are_built_by_rule(ending, factor, si):
    name, text = split_column_name(f"some_signal_{ending}")
    known = known_unit(text)
    assert name == "some_signal" and known.si == si and known.factor == pytest.approx(factor, rel=1e-14)
    back = split_column_name(column_name(name, known.si))
    assert back[0] == name and dimension(back[1]) == dimension(si)


@pytest.mark.parametrize("column", ["angle_min", "knee_L", "hip_h", "field_T", "a_per_s", "x_m_per", "per_s2x"])
def test_endings_that_may_mean_something_else_are_refused(column):
    with pytest.raises(RecordingError, match="does not end in a known unit"):
        split_column_name(column)


@pytest.mark.parametrize("text", ["rda", "m)", "(", "kg/", "m//s", "1e5", "N**", "?"])
def test_unit_texts_that_are_refused(text):
    with pytest.raises(UnitError, match="is not a unit that is understood"):
        si_factor(text)


def test_a_misspelt_unit_is_answered_with_the_nearest():
    with pytest.raises(UnitError, match="did you mean rad"):
        dimension("radd")


def test_a_unit_with_an_offset_is_refused():
    with pytest.raises(UnitError, match="has an offset"):
        si_factor("degC")


POWERS = st.tuples(
    st.sampled_from("kg m s A K mol cd rad Hz N Pa J W C V ohm F Wb T H S".split()), st.sampled_from(["", "^2", "^3"])
).map("".join)
PRODUCTS = st.tuples(
    st.one_of(POWERS, st.just("1")), st.lists(st.tuples(st.sampled_from("*/"), POWERS), max_size=3)
).map(lambda product: product[0] + "".join(sign + power for sign, power in product[1]))


@given(PRODUCTS, PRODUCTS)
@example("m", "mol")
@example("W", "Wb")
@settings(max_examples=300)
def test_products_of_si_units_are_what_pint_says(one, other):
    assert units.si.base_of(one)[0] == known_unit(one).factor == 1.0
    assert same_dimension(one, other) == (dimension(one) == dimension(other))
    assert same_dimension(f"{one}*rad", f"{one}/rad^2")


def test_usual_units_do_not_import_pint():
    code = (
        "import sys; from symid import units; "
        "units.known_unit(units.split_column_name('ankle_angle_deg')[1]); units.known_unit('N*s^2/m'); "
        "units.same_dimension('1/s^2', 'rad/s^2'); "
        "sys.exit('pint' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
