"""A solution checked by others than its solver: a finer mesh, an integrator, the optimality conditions.

The integrator is the compiled simulator with steps that are halved until the outputs agree: 0.03 s for 5000 samples.
SciPy's, which call Python at every step, take more than a second for a thousand samples of a driven model, longer
than the solve; that they find the same departures is a test.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symid.errors import SymidError
from symid.identification.elsewhere import said_of_optimum
from symid.nlp import OptimalityReport, check_optimality
from symid.simulation import simulator
from symid.threads import one_blas_thread
from symid.transcription.known import input_at
from symid.units import unit_symbol

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
PIECES, HALVINGS, AGREES = 8, 6, 1e-4
"""Of a sample interval into pieces, of which the integrator halves its steps until the outputs agree to that part of
their standard deviation."""


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
    """Solve on a finer mesh, integrate, measure optimality, look for other optima where the fit errs much.

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
        sentences.append(_said_of_departure(solution, departures))
    sentences += said_of_optimum(solution) + _said_of_mesh(solution, mesh)
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
    t, found = solution.transcription, []
    try:
        loop = simulator(t.model)
        for e, frame in enumerate(solution.trajectories):
            y = _integrate(solution, loop, e)
            fitted = frame[list(t.model.outputs)].to_numpy()
            found.append(np.nan_to_num(np.abs(y - fitted), nan=np.inf).max(axis=0))
    except SymidError:
        return None
    return tuple(found)


def _integrate(solution: Solution, loop, e: int) -> np.ndarray:
    """(samples, m) outputs, with steps that are halved until they agree."""
    t = solution.transcription
    m, d, parameters = t.measured[t.recording_of[e]], t.program.data[e], t.layout.parameters(solution.result.z)
    time = m.mesh(PIECES)
    inputs = {u: np.append(input_at(t.model, t.scheme, m, u, 0.0, PIECES), m.inputs[u][m.last]) for u in m.inputs}
    if t.scheme.order == 2 and t.layout.refine == 1:  # its mesh sees straight lines
        inputs |= {u: np.interp(time, m.time, m.inputs[u]) for u in m.inputs if t.model.inputs[u].hold == "smooth"}
    noise = {w: np.append(np.repeat(x, PIECES), 0.0) for w, x in zip(t.model.noises, d.noise.T, strict=True)}
    before = slice(0, m.first + 1)
    history = (m.time[before], m.states[before]) if t.model.delays and m.first else None
    size, last = np.std(m.targets[m.nodes], axis=0), None
    for halvings in range(HALVINGS):
        run = loop.simulate(
            parameters[t.layout.parameter_index[e]],
            t.layout.states(solution.result.z, e)[0],
            time,
            inputs,
            noise=noise,
            history=history,
            substeps=2**halvings,
            limit=1e200,
            keep="outputs",
        ).y[::PIECES]
        large = np.maximum(np.maximum(size, np.abs(run)), np.finfo(float).tiny)  # a recording of zeros has no size
        if last is not None and np.nanmax(np.abs(run - last) / large, initial=0.0) < AGREES:
            break
        last = run
    return run


def _departs(solution: Solution, departures) -> bool:
    t = solution.transcription
    rms = np.array([solution.fit["rms"][name] for name in t.model.outputs])
    size = [np.std(t.measured[r].targets[t.measured[r].nodes], axis=0) for r in t.recording_of]
    return departures is not None and any(
        np.any(d > np.maximum(DEPARTS * s, 3 * rms)) for d, s in zip(departures, size, strict=True)
    )


def _said_of_departure(solution: Solution, departures) -> str:
    worst = np.max(departures, axis=0)
    parts = [
        f"{name} by up to {x:.3g} {unit_symbol(y.unit)}".strip()
        for (name, y), x in zip(solution.model.outputs.items(), worst, strict=True)
    ]
    return (
        "No integrator reproduces this motion: from the fitted initial state with the fitted parameters it departs "
        "from the "
        f"fitted one, {', '.join(parts)}. The model with these parameters is unstable, or the mesh far too coarse"
    )


def _said_of_mesh(solution: Solution, mesh: pd.DataFrame | None) -> list[str]:
    if mesh is None:
        return ["The error of the mesh is not known: with half its step the problem was not solved"]
    worst = mesh["std_errors"].abs()
    if not len(worst) or not worst.max() > COARSE:
        return []
    name, p = worst.idxmax(), solution.problem
    factor = int(np.ceil((worst.max() / FINE) ** (1 / p.scheme.order)))
    return [
        f"The mesh is too coarse: it shifts {name} by {mesh.loc[name, 'std_errors']:.2g} standard errors "
        f"({mesh.loc[name, 'error']:+.3g} {solution.model.parameters[name.split('[')[0]].unit}); solution.refined() "
        f"solves again with {p.refine * factor} intervals in a sample interval"
    ]
