"""Figures and reports: what they show, also where parameters sit at bounds or a solve failed."""

import io
import re
import sys
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from browser import assert_well_shown, needs_browser, seen
from conftest import pendulum, pendulum_recording
from PIL import Image

import symid as si
from symid import plots
from symid.plots import solution as solution_figures, style
from symid.report import report_html, solution as solution_report, write_report, write_study_report
from symid.units import with_error


@pytest.fixture(scope="module")
def solution():
    return si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve()


@pytest.fixture(scope="module")
def at_bound():
    model = pendulum().with_bounds(damping=(0, 0.1))
    return si.Identification(model, pendulum_recording(noise=0.01)).solve()


@pytest.fixture(scope="module")
def not_solved():
    return si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve(3, seed=1, max_iterations=1)


class Tags(HTMLParser):
    """Every opened tag is closed, and nothing is fetched."""

    def __init__(self):
        super().__init__()
        self.open, self.sources = [], []

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "img", "br", "source", "wbr"):
            self.open.append(tag)
        self.sources += [v for k, v in attributes if k in ("src", "srcset", "href")]

    def handle_startendtag(self, tag, attributes):
        """One that closes itself, as MathML's spaces do."""

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def lines_of(axes, colour):
    return [line for line in axes.lines if line.get_color() == colour and len(line.get_xdata()) > 2]


def test_fit_shows_the_recording_the_model_and_their_difference(solution):
    above, below = solution.plot().axes
    (recorded,), (model,) = lines_of(above, style.RECORDED), lines_of(above, style.MODEL)
    (residual,) = lines_of(below, style.WARN)
    frame = solution.trajectories[0]
    np.testing.assert_allclose(recorded.get_ydata(), np.rad2deg(frame["measured recorded"]))
    np.testing.assert_allclose(residual.get_ydata(), recorded.get_ydata() - model.get_ydata())
    assert f"{solution.fit['rms_deg']['all']:.3f}"[:4] in above.get_title(loc="left")


def test_parameters_show_value_and_95_percent_interval(solution):
    (axes,) = plots.plot_parameters(solution, {"damping": 0.4}).axes
    row = solution.parameters.loc["damping"]
    (interval,) = [line for line in axes.lines if line.get_linewidth() == 2 and len(line.get_xdata()) == 2]
    np.testing.assert_allclose(
        interval.get_xdata(), [row.value - 1.96 * row.std_error, row.value + 1.96 * row.std_error]
    )
    assert [line.get_xdata()[0] for line in axes.lines if line.get_marker() == "x"] == [0.4]
    assert with_error(row.value, row.std_error, digits=4) in [t.get_text() for t in axes.texts]


def test_a_parameter_at_a_bound_is_marked_everywhere(at_bound):
    assert at_bound.parameters.at_bound.all()
    (axes,) = plots.plot_parameters(at_bound).axes
    assert "at its bound" in axes.texts[0].get_text()
    assert '<tr class="mark">' in report_html(at_bound)
    assert "at its bound" in at_bound._repr_html_()


def test_an_interval_far_larger_than_the_values_does_not_hide_them():
    low, high = solution_figures._limits(np.array([1.0, 2.0]), np.array([1e6, 0.1]), [])
    assert -2 < low < 1 and 2 < high < 5


def test_intervals_that_are_alike_are_whole():
    """Though the values are nearer to each other than their errors."""
    low, high = solution_figures._limits(np.array([-1.42e-3, -6e-4]), np.array([1.7e-3, 1.65e-3]), [])
    assert low < -3.12e-3 and high > 1.05e-3


@pytest.mark.parametrize("value", [np.array([0.0]), np.array([-1e-9]), np.array([3e7]), np.array([5.0, 5.0])])
def test_every_value_lies_on_its_axis(value):
    low, high = solution_figures._limits(value, np.full(value.shape, np.nan), [])
    assert low < value.min() and value.max() < high


def test_starts_show_every_start_and_which_failed(not_solved):
    assert not not_solved.solved
    left, right = plots.plot_starts(not_solved).axes
    assert sorted(x for line in left.lines for x in line.get_xdata()) == [1, 2, 3]
    assert [t.get_text() for t in left.get_legend().get_texts()] == ["not solved"]
    assert len(right.lines) == 3


def test_figures_show_themselves_without_pyplot(solution):
    assert "matplotlib.pyplot" not in sys.modules or "pyplot" not in vars(plots)
    for draw in (plots.plot_fit, plots.plot_parameters, plots.plot_starts):
        assert draw(solution)._repr_png_().startswith(b"\x89PNG")
        wide, _ = Image.open(io.BytesIO(draw(solution)._repr_png_())).size
        assert wide <= 120 * style.NOTEBOOK  # letters as large beside the figure as a phone needs


def test_report_is_one_whole_file(solution, tmp_path):
    path = write_report(solution, tmp_path / "new" / "report.html", held_out=solution.free_run((3.0, 6.0)))
    assert [p.name for p in path.parent.iterdir()] == ["report.html"]
    tags = Tags()
    tags.feed(path.read_text(encoding="utf-8"))
    assert tags.open == []
    assert len(tags.sources) == 2 * 5 and all(s.startswith("data:image/png;base64,") for s in tags.sources)
    text = path.read_text()
    for part in (
        "Parameters",
        "Fit",
        "Starts",
        "Solver",
        "Provenance",
        "held out, free run",
        "midpoint",
        "damping",
        "<math",
        "Held out, 3 to 6 s",
        "doi:10.1016/j.jneumeth.2020.108580",
        f"symid {si.__version__}",
    ):
        assert part in text


def test_report_of_a_failed_solve_says_so_and_has_all_starts(not_solved):
    text = report_html(not_solved)
    assert "NOT SOLVED" in text and "no standard errors" in text and "Where each start ended" in text
    assert len(re.findall(r"maximum iterations exceeded", text)) >= 3


def test_report_shows_a_few_episodes_not_fifty():
    problem = si.Identification(pendulum(), pendulum_recording(), episodes=si.Episodes(5, push=0.1))
    assert report_html(problem.solve()).count("Recorded, model and residual") == 2 * 3  # caption and alt text


def test_a_report_that_cannot_be_drawn_leaves_the_old_one(solution, tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    path.write_text("old")
    monkeypatch.setattr(plots.Picture, "png", lambda self, **_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_report(solution, path)
    assert path.read_text() == "old" and len(list(tmp_path.iterdir())) == 1


def test_a_long_recording_also_shows_a_stretch_whose_error_is_typical():
    solution = si.Identification(pendulum(), pendulum_recording(duration=60.0, noise=0.01)).solve()
    t0, t1 = plots.typical_stretch(solution)
    swings = np.flatnonzero(np.diff(np.sign(solution.trajectories[0]["measured"].loc[t0:t1])) > 0)
    assert len(swings) == pytest.approx(solution_figures.SWINGS, abs=2)
    error = solution.trajectories[0]["measured"] - solution.trajectories[0]["measured recorded"]
    assert error.loc[t0:t1].std() == pytest.approx(error.std(), rel=0.1)
    assert plots.plot_fit(solution, 0, (t0, t1)).axes[0].get_xlim() == (t0, t1)
    assert plots.typical_stretch(si.Identification(pendulum(), pendulum_recording()).solve()) is None


@pytest.mark.parametrize(
    "pace", [1e-5, pytest.param(1.0, marks=pytest.mark.slow), pytest.param(1e5, marks=pytest.mark.slow)]
)
def test_figures_suit_the_pace_and_the_size_of_any_system(pace, tmp_path):
    """Micrometres in milliseconds, metres in seconds and metres in days; each time axis has its own unit."""
    size = 1e-6 if pace < 1 else 1.0
    m = si.Model("rod")
    m.place, m.speed = si.State(unit="m"), si.State(unit="m/s")
    m.stiffness = si.Parameter(unit="1/s^2", bounds=(1 / pace**2, 100 / pace**2))
    m.kinematics = si.Equation(m.place.dot - m.speed)
    m.balance = si.Equation(m.speed.dot + m.stiffness * m.place)
    m.seen = si.Output(m.place, channel="place")
    time = pace * np.linspace(0, 60, 1200)
    place = size * (np.cos(3 * time / pace) + 0.01 * np.random.default_rng(2).standard_normal(time.size))
    solution = si.Identification(m, si.Recording("rod", time, {"place": place}, {"place": "m"})).solve()
    above, below = plots.plot_fit(solution).axes
    unit, factor = {1e-5: ("ms", 1e3), 1.0: ("s", 1.0), 1e5: ("d", 1 / 86400)}[pace]
    assert below.get_xlabel() == f"time [{unit}]" and below.get_xlim()[1] == pytest.approx(60 * pace * factor)
    assert above.get_ylabel() == ("µm" if size < 1 else "m") and np.abs(above.lines[1].get_ydata()).max() < 1.5
    assert below.get_ylabel().endswith("nm" if size < 1 else "mm")
    t0, t1 = plots.typical_stretch(solution)
    assert 5 < (t1 - t0) / (2 * np.pi / 3 * pace) < 11
    assert "</html>" in report_html(solution)


def test_estimates_that_move_together_are_named(solution):
    assert "move together" not in report_html(solution)
    covariance = np.array([[1.0, -0.99], [-0.99, 1.0]])
    both = SimpleNamespace(covariance=pd.DataFrame(covariance), values={"stiffness": 1.0, "mass": 2.0})
    (told,) = solution_report._together(both)
    assert "stiffness and mass (−0.99)" in told


@needs_browser
def test_the_look_in_a_browser_finds_what_is_wrong(tmp_path):
    content = '<p style="width:600px">wide</p><img src="data:image/png;base64,AAAA">'
    (tmp_path / "bad.html").write_text(f'<main>{content}</main><script>console.error("x")</script>')
    desk, phone = seen(tmp_path / "bad.html")
    assert desk["overflow"] == 0 < phone["overflow"] and phone["wide"] and desk["empty"] == 1 and desk["console"]


@needs_browser
def test_in_a_browser_a_report_is_whole_on_a_desk_and_on_a_phone(solution, tmp_path):
    assert_well_shown(write_report(solution, tmp_path / "report.html", solution.free_run((3.0, 6.0))), figures=5)


@pytest.fixture(scope="module")
def study():
    problems = {"free": pendulum(), "bounded": pendulum().with_bounds(damping=(0, 0.1))}
    problems = {k: si.Identification(m, pendulum_recording(noise=0.01)) for k, m in problems.items()}
    return si.Study.product(problems, starts=2, max_iterations=60).run_here(on_finished=None)


def test_the_report_of_a_study_has_every_problem_and_solve(study, tmp_path):
    text = write_study_report(study, tmp_path / "study.html", "Two models").read_text()
    assert "4 of 4 solves of 2 problems" in text
    for part in ("Two models", "free/0", "bounded/1", "2 of 2", "at the same optimum", "Provenance", "Please cite"):
        assert part in text
    assert ">the same<" in text and "hollow" not in text
    assert [t.get_text() for t in plots.plot_study(study).axes[0].texts] == ["free", "bounded"]


def test_solves_that_ended_alike_are_not_cut_off_at_the_edge(study):
    for axes in plots.plot_study(study).axes:
        (low, high), largest = axes.get_xlim(), max(line.get_xdata()[0] for line in axes.lines)
        assert low <= 0 and high - largest > 0.03 * (high - low)


@needs_browser
def test_in_a_browser_the_report_of_a_study_is_whole(study, tmp_path):
    assert_well_shown(write_study_report(study, tmp_path / "study.html"), figures=1)


def test_an_interval_beyond_a_bound_is_remarked(solution):
    assert "reaches beyond a bound" not in report_html(solution)
    p = solution.parameters.loc["damping"]
    near = pendulum().with_bounds(damping=(p.value - p.std_error, 5))
    told = report_html(si.Identification(near, pendulum_recording(noise=0.01)).solve())
    assert "reaches beyond a bound: damping (lower bound" in told


def test_starts_that_agree_are_drawn_at_one_place_with_the_numbers_of_the_table():
    solution = si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve(3, seed=1)
    left, right = plots.plot_starts(solution).axes
    drawn = {x: y for line in left.lines for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True)}
    assert drawn == {r.number + 1: pytest.approx(np.rad2deg(r.rms)) for r in solution.starts}
    assert np.ptp(left.get_ylim()) > 0.01 * solution.fit["rms_deg"]["all"] and right.get_xlim()[1] >= 1


def test_a_problem_shows_what_will_be_solved_and_builds_nothing():
    problem = si.Identification(
        pendulum(),
        pendulum_recording(),
        window=(0, 2),
        episodes=si.Episodes(3, push=0.1, seed=5),
        weights={"measured": 2.0},
    )
    assert "transcription" not in vars(problem)
    for text in (repr(problem), problem._repr_html_()):
        for part in (
            "driven pendulum",
            "damping",
            "0 s to 2 s",
            "angle (weight 2)",
            "midpoint",
            "3, multisine noise, seed 5",
        ):
            assert part in text
    assert "transcription" not in vars(problem)
