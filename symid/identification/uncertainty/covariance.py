"""Covariance of the identified parameters: sensitivities at the solution, and a model of the errors."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from symid.identification.noise import Beside, Errors, choose
from symid.identification.uncertainty.combinations import Combination, combinations, involved
from symid.identification.uncertainty.disturbances import Disturbances
from symid.identification.uncertainty.sensitivity import PROBES, Reduced, Sensitivity
from symid.ipopt_solver import SolverResult
from symid.threads import one_blas_thread
from symid.transcription import Transcription

UNSEEN = 1e-9
"""Change of the outputs, as a share of what is recorded, by a parameter's whole scale, that counts as none."""
ALIKE = 1e-7
"""Relative singular value below which changes of the outputs by several parameters are the same: derivatives through
a factorised system have some nine digits."""


@dataclass(frozen=True, eq=False)
class ParameterErrors:
    """What a solution's data say of its parameters [SI].

    Parameters
    ----------
    covariance : (q, q) on what is determined; zero for parameters at a bound.
    inverse : (q, q) inverse of half the objective's curvature: what the covariance would be for unit weights and noise.
    null : (q, k) directions in which the outputs do not change.
    at_bound : (q,) whether a parameter sits at a bound.
    model : name of the error model. why : a sentence about it.
    noise : (recordings, m) standard deviation of the noise of each output.
    residuals : of each recording, with what the fit could follow of them.
    worth_of_disturbances : objective of one of one standard deviation, in the mean of those that are penalised.
    misfit : penalised disturbance -> its mean square over what its penalty expects beside the noise.
    """

    covariance: np.ndarray
    inverse: np.ndarray
    null: np.ndarray
    at_bound: np.ndarray
    model: str
    why: str
    noise: np.ndarray
    residuals: list[Errors]
    worth_of_disturbances: float = 0.0
    misfit: dict[str, float] = field(default_factory=dict)

    @property
    def undetermined(self) -> np.ndarray:
        """(q,) whether the data say nothing of a parameter alone."""
        return np.any(self.null != 0, axis=1)

    @property
    def std_errors(self) -> np.ndarray:
        """(q,) NaN for a parameter at a bound, infinite for one that is not determined."""
        errors = np.sqrt(np.maximum(np.diag(self.covariance), 0.0))
        return np.where(self.at_bound, np.nan, np.where(self.undetermined, np.inf, errors))

    def worth(self, index: int) -> float:
        """Deviance of a unit of the objective: for parameter `index`, or over all where it is not determined."""
        covariance, inverse = np.diag(self.covariance), np.diag(self.inverse)
        known = np.flatnonzero(np.isfinite(self.std_errors) & (covariance > 0))
        chosen = [index] if index in known else known
        return float(np.exp(np.mean(np.log(inverse[chosen] / covariance[chosen])))) if len(chosen) else 1.0

    def determined(self, names: list[str], values: np.ndarray) -> list[tuple[Combination, float]]:
        """Combinations of undetermined parameters that are determined, with their standard errors."""
        found = combinations(self.null, names, values)
        return [(c, float(np.sqrt(max(c.gradient @ self.covariance @ c.gradient, 0.0)))) for c in found]


@one_blas_thread
def parameter_errors(
    t: Transcription,
    result: SolverResult,
    known: np.ndarray,
    choice: str = "auto",
    penalty: float = 0.0,
    loss: dict[str, float] | None = None,
) -> ParameterErrors:
    """Standard errors by an error model of `noise`.

    A change of one recorded sample moves the optimum by the inverse of the optimality system times
    the mixed derivative of the objective; noise of the model's covariance is sent through that
    influence (sandwich; Ljung 1999, section 9.4). Whatever the weights of the objective are.

    Parameters
    ----------
    known : (recordings, m) standard deviations of the noise [SI], NaN where unknown.
    choice : "auto", "white", "coloured" or "clustered".
    penalty : weight of squared scaled parameters in the objective. loss : output name -> width of a robust loss.
    """
    s = Sensitivity(t, result.z, result.multipliers, bound_active(t, result), penalty, loss or {})
    s = replace(s, fixed=_pushed(s))
    white, at_bound = s.gauss_newton(), s.fixed
    inverse, null, shared = determined(white)
    errors, disturbances = _errors(white, shared, known), Disturbances(white, inverse)
    beside, told = None, errors
    if t.model.controls:
        told = _told(disturbances, errors)
        beside = Beside(told, disturbances.left, known.shape[1])
    model = choose(told, choice, t.episodes.count, beside)
    reduced, inverse = (white, inverse) if model.name == "white" else _exact(s, white, inverse)
    disturbances = Disturbances(reduced, inverse)
    total, noise, why = model.covariance(told, disturbances.influences)
    total = total + t.information * inverse @ disturbances.prior @ inverse
    scale, q = t.layout.parameter_scale, len(t.layout.parameter_names)
    free = ~at_bound[t.layout.offsets[-1] :]
    full, unit = np.zeros((q, q)), np.zeros((q, q))
    full[np.ix_(free, free)], unit[np.ix_(free, free)] = (
        x * np.outer(scale[free], scale[free]) for x in (total, inverse)
    )
    directions = np.zeros((q, null.shape[1]))
    directions[free] = null * scale[free, None]
    noise = noise[:, : known.shape[1]]
    found = ParameterErrors(full, unit, directions, ~free, model.name, why, noise, errors)
    if beside is None or not disturbances.names:
        return found
    misfit = dict(zip(disturbances.names, map(float, beside.misfit), strict=True))
    return replace(found, worth_of_disturbances=float(np.mean(beside.worth[known.shape[1] :])), misfit=misfit)


def bound_active(t: Transcription, result: SolverResult) -> np.ndarray:
    """(n,) whether each unknown sits at one of its bounds, or has but one value."""
    lower, upper, z = t.program.lower, t.program.upper, result.z
    near = 1e-5 * np.maximum(1.0, np.abs(z))
    pull = 1e-8 * t.program.objective_scale
    with np.errstate(invalid="ignore"):
        return (
            (lower == upper)
            | ((z - lower < near) & (result.bound_multipliers_lower > pull))
            | ((upper - z < near) & (result.bound_multipliers_upper > pull))
        )


def _pushed(s: Sensitivity) -> np.ndarray:
    """(n,) `s.fixed` without parameters at a bound along which the outputs do not change: nothing pushes them there,
    and what they make up for is as undetermined as they are."""
    first, program = s.t.layout.offsets[-1], s.t.program
    free = s.fixed & ~((np.arange(s.fixed.size) >= first) & (program.lower < program.upper))
    if np.array_equal(free, s.fixed):
        return s.fixed
    null = determined(replace(s, fixed=free).gauss_newton())[1]
    flat = first + np.flatnonzero(~free[first:])[np.any(null != 0, axis=1)]
    return np.where(np.isin(np.arange(s.fixed.size), flat), False, s.fixed)


def determined(reduced: Reduced) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Inverse information (q, q) on the determined subspace, null space (q, k), orthonormal slopes (rows, q - k).

    A parameter that has no part in the null space has zeros there: what its step does to the outputs counts, which no
    unit changes.
    """
    s = reduced.s
    rooted = np.sqrt(s.curvatures)[:, None] * reduced.slopes
    values, vectors = np.linalg.eigh(reduced.beside)
    rooted = np.vstack(
        [rooted, np.sqrt(s.penalty) * np.eye(rooted.shape[1]), (vectors * np.sqrt(np.maximum(values, 0.0))).T]
    )
    size = np.linalg.norm(rooted, axis=0)
    recorded = np.concatenate([np.nan_to_num(s.t.measured[r].recorded).ravel() for r in s.t.recording_of])
    seen = size > UNSEEN * np.sqrt(np.sum(s.weights * recorded**2))
    scale = np.where(seen, size, 1.0)
    u, values, v = np.linalg.svd(np.where(seen, rooted / scale, 0.0), full_matrices=False)
    kept = values > ALIKE
    root = v[kept].T / values[kept] / scale[:, None]
    null = v[~kept].T
    null = np.where(involved(null)[:, None], null, 0.0) / scale[:, None]
    return root @ root.T, null, reduced.slopes @ root


def _exact(s: Sensitivity, white: Reduced, inverse: np.ndarray) -> tuple[Reduced, np.ndarray]:
    """With the curvature of model and outputs where that is a minimum, on the determined subspace; else without.

    Errors that are not small beside the motion bend the objective, most of all those of the process
    noise that an episode is given.
    """
    values, vectors = np.linalg.eigh(inverse)
    root = vectors[:, values > 0] * np.sqrt(values[values > 0])
    exact = s.exact()
    curvature = root.T @ exact.curvature @ root
    if np.linalg.eigvalsh(curvature).min(initial=1.0) <= ALIKE:
        return white, inverse
    return exact, root @ np.linalg.inv(curvature) @ root.T


def _errors(reduced: Reduced, shared: np.ndarray, known: np.ndarray) -> list[Errors]:
    s, t = reduced.s, reduced.s.t
    own = s.by_recording(reduced.initial_slopes(t.layout.n * t.episodes.count + PROBES))
    found = []
    for r, slopes in enumerate(s.by_recording(shared)):
        episodes = [e for e, of in enumerate(t.recording_of) if of == r]
        error = np.mean([s.pulls[e] for e in episodes], axis=0)
        present = np.isfinite(t.measured[r].recorded)
        step = t.program.data[episodes[0]].step
        weights = step * t.program.weights[episodes[0]] * len(episodes)
        slopes, own_slopes = slopes * present[:, :, None], own[r] * present[:, :, None]
        own_slopes = _orthonormal(own_slopes, weights)
        found.append(Errors(error, slopes, own_slopes, weights, known[r], present, t.measured[r].step))
    return found


def _told(d: Disturbances, errors: list[Errors]) -> list[Errors]:
    """Errors of outputs and disturbances together, in which the parameters' own directions are orthonormal."""
    values, vectors = np.linalg.eigh(d.inverse)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    parts = zip(errors, d.error, d.slopes, d.weights, d.known, d.present, strict=True)
    return [
        replace(
            r,
            error=error,
            shared=slopes @ root * present[:, :, None],
            own=np.zeros((*error.shape, 0)),
            weights=np.concatenate([r.weights, weights * d.t.episodes.count]),
            known=np.concatenate([r.known, known]),
            present=present,
        )
        for r, error, slopes, weights, known, present in parts
    ]


def _orthonormal(slopes: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(K, m, d) a basis of the slopes whose weighted squares sum to one."""
    root = np.sqrt(weights)[:, None]
    u, values, _ = np.linalg.svd(
        (slopes * root).reshape(slopes.shape[0] * slopes.shape[1], slopes.shape[2]), full_matrices=False
    )
    kept = values > ALIKE * values.max(initial=0.0)
    seen = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    return u[:, kept].reshape(*slopes.shape[:2], kept.sum()) * seen
