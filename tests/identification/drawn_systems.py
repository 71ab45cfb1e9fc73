"""A system with a random truth, records of it, and what an identification of it should reach.

Motions come from the compiled simulator with fine substeps, which the identification does not share a formula with.
"""

from dataclasses import dataclass

import numpy as np

import symid as si
from symid.recording import Recording
from symid.simulation import simulator


@dataclass(frozen=True, eq=False)
class System:
    """A model, recordings, the true parameters, the noise of each recorded channel, and how to solve it."""

    model: si.Model
    recordings: list[Recording]
    truth: dict[str, float]
    sigma: dict[str, float]
    options: dict

    def problem(self) -> si.Identification:
        return si.Identification(self.model, self.recordings, **self.options)

    def failure(self, solution: si.Solution, allowed: float = 1.3) -> str:
        """Why `solution` is not the one that follows the recordings within the noise; "" if it is."""
        if not solution.solved:
            return solution.result.status_name
        errors = {
            y.channel: solution.fit["rms"][name] / self.sigma[y.channel] for name, y in self.model.outputs.items()
        }
        return "; ".join(f"{c} errs by {e:.2f} times its noise" for c, e in errors.items() if e > allowed)


def record(
    model: si.Model,
    truth: dict,
    initial: list[float],
    time: np.ndarray,
    inputs: dict[str, np.ndarray],
    noise: float,
    rng: np.random.Generator,
    name: str,
) -> tuple[Recording, dict[str, float]]:
    """The motion of the truth with sensor noise of `noise` times each channel's standard deviation."""
    run = simulator(model).simulate(truth, initial, time, inputs, substeps=20, limit=1e12)
    assert not run.diverged, f"{name}: the truth itself diverges"
    channels, sigma = {u.channel: inputs[k] for k, u in model.inputs.items()}, {}
    for (k, y), values in zip(model.outputs.items(), run.y.T, strict=True):
        sigma[y.channel] = noise * max(np.std(values), 1e-3 * np.abs(values).max())
        channels[y.channel] = values + sigma[y.channel] * rng.standard_normal(len(time))
    units = {u.channel: u.unit or "1" for u in (*model.inputs.values(), *model.outputs.values())}
    return Recording(name, time, channels, units), sigma


def system(
    model: si.Model, truth: dict, runs: list[tuple], noise: float, rng: np.random.Generator, **options
) -> System:
    """runs : (initial state, time, inputs) of each recording."""
    made = [record(model, truth, x0, t, u, noise, rng, f"{model.name} {k + 1}") for k, (x0, t, u) in enumerate(runs)]
    sigma = {c: float(np.sqrt(np.mean([s[c] ** 2 for _, s in made]))) for c in made[0][1]}
    return System(model, [r for r, _ in made], truth, sigma, options)


def smooth(rng: np.random.Generator, time: np.ndarray, fastest: float, size: float = 1.0) -> np.ndarray:
    """A random multisine of six lines up to `fastest` [Hz], of standard deviation `size`."""
    f = rng.uniform(0.05, 1.0, 6) * fastest
    return size / np.sqrt(3) * np.sin(2 * np.pi * np.outer(time, f) + rng.uniform(0, 2 * np.pi, 6)).sum(axis=1)


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))
