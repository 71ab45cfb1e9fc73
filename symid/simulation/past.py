"""What delayed signals read: given history, the dense output of stored steps, the step under way, and inputs."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np

from symid.codegen.ode import BETWEEN, OdeSource
from symid.recording.signals.between import bend
from symid.simulation.run import Run


@dataclass(eq=False)
class Step:
    """A finished step: x at its start, k1, k2 + k3 and k4 of Runge-Kutta 4, and those of the sensitivities."""

    begin: float
    span: float
    x: list[np.ndarray]
    S: list[np.ndarray]

    def value(self, time: float, i: int) -> tuple[float, float, np.ndarray]:
        """State i, its rate and its sensitivities within the step (Hairer, Norsett & Wanner 1993, II.6)."""
        h, q = self.span, (time - self.begin) / self.span
        b = h * (q - 1.5 * q**2 + 2 * q**3 / 3), h * (q**2 - 2 * q**3 / 3), h * (-0.5 * q**2 + 2 * q**3 / 3)
        slope = 1 - 3 * q + 2 * q**2, 2 * q - 2 * q**2, -q + 2 * q**2
        value = self.x[0][i] + sum(w * k[i] for w, k in zip(b, self.x[1:], strict=True))
        rate = sum(w * k[i] for w, k in zip(slope, self.x[1:], strict=True))
        return value, rate, self.S[0][i] + sum(w * k[i] for w, k in zip(b, self.S[1:], strict=True))


class Past:
    """Inputs and late signals at any time of a run.

    lag : (L,) [s] how late each signal is. dlag : (L, nq) its slopes.
    """

    def __init__(self, run: Run, source: OdeSource, lag: np.ndarray, dlag: np.ndarray):
        self.run, self.source, self.lag, self.dlag = run, source, lag, dlag
        given, times = run.signals.given, run.signals.times
        between = np.zeros(given.shape[1], dtype=int)
        between[: len(source.input_between)] = source.input_between
        self.held, self.curved = between == BETWEEN.index("zero"), between >= BETWEEN.index("cubic")
        self.quintic = between == BETWEEN.index("band-limited")
        self.any_held, self.any_curved = bool(self.held.any()), bool(self.curved.any())
        self.lines = np.zeros_like(given)
        self.lines[:-1] = np.diff(given, axis=0) / np.diff(times)[:, None]
        self.flat = np.zeros(given.shape[1])
        self.steps: list[Step] = []
        self.begins: list[float] = []
        n, zero = len(run.x0), np.zeros((len(run.x0), run.nq))
        self.start, self.span, self.x, self.S = run.t[0], 0.0, run.x0, zero
        self.rate, self.curve, self.S_rate, self.S_curve = np.zeros(n), np.zeros(n), zero, zero
        self.known = False

    def begin(self, t: float, h: float, x: np.ndarray, S: np.ndarray) -> None:
        """A step of h begins at t; the rates at its start are not known yet."""
        self.start, self.span, self.x, self.S, self.known = t, h, x, S, False

    def inside(self, rate: np.ndarray, S_rate: np.ndarray) -> None:
        """The rates at the start of the present step are known."""
        self.rate, self.S_rate, self.known = rate, S_rate, True

    def end(self, step: Step) -> None:
        """A step is finished; it is kept where signals are late."""
        self.known, self.span = False, 0.0
        if len(self.lag):
            self.steps.append(step)
            self.begins.append(step.begin)
            self.curve, self.S_curve = (step.x[3] - step.x[1]) / step.span, (step.S[3] - step.S[1]) / step.span
            self.start = step.begin + step.span

    def inputs_at(self, time: float, k: int) -> tuple[np.ndarray, np.ndarray]:
        """(inputs,) and slopes: linear or curved between samples or held, constant beyond the ends.

        k is the present interval: at its end a held input still has the value of its start.
        """
        t, u, present = self.run.signals.times, self.run.signals.given, k + self.run.early
        k = min(max(present, 0), len(t) - 2)
        while k > 0 and time < t[k]:
            k -= 1
        while k < len(t) - 2 and time > t[k + 1]:
            k += 1
        h = t[k + 1] - t[k]
        f = (time - t[k]) / h
        slope = self.lines[k] if 0 <= f <= 1 else self.flat
        value = u[k] + min(max(f, 0.0), 1.0) * (u[k + 1] - u[k])
        if self.any_curved and 0 <= f <= 1:
            slopes, bends = self.run.signals.slopes, self.run.signals.bends
            ends = None if bends is None else (bends[k], bends[k + 1])
            more, steeper = bend(f, h, slopes[k] - slope, slopes[k + 1] - slope, ends, self.quintic)
            value, slope = value + self.curved * more, slope + self.curved * steeper
        if self.any_held:
            at_end = present == k - 1 and time - t[k] < 1e-9 * h
            held = present if at_end else len(t) - 1 if present > k and f >= 1 else k
            value, slope = np.where(self.held, u[held], value), np.where(self.held, 0.0, slope)
        return value, slope

    def late_at(self, time: float, k: int, x: np.ndarray, S: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(L,) late signals and their (L, nq) sensitivities; x and S are the present ones, for a lag of zero."""
        if not len(self.lag):
            return self.lag, self.dlag
        late, lS = np.zeros(len(self.lag)), np.zeros_like(self.dlag)
        for j, (kind, i) in enumerate(zip(self.source.late_kind, self.source.late_index, strict=True)):
            if kind and self.held[i] and self.span:
                (late[j], rate), row = self._held_mean(self.lag[j], k, i), 0.0
            elif kind:
                values, slopes = self.inputs_at(time - self.lag[j], k)
                late[j], rate, row = values[i], slopes[i], 0.0
            elif self.lag[j] == 0:
                late[j], rate, row = x[i], self.rate[i], S[i]
            else:
                late[j], rate, row = self._state_at(time - self.lag[j], i)
            lS[j] = row - rate * self.dlag[j]
        return late, lS

    def _held_mean(self, lag: float, k: int, i: int) -> tuple[float, float]:
        """Mean over the present step of input i as it was `lag` ago, which is held, and its slope in time.

        What it was at one moment would not answer to a small change of the lag; where a sample is met the slope is that
        for a little more lag. k is the present interval.
        """
        t, u, k = self.run.signals.times, self.run.signals.given[:, i], k + self.run.early
        begin, end, total, met = self.start - lag, self.start - lag + self.span, 0.0, 1e-9 * self.span
        while k > 0 and begin <= t[k] + met:
            k -= 1
        while k < len(t) - 1 and begin > t[k + 1] + met:
            k += 1
        first = u[k]
        while k < len(t) - 1 and end > t[k + 1] + met:
            total, begin, k = total + u[k] * (t[k + 1] - begin), t[k + 1], k + 1
        return (total + u[k] * (end - begin)) / self.span, (u[k] - first) / self.span

    def _state_at(self, time: float, i: int) -> tuple[float, float, np.ndarray | float]:
        first = self.run.t[0]
        present = time >= self.start if self.known else time >= first if not self.steps else time > self.start
        if present:
            d = time - self.start
            return (
                self.x[i] + d * self.rate[i] + 0.5 * d * d * self.curve[i],
                self.rate[i] + d * self.curve[i],
                self.S[i] + d * self.S_rate[i] + 0.5 * d * d * self.S_curve[i],
            )
        if time <= first or not self.steps:
            return self._before(time, i)
        return self.steps[max(bisect_right(self.begins, time) - 1, 0)].value(time, i)

    def _before(self, time: float, i: int) -> tuple[float, float, np.ndarray | float]:
        """From the given history, or the initial state held."""
        ht, hx = self.run.ht, self.run.hx
        if ht is None:
            row = np.zeros(self.run.nq)
            row[self.run.nqp : self.run.nqp + self.run.nqx][self.run.qx == i] = 1
            return self.run.x0[i], 0.0, row
        if len(ht) < 2:
            return hx[0, i], 0.0, 0.0
        k = min(max(int(np.searchsorted(ht, time)) - 1, 0), len(ht) - 2)
        h, a, b = ht[k + 1] - ht[k], hx[k, i], hx[k + 1, i]
        f, hs, row = max((time - ht[k]) / h, 0.0), self.run.hs, np.zeros(self.run.nq)
        if hs is not None:
            row[: hs.shape[2]] = hs[k, i] + f * (hs[k + 1, i] - hs[k, i])
        return a + f * (b - a), (b - a) / h if f > 0 else 0.0, row

    def correct(self, now: float, interval: float, e: np.ndarray, Sy: np.ndarray) -> None:
        """A fixed-lag smoother on the stored steps (Anderson & Moore 1979, 7.3), linear within each."""
        for step in reversed(self.steps):
            late = (now - step.begin) / interval
            end = late - step.span / interval
            if end >= self.run.npast:
                break
            for values, sign, moved in ((step.x, 1.0, e), (step.S, -1.0, Sy)):
                for k, part in enumerate(self._parts(self.run.gain, late, end, step.span)):
                    values[k] = values[k] + sign * (part @ moved)
            if self.run.dgain is not None:
                for k, part in enumerate(self._parts(self.run.dgain, late, end, step.span)):
                    step.S[k] = step.S[k] + e @ part

    def _parts(self, gain: np.ndarray, late: float, end: float, span: float) -> tuple[np.ndarray, ...]:
        """Corrections per surprise of the four parts of a step that began `late` sample intervals before the sample."""
        start = self._gain(gain, late)
        slope = (self._gain(gain, end) - start) / span
        return start, slope, 2 * slope, slope

    def _gain(self, gain: np.ndarray, late: float) -> np.ndarray:
        """(n, m, ...) correction per surprise, `late` sample intervals before the sample."""
        j = int(late)
        if late < 0:
            return gain[0]
        if j >= self.run.npast:
            return np.zeros_like(gain[0])
        return (1 - (late - j)) * gain[j] + (late - j) * gain[j + 1]
