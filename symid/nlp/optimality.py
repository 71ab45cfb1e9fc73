"""Is a point optimal? The first-order conditions, measured without the solver."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from symid.nlp.program import NonlinearProgram


@dataclass(frozen=True)
class OptimalityReport:
    """Errors of the first-order conditions (Waechter and Biegler 2006, eqs. 4 to 6).

    All are measured on the scaled program; stationarity and complementarity are divided by the
    mean size of the multipliers over 100 where that exceeds 1, as in eq. 5.
    """

    feasibility: float
    feasibility_place: str
    stationarity: float
    stationarity_place: str
    dual_feasibility: float
    complementarity: float
    multipliers_estimated: bool
    tolerance: float

    @property
    def ok(self) -> bool:
        """Whether every error is below the tolerance."""
        errors = (self.feasibility, self.stationarity, self.dual_feasibility, self.complementarity)
        return max(errors) < self.tolerance

    def __str__(self) -> str:
        origin = "estimated by least squares" if self.multipliers_estimated else "given"
        return (
            f"{'Optimal' if self.ok else 'NOT optimal'} to {self.tolerance:g} (multipliers {origin}):\n"
            f"  feasibility: {self.feasibility:.1e} at {self.feasibility_place}\n"
            f"  stationarity: {self.stationarity:.1e} at {self.stationarity_place}\n"
            f"  dual feasibility: {self.dual_feasibility:.1e}\n"
            f"  complementarity: {self.complementarity:.1e}"
        )


def check_optimality(
    nlp: NonlinearProgram,
    z: np.ndarray,
    multipliers: np.ndarray | None = None,
    bound_multipliers_lower: np.ndarray | None = None,
    bound_multipliers_upper: np.ndarray | None = None,
    *,
    tolerance: float = 1e-5,
    active_tolerance: float = 1e-6,
) -> OptimalityReport:
    """Measure how well `z` satisfies the first-order conditions of `nlp`.

    Parameters
    ----------
    z : array, shape (n,)
        The point to judge.
    multipliers : array, shape (m,), optional
        Multipliers of the constraints: positive pushes down from the upper side. If any of the
        three is absent all are estimated by least squares over the active constraints and bounds,
        those within `active_tolerance` (relative) of their bound.
    bound_multipliers_lower, bound_multipliers_upper : array, shape (n,), optional
        Non-negative multipliers of the bounds.

    Returns
    -------
    OptimalityReport
    """
    z = np.asarray(z, dtype=float)
    given = (multipliers, bound_multipliers_lower, bound_multipliers_upper)
    estimated = any(one is None for one in given)
    lam, low, up = _estimate(nlp, z, active_tolerance) if estimated else map(np.asarray, given)
    scale_z = np.ones(nlp.n) if nlp.variable_scale is None else nlp.variable_scale
    scale_g = np.ones(nlp.m) if nlp.constraint_scale is None else nlp.constraint_scale
    values = nlp.constraints(z)
    slope = (nlp.gradient(z) + nlp.jacobian_matrix(z).T @ lam - low + up) * scale_z
    slope = slope / nlp.objective_scale
    duals = np.concatenate([lam * scale_g, low * scale_z, up * scale_z]) / nlp.objective_scale
    damping = max(1.0, np.abs(duals).mean() / 100) if duals.size else 1.0
    violation = np.concatenate([
        _outside(values, nlp.constraint_lower, nlp.constraint_upper) / scale_g,
        _outside(z, nlp.lower, nlp.upper) / scale_z,
    ])  # fmt: skip
    worst = int(np.argmax(violation))
    place = nlp.describe_constraint(worst) if worst < nlp.m else nlp.describe_variable(worst - nlp.m)
    steepest = int(np.argmax(np.abs(slope)))
    products = np.concatenate([
        np.maximum(lam, 0) * _gap(values, nlp.constraint_upper),
        np.maximum(-lam, 0) * _gap(values, nlp.constraint_lower),
        low * _gap(z, nlp.lower),
        up * _gap(z, nlp.upper),
    ])  # fmt: skip
    wrong_sign = np.concatenate([-low, -up, *_unbounded_pull(nlp, lam, low, up)])
    return OptimalityReport(
        feasibility=float(violation[worst]), feasibility_place=place,
        stationarity=float(abs(slope[steepest]) / damping),
        stationarity_place=nlp.describe_variable(steepest),
        dual_feasibility=float(max(0.0, wrong_sign.max()) / nlp.objective_scale),
        complementarity=float(np.abs(products).max() / nlp.objective_scale / damping),
        multipliers_estimated=estimated, tolerance=tolerance,
    )  # fmt: skip


def _outside(value, lower, upper) -> np.ndarray:
    return np.maximum(0.0, np.maximum(lower - value, value - upper))


def _gap(value, bound) -> np.ndarray:
    """Distance to a bound; zero where there is none, for `_unbounded_pull` sees to those."""
    return np.where(np.isfinite(bound), np.abs(value - np.where(np.isfinite(bound), bound, 0)), 0.0)


def _unbounded_pull(nlp: NonlinearProgram, lam, low, up) -> list[np.ndarray]:
    """Multipliers that push away from a bound which does not exist."""
    pairs = ((lam, nlp.constraint_upper), (-lam, nlp.constraint_lower), (low, nlp.lower), (up, nlp.upper))
    return [np.where(np.isinf(bound), multiplier, 0.0) for multiplier, bound in pairs]


def _near(value, bound, tolerance) -> np.ndarray:
    return np.isfinite(bound) & (np.abs(value - bound) <= tolerance * np.maximum(1.0, np.abs(value)))


def _estimate(nlp: NonlinearProgram, z: np.ndarray, tolerance: float):
    """Least-squares multipliers over active constraints and variables away from their bounds."""
    values, gradient, jacobian = nlp.constraints(z), nlp.gradient(z), nlp.jacobian_matrix(z)
    active = np.flatnonzero(
        _near(values, nlp.constraint_lower, tolerance) | _near(values, nlp.constraint_upper, tolerance)
    )
    at_lower, at_upper = _near(z, nlp.lower, tolerance), _near(z, nlp.upper, tolerance)
    free = np.flatnonzero(~(at_lower | at_upper))
    inner = jacobian[active][:, free]
    lam = np.zeros(nlp.m)
    if active.size and free.size:
        # Normal equations as an augmented system keep the sparsity; the tiny shift makes
        # dependent constraints solvable.
        shift = -1e-12 * scipy.sparse.eye_array(active.size)
        system = scipy.sparse.block_array([[scipy.sparse.eye_array(free.size), inner.T], [inner, shift]])
        solution = scipy.sparse.linalg.splu(system.tocsc()).solve(np.r_[-gradient[free], np.zeros(active.size)])
        lam[active] = solution[free.size :]
    slope = gradient + jacobian.T @ lam
    return lam, np.where(at_lower, np.maximum(slope, 0), 0.0), np.where(at_upper, np.maximum(-slope, 0), 0.0)
