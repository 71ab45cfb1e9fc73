"""Forward simulation of one closed loop from many initial states at once."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from symid.analysis.points import check_values, kernel_of, uniform_values
from symid.codegen import Kernel
from symid.codegen.equations.rates import late_of, late_symbols, step_program
from symid.errors import ModelError
from symid.model import Model
from symid.units import FloatArray

_SWEEP = 50
"""Steps between two looks at which runs have failed already."""


@dataclass(frozen=True, eq=False)
class Drive:
    """What acts on all runs: time (N,) [s], inputs and recorded outputs at it, by name (N,)."""

    time: FloatArray
    inputs: Mapping[str, FloatArray]
    recorded: Mapping[str, FloatArray]

    def resampled(self, step: float) -> Drive:
        """Linear between samples, every `step` [s] from the first to the last."""
        count = round((self.time[-1] - self.time[0]) / step) + 1
        time = self.time[0] + step * np.arange(count)

        def at(signals):
            return {k: np.interp(time, self.time, v) for k, v in signals.items()}

        return Drive(time, at(self.inputs), at(self.recorded))


def forward_rms(
    model: Model,
    states: FloatArray,
    values: Mapping[str, float],
    drive: Drive,
    limit: float,
    step: float = 0.005,
    threads: int = 2,
) -> FloatArray:
    """(K,) root mean square [SI] over all outputs and steps of simulated minus recorded.

    Explicit Euler, as in Wang & van den Bogert 2020. A run whose squares already add up to more
    than `limit` allows over the whole time is ended and gets infinity.

    Parameters
    ----------
    states : (K, n) initial states.
    values : of all parameters, by name, in SI.
    drive : inputs and recorded outputs (all the model's) over the time to simulate.
    limit : [SI] above which the exact value does not matter.
    step : of the integration [s].

    Raises
    ------
    ModelError
        If a parameter has no value, or an input or a recorded output of the model is not in `drive`.
    """
    check_values(model, values)
    needs = (("input", model.inputs, drive.inputs), ("recorded output", model.outputs, drive.recorded))
    for kind, wanted, given in needs:
        for name in wanted:
            if name not in given:
                raise ModelError(f"forward simulation of '{model.name}' needs the {kind} '{name}'; found {list(given)}")
    kernel = kernel_of(model, step_program)
    fine = drive.resampled(step)
    parts = np.array_split(np.arange(len(states)), min(threads, len(states)))
    with ThreadPoolExecutor(threads) as pool:
        runs = pool.map(lambda part: _run(model, kernel, states[part], values, fine, limit, step), parts)
        return np.concatenate(list(runs))


def _run(
    model: Model,
    kernel: Kernel,
    states: FloatArray,
    values: Mapping[str, float],
    drive: Drive,
    limit: float,
    step: float,
) -> FloatArray:
    count, n = states.shape
    steps, m = len(drive.time) - 1, len(model.outputs)
    allowed = limit**2 * steps * m
    late = _Late(model, values, drive, step, states)
    uniform = np.concatenate([uniform_values(model, values), np.zeros(m), [step]])
    signals = np.stack([drive.inputs[k] for k in model.inputs], axis=1) if model.inputs else np.zeros((steps + 1, 0))
    recorded = np.stack([drive.recorded[k] for k in model.outputs], axis=1)
    runs, squares = np.arange(count), np.full(count, np.inf)
    now = np.hstack([states, np.zeros((count, 1))])
    nothing, none = np.zeros((count, 0)), np.zeros(0)
    for i in range(steps):
        uniform[: signals.shape[1]] = signals[i]
        uniform[-1 - m - 1], uniform[-1 - m : -1] = drive.time[i], recorded[i]
        now = kernel.residual(nothing[: len(now)], none, late.beside(now, i), uniform)
        if (i + 1) % _SWEEP == 0:
            alive = now[:, n] <= allowed  # NaN is not alive
            if not alive.all():
                runs, now = runs[alive], np.ascontiguousarray(now[alive])
                late.keep(alive)
                if not len(runs):
                    break
    squares[runs] = now[:, n]
    rms = np.sqrt(squares / (steps * m))
    return np.where(rms <= limit, rms, np.inf)


class _Late:
    """Late signals of all runs: states from the last steps, inputs from the drive, linear between.

    Before the start every state rests at its initial value.
    """

    def __init__(self, model: Model, values: Mapping[str, float], drive: Drive, step: float, states: FloatArray):
        names = list(model.states)
        self.drive, self.n = drive, len(names)
        self.late = [(names.index(of) if of in names else None, of, lag / step) for of, lag in late_of(model, values)]
        depth = max((int(back) for k, _, back in self.late if k is not None), default=0) + 2
        self.past = np.repeat(states[None], depth, axis=0) if late_symbols(model) else None

    def beside(self, now: FloatArray, i: int) -> FloatArray:
        """`now` at step i, with the late signals in further columns."""
        if self.past is None:
            return now
        depth = len(self.past)
        self.past[i % depth] = now[:, : self.n]
        columns = np.empty((len(now), len(self.late)))
        for j, (k, of, back) in enumerate(self.late):
            whole, part = int(back), back - int(back)
            if k is None:
                columns[:, j] = np.interp(i - back, np.arange(len(self.drive.time)), self.drive.inputs[of])
            else:
                newer, older = self.past[(i - whole) % depth, :, k], self.past[(i - whole - 1) % depth, :, k]
                columns[:, j] = newer + part * (older - newer)
        return np.hstack([now, columns])

    def keep(self, alive: np.ndarray) -> None:
        if self.past is not None:
            self.past = np.ascontiguousarray(self.past[:, alive])
