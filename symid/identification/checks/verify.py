"""A solution checked by others than its solver: a finer mesh, an integrator, the optimality conditions.

The integrator is that of `identification.integrate`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SymidError
from symid.identification.checks.curved import said_of_intervals
from symid.identification.checks.elsewhere import said_of_optimum
from symid.identification.checks.held import said_of_inputs
from symid.identification.checks.integrate import Reintegration
from symid.nlp import OptimalityReport, check_optimality
from symid.threads import one_blas_thread
from symid.units import quantity, rough, unit_symbol

if TYPE_CHECKING:
    import pandas as pd

    from symid.identification.solution import Solution

COARSE = 0.5
"""Error of the mesh [standard errors] that is said: it shifts a 95 % interval by a quarter of its half width."""
FINE = 0.1
"""Error of the mesh [standard errors] that the advised refinement leaves."""
ROUNDED = 1e-6
"""Part of a parameter's value that is no error of the mesh, however small the noise."""
DEPARTS = 0.01
"""Part of the recorded outputs' standard deviation by which an integrated motion may depart from the fitted one, or by
as much as the fit errs."""
MOST_TOLD = 3
"""Outputs that a sentence names."""


@dataclass(frozen=True, eq=False)
class Verification:
    """What others find of a solution.

    Attributes
    ----------
    mesh : (parameters) index name, columns error [SI] (the value's excess that the mesh makes) and std_errors (in
        standard errors), by solving again with steps half as long (Richardson 1911); None if that was not solved.
    departures : per episode (m,) largest distance [SI] of outputs that are integrated from the fitted initial state
        with the fitted parameters to the fitted ones; None where the simulator cannot run the model.
    departs : whether an integrated motion departs by more than `DEPARTS` and than the fit errs.
    optimality : errors of the first-order conditions, measured without Ipopt.
    sentences : what does not agree, in words.
    """

    mesh: pd.DataFrame | None
    departures: tuple[np.ndarray, ...] | None
    departs: bool
    optimality: OptimalityReport
    sentences: tuple[str, ...]

    def __repr__(self) -> str:
        return (
            "\n".join(f"{s}." for s in self.sentences)
            or "Mesh, integrator and optimality conditions agree with the solution."
        )


@one_blas_thread
def verify(solution: Solution) -> Verification:
    """Solve on a finer mesh, integrate, measure optimality, look for other optima where the fit errs much, and at the
    ends of the intervals of what is hardly known.

    It takes about as long as the solve did.
    """
    mesh, departures, optimality = mesh_error(solution), integrated(solution), optimality_of(solution)
    departs, sentences = _departs(solution, departures), []
    if not optimality.ok:
        sentences.append(
            f"Measured without Ipopt the point is not optimal: {str(optimality).splitlines()[1].strip()}; "
            f"{str(optimality).splitlines()[2].strip()}"
        )
    if departs:
        coarse = mesh is not None and bool((mesh["std_errors"].abs() > COARSE).any())
        sentences.append(_said_of_departure(solution, departures, coarse))
    sentences += said_of_optimum(solution) + said_of_inputs(solution) + _said_of_mesh(solution, mesh)
    sentences += said_of_intervals(solution)
    return Verification(mesh, departures, departs, optimality, tuple(sentences))


def optimality_of(solution: Solution) -> OptimalityReport:
    r = solution.result
    nlp = solution.problem.nonlinear_program(r.z)
    return check_optimality(nlp, r.z, r.multipliers, r.bound_multipliers_lower, r.bound_multipliers_upper)


def mesh_error(solution: Solution) -> pd.DataFrame | None:
    """See `Verification.mesh`."""
    import pandas as pd

    finer = replace(solution.problem, refine=2 * solution.problem.refine)
    try:
        result = finer.solve_from(finer.start(solution), near=True, max_iterations=50)
    except SymidError:
        return None
    if not result.solved:
        return None
    values = np.array(list(solution.values.values()))
    gain = 2**solution.problem.scheme.order
    error = (values - finer.transcription.layout.parameters(result.z)) * gain / (gain - 1)
    floor = ROUNDED * np.abs(values)
    std = np.maximum(solution.parameters["std_error"].to_numpy(), floor)
    known = np.isfinite(std) & (std > 0) & (np.abs(error) > floor)
    return pd.DataFrame(
        {"error": error, "std_errors": np.where(known, error / np.where(known, std, 1.0), 0.0)},
        index=solution.parameters.index,
    )


def integrated(solution: Solution) -> tuple[np.ndarray, ...] | None:
    """See `Verification.departures`."""
    try:
        again = Reintegration(solution)
        return tuple(again.departures(e) for e in range(len(solution.trajectories)))
    except SymidError:
        return None


def _departs(solution: Solution, departures) -> bool:
    return departures is not None and any(
        np.any(d > allowed) for d, allowed in zip(departures, _allowed(solution), strict=True)
    )


def _allowed(solution: Solution) -> list[np.ndarray]:
    """Per episode (m,) how far an integrated motion may depart, see `DEPARTS`."""
    t = solution.transcription
    rms = np.array([solution.fit["rms"][name] for name in t.model.outputs])
    size = [np.std(t.measured[r].targets[t.measured[r].nodes], axis=0) for r in t.recording_of]
    return [np.maximum(DEPARTS * s, 3 * rms) for s in size]


def _said_of_departure(solution: Solution, departures, coarse: bool) -> str:
    worst = np.max(departures, axis=0)
    named = list(zip(solution.model.outputs.items(), worst, np.max(worst / _allowed(solution), axis=0), strict=True))
    told = sorted(named, key=lambda one: -one[2])[:MOST_TOLD]
    parts = [f"{name} by up to {quantity(float(x), unit=y.unit or '1')}" for (name, y), x, _ in told]
    parts += [f"and {len(named) - len(told)} more outputs"] if named[MOST_TOLD:] else []
    followed = _followed(solution)
    return (
        "No integrator reproduces this motion: from the fitted initial state with the fitted parameters it departs "
        f"from the fitted one, {', '.join(parts)}. "
    ) + (
        "Nor does it follow from one sample to the next: the mesh is far too coarse"
        if followed is None
        else f"Begun anew every {followed:.3g} s it follows: the mesh is too coarse for more than that, see below"
        if coarse
        else f"Begun anew every {followed:.3g} s it follows: the motion solves the equations, but the model with these "
        "parameters is unstable, and small errors grow"
    )


def _followed(solution: Solution) -> float | None:
    """Time [s], halved from the whole, for which an integration from any fitted state follows the fit; or None."""
    again, allowed, t = Reintegration(solution), _allowed(solution), solution.transcription
    length = max(m.intervals for m in t.measured) // 2
    while length:
        if all(np.all(again.departures(e, length) <= allowed[e]) for e in range(len(allowed))):
            return length * t.measured[0].step
        length //= 2
    return None


def _said_of_mesh(solution: Solution, mesh: pd.DataFrame | None) -> list[str]:
    if mesh is None:
        return ["The error of the mesh is not known: with half its step the problem was not solved"]
    worst = mesh["std_errors"].abs()
    if not len(worst) or not worst.max() > COARSE:
        return []
    name, p = worst.idxmax(), solution.problem
    unit = unit_symbol(solution.model.parameters[name.split("[")[0]].unit)
    factor = int(np.ceil((worst.max() / FINE) ** (1 / p.scheme.order)))
    return [
        f"The mesh is too coarse: it shifts {name} by {rough(mesh.loc[name, 'std_errors'])} standard errors "
        f"({rough(mesh.loc[name, 'error'], 3)} {unit}); "
        f"solution.refined() solves again with {p.refine * factor} intervals in a sample interval"
    ]
