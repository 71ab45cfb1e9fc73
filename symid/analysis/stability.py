"""Is an identified controller stable? By eigenvalues, and by simulation, over the recorded range."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from symid import checked
from symid.analysis.eigenvalues import complete, growth
from symid.analysis.forward import Drive, forward_rms
from symid.analysis.points import grid
from symid.errors import ModelError
from symid.identification import Solution
from symid.model import Model
from symid.recording import Recording, rate_name
from symid.units import FloatArray

RMS_OVER_STD = 3.0
"""A forward simulation counts as stable up to this many standard deviations of the recorded outputs."""
MOST_POINTS = 1_000_000
"""Grid points, and steps of a forward simulation: beyond, an answer takes gigabytes and hours."""


@dataclass(frozen=True, eq=False)
class Stability:
    """Two stability tests of one controller over a grid of states (Wang & van den Bogert 2020).

    Attributes
    ----------
    states : names of the n gridded states.
    points : (K, n) operating points and initial states; per_state : grid points per state.
    growth : (K,) largest real part [1/s] of the roots, linearised at each point.
    rms : (K,) of the forward simulations [SI], infinite where above the limit; None if not made.
    limit : rms [SI] up to which a forward simulation counts as stable.

    Examples
    --------
    >>> found = si.stability(problem.solve(), held_out=(4, 6))
    >>> found.eigenvalue_percent, found.points.shape[1]
    (100.0, 2)
    """

    states: tuple[str, ...]
    points: FloatArray
    per_state: int
    growth: FloatArray
    rms: FloatArray | None = None
    limit: float = np.nan

    @property
    def eigenvalue_percent(self) -> float:
        """Share [%] of operating points where no real part is positive."""
        return 100 * float(np.mean(self.growth <= 0))

    @property
    def forward_percent(self) -> float:
        """Share [%] of initial states from which the simulation stays within the limit.

        Raises
        ------
        ModelError : no forward simulations were made.
        """
        if self.rms is None:
            raise ModelError("no forward simulations were made: ask for them with held_out=(start, end)")
        return 100 * float(np.mean(self.rms <= self.limit))

    def share(self, first: str, second: str, test: str = "eigenvalue") -> FloatArray:
        """(per_state, per_state) share of stable points over two states, all others taken together.

        Parameters
        ----------
        first, second : names of two states of the grid.
        test : ``"eigenvalue"`` or ``"forward"``.

        Raises
        ------
        ModelError : there is no such state, or no forward simulations were made.
        """
        for name in (first, second):
            self._place(name)
        checked.choice(test, ("eigenvalue", "forward"), "stability map: test", ModelError)
        if test == "forward" and self.rms is None:
            raise ModelError("no forward simulations were made: ask for them with held_out=(start, end)")
        stable = np.asarray(self.growth <= 0 if self.rms is None or test == "eigenvalue" else self.rms <= self.limit)
        table = stable.reshape((self.per_state,) * len(self.states))
        a, b = self.states.index(first), self.states.index(second)
        others = tuple(k for k in range(len(self.states)) if k not in (a, b))
        shares: FloatArray = table.mean(axis=others)
        return shares if a < b else shares.T

    def axis(self, state: str) -> FloatArray:
        """(per_state,) the values of one state."""
        return np.unique(self.points[:, self._place(state)])

    def _place(self, state: str) -> int:
        if not isinstance(state, str) or state not in self.states:
            raise ModelError(f"the stability map has no state {checked.shown(state)}; it has {', '.join(self.states)}")
        return self.states.index(state)

    def __repr__(self) -> str:
        forward = "" if self.rms is None else f", {self.forward_percent:.2f} % by forward simulation"
        return (
            f"<Stability: {self.eigenvalue_percent:.2f} % stable by eigenvalues{forward}, of {len(self.points)} points>"
        )

    def _repr_html_(self) -> str:
        rows = [("by eigenvalues", self.eigenvalue_percent)]
        rows += [("by forward simulation", self.forward_percent)] if self.rms is not None else []
        cells = "".join(f"<tr><td>stable {how}</td><td>{share:.2f} %</td></tr>" for how, share in rows)
        return f"<table>{cells}<tr><td>points</td><td>{len(self.points)}</td></tr></table>"


def stability(
    solution: Solution, *, held_out: tuple[float, float] | None = None, which: int = 0, **options: Any
) -> Stability:
    """Both tests of an identified controller over the states recorded in its window.

    Parameters
    ----------
    solution : of an identification.
    held_out : (start, end) [s] of the forward simulations; none are made without it.
    which : which of the solution's recordings.
    options : ``window``, ``per_state``, ``step``, ``threads`` as for `stability_of`.

    Examples
    --------
    >>> si.stability(problem.solve(), held_out=(4, 6)).eigenvalue_percent
    100.0
    """
    checked.kind(solution, Solution, "stability", ModelError)
    recordings = solution.problem.recordings
    which = checked.whole(which, "stability: which", ModelError, most=len(recordings) - 1)
    recording = recordings[which]
    options.setdefault("window", solution.problem.windows[which] or recording.interval)
    return stability_of(solution.model, solution.values, recording, held_out=held_out, **options)


def stability_of(
    model: Model,
    values: Mapping[str, float],
    recording: Recording,
    *,
    window: tuple[float, float],
    held_out: tuple[float, float] | None = None,
    per_state: int = 11,
    step: float = 0.005,
    threads: int = 2,
) -> Stability:
    """Both tests over a grid that spans the states recorded in `window`.

    Parameters
    ----------
    threads : of the compiled simulations.
    model, values : the closed loop and its parameters by name, in SI.
    recording : with a channel for every gridded state, input and output.
    window : (start, end) [s]; the end itself is not part of it.
    held_out : (start, end) [s] of the forward simulations; none are made without it.
    per_state : grid points for each state.
    step : of the explicit Euler integration [s].

    Returns
    -------
    Stability, whose limit is 3 times the mean standard deviation of the outputs in `window`.

    Raises
    ------
    ModelError, RecordingError
        If a parameter has no value, a channel is missing, or a window holds no samples of the recording.

    Examples
    --------
    >>> found = si.stability_of(model, {"damping": 0.4}, recording, window=(0, 4), per_state=5)
    >>> found.eigenvalue_percent
    100.0
    """
    states = checked.kind(model, Model, "stability", ModelError).states
    chosen = tuple(name for name, s in states.items() if s.role != "memory")
    checked.kind(recording, Recording, "stability: recording", ModelError)
    most = max(2, int(MOST_POINTS ** (1 / max(len(chosen), 1))))
    per_state = checked.whole(per_state, "stability: per_state", ModelError, least=1, most=most)
    threads = checked.whole(threads, "stability: threads", ModelError, least=1)
    rows = recording_rows(recording, window)
    recorded = np.stack([recording[_channel(model, name, recording)][rows] for name in chosen], axis=1)
    outputs = {name: recording[o.channel] for name, o in model.outputs.items()}
    points = grid(recorded.min(axis=0), recorded.max(axis=0), per_state)
    states = complete(model, points, values)
    rates = growth(model, states, values)
    limit = RMS_OVER_STD * float(np.mean([v[rows].std() for v in outputs.values()]))
    if held_out is None:
        return Stability(chosen, points, per_state, rates, None, limit)
    within = recording_rows(recording, held_out, to_end=True)
    time = recording.time[within]
    least = (time[-1] - time[0]) / MOST_POINTS
    if checked.number(step, "stability: step", ModelError, least=least) > time[-1] - time[0]:
        raise ModelError(f"stability: step={step:g} s is longer than held_out, {held_out} s")
    drive = Drive(
        time,
        {k: recording[u.channel][within] for k, u in model.inputs.items()},
        {k: v[within] for k, v in outputs.items()},
    )
    rms = forward_rms(model, states, values, drive, limit, step, threads)
    return Stability(chosen, points, per_state, rates, rms, limit)


def recording_rows(recording: Recording, window: tuple[float, float], to_end: bool = False) -> np.ndarray:
    """Rows from the start of `window` up to its end, without it unless `to_end`."""
    window = checked.window(window, "stability: held_out" if to_end else "stability: window", ModelError)
    end = window[1] + 1e-9 if to_end else window[1] - 1e-9
    rows = np.flatnonzero((recording.time >= window[0] - 1e-9) & (recording.time < end))
    if len(rows) < 2:
        raise ModelError(
            f"the window {window} s holds {len(rows)} samples of the recording, which lasts from "
            f"{recording.time[0]:g} to {recording.time[-1]:g} s"
        )
    return rows


def _channel(model: Model, state: str, recording: Recording) -> str:
    """Channel with this state: of the output that shows it, of its own name, or of the rate of such a one."""
    shown = {str(o.expr): o.channel for o in model.outputs.values()}
    if state in shown or state in recording.channels:
        return shown.get(state, state)
    coordinate = model.rates().get(state)
    return rate_name(shown[coordinate]) if coordinate in shown else state
