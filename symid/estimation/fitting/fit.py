"""What a fit of a model to data found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from symid.estimation.sensors.whitening import Whitening
from symid.model import Model
from symid.simulation import Simulator, simulator


def rms_of(errors: Sequence[np.ndarray]) -> np.ndarray:
    """(m,) root mean square of the errors (N, m) of all segments."""
    return np.sqrt(np.mean(np.vstack(errors) ** 2, axis=0))


@dataclass(frozen=True, eq=False)
class Fit:
    """A model with all of its unknowns fitted.

    Attributes
    ----------
    model : what was fitted. values : parameter -> SI.
    initial : (E, n) state at the start of each segment.
    process : (w,) standard deviations of the model's noises that the gain was made for; then, where a filter's
        cutoff was estimated, the sharpness of `Data.sharpened`, and, where `Data.ratios_free`, by what factor the noise
        of each sensor but the first is larger than `Data.sensor_noise`.
    kalman_gain : (n, m) or None. innovations : per segment (N, m), recorded minus predicted.
    whitening : makes the innovations white. loglik2 : twice the log-likelihood.
    errors : parameter -> standard error, zero for what was held; empty where not asked for.
    substeps, method : of the integrator in each sample; `coarse` substeps are good enough for slopes.
    bounded : whether growth without end had to be kept away.
    """

    model: Model
    values: dict[str, float]
    initial: np.ndarray
    process: np.ndarray
    kalman_gain: np.ndarray | None
    innovations: tuple[np.ndarray, ...]
    whitening: Whitening
    loglik2: float
    errors: dict[str, float] = field(default_factory=dict)
    iterations: int = 0
    converged: bool = False
    substeps: int = 1
    coarse: int = 1
    bounded: bool = False
    method: str = "rk4"

    @property
    def simulator(self) -> Simulator:
        return simulator(self.model)

    @property
    def steps(self) -> dict:
        """How the integrator steps, as `Simulator.simulate` takes it."""
        return {"substeps": self.substeps, "method": self.method}

    @property
    def at_bounds(self) -> list[str]:
        """Parameters of which the data ask for a value beyond their bounds.

        Zero is no such bound: nothing has a negative mass, stiffness or damping.
        """
        bounds = {k: p.bounds for k, p in self.model.parameters.items()}
        return [
            k for k, (low, high) in bounds.items() if low < high and self.values[k] in (low, high) and self.values[k]
        ]

    @property
    def covariance(self) -> np.ndarray:
        """(m, m) of the innovations, whitened by their own past where they have a memory."""
        return self.whitening.covariance

    @property
    def rms_errors(self) -> np.ndarray:
        """(m,) root mean square of each output's innovations."""
        return rms_of(self.innovations)

    @property
    def remaining(self) -> tuple[np.ndarray, ...]:
        """Per segment (N, m), the innovations made white and of unit covariance."""
        parts = zip(self.innovations, self.whitening.sizes, strict=True)
        return tuple(self.whitening(s[:, :, None], size).reshape(s.shape) for s, size in parts)
