"""States that outputs show together: positions of markers give angles, the angle behind a gear that of the motor."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from symid.codegen import compile_program
from symid.codegen.equations.balance import shown_program
from symid.model import Model
from symid.transcription.guesses import parameter_guesses

DRAWS, STEPS = 64, 30
"""Random first values for the first sample, and Gauss-Newton steps from each."""
TOGETHER, PARTS, FOLLOWING = 4, 1000, 6
"""Samples that begin from the last one before them, half a period at ten samples to it, or so many that there are a
thousand parts of a long recording; and steps from there at most."""
SOLVED = 1e-12
"""Error of the outputs, as a share of their variation, with which the steps end."""
AGREED = 0.3
"""Error of the outputs, as a share of their variation, up to which the states count as seen."""


def seen_together(
    model: Model, channels: Mapping[str, np.ndarray], known: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """States (samples,) [SI] beside the `known` ones, with which outputs are as recorded.

    From outputs that are functions of states and constants alone, but for an offset, which is as guessed; none where
    these have fewer equations than unknown states, or no solution within the states' bounds is found. Of several
    solutions the nearest to zero begins, and the motion goes on from it.
    """
    guesses = dict(zip(model.parameters, parameter_guesses(model), strict=True))
    names, program = list(model.states), shown_program(model, guesses)
    rows = [i for i, of in enumerate(program.shows) if of and not of <= known.keys()]
    unknown = sorted(set().union(*(program.shows[i] for i in rows)) - known.keys()) if rows else []
    if not unknown or len(rows) < len(unknown):
        return {}
    kernel = compile_program(program.program, backend="numpy")
    outputs = list(model.outputs.values())
    targets = np.column_stack([channels[outputs[i].channel] for i in rows])
    spread = np.maximum(targets.std(axis=0), 1e-9 * np.abs(targets).max(axis=0))
    places = [names.index(s) for s in unknown]
    local = np.column_stack([known.get(s, np.zeros(len(targets))) for s in names])
    constants = np.array([c.value for c in model.constants.values()], dtype=float)

    def stepped(x: np.ndarray, at: np.ndarray, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """Gauss-Newton from `x` (k, unknown) for the samples `at` (k,); and (k, rows) errors that are left."""
        here = local[at].copy()
        for last in range(steps + 1):
            here[:, places] = x
            given = (here, np.empty(0), np.empty((len(at), 0)), constants)
            error = kernel.residual(*given)[:, rows] - targets[at]
            if last == steps or not np.isfinite(error).all() or np.all(np.abs(error) <= SOLVED * spread):
                break
            dense = np.zeros((len(at), kernel.m, kernel.n_local))
            dense[:, kernel.jacobian_rows, kernel.jacobian_cols] = kernel.jacobian(*given)
            slopes = dense[:, rows][:, :, places] / spread[:, None]
            norm = np.linalg.norm(slopes, axis=1, keepdims=True)
            norm = np.where(norm > 0, norm, 1.0)  # whatever the units of outputs and states
            x = x - (np.linalg.pinv(slopes / norm, rcond=1e-9) @ (error / spread)[:, :, None])[:, :, 0] / norm[:, 0]
        return x, error

    with np.errstate(all="ignore"):
        try:
            found = _followed(stepped, targets, spread, [model.states[s].unit == "rad" for s in unknown])
        except np.linalg.LinAlgError:  # what is not finite has no pseudo-inverse
            return {}
    if found is None:
        return {}
    lower, upper = np.array([model.states[s].bounds for s in unknown], dtype=float).T
    return {} if np.any((found < lower) | (found > upper)) else dict(zip(unknown, found.T, strict=True))


def _followed(stepped, targets: np.ndarray, spread: np.ndarray, angles: list[bool]) -> np.ndarray | None:
    """(samples, unknown) from the first sample on, None where the outputs are not as recorded."""
    size = np.where(angles, 1.0, np.abs(targets).max())
    draws = np.random.default_rng(0).standard_normal((DRAWS, len(size))) * size
    ends = [stepped(x[None], np.array([0]), STEPS) for x in draws]
    good = [x[0] for x, e in ends if np.isfinite(x).all() and np.all(np.abs(e) <= AGREED * spread)]
    if not good:
        return None
    x = min(good, key=lambda end: float(np.sum((end / size) ** 2)))
    found, errors = np.empty((len(targets), len(size))), np.empty_like(targets)
    together = max(TOGETHER, len(targets) // PARTS)
    for first in range(0, len(targets), together):
        at = np.arange(first, min(first + together, len(targets)))
        found[at], errors[at] = stepped(np.tile(x, (len(at), 1)), at, FOLLOWING)
        x = found[at[-1]]
    agrees = np.isfinite(found).all() and np.all(np.sqrt(np.mean(errors**2, axis=0)) <= AGREED * spread)
    return found if agrees else None
