"""Predict each sample of data from those before it, and say how likely that makes them.

Random forces that act on the system cannot be simulated, but each sample tells what they did:
the state is moved by a Kalman gain after every sample (Ljung 1999, ch. 7; Mehra 1971), and the
remaining innovations are white if the model is right. Without random forces the gain is zero and
a prediction is a simulation. The covariance of the innovations is concentrated out, so that
-N log det of it is twice the log-likelihood.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symid.errors import SymidError
from symid.estimation.predicting.forces import Forces, is_white
from symid.estimation.predicting.history import states_before
from symid.estimation.predicting.kalman import KalmanFilter, linearised_along, points_along
from symid.estimation.sensors.whitening import Whitening, whitening_of
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.model import Model
from symid.simulation import Linearised, simulator

LONGEST_STEP = 0.02
"""First longest step of the integrator [s], of a motion with the pace of a second."""
SLOPE_STEP = 1e-4
"""Slopes of the gain are differences over such a part of a parameter."""


class Predictor:
    """Predictions of one set of data by one model, at whatever values.

    Parameters
    ----------
    fixed : parameters that keep their value: nobody asks for slopes by them.
    substeps, method : of the integrator in each sample, at least so many; as of `Simulator.simulate`.

    Attributes
    ----------
    tuned : places in `process` of what a fit looks for. bounded : whether it keeps growth without end away.
    gain_moves : whether slopes by parameters know that the gain depends on these.
    fewest : substeps of a smooth motion with the data's pace.
    defect : (N, m) of each segment, by which the outputs of these steps are corrected; None where they are not.
    """

    tuned: Sequence[int] = ()
    bounded = False
    gain_moves = True
    defect: Sequence[np.ndarray] | None = None

    def __init__(self, model: Model, data: Data, fixed: Sequence[str] = (), substeps: int = 1, method: str = "rk4"):
        self.model, self.data = model, data
        self.sim = simulator(model)
        self.free = [p for p in self.sim.parameters if p not in fixed]
        self.index = np.array([self.sim.parameters.index(p) for p in self.free], dtype=int)
        self.driven = data.driven and bool(model.noises)
        self.noises = len(model.noises)
        self.sharpness_at = self.noises if data.cutoff_free else None
        self.ratios_at = slice(self.noises + data.cutoff_free, None)
        self.step = data.segments[0].step
        longest = LONGEST_STEP * data.pace
        self.fewest = int(np.ceil(self.step / (1.01 * longest)))
        self.substeps, self.method = max(substeps, self.fewest), method

    @property
    def steps(self) -> dict:
        """How the integrator steps, as `Simulator.simulate` takes it."""
        return {"substeps": self.substeps, "method": self.method}

    def run(self, p, x0, gain, sensitivities: bool, keep: str = "outputs", process=(), gain_slopes=None):
        """Trajectories of all segments, or None if one diverged; `p` are values in the order of `sim`, or by name.

        gain_slopes : of `gain`, as the method of that name makes them: where known, a part of the sensitivities.
        """
        out, (late, lag) = [], self._late(p, x0)
        for e, start in zip(self.segments(process), x0, strict=True):
            t = e.simulate(
                self.sim,
                p,
                start,
                gain,
                gain_slopes=gain_slopes,
                keep=keep,
                sensitivity=self.free if sensitivities else (),
                initial_sensitivity=self.sim.states if sensitivities else (),
                history=self._history(p, start, e, lag, self.free if sensitivities else ()),
                late=late,
                unknown=lag if self.driven else 0.0,
                **self.steps,
            )
            if t.diverged:
                return None
            out.append(t)
        return out

    def _late(self, p, x0) -> tuple[np.ndarray | None, float]:
        """(m,) [s] how late each output is, and how late any state is read; None and zero where none is."""
        if not self.model.delays:
            return None, 0.0
        try:
            linear = linearised_along(self.sim, p, x0, self.data.mean_inputs, points=1)
        except SymidError:  # it diverges, too
            return None, 0.0
        of_states = np.where(linear.late_state < 0, 0.0, linear.lag)
        return ((linear.C_late != 0) * of_states).max(axis=1, initial=0.0), of_states.max(initial=0.0)

    def _history(self, p, start, segment: Segment, lag: float, sensitivity: Sequence[str] = ()):
        """States just before a segment, where something reads them late, and their slopes."""
        if lag <= 0:
            return None
        return states_before(self.sim, p, start, segment, lag, self.data.pace, self.steps, sensitivity)

    def segments(self, process) -> tuple[Segment, ...]:
        """The segments at the sharpness that stands behind the noises in `process`."""
        sharpness = self.sharpness(process)
        return self.data.segments if sharpness == 1.0 else tuple(e.sharpened(sharpness) for e in self.data.segments)

    def sharpness(self, process) -> float:
        return float(process[self.sharpness_at]) if self.sharpness_at is not None and len(process) else 1.0

    def sensors(self, process) -> np.ndarray:
        """(m,) standard deviations of the sensors' noise."""
        ratios = process[self.ratios_at]
        return self.data.sensor_noise * np.append(1.0, ratios) if len(ratios) else self.data.sensor_noise

    def innovations(self, runs, process=()) -> list[np.ndarray]:
        left = [e.recorded - t.y for e, t in zip(self.segments(process), runs, strict=True)]
        if unseen := sum(t.unseen for t in runs):  # all count as large as those that were compared
            left = [e * np.sqrt(self.data.samples / (self.data.samples - unseen)) for e in left]
        return left if self.defect is None else [e - d for e, d in zip(left, self.defect, strict=True)]

    def score(self, innovations, process=()) -> tuple[float, Whitening]:
        """Twice the log-likelihood, and what whitens the innovations."""
        whitening = whitening_of(innovations, self.data.memory, self.data.error_sizes)
        if not self.driven:
            # Even a motion that has come to rest, and is met exactly, has a finite likelihood.
            whitening = whitening.apart((1e-6 * self.data.sensor_noise) ** 2)
        value = whitening.loglik2(innovations)
        if self.data.filter is not None:
            volume = self.data.filter.log_volume(self.step, self.sharpness(process))[0]
            value += 2 * self.data.samples * len(whitening.covariance) * volume
        return value, whitening

    def evaluate(self, p, x0, gain, process=()) -> float:
        return self._followed(p, x0, gain, process, keep="outputs")[0]

    def _followed(self, p, x0, gain, process, keep: str, sensitivities: bool = False, gain_slopes=None):
        """Twice the log-likelihood, -inf where a run diverges, and the runs."""
        runs = self.run(p, x0, gain, sensitivities, keep, process, gain_slopes)
        return (-np.inf if runs is None else self.score(self.innovations(runs, process), process)[0]), runs

    def sensitive(self, p, x0, gain, process, path):
        """`run` with the sensitivities of all that is free, tuned, or where a segment begins."""
        slopes = self.gain_slopes(self.kalman_filter(p, process, path), p, process, path) if self.driven else None
        return self.run(p, x0, gain, True, process=process, gain_slopes=slopes)

    def kalman_gain(self, p, process, path):
        """Kalman gain at these values, linearised along a path of states; None without random forces."""
        return self.kalman_filter(p, process, path).gain if self.driven else None

    def kalman_filter(self, p, process, path) -> KalmanFilter:
        """The filter at these values, linearised along a path of states."""
        linear, sensors = self.linearised(p, path), self.sensors(process)
        ratio = self.data.segments[0].ratio
        parts, banded = ratio if self.model.delays else 1, ratio > 1 and self.data.filter is not None
        forces = Forces(self.step, is_white(self.model), parts, banded)
        return KalmanFilter.of(linear, forces, process[: self.noises], sensors)

    def gain_slopes(self, filter: KalmanFilter, p, process, path) -> np.ndarray | None:
        """Slopes of its gain by the free parameters, and by the logarithms of what is tuned of it; None without any."""
        others, path = [], points_along(path)
        for i in self.index if self.gain_moves else ():
            moved = p.copy()
            moved[i] += SLOPE_STEP * abs(p[i]) or SLOPE_STEP**2
            others.append((moved[i] - p[i], self.linearised(moved, path), process[: self.noises], filter.sensor))
        for j in self.tuned_gain:
            more = process.copy()
            more[j] *= np.exp(SLOPE_STEP)
            others.append((SLOPE_STEP, filter.linear, more[: self.noises], self.sensors(more)))
        slopes = filter.slopes(others) if others else None
        if slopes is None or self.gain_moves:
            return slopes
        return np.concatenate([np.zeros((len(self.index), *slopes.shape[1:])), slopes])

    @property
    def tuned_gain(self) -> list[int]:
        """What is tuned but the sharpness of a filter, of which the gain does not know."""
        return [j for j in self.tuned if j != self.sharpness_at]

    def linearised(self, p, path) -> Linearised:
        """The model linearised along a path of states and at the mean of each input."""
        return linearised_along(self.sim, p, path, self.data.mean_inputs)

    def path(self, p, x0, gain) -> np.ndarray:
        """States along the trajectories, or the initial states if those diverge."""
        runs = self.run(p, x0, gain, False, keep="states") if self.driven else None
        return np.vstack([t.x for t in runs]) if runs else x0
