"""Parts of a page: tables, numbers, equations."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import ROOT, pendulum, pendulum_recording

import symid as si
from symid.mechanics.missing.unknown_laws import unknown_sensor
from symid.model import show
from symid.plots.style import banded, bridged
from symid.report import page, report_html
from symid.report.diagnosis import _parameters
from symid.report.origin import command
from symid.units import without_unit


def test_words_in_equations_are_no_products_of_letters():
    text = report_html(si.Identification(pendulum(), pendulum_recording()).solve(max_iterations=1))
    latex = "".join(show.latex_lines(pendulum()))
    assert r"\mathrm{damping}" in latex and r"\: " in latex and 'mathvariant="normal">d' in text


def test_numbers_stand_below_each_other_and_long_names_may_go_on_in_the_next_line():
    text = page.table(["name", "score"], [["a_long_name", "4,575.5"], ["b", "−5.3"]])
    assert '<th class="n">score' in text and "a_<wbr>long_<wbr>name" in text
    assert '<th class="">when' in page.table(["when"], [["always"], ["1"]])


def test_text_is_escaped():
    assert "<script>" not in page.page(
        "<script>",
        page.paragraph("<script>"),
        page.table(["<script>"], [["<script>"]]),
        page.facts({"<script>": "<script>"}),
    )


@pytest.mark.parametrize(
    ("value", "shown"), [(float("nan"), "none"), (float("inf"), "∞"), (-1234.567, "−1234.6"), (True, "yes"), (12, "12")]
)
def test_numbers(value, shown):
    assert page.number(value) == shown


def test_rates_have_primes_that_are_seen():
    """A prime above a word is a hair in a browser: it stands beside the letters, also of a part with an index."""
    m = si.Model("m")
    m.speed, m.other = si.State(unit="m/s", index=range(2)), si.State(unit="m/s")
    m.a = si.Equation({i: m.speed[i].dot + m.other for i in range(2)})
    m.b = si.Equation(m.other.dot + m.speed[0])
    mathml = page.equations(show.latex_lines(m))
    assert mathml.count("<mo>&#x02032;</mo></mrow>") == 3 and "msubsup" not in mathml and "msup" not in mathml


def test_a_minus_is_long_in_words_and_a_hyphen_stays():
    assert "outside −0.145 m/s" in page.paragraph("outside -0.145 m/s")
    assert "pages 25-57, --body" in page.paragraph("pages 25-57, --body")


def test_dense_frequencies_are_drawn_by_their_means():
    """Noise of a thousand frequencies is a line, no dark area; what stands apart stays as it is."""
    frequency = np.arange(1, 1001) * 0.05
    power = np.random.default_rng(0).exponential(size=1000)
    f, p = banded(frequency, power)
    assert np.array_equal(f[:5], frequency[:5]) and np.array_equal(p[:5], power[:5])
    assert len(f) < 90 and np.abs(p[-5:] - 1).max() < 0.5 and np.all(np.diff(f) > 0)


@pytest.mark.parametrize(
    "key, said",
    [
        ("k2_Nm_rad2", "k2"),
        ("time_constant_s", "time constant"),
        ("coefficient_N_s2_m2", "coefficient"),
        ("g_scale", "g scale"),
        ("coefficient_Nm_s2_rad2", "coefficient"),
        ("delay_s", "delay"),
    ],
)
def test_a_parameter_is_called_without_its_unit(key, said):
    assert without_unit(key) == said


def test_coefficients_without_a_formula_are_folded_and_a_bound_is_named():
    body = si.mechanics.DoubleLinkPendulum.from_json(ROOT / "data" / "standing_synthetic" / "body.json")
    model = body.with_feedback(si.mechanics.PD()).with_term(
        unknown_sensor({"sensor:ankle": 1.0}, (0, 10)).at("sensor:ankle")
    )
    values = dict.fromkeys(model.parameters, 0.01) | {"kp_ankle": 0.0}
    found = SimpleNamespace(
        improved=model, values=values, baseline=SimpleNamespace(values={}), final=SimpleNamespace(errors={}), named=()
    )
    table, fold = _parameters(found)
    assert (
        "unknown_" not in str(table) and "0 N m/rad at its bound" in str(table) and "standard error" not in str(table)
    )
    assert "<details>" in str(fold) and str(fold).count("<small>unknown sensor error, the sensor of the ankle: c") > 5


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["/x/bin/symid", "demo"], "symid demo"),
        (["/x/symid/cli/__main__.py", "demo"], "symid demo"),
        (["/x/ipykernel_launcher.py", "-f", "/tmp/kernel.json"], "in a notebook"),
        (["walk.py"], "walk.py"),
        ([""], "python"),
        ([], "python"),
    ],
)
def test_a_command_is_told_as_one_would_type_it(words, said):
    assert command(words) == said


def test_a_gap_is_no_noise_at_high_frequencies():
    values = np.sin(0.02 * np.arange(1000)) + 3
    gapped = np.where(np.abs(np.arange(1000) - 500) < 15, np.nan, values)
    assert np.abs(bridged(gapped) - values).max() < 0.05 and np.array_equal(bridged(values), values)
