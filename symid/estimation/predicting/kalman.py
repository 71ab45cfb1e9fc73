"""How much of each sample's innovation belongs to the state: the stationary Kalman gain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import matrix_balance

from symid.estimation.predicting.forces import Forces
from symid.simulation import Linearised, Simulator

FLOOR = 1e-12
"""Every state is moved by at least so small a variance, that of a sensor's noise being one: a mode that nothing moves
has no stationary gain."""
MOST_DOUBLINGS, DIED_OUT, SETTLED = 40, 1e-9, 1e-14
"""The covariance and a change of it are followed over at most 2^40 samples: until so small a part of a change is left,
and until the covariance grows by no larger part."""


def linearised_along(
    simulator: Simulator, values, states: np.ndarray, inputs: Mapping[str, float], points: int = 16
) -> Linearised:
    """The mean of the linearisations at `points` states of a trajectory (statistical linearisation).

    Parameters
    ----------
    inputs : the mean of each: a rope's length or a vehicle's speed, which a model may multiply by or divide by.
    """
    rows = points_along(states, points)
    return simulator.linearise(values, rows, np.array([inputs[u] for u in simulator.source.inputs]))


def points_along(states: np.ndarray, points: int = 16) -> np.ndarray:
    """(P, n) states of a trajectory at which it is linearised: of themselves they give the same ones again."""
    rows = states if np.isfinite(states.sum()) else states[np.isfinite(states).all(axis=1)]
    return rows[np.linspace(0, len(rows) - 1, points).astype(int)] if len(rows) else states[:1]


@dataclass(frozen=True, eq=False)
class KalmanFilter:
    """The stationary Kalman filter of a linearised model; its states are divided by `size`, its outputs by `sensor`.

    Attributes
    ----------
    linear : the model. forces : what random forces do within a sample.
    sensor : (m,) standard deviation of each output. size : (n,) of the states.
    F, Q, C : (n, n), (n, n), (m, n) transition over a sample, what random forces add to the covariance, and outputs.
    f, q : F and Q of one of the parts of a sample at whose ends the past is corrected for delayed states.
    P : (n, n) covariance of the predicted state; None where there is no stationary one.
    leak : part of the state that is kept from sample to sample, below one where only that makes P stationary.
    """

    linear: Linearised
    forces: Forces
    sensor: np.ndarray
    size: np.ndarray
    F: np.ndarray
    Q: np.ndarray
    f: np.ndarray
    q: np.ndarray
    C: np.ndarray
    P: np.ndarray | None = None
    leak: float = 1.0

    @classmethod
    def of(cls, linear: Linearised, forces: Forces, process: np.ndarray, sensor: np.ndarray) -> KalmanFilter:
        """The filter of a linearised model.

        Parameters
        ----------
        process : (w,) standard deviation of each noise of the model.
        """
        A, G, C = linear.without_delay()
        moved = forces.moved(A, G, process)
        size = _sizes(moved[0], C / sensor[:, None])
        scaled = _scaled(*moved, C / sensor[:, None], size)
        found = cls(linear, forces, sensor, size, *scaled)
        for leak in (1.0, 1 - 1e-4, 1 - 1e-3, 1 - 1e-2):
            P = stationary_covariance(leak * found.F, found.C, found.Q + FLOOR * np.eye(len(size)))
            if P is not None:
                return replace(found, P=P, leak=leak)
        return found

    @property
    def expected(self) -> np.ndarray:
        """(m,) standard deviations of innovations if all noises are as large as stated; NaN where P is None."""
        if self.P is None:
            return np.full(len(self.C), np.nan)
        return self.sensor * np.sqrt(1 + np.einsum("ij,jk,ik->i", self.C, self.P, self.C))

    @property
    def gain(self) -> np.ndarray:
        """Gain that moves the state after a sample by gain @ (recorded - predicted).

        (n, m), or (1 + k, n, m) where the model has delayed states: then also for the states 1 ... k parts of a sample
        before (fixed-lag smoothing; Anderson & Moore 1979, 7.3). Where a sample is long against the motion its past is
        no straight line: of a standing person in samples of 50 ms, whose feedback is 100 ms late, the error of that
        looked like a leg whose centre of mass lies elsewhere (draw 724 of "person").
        """
        if self.P is None:
            return np.zeros((len(self.linear.A), len(self.C)))
        return self._gain(self.F, self.f, self.q, self.C, self.P, self.sensor)

    def _gain(self, F, f, q, C, P, sensor: np.ndarray) -> np.ndarray:
        own, lags = len(self.linear.A), self.linear.lag[self.linear.late_state >= 0]
        inverse = np.linalg.inv(C @ P @ C.T + np.eye(len(C)))
        now = P @ C.T @ inverse
        if not len(lags):
            return now[:own] * self.size[:own, None] / sensor
        count, error = 2 + int(np.ceil(lags.max() * self.forces.parts / self.forces.step)), (F - F @ now @ C).T
        back = [P, *self._within(f, q, P - now @ C @ P)]
        while len(back) < count:
            back.append(back[-self.forces.parts] @ error)
        return np.array([b @ C.T @ inverse for b in back[:count]])[:, :own] * self.size[:own, None] / sensor

    def _within(self, f: np.ndarray, q: np.ndarray, P: np.ndarray) -> list[np.ndarray]:
        """Covariances of the state that is predicted for a sample with what it was 1, 2 ... parts of a sample before.

        P : (n, n) covariance of the state after the sample before.
        """
        known = [P]
        for _ in range(self.forces.parts - 1):
            known.append(f @ known[-1] @ f.T + q)
        return [P @ np.linalg.matrix_power(f, i).T for i, P in enumerate(known[:0:-1], start=1)]

    def slopes(self, others: Sequence[tuple[float, Linearised, np.ndarray, np.ndarray]]) -> np.ndarray | None:
        """(B, *gain.shape) change of the gain per unit towards each of B filters that differ little from this one.

        Their P follows from this one by one step of Newton's method for the Riccati equation (Hewer 1971), whose linear
        equation is solved by doubling.

        Parameters
        ----------
        others : how far each is, and its model, process noise and sensor noise.
        """
        n = len(self.F)
        models = [linear.without_delay() for _, linear, _, _ in others]
        if self.P is None or any(len(A) != n for A, _, _ in models):
            return None
        process, sensor = (np.array([o[k] for o in others]) for k in (2, 3))
        A, G, C = (np.stack(k) for k in zip(*models, strict=True))
        moved_by = self.forces.moved(A, G, process)
        F, Q, f, q, C = _scaled(*moved_by, C / sensor[:, :, None], self.size)
        now = self.P @ self.C.T @ np.linalg.inv(self.C @ self.P @ self.C.T + np.eye(len(self.C)))
        left, kept, moved = np.eye(n) - now @ C, self.leak * F, self.leak * F @ now
        power = self.leak * self.F @ (np.eye(n) - now @ self.C)
        with np.errstate(over="ignore", invalid="ignore"):  # of a filter that is not stable after all
            after = kept @ left @ self.P @ (kept @ left).swapaxes(1, 2) + moved @ moved.swapaxes(1, 2)
            change = after + Q + FLOOR * np.eye(n) - self.P
            for _ in range(MOST_DOUBLINGS):
                change = change + power @ change @ power.T
                power = power @ power
                if not np.abs(power).max() >= DIED_OUT:
                    break
        if not np.isfinite(change).all():
            return None
        here = self.gain
        return np.array(
            [
                (self._gain(*model, own) - here) / far
                for (far, *_), own, *model in zip(others, sensor, F, f, q, C, self.P + change, strict=True)
            ]
        )


def stationary_covariance(F: np.ndarray, C: np.ndarray, Q: np.ndarray) -> np.ndarray | None:
    """(n, n) P = F P (1 + C'C P)^-1 F' + Q, of a predicted state that (m, n) C shows with noise of variance one.

    None where there is none. By doubling the number of samples: Anderson's recursion of 1978, as Guo, Chu, Liang & Lin
    describe it (2020, arXiv 2005.08288). It takes a third of the time of `scipy.linalg.solve_discrete_are`, which finds
    nothing where a mode dies out within a sample.
    """
    back, seen, P, one = F.T, C.T @ C, Q, np.eye(len(F))
    with np.errstate(over="ignore", invalid="ignore"):  # of a mode that grows unseen
        for _ in range(MOST_DOUBLINGS):
            try:
                apart = np.linalg.inv(one + seen @ P)
            except np.linalg.LinAlgError:
                return None
            between, more = back @ apart, back.T @ P @ apart @ back
            P, seen, back = P + (more + more.T) / 2, seen + between @ seen @ back.T, between @ back
            if not np.isfinite(P).all():
                return None
            if np.abs(more).max() <= SETTLED * np.abs(P).max():
                return P
    return None


def _scaled(F, Q, f, q, C, size: np.ndarray) -> tuple[np.ndarray, ...]:
    with np.errstate(all="ignore"):  # hopeless candidates overflow, and have no gain
        F, f = (moved * size / size[:, None] for moved in (F, f))
        Q, q = (added / np.outer(size, size) for added in (Q, q))
        return F, Q, f, q, C * size


def _sizes(F: np.ndarray, C: np.ndarray) -> np.ndarray:
    """(n,) by which states are divided so that millimetres beside kilopascals do no harm (Parlett & Reinsch 1969)."""
    if not np.isfinite(F).all():
        return np.ones(len(F))
    with np.errstate(invalid="ignore"):  # SciPy makes integers of sizes beyond all bounds, which nobody asked for
        _, (size, _) = matrix_balance(F, permute=False, separate=True)
    return size / (np.abs(C * size).max() or 1.0)
