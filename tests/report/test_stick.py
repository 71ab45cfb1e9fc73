"""Stick figures stand where trigonometry says; the animation moves; a live plot follows the solve."""

import io

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording
from PIL import Image

import symid as si
from symid.mechanics import Chain, FullStatePD, rig_model, skeleton
from symid.plots import animate, plot_poses
from symid.plots.live import LivePlot
from symid.plots.style import NOTEBOOK
from symid.report import report_html
from symid.simulation import Simulator


@pytest.mark.parametrize("upright", [True, False])
@pytest.mark.parametrize("absolute", [True, False])
def test_joints_stand_where_trigonometry_says(upright, absolute):
    body = skeleton(Chain.uniform(2, length=0.5, upright=upright, absolute=absolute).plant())
    first, second = 0.3, -0.8
    angle = second if absolute else first + second
    (joints,) = body.positions([[first, second, 9.0, 9.0]])
    sign = 1 if upright else -1
    elbow = 0.5 * np.array([np.sin(first), sign * np.cos(first)])
    np.testing.assert_allclose(joints, [[0, 0], elbow, elbow + 0.5 * np.array([np.sin(angle), sign * np.cos(angle)])])


def test_links_keep_their_lengths_whatever_was_added_to_the_model():
    rig = rig_model(
        {"m1_kg": 0.1, "a1_m": 0.2, "I1_kg_m2": 1e-3, "L1_m": 0.3, "m2_kg": 0.1, "a2_m": 0.1, "I2_kg_m2": 1e-3}
    )
    body = skeleton(rig.with_term(si.mechanics.LIBRARY["viscous_friction"].at("joint1")))
    joints = body.positions(np.random.default_rng(0).uniform(-3, 3, (20, 4)))
    np.testing.assert_allclose(np.linalg.norm(np.diff(joints, axis=1), axis=2), [[0.3, 0.2]] * 20)
    closed = Chain.uniform(2, upright=True).with_feedback(FullStatePD())
    assert skeleton(closed).states == tuple(closed.states)


def test_a_model_that_is_no_chain_has_no_stick_figure():
    with pytest.raises(si.ModelError, match="no planar chain"):
        skeleton(pendulum())
    solution = si.Identification(pendulum(), pendulum_recording()).solve()
    with pytest.raises(si.ModelError, match="no planar chain"):
        plot_poses(solution)


def swing_with(missing: slice) -> si.Solution:
    rig = rig_model({"m1_kg": 0.1, "a1_m": 0.2, "I1_kg_m2": 1e-3}, ["link1_angle"], friction=["joint1"])
    time = np.arange(0, 2, 0.02)
    run = Simulator(rig).simulate({next(iter(rig.parameters)): 1e-3}, {"link1_angle": 1.0, "link1_velocity": 0.0}, time)
    noise = 0.05 * np.random.default_rng(0).standard_normal(len(time))
    angle = run.states["link1_angle"] + noise
    angle[missing] = np.nan
    return si.Identification(rig, si.Recording("swing", time, {"link1_angle": angle}, {"link1_angle": "rad"})).solve()


@pytest.fixture(scope="module")
def swing():
    return swing_with(slice(0, 0))


def test_a_recording_with_a_gap_has_a_report_with_its_stick_figure():
    text = report_html(swing_with(slice(20, 30)))
    assert "The body at some instants" in text


def test_poses_show_the_recording_below_the_model(swing):
    panels = plot_poses(swing, window=(0.5, 1.5)).axes
    frame = swing.trajectories[0].loc[0.5:1.5]
    for axes, row in zip(panels, np.linspace(0, len(frame) - 1, len(panels)).round().astype(int), strict=True):
        recorded, model = (line.get_xydata() for line in axes.lines[-2:])
        for joints, column in ((recorded, "measured_link1_angle recorded"), (model, "link1_angle")):
            angle = frame[column].iloc[row]
            np.testing.assert_allclose(joints[1], [0.4 * np.sin(angle), -0.4 * np.cos(angle)])


def test_an_animation_has_a_frame_for_each_instant_and_moves(swing, tmp_path):
    path = animate(swing, window=(0.0, 1.0), speed=0.5).save(tmp_path / "swing.gif")
    film = Image.open(path)
    assert film.n_frames * film.info["duration"] == pytest.approx(2000, abs=80)  # a second at half its speed
    first = np.asarray(film.convert("L"), float)
    film.seek(film.n_frames - 1)
    assert np.abs(np.asarray(film.convert("L"), float) - first).max() > 50


def test_a_live_plot_follows_the_solve(monkeypatch):
    shown = []

    class Display:
        def update(self, figure):
            shown.append(figure)

    def display(figure, display_id):
        shown.append(figure)
        return Display()

    monkeypatch.setattr("IPython.display.display", display)
    monkeypatch.setattr("symid.plots.live.EVERY_S", 0.0)
    live = LivePlot()
    solution = si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve(on_iteration=live)
    assert len(shown) == len(live.iterations) >= solution.result.iterations
    left, right = shown[-1].axes
    assert left.lines[0].get_ydata()[-1] == live.iterations[-1].objective and len(right.lines) == 2
    assert Image.open(io.BytesIO(live._repr_png_())).size[0] > 100


def test_starts_are_drawn_apart_while_they_are_solved():
    live = LivePlot()
    live._show = lambda: None
    si.Identification(pendulum(), pendulum_recording(noise=0.01)).solve(2, seed=1, on_iteration=live)
    left, right = live.figure().axes
    assert len(left.lines) == 2 and len(right.lines) == 4
    assert all((np.diff(line.get_xdata()) > 0).all() for line in (*left.lines, *right.lines))
    assert left.get_title(loc="left").startswith("start 2: objective")
    figure = left.figure
    figure.set_size_inches(NOTEBOOK, figure.get_figheight())
    figure.draw_without_rendering()
    title, (legend,) = left._left_title.get_window_extent(), [one.get_window_extent() for one in figure.legends]
    assert not title.overlaps(legend) and 0 <= legend.x0 < legend.x1 <= figure.bbox.x1 and title.x1 <= figure.bbox.x1
