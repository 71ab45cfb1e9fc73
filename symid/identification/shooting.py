"""A better start where the loop is stable: output error by simulation, without a nonlinear program.

Single shooting with exact sensitivities takes a fraction of a second and ends close to the
optimum of the collocation, which then needs a few iterations. It needs a loop that follows the
recording somewhat: from a worse one, or an unstable one, it could end in another local optimum.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from symid.identification.bounds import parameter_bounds
from symid.simulation import simulator
from symid.transcription import Transcription

MAX_EVALUATIONS = 15


def shoot(t: Transcription, parameters: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]] | None:
    """Parameters and states of every episode that fit the recordings' outputs, or None.

    `parameters` (free parameters,) SI, where the search begins. Process noise enters only the
    final simulation of each episode. None where the model has delays or parameters of single
    recordings, or where the first simulation errs by more than the recorded outputs vary.
    """
    if t.model.delays or len(t.layout.parameter_names) != len(t.model.parameters):
        return None
    sim, names, n = simulator(t.model), t.layout.parameter_names, t.layout.n
    scale = np.concatenate([t.layout.parameter_scale, np.tile(t.layout.state_scale, len(t.measured))])
    weights = np.sqrt(t.program.error_constants[-len(t.model.outputs):])

    def run(x, r, slopes=False, noise=None):
        m, first = t.measured[r], len(names) + n * r
        wanted = {"sensitivity": names, "initial_sensitivity": t.layout.state_names} if slopes else {}
        return sim.simulate(x[:len(names)], x[first:first + n], m.time[m.nodes],
                            {k: u[m.nodes] for k, u in m.inputs.items()}, noise=noise, limit=100.0, **wanted)

    def residual(z):
        errors = [(run(z * scale, r).y - m.targets[m.nodes]) * weights for r, m in enumerate(t.measured)]
        return np.nan_to_num(np.concatenate([e.ravel() for e in errors]), nan=1e3)

    def jacobian(z):
        blocks = []
        for r in range(len(t.measured)):
            dy = run(z * scale, r, slopes=True).dy * weights[:, None]
            block = np.zeros((dy.shape[0] * dy.shape[1], len(z)))
            columns = np.r_[:len(names), len(names) + n * r:len(names) + n * (r + 1)]
            block[:, columns] = np.nan_to_num(dy.reshape(len(block), -1)) * scale[columns]
            blocks.append(block)
        return np.concatenate(blocks)

    initial = [m.states[m.first] for m in t.measured]
    lower, upper = (np.concatenate([b, np.full(n * len(t.measured), s)]) / scale
                    for b, s in zip(parameter_bounds(t), (-np.inf, np.inf), strict=True))
    z = np.clip(np.concatenate([parameters, *initial]) / scale, np.nextafter(lower, np.inf), np.nextafter(upper, -np.inf))
    if not np.mean(residual(z) ** 2) < np.mean([np.var(m.targets[m.nodes] * weights, axis=0) for m in t.measured]):
        return None
    found = least_squares(residual, z, jacobian, bounds=(lower, upper), x_scale="jac", max_nfev=MAX_EVALUATIONS,
                          ftol=1e-6).x * scale
    states, drawn = [], iter(_noise(t))
    for r in t.recording_of:
        trajectory = run(found, r, noise=next(drawn))
        if trajectory.diverged:
            return None
        states.append(trajectory.x)
    return found[:len(names)], states


def _noise(t: Transcription) -> list[dict[str, np.ndarray]]:
    """Per episode the noise by name at all nodes; the last node's is not used."""
    count = len(t.model.noises)
    tables = [d.interval[:, d.interval.shape[1] - count:] for d in t.program.data]
    return [dict(zip(t.model.noises, np.vstack([table, np.zeros((1, count))]).T, strict=True)) for table in tables]
