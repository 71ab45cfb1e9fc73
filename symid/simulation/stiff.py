"""A stiff motion, integrated by SciPy's Radau IIA of order 5 (Hairer & Wanner 1996, section IV.8).

An explicit method needs steps as short as the fastest time constant, however long that has died away.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from symid.codegen.ode import BETWEEN, ode_source
from symid.deadline import check
from symid.errors import SymidError
from symid.model import Model
from symid.recording.signals.between import CURVES, bend, derivatives
from symid.threads import one_blas_thread

MOST = 100_000
"""Evaluations of the rates, some seconds of Python, after which an integration is given up."""


@one_blas_thread
def simulate_stiff(
    model: Model,
    parameters: np.ndarray,
    initial_state: np.ndarray,
    time: np.ndarray,
    inputs: Mapping[str, np.ndarray],
    noise: Mapping[str, np.ndarray],
    size: np.ndarray,
    tolerance: float,
) -> np.ndarray:
    """Outputs (N, m) at `time`, of a model without late signals.

    Parameters
    ----------
    parameters, initial_state : in declared order [SI].
    inputs, noise : as of `Simulator.simulate`.
    size : (n,) of the states [SI]; errors are `tolerance` times it.

    Raises
    ------
    SymidError : late signals, more than `MOST` evaluations, or rates that cannot be solved for.
    """
    from scipy.integrate import solve_ivp

    source = ode_source(model)
    if source.late:
        raise SymidError(f"simulation of '{model.name}': a stiff integrator has no late signals")
    functions, n = source.in_python(), len(source.states)
    constants = np.array([c.value for c in model.constants.values()], dtype=float)
    u = np.column_stack([np.zeros(len(time)), *(inputs[k] for k in source.inputs)])[:, 1:]
    w = np.column_stack([np.zeros(len(time)), *(noise[k] for k in source.noises)])[:, 1:]
    holds, calls, late = [BETWEEN[k] for k in source.input_between], 0, np.zeros(0)
    held, curved, quintic = (np.isin(holds, kinds) for kinds in (["zero"], [*CURVES], ["band-limited"]))
    slopes, bends = derivatives(time, u, holds)

    def given(t: float, k: int) -> np.ndarray:
        """Inputs at t, of which those that are held are those of sample k."""
        j = min(max(int(np.searchsorted(time, t, side="right")) - 1, 0), len(time) - 2)
        h = time[j + 1] - time[j]
        part, line = (t - time[j]) / h, (u[j + 1] - u[j]) / h
        ends = None if bends is None else (bends[j], bends[j + 1])
        more, _ = bend(part, h, slopes[j] - line, slopes[j + 1] - line, ends, quintic)
        return np.where(held, u[k], u[j] + (t - time[j]) * line + curved * more)

    def rates(t: float, x: np.ndarray, k: int) -> np.ndarray:
        nonlocal calls
        calls += 1
        check()
        if calls > MOST:
            raise SymidError(f"simulation of '{model.name}': more than {MOST} evaluations of a stiff motion")
        mass, force = functions["mass"](np.zeros(n), x, late, given(t, k), w[k], parameters, constants, t)
        try:
            return np.linalg.solve(mass.reshape(n, n), -force)
        except np.linalg.LinAlgError as singular:
            raise SymidError(f"simulation of '{model.name}': rates cannot be solved for at {t:g} s") from singular

    states, steady = [np.asarray(initial_state, dtype=float)[None]], np.column_stack([u[:, held], w])
    edges = [0, *(np.flatnonzero(np.any(np.diff(steady[:-1], axis=0) != 0, axis=1)) + 1), len(time) - 1]
    for k, end in zip(edges, edges[1:], strict=False):
        try:
            run = solve_ivp(
                rates,
                (time[k], time[end]),
                states[-1][-1],
                "Radau",
                time[k + 1 : end + 1],
                args=(k,),
                rtol=tolerance,
                atol=tolerance * size,
            )
        except ValueError as infinite:  # SciPy's linear algebra refuses what is not finite
            raise SymidError(f"simulation of '{model.name}': no finite rates after {time[k]:g} s") from infinite
        if not run.success:
            raise SymidError(f"simulation of '{model.name}': {run.message}")
        states.append(run.y.T)
    y = []
    for j, x in enumerate(np.concatenate(states)):
        k = min(j, len(time) - 2)
        rate = rates(time[j], x, k) if source.outputs_need_rates else np.zeros(n)
        y += functions["observe"](rate, x, late, u[j], w[k], parameters, constants, time[j])
    return np.array(y)
