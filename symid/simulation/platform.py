"""Synthetic recordings: platform motion by the article's protocol, and any model simulated on it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symid.errors import SymidError
from symid.model import Model
from symid.recording import Recording
from symid.simulation.simulator import simulator
from symid.units import known_unit

WARM_UP = 20.0
"""Seconds of unrecorded motion before a synthetic recording starts, so that it does not start at rest."""


@dataclass(frozen=True)
class PlatformProtocol:
    """Random square pulses of position through a critically damped actuator and a low pass.

    Amplitudes and durations are those of Wang & van den Bogert (2020, section 2.1); the actuator's
    and the filter's frequencies give the recorded rms and peaks of acceleration (0.57 and 3.6 m/s^2).
    """

    positions: tuple[float, ...] = (-0.05, -0.025, 0.0, 0.025, 0.05)
    durations: tuple[float, ...] = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5)
    actuator: float = 12.0
    low_pass: float = 20.0

    def acceleration(self, time: np.ndarray, seed: int) -> np.ndarray:
        """(N,) platform acceleration [m/s^2] at evenly spaced `time` [s]."""
        return self.motion(time, seed)[2]

    def motion(self, time: np.ndarray, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Position [m], velocity [m/s] and acceleration [m/s^2] at evenly spaced `time` [s]."""
        from scipy.signal import cont2discrete, lfilter  # here: takes half the time that a worker needs to start

        step = float(time[1] - time[0])
        fine = max(1, int(np.ceil(step / 0.001)))
        h, n = step / fine, (len(time) - 1) * fine + 1
        w, v = self.actuator, self.low_pass
        denominator = np.polymul([1, 2 * w, w * w], [1, 2 * v, v * v])
        command = self._command(n, h, np.random.default_rng(seed))
        out = []
        for derivative in range(3):
            numerator = np.concatenate([[w * w * v * v], np.zeros(derivative)])
            b, a, _ = cont2discrete((numerator, denominator), h, method="zoh")
            out.append(lfilter(b.ravel(), a, command)[::fine])
        return tuple(out)

    def _command(self, n: int, h: float, rng: np.random.Generator) -> np.ndarray:
        pulses, total = [], 0
        while total < n:
            length = round(rng.choice(self.durations) / h)
            pulses.append(np.full(length, rng.choice(self.positions)))
            total += length
        return np.concatenate(pulses)[:n]


def synthetic_recording(
    model: Model,
    parameters: Mapping[str, float],
    *,
    duration: float,
    rate: float,
    seed: int,
    process_noise: Mapping[str, float] | None = None,
    sensor_noise: Mapping[str, float] | None = None,
    resolution: float = 0.0,
    initial_state: Mapping[str, float] | None = None,
    warm_up: float = WARM_UP,
    hold: float = 0.01,
    protocol: PlatformProtocol | None = None,
) -> Recording:
    """Simulate `model` and record its outputs and inputs with noise.

    Parameters
    ----------
    parameters : SI values. duration [s], rate [Hz].
    process_noise : noise name -> standard deviation, drawn anew every `hold` seconds.
    sensor_noise : channel -> standard deviation; resolution : step of an encoder, 0 for none.
    initial_state : zero where left out. warm_up : seconds before the recording [s].
    protocol : what every input does; the article's platform by default.

    Raises
    ------
    SymidError : the motion diverges, or a noise or channel is unknown.

    Examples
    --------
    >>> facts = {"m1_kg": 0.3, "a1_m": 0.2, "I1_kg_m2": 4e-3}
    >>> rig = si.mechanics.rig_model(facts, ["link1_angle"], friction=["joint1"])
    >>> made = synthetic_recording(rig, dict.fromkeys(rig.parameters, 1e-3), duration=2, rate=100, seed=1, warm_up=0,
    ...                            initial_state={"link1_angle": 1.0}, sensor_noise={"link1_angle": 1e-3})
    >>> len(made.time)
    201
    """
    rng = np.random.default_rng(seed)
    fine = max(1, int(np.ceil(1 / rate / hold - 1e-9)))
    step = 1 / rate / fine
    n = round((warm_up + duration) * rate) * fine + 1
    time = np.arange(n) * step - warm_up
    inputs = {k: (protocol or PlatformProtocol()).acceleration(time, int(rng.integers(2**31))) for k in model.inputs}
    noise = {k: _held(rng, n, max(1, round(hold / step)), s) for k, s in (process_noise or {}).items()}
    _known("process noise", noise, model.noises, model)
    channels = [y.channel for y in model.outputs.values()]
    _known("sensor", sensor_noise or {}, channels, model)
    start = dict.fromkeys(model.states, 0.0) | dict(initial_state or {})
    run = simulator(model.with_unstated_holds("linear")).simulate(
        parameters, start, time, inputs, noise=noise, substeps=max(1, int(np.ceil(step / 0.0051))), method="stiff"
    )
    if run.diverged:
        raise SymidError(
            f"model '{model.name}' with these parameters diverges {time[run.reached]:+.2f} s after the start of "
            "the recording; choose a stable loop"
        )
    rows = slice(round(warm_up * rate) * fine, None, fine)
    table, units = {}, {}
    for y, values in zip(model.outputs.values(), run.y.T, strict=True):
        noisy = values[rows] + rng.normal(size=len(values[rows])) * (sensor_noise or {}).get(y.channel, 0.0)
        table[y.channel] = np.round(noisy / resolution) * resolution if resolution else noisy
        units[y.channel] = known_unit(y.unit).si
    for name, values in inputs.items():
        table[model.inputs[name].channel] = values[rows]
        units[model.inputs[name].channel] = known_unit(model.inputs[name].unit).si
    return Recording(
        f"synthetic {model.name}",
        time[rows],
        table,
        units,
        noise=dict(sensor_noise or {}),
        history=(f"simulated with seed {seed}",),
    )


def _held(rng: np.random.Generator, n: int, hold: int, size: float) -> np.ndarray:
    return np.repeat(rng.normal(size=n // hold + 1) * size, hold)[:n]


def _known(what: str, given, names, model: Model) -> None:
    for name in given:
        if name not in names:
            raise SymidError(f"model '{model.name}' has no {what} '{name}'; it has {', '.join(names)}")
