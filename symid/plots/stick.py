"""The body as a stick figure, recording beside model: poses side by side, and an animation."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from symid.files import write_atomically
from symid.mechanics.chains.skeleton import skeleton
from symid.plots.style import INK, MODEL, RECORDED, Picture

if TYPE_CHECKING:
    from symid.identification import Solution
    from symid.optimization import Plan

POSES = 6
SECONDS = 10.0
"""Of an animation, where no window is given."""
FRAME_S = 0.08
"""A GIF counts time in hundredths of a second."""


@dataclass(frozen=True, eq=False)
class Animation:
    """A moving picture, which a notebook shows as it is.

    Attributes
    ----------
    gif : the file's content.

    Examples
    --------
    >>> animate(fit, window=(0, 2)).save("swing.gif")               # doctest: +SKIP
    """

    gif: bytes

    def save(self, path: str | Path) -> Path:
        """Write the GIF to `path`, whole or not at all."""
        return write_atomically(path, self.gif)

    def _repr_mimebundle_(self, include=None, exclude=None) -> dict[str, bytes]:
        return {"image/gif": self.gif}


def plot_poses(solution: Solution | Plan, episode: int = 0, window: tuple[float, float] | None = None) -> Picture:
    """The body at some instants, recorded and modelled, for any planar chain of `symid.mechanics`.

    Parameters
    ----------
    solution : or a plan, of a chain. episode : which one, from 0.
    window : part of the time [s] that is drawn, all by default.

    Raises
    ------
    ModelError : the model is no such chain.

    Examples
    --------
    >>> plot_poses(fit, window=(0, 2)).savefig("poses.png")         # doctest: +SKIP
    """
    time, model, recorded = _motion(solution, episode, window)
    rows = np.linspace(0, len(time) - 1, POSES).round().astype(int)
    joints = np.concatenate([model, recorded if recorded is not None else model]).reshape(-1, 2)
    wide, high = np.nanmax(joints, axis=0) - np.nanmin(joints, axis=0)
    figure = Picture(
        figsize=(9, float(np.clip(1.4 * high / max(wide, 0.4 * high), 0.9, 2.1)) + 0.7), layout="constrained"
    )
    panels = figure.subplots(1, POSES, sharex=True, sharey=True)
    for axes, row in zip(panels, rows, strict=True):
        _stage(axes, model, recorded)
        if recorded is not None:
            axes.plot(*recorded[row].T, "o-", color=RECORDED, lw=4.5, ms=7, solid_capstyle="round", label="recorded")
        axes.plot(*model[row].T, "o-", color=MODEL, lw=1.4, ms=3.5, label="model")
        axes.set_title(f"{time[row]:.3g} s", fontsize=9)
    figure.legend(
        *panels[0].get_legend_handles_labels(), loc="outside upper right", ncols=2, frameon=False, fontsize=8.5
    )
    return figure


def animate(
    solution: Solution | Plan, episode: int = 0, window: tuple[float, float] | None = None, speed: float = 1.0
) -> Animation:
    """The body in motion, the recording beside the model, for any planar chain of `symid.mechanics`.

    Parameters
    ----------
    solution : or a plan, of a chain. episode : which one, from 0.
    window : part of the time [s] that is shown, the first `SECONDS` by default. speed : 0.5 is half as fast as it was.

    Raises
    ------
    ModelError : the model is no such chain.

    Examples
    --------
    >>> body = si.mechanics.DoubleLinkPendulum.from_json("data/standing_synthetic/body.json")
    >>> standing = si.read_recording("data/standing_synthetic/recording.csv")
    >>> problem = si.Identification(body.with_feedback(si.mechanics.PD()), standing, window=(0, 5))
    >>> animate(problem.solve(), speed=0.5).save("standing.gif")                # doctest: +SKIP
    """
    time, model, recorded = _motion(solution, episode, window)
    end = time[-1] if window is not None else min(time[-1], time[0] + SECONDS)
    shown = np.arange(time[0], end, speed * FRAME_S)
    rows = np.minimum(np.searchsorted(time, shown), len(time) - 1)
    figure = Picture(figsize=(5.2, 3.2), dpi=80)
    canvas = FigureCanvasAgg(figure)
    panels = figure.subplots(1, 1 + (recorded is not None), squeeze=False)[0]
    lines = []
    sides = [("model", model, MODEL)] if recorded is None else [("recorded", recorded, INK), ("model", model, MODEL)]
    for axes, (name, joints, colour) in zip(panels, sides, strict=True):
        _stage(axes, model, recorded)
        axes.set_title(name, fontsize=10, color=colour)
        lines.append((axes.plot(*joints[0].T, "o-", color=colour, lw=3, ms=6)[0], joints))
    clock = figure.text(0.5, 0.02, "", ha="center", fontsize=9)
    frames = []
    for row in rows:
        for line, joints in lines:
            line.set_data(*joints[row].T)
        clock.set_text(f"{time[row]:.1f} s")
        canvas.draw()
        frames.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").quantize(32))
    buffer, each = io.BytesIO(), round(1000 * FRAME_S)
    frames[0].save(buffer, format="gif", save_all=True, append_images=frames[1:], duration=each, loop=0)
    return Animation(buffer.getvalue())


def _motion(solution, episode: int, window) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Time [s], and the joints' positions of the model and (where angles were recorded) of the recording."""
    body, frame = skeleton(solution.problem.model), solution.trajectories
    frame = frame if not isinstance(frame, tuple) else frame[episode]
    frame = frame if window is None else frame.loc[window[0] : window[1]]
    states = frame[list(body.states)].to_numpy()
    seen = states.copy()
    for name, output in solution.problem.model.outputs.items():
        if str(output.expr) in body.states and f"{name} recorded" in frame:
            seen[:, body.states.index(str(output.expr))] = frame[f"{name} recorded"]
    recorded = None if np.array_equal(seen, states) else body.positions(seen)
    return frame.index.to_numpy(), body.positions(states), recorded


def _stage(axes, *bodies: np.ndarray | None) -> None:
    """Room for all that moves, the base, no axes: lengths are all to one scale."""
    joints = np.concatenate([b.reshape(-1, 2) for b in bodies if b is not None])
    (left, low), (right, high) = np.nanmin(joints, axis=0), np.nanmax(joints, axis=0)  # gaps are not drawn
    reach = max(right - left, high - low)
    half, margin = max(-left, right, 0.2 * reach), 0.07 * reach
    axes.set(xlim=(-half - margin, half + margin), ylim=(low - margin, high + margin))
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.plot([-0.2 * reach, 0.2 * reach], [0, 0], color=INK, lw=1, zorder=0)
