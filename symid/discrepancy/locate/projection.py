"""What is left of a fit once its own unknowns have explained all that they can, and how terms would change it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from symid.discrepancy.model.hypothesis import extended, padded
from symid.discrepancy.model.suspects import Suspect
from symid.errors import DiagnosisError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.signals.data import Data
from symid.simulation import Simulator

NOTHING_NEW = 1e-8
"""Part of the power of a response that rounding leaves of what the model's own unknowns explain."""
RUNS_AWAY = 1e100
"""A response as large is that of a motion which grows without end; its square is no number."""


class Projection:
    """The innovations of one fit with everything that its own unknowns could explain taken out.

    Parameters
    ----------
    known : parameters that keep their values and explain nothing.

    Attributes
    ----------
    bases : orthonormal bases (N m, q) of what each suspect that was tried adds.
    scans : of each suspect whose moment or frequency was looked for: (k,) the gain of twice the log-likelihood that
        it is forecast to have at its best one, of (N m, k) that are left.
    """

    def __init__(self, fit: Fit, data: Data, known: Sequence[str] = ()):
        self.fit, self.data = fit, data
        self.bases: list[np.ndarray] = []
        self.scans: list[Callable[[np.ndarray], np.ndarray]] = []
        fitter = Fitter.of(fit, data, known)
        self.steps = fitter.steps
        # The Kalman gain stands still here, as it does for what suspects change: theirs are then no news to these.
        runs = fitter.run(np.array(list(fit.values.values())), fit.initial, fit.kalman_gain, sensitivities=True)
        self.outputs = len(data.sensor_noise)
        q, n = len(fitter.free), fit.initial.shape[1]
        columns = []
        for i, (t, size) in enumerate(zip(runs, fit.whitening.sizes, strict=True)):
            J = fit.whitening(t.dy, size)
            wide = np.zeros((len(J), q + n * len(runs)))
            wide[:, :q], wide[:, q + i * n : q + (i + 1) * n] = J[:, :q], J[:, q:]
            columns.append(wide)
        J = np.vstack(columns)
        if not np.isfinite(J).all():
            raise DiagnosisError(
                f"model '{fit.model.name}' answers its own unknowns with what is no number, as a square root does at "
                "zero; write it so that it has a slope there, or give start values that keep away from it"
            )
        J /= np.maximum(np.sqrt((J**2).sum(0)), 1e-300)
        U, s, _ = np.linalg.svd(J, full_matrices=False)
        self.own = U[:, s > 1e-8 * s[0]]
        self.rest = self.project(self.whiten([s[:, :, None] for s in fit.innovations])[:, 0])

    def whiten(self, parts: Sequence[np.ndarray]) -> np.ndarray:
        """(N, m, q) of each segment -> (N m, q) of all, with unit covariance."""
        whitening = self.fit.whitening
        return np.vstack([whitening(a, size) for a, size in zip(parts, whitening.sizes, strict=True)])

    def project(self, a: np.ndarray) -> np.ndarray:
        return a - self.own @ (self.own.T @ a)

    def score(self, columns: np.ndarray) -> tuple[float, np.ndarray]:
        """Forecast gain of twice the log-likelihood for (N m, q) columns, and their coefficients."""
        gains, coefficients = self.scores(columns, self.rest[:, None])
        return float(gains[0]), coefficients[:, 0]

    def scores(self, columns: np.ndarray, rests: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """`score` of each of (N m, k) `rests`: (k,) gains and (q, k) coefficients."""
        a = self.project(columns)
        kept = (a**2).sum(0) > NOTHING_NEW * (columns**2).sum(0)
        scale = np.sqrt((a**2).sum(0)) + 1e-300
        a = np.where(kept, a / scale, 0.0)
        along = a.T @ rests
        c, *_ = np.linalg.lstsq(a.T @ a, along, rcond=1e-8)
        return (c * along).sum(0), c / scale[:, None]

    def forecast(self, columns: np.ndarray) -> tuple[float, np.ndarray]:
        """`score`, remembering in `bases` what it was that was tried: an orthonormal basis of what the columns add."""
        a = self.project(columns)
        scale = np.sqrt((a**2).sum(0)) + 1e-300
        kept = scale**2 > NOTHING_NEW * (columns**2).sum(0)
        if kept.any():
            self.bases.append(np.linalg.qr((a / scale)[:, kept])[0].astype(np.float32))
        return self.score(columns)

    def response(
        self, suspect: Suspect, sim: Simulator, values: dict[str, float], each: Sequence[dict[str, float]] | None = None
    ) -> np.ndarray | None:
        """(N m, q) change of the predictions per unit of what can be off, at `values`, `each` of one segment."""
        names = [suspect.term.parameter_name(q.key) for q in suspect.law.parameters if q.null is not None]
        out = []
        for e, x0, own in zip(
            self.data.segments, extended(self.fit.initial, sim), each or [{}] * len(self.data.segments), strict=True
        ):
            if not suspect.touches(values, e):
                out.append(np.zeros((*e.recorded.shape, len(names))))
                continue
            p = self.fit.values | suspect.named(values | own)
            t = e.simulate(
                sim, p, x0, padded(self.fit.kalman_gain, sim), sensitivity=names, keep="outputs", **self.steps
            )
            if t.diverged:
                return None
            out.append(t.dy)
        found = self.whiten(out)
        return found if np.abs(found).max(initial=0.0) < RUNS_AWAY else None
