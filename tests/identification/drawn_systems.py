"""A system with a random truth, records of it, and what an identification of it should reach.

Motions come from the compiled simulator with fine substeps, which the identification does not share a formula with.
"""

from dataclasses import dataclass, field

import numpy as np

import symid as si
from symid.recording import Recording
from symid.simulation import simulator

BEATEN = 1.005
"""Objective over that of the truth above which there is a better optimum; the rest is the error of the mesh."""
OFF = 6.0
"""Standard errors from the truth that no luck explains."""


@dataclass(frozen=True, eq=False)
class System:
    """A model, recordings, the true parameters, the noise of each recorded channel, how to solve it.

    motions : (samples, n) true states of each recording.
    """

    model: si.Model
    recordings: list[Recording]
    truth: dict[str, float]
    sigma: dict[str, float]
    options: dict
    motions: list[np.ndarray] = field(default_factory=list)

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

    def lost(self, solution: si.Solution) -> str:
        """Why `solution` is not the best optimum, or why its errors are wrong and nothing says so; "" if neither.

        The truth follows the equations, too: of the best optimum the objective is less. It is where a solve
        from the truth ends.
        """
        t = solution.transcription
        true = np.array([self.truth[name] for name in t.layout.parameter_names])
        z = t.start(true, [self.motions[r] for r in t.recording_of])
        of_truth = t.program.objective(z)
        if solution.result.objective > BEATEN * of_truth:  # on a coarse mesh the truth does not solve the equations
            of_truth = max(of_truth, solution.problem.solve_from(z, near=True).objective)
        said = f"its objective is {solution.result.objective / of_truth:.5g} times that of the truth"
        if solution.result.objective > BEATEN * of_truth:
            return said
        table = solution.parameters
        off = (np.abs(table.value - true) / table.std_error).fillna(0.0)
        if off.max() > OFF and not solution.warnings:
            return f"{off.idxmax()} is {off.max():.3g} standard errors off, {said}"
        return ""


def record(
    model: si.Model,
    truth: dict,
    initial: list[float],
    time: np.ndarray,
    inputs: dict[str, np.ndarray],
    noise: float,
    rng: np.random.Generator,
    name: str,
) -> tuple[Recording, dict[str, float], np.ndarray]:
    """The motion of the truth with sensor noise of `noise` times each channel's standard deviation; its true states."""
    run = simulator(model).simulate(truth, initial, time, inputs, substeps=20, limit=1e12)
    assert not run.diverged, f"{name}: the truth itself diverges"
    channels, sigma = {u.channel: inputs[k] for k, u in model.inputs.items()}, {}
    for (k, y), values in zip(model.outputs.items(), run.y.T, strict=True):
        sigma[y.channel] = noise * max(np.std(values), 1e-3 * np.abs(values).max())
        channels[y.channel] = values + sigma[y.channel] * rng.standard_normal(len(time))
    units = {u.channel: u.unit or "1" for u in (*model.inputs.values(), *model.outputs.values())}
    return Recording(name, time, channels, units), sigma, run.x


def system(
    model: si.Model, truth: dict, runs: list[tuple], noise: float, rng: np.random.Generator, **options
) -> System:
    """runs : (initial state, time, inputs) of each recording."""
    made = [record(model, truth, x0, t, u, noise, rng, f"{model.name} {k + 1}") for k, (x0, t, u) in enumerate(runs)]
    recordings, noises, motions = zip(*made, strict=True)
    sigma = {c: float(np.sqrt(np.mean([s[c] ** 2 for s in noises]))) for c in noises[0]}
    return System(model, list(recordings), truth, sigma, options, list(motions))


def smooth(rng: np.random.Generator, time: np.ndarray, fastest: float, size: float = 1.0) -> np.ndarray:
    """A random multisine of six lines up to `fastest` [Hz], of standard deviation `size`."""
    f = rng.uniform(0.05, 1.0, 6) * fastest
    return size / np.sqrt(3) * np.sin(2 * np.pi * np.outer(time, f) + rng.uniform(0, 2 * np.pi, 6)).sum(axis=1)


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))
