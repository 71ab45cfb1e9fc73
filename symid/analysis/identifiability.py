"""Which parameters can be told apart at all, before there are data: rank of the output sensitivities."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from symid import checked
from symid.analysis.eigenvalues import slopes_at
from symid.errors import ModelError
from symid.identification.uncertainty.combinations import combinations, involved
from symid.model import Model
from symid.model.symmetry import unchanged
from symid.simulation import Trajectory, simulator

DEPENDENT = 1e-8
"""Singular value, relative to unit columns, below which sensitivities are dependent: Runge-Kutta keeps a symmetry of
the model to rounding, while what only looks alike over a short time differs by more."""
POINTS, EXPERIMENTS, SAMPLES = 3, 3, 300
"""Random parameter values; motions from other states and inputs at each of them; samples of a motion."""
GROWN = 4.0
"""Exponent to which an unstable mode may grow in a motion: its digits must not drown the others'."""


@dataclass(frozen=True)
class Identifiability:
    """What outputs, recorded without noise, would determine.

    Attributes
    ----------
    parameters : all names. rank : how many numbers of them are determined.
    undetermined : names of the parameters that are not determined alone.
    combinations : what is determined of those, and whether that is proved on the equations.
    unobserved : states whose initial values no output shows, with the parameters known.
    """

    parameters: tuple[str, ...]
    rank: int
    undetermined: tuple[str, ...]
    combinations: dict[str, bool]
    unobserved: tuple[str, ...]

    @property
    def identifiable(self) -> bool:
        """Whether every parameter is determined (locally: up to finitely many values)."""
        return not self.undetermined

    def __repr__(self) -> str:
        said = ["All parameters are determined by the outputs."] if self.identifiable else []
        if self.undetermined:
            said.append(
                f"{', '.join(self.undetermined)}: not determined one by one; together "
                f"{len(self.parameters) - self.rank} of their numbers can be chosen freely."
            )
        for text, exact in self.combinations.items():
            said.append(f"Determined: {text} ({'exact, by the equations' if exact else 'at random points'}).")
        if self.unobserved:
            said.append(f"No output shows: {', '.join(self.unobserved)}.")
        return "\n".join(said)


def identifiability(model: Model, seed: int = 0) -> Identifiability:
    """Local structural identifiability from motions at random parameters, states and inputs.

    The sensitivities of the outputs to the parameters, less what initial states can do, have full rank
    where no combination of parameters is free (Jacquez & Greif 1985; Stigter & Molenaar 2015). A
    combination that is the same at all points is proved by SymPy where the equations themselves do not
    change along it, which needs no motion.

    Parameters
    ----------
    model : with outputs. seed : of the random points.

    Raises
    ------
    ModelError
        If the model has no outputs, or no bounded motion was found at random parameters.

    Examples
    --------
    >>> si.identifiability(model)
    All parameters are determined by the outputs.
    """
    checked.kind(model, Model, "identifiability", ModelError)
    seed = checked.whole(seed, "identifiability: seed", ModelError)
    model = model.simulated("identifiability")
    names = list(model.parameters)
    if not model.outputs:
        raise ModelError(f"identifiability: model '{model.name}' has no Output")
    found = [_at_point(model, np.random.default_rng([seed, k])) for k in range(POINTS)]
    freedom = min(null.shape[1] for _, null, _ in found)
    found = [(p, null, unseen) for p, null, unseen in found if null.shape[1] == freedom]
    lost = np.any([involved(_unit(null)) for _, null, _ in found], axis=0) if freedom else np.zeros(len(names), bool)
    told = [{c.text: c for c in combinations(null, names, p)} for p, null, _ in found]
    same = [text for text in told[0] if all(text in other for other in told)]
    unseen = set.intersection(*(set(u) for _, _, u in found))
    exact = _proved(model, found[0][1], found[0][0], names) if same and len(same) == len(told[0]) else False
    return Identifiability(
        tuple(names),
        len(names) - freedom,
        tuple(n for n, x in zip(names, lost, strict=True) if x),
        dict.fromkeys(same, exact),
        tuple(s for s in model.states if s in unseen),
    )


def _unit(null: np.ndarray) -> np.ndarray:
    """Each parameter divided by its size: whether it takes part does not depend on its unit."""
    size = np.linalg.norm(null, axis=1)
    return null / np.where(size > 0, size, 1.0)[:, None]


def _at_point(model: Model, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Random parameters (q,), null space (q, k) of the sensitivities there, states that no output shows."""
    states, blocks, seen = list(model.states), [], np.zeros(len(model.states))
    for _ in range(20):
        values = _draw(model.parameters.values(), rng)
        runs = [_run(model, values, rng) for _ in range(EXPERIMENTS)]
        if not any(run.diverged or run.dy is None or not np.all(np.isfinite(run.dy)) for run in runs):
            break
    else:
        raise ModelError(
            f"identifiability: the motion of model '{model.name}' is unbounded at random parameters; give its "
            "parameters bounds or guesses"
        )
    unit = np.concatenate([np.abs(values), np.ones(len(states))])
    scale = np.max([np.abs(run.dy * unit).max(axis=(0, 2)) for run in runs], axis=0)
    q, size = len(values), np.zeros(len(values))
    for run in runs:
        dy = (run.dy / np.where(scale > 0, scale, 1.0)[:, None]).reshape(-1, q + len(states))
        size += np.sum(dy[:, :q] ** 2, axis=0)
        basis, kept = _range(dy[:, q:])
        seen = np.maximum(seen, kept)
        blocks.append(dy[:, :q] - basis @ (basis.T @ dy[:, :q]))
    size = np.where(size > 0, np.sqrt(size), 1.0)
    _, s, v = np.linalg.svd(np.vstack(blocks) / size, full_matrices=True)
    s = np.concatenate([s, np.zeros(q - len(s))])
    return values, v[s < DEPENDENT].T / size[:, None], [n for n, x in zip(states, seen, strict=True) if x == 0]


def _range(slopes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Orthonormal range of (rows, n), and (n,) whether each column is more than nothing."""
    size = np.linalg.norm(slopes, axis=0)
    seen = size > DEPENDENT * size.max(initial=0.0)
    u, s, _ = np.linalg.svd(slopes[:, seen] / size[seen], full_matrices=False)
    return u[:, s > DEPENDENT], seen.astype(float)


def _run(model: Model, values: np.ndarray, rng: np.random.Generator) -> Trajectory:
    """A motion and its sensitivities, from a random state under random inputs, over the time of the model's modes."""
    start = _draw(model.states.values(), rng, centred=True)
    names = list(model.parameters)
    slopes = slopes_at(model, start[None, :], dict(zip(names, values, strict=True)))
    roots = np.linalg.eigvals(np.linalg.solve(slopes.mass[0], -slopes.state[0])) if len(start) else np.zeros(0)
    speeds = np.abs(roots[np.abs(roots) > 1e-6 * max(np.abs(roots).max(initial=0.0), 1e-300)])
    slow, fast = (speeds.min(), speeds.max()) if len(speeds) else (1.0, 1.0)
    length = min(6 / np.sqrt(slow * fast), GROWN / max(roots.real.max(initial=0.0), 1e-9 * fast))
    time = np.linspace(0, length, SAMPLES)
    inputs = {
        name: sum(
            rng.uniform(0.3, 1) * np.sin(2 * np.pi * rng.uniform(0.3, 6) * time / length + rng.uniform(0, 6))
            for _ in range(4)
        )
        for name in model.inputs
    }
    return simulator(model).simulate(
        values,
        start,
        time,
        inputs,
        sensitivity=names,
        initial_sensitivity=list(model.states),
        substeps=int(np.clip(np.ceil(2 * fast * length / SAMPLES), 1, 50)),
        limit=1e6,
    )


def _draw(parts: Iterable[Any], rng: np.random.Generator, centred: bool = False) -> np.ndarray:
    """Random values inside the bounds, about the guesses, or of order one."""
    values = []
    for p in parts:
        (low, high), guess = p.bounds, getattr(p, "guess", None)
        if guess:
            value = guess * rng.uniform(0.7, 1.3)
        elif np.isfinite([low, high]).all():
            value = low + (high - low) * (rng.uniform(0.35, 0.65) if centred else rng.uniform(0.2, 0.8))
            value = np.clip(value, -1, 1) if centred and low < 0 < high else value
        else:
            value = rng.uniform(-0.5, 0.5) if centred else rng.uniform(0.5, 2.0)
        values.append(float(np.clip(value, low, high)))
    return np.array(values)


def _proved(model: Model, null: np.ndarray, values: np.ndarray, names: list[str]) -> bool:
    """Whether each null direction, as one of sums or of products, leaves the equations as they are."""
    for basis, as_factors in ((null, False), (null / values[:, None], True)):
        rows = _echelon(basis)
        if all(unchanged(model, {n: x for n, x in zip(names, row, strict=True) if x}, as_factors) for row in rows):
            return True
    return False


def _echelon(null: np.ndarray) -> np.ndarray:
    """(k, q) the directions with as many zeros and ones as they allow."""
    rows = null.T.copy()
    for i in range(len(rows)):
        free = np.abs(rows[i])
        pivot = int(np.argmax(free))
        rows[i] /= rows[i, pivot]
        for j in range(len(rows)):
            if j != i:
                rows[j] -= rows[j, pivot] * rows[i]
    rows[np.abs(rows) < 1e-7] = 0
    return np.array([[round(float(x), 6) for x in row] for row in rows])
