"""Cheap forecasts of what a suspect would gain, before anything is refitted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import fftconvolve

from symid.discrepancy.comb import comb
from symid.discrepancy.data import Data
from symid.discrepancy.fit import Fit, Fitter, whitened
from symid.discrepancy.suspects import HIGHEST_FREQUENCY, Suspect
from symid.model import Model
from symid.simulation import Simulator, simulator


class Screen:
    """The surprises of one fit with everything that its own unknowns could explain taken out."""

    def __init__(self, fit: Fit, data: Data):
        self.fit, self.data = fit, data
        fitter = Fitter(fit.model, data)
        self.substeps = fitter.substeps
        runs = fitter.run(np.array(list(fit.values.values())), fit.initial, fit.gain, sensitivities=True)
        self.white = np.sqrt(data.weight) * np.linalg.inv(np.linalg.cholesky(fit.covariance))
        q, n = len(fitter.free), fit.initial.shape[1]
        columns = []
        for i, t in enumerate(runs):
            J = self.whiten(t.dy)
            wide = np.zeros((len(J), q + n * len(runs)))
            wide[:, :q], wide[:, q + i * n:q + (i + 1) * n] = J[:, :q], J[:, q:]
            columns.append(wide)
        J = np.vstack(columns)
        J /= np.maximum(np.sqrt((J**2).sum(0)), 1e-300)
        U, s, _ = np.linalg.svd(J, full_matrices=False)
        self.own = U[:, s > 1e-8 * s[0]]
        self.rest = self.project(np.concatenate([self.whiten(s[:, :, None])[:, 0] for s in fit.surprise]))

    def whiten(self, a: np.ndarray) -> np.ndarray:
        """(N, m, q) -> (N m, q) with unit covariance."""
        return whitened(self.white, a)

    def project(self, a: np.ndarray) -> np.ndarray:
        return a - self.own @ (self.own.T @ a)

    def score(self, columns: np.ndarray, rest: np.ndarray | None = None) -> tuple[float, np.ndarray]:
        """Gain of twice the log-likelihood forecast for (N m, q) columns, and their coefficients; of other surprises if given."""
        rest = self.rest if rest is None else rest
        a = self.project(columns)
        kept = (a**2).sum(0) > 1e-8 * (columns**2).sum(0)
        scale = np.sqrt((a**2).sum(0)) + 1e-300
        a = np.where(kept, a / scale, 0.0)
        c, *_ = np.linalg.lstsq(a.T @ a, a.T @ rest, rcond=1e-8)
        return float(c @ (a.T @ rest)), c / scale

    def response(self, suspect: Suspect, sim: Simulator, values: dict[str, float],
                 each: Sequence[dict[str, float]] | None = None) -> np.ndarray | None:
        """(N m, q) change of the predictions per unit of what can be switched off, at `values`, `each` of one episode."""
        names = [suspect.term.parameter_name(q.key) for q in suspect.law.parameters if q.null is not None]
        out = []
        for e, x0, own in zip(self.data.episodes, extended(self.fit.initial, sim), each or [{}] * len(self.data.episodes), strict=True):
            if not suspect.touches(values, e):
                out.append(np.zeros((e.recorded.size, len(names))))
                continue
            p = self.fit.values | suspect.named(values | own)
            t = sim.simulate(p, x0, e.time, e.inputs, substeps=self.substeps, gain=padded(self.fit.gain, sim),
                             recorded=e.recorded, sensitivity=names, keep="outputs")
            if t.diverged:
                return None
            out.append(self.whiten(t.dy))
        return np.vstack(out)

    def scan(self, suspect: Suspect, model: Model) -> list[tuple[float, dict[str, float]]]:
        """Forecasts over the grid of the scanned parameter, best first, with start values."""
        sim, found = simulator(model), []
        strength = suspect.strength.key
        if self.data.driven and suspect.scanned.key == "start_s":
            grid = slide(self, suspect, sim)
        elif self.data.driven and suspect.scanned.key == "frequency_Hz":
            grid = sweep(self, suspect, sim)
        elif suspect.scanned.key == "frequency_Hz":
            grid = comb(self, suspect, sim, HIGHEST_FREQUENCY)
        else:
            grid = suspect.grid(self.data)
        for values in grid:
            quadratures = suspect.quadratures(values)
            columns = [self.response(suspect, sim, v) for v in quadratures]
            if any(c is None for c in columns):
                continue
            gain, c = self.score(np.hstack(columns))
            if len(c) == 2:
                turned = {strength: float(np.hypot(*c)), suspect.phase: float(np.arctan2(c[1], c[0]))}
            else:
                turned = {strength: suspect.strength.null + float(c[0])}
            found.append((gain, values | turned))
        low, high = suspect.strength.bounds
        found = [(g, v) for g, v in found if low <= v[strength] <= high]
        return sorted(found, key=lambda f: -f[0])


def slide(screen: Screen, suspect: Suspect, sim: Simulator, keep: int = 4) -> list[dict[str, float]]:
    """The best starts of an event: its response is computed once per shape and slid over the surprises.

    A loop that is nearly linear and does not change answers alike at all times; what this picks
    is scored exactly afterwards.
    """
    (t0, t1), found = screen.data.span, []
    step = screen.data.episodes[0].step
    rest = screen.rest.reshape(-1, len(screen.white))
    for values in suspect.shapes():
        middle = 0.5 * (t0 + t1)
        column = screen.response(suspect, sim, values | {"start_s": middle})
        if column is None:
            continue
        first = int((middle - t0) / step) - 1
        kernel = column.reshape(rest.shape)[first:first + int(10 / step)]
        score = sum(fftconvolve(rest[:, o], kernel[::-1, o])[len(kernel) - 1:] for o in range(rest.shape[1]))
        gain = score**2 / (kernel**2).sum()
        for k in _peaks(gain, int(0.5 / step), keep):
            found.append((gain[k], values | {"start_s": float(t0 + (k + 1) * step)}))
    return [v for _, v in sorted(found, key=lambda f: -f[0])[:2 * keep]]


def sweep(screen: Screen, suspect: Suspect, sim: Simulator, keep: int = 6) -> list[dict[str, float]]:
    """The best frequencies: the response is known from a few and interpolated, surprises by FFT."""
    rest = screen.rest.reshape(-1, len(screen.white))
    n, step = len(rest), screen.data.episodes[0].step
    time = np.arange(n) * step
    known = np.geomspace(0.05, HIGHEST_FREQUENCY, 24)
    answers = []
    for f in known:
        column = screen.response(suspect, sim, suspect.starts()[0] | {"frequency_Hz": float(f), suspect.phase: 0.0})
        if column is None:
            return []
        late = slice(n // 5, None)
        basis = np.column_stack([np.cos(2 * np.pi * f * time), np.sin(2 * np.pi * f * time)])[late]
        c, *_ = np.linalg.lstsq(basis, column.reshape(rest.shape)[late], rcond=None)
        answers.append(c[0] - 1j * c[1])
    size = 4 * n
    f = np.fft.rfftfreq(size, step)
    use = (f > 1.0 / time[-1]) & (f < HIGHEST_FREQUENCY)
    spectrum = np.fft.rfft(rest, size, axis=0)[use]
    G = np.column_stack([np.interp(f[use], known, [a[o].real for a in answers])
                         + 1j * np.interp(f[use], known, [a[o].imag for a in answers]) for o in range(rest.shape[1])])
    gain = 2 * np.abs((G.conj() * spectrum).sum(1)) ** 2 / (n * (np.abs(G) ** 2).sum(1) + 1e-300)
    return [suspect.starts()[0] | {"frequency_Hz": float(f[use][k])} for k in _peaks(gain, 6, keep)]


def _peaks(values: np.ndarray, apart: int, keep: int) -> list[int]:
    """Indices of the largest values that are at least `apart` from each other."""
    values, found = values.copy(), []
    for _ in range(keep):
        k = int(np.argmax(values))
        if not values[k] > 0:
            break
        found.append(k)
        values[max(0, k - apart):k + apart + 1] = 0
    return found


def padded(gain: np.ndarray | None, sim: Simulator) -> np.ndarray | None:
    """The gain with rows of zero for states that a term added."""
    if gain is None:
        return None
    rows = len(sim.states) - gain.shape[-2]
    return np.pad(gain, [(0, 0)] * (gain.ndim - 2) + [(0, rows), (0, 0)])


def extended(initial: np.ndarray, sim: Simulator) -> np.ndarray:
    """Initial states with zero for states that a term added."""
    return np.hstack([initial, np.zeros((len(initial), len(sim.states) - initial.shape[1]))])
