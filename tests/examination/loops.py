"""What a machine under feedback does, with what its model lacks, shaken by random forces besides the recorded ones.

By an integrator of this file, of fixed steps: Runge and Kutta's of order 4, with forces that jump at each.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from lacking import Joint, force_of, late_sensor, signal_of
from machines import Made

import symid as si
from symid.mechanics import LIBRARY

FINE = 10
"""Steps of the simulation in a sample."""
SAMPLES, SWINGS, WARM_UP = 40, 120, 15
"""Samples in a swing; swings in a recording and before it."""
LATE = (0.03, 0.1)
"""Delays and lags of the feedback, in parts of a swing."""
KEYS = {"feedback_delay": "delay_s", "muscle_lag": "time_constant_s"}
FORCES = ("coulomb_friction", "joint_drag", "cubic_stiffness")
UNSTABLE, FARTHEST = 1e6, 30.0
"""A state, and usual swings of a joint, beyond which a loop holds nothing: an arm turned eleven times (601)."""


@dataclass(frozen=True)
class Loop:
    """A model under feedback, and the plant that it is of.

    rates : of the states, from them, the inputs by channel and the forces at the joints. feedback : those forces, from
    positions and rates of the joints. joints : by place. noise : rms over a sample of the random force at each joint,
    as a part of its usual one. inputs : rms by channel. outputs : functions of the states by channel.
    """

    model: si.Model
    rates: Callable
    feedback: Callable
    joints: dict[str, Joint]
    noise: float
    inputs: dict[str, float]
    outputs: dict[str, Callable]
    pace_Hz: float
    start: tuple[float, ...]

    @property
    def missing(self) -> list[tuple[str, str]]:
        """Every law that it may lack, and where; half of them of the feedback."""
        others = [(law, at) for at in self.joints for law in FORCES]
        others += [(law, y.at) for y in self.model.outputs.values() for law in ("sensor_delay", "sensor_lag")]
        return [*others, *((law, "global") for law in KEYS for _ in range(len(others) // 2))]


def run_loop(rng, loop: Loop, missing: tuple[str, str] | None) -> Made:
    """What it did, without noise of its sensors; FloatingPointError where what is missing makes it unstable."""
    law, at = missing or ("", "")
    f0, step, count = loop.pace_Hz, 1 / (SAMPLES * loop.pace_Hz), (SWINGS + WARM_UP) * SAMPLES
    time, first = step * np.arange(count), WARM_UP * SAMPLES
    given = {c: signal_of(rng, time, f0, rms) for c, rms in loop.inputs.items()}
    late, force, truth = rng.uniform(*LATE) / f0, {}, {}
    if law in KEYS:
        truth = {LIBRARY[law].at(at): {KEYS[law]: late}}
    if law in FORCES:
        force[at], values = force_of(rng, law, loop.joints[at])
        truth = {LIBRARY[law].at(at): values}
    seen = _states(rng, loop, given, force, {law: late}, step / FINE, (count - 1) * FINE)
    if any(np.ptp(j.position(seen.T)) > FARTHEST * j.swing for j in loop.joints.values()):
        raise FloatingPointError("the joints turn far beyond where the loop holds them")
    outputs = {c: f(seen.T) for c, f in loop.outputs.items()}
    for part in loop.model.outputs.values():
        if law.startswith("sensor") and part.at == at:
            fine = step / FINE * np.arange(len(seen))
            outputs[part.channel], values = late_sensor(rng, law, fine, outputs[part.channel], f0)
            truth = {LIBRARY[law].at(at): values}
    units = {p.channel: p.unit for p in (*loop.model.inputs.values(), *loop.model.outputs.values())}
    inputs = {c: s(time[first:]) for c, s in given.items()}
    outputs = {c: y[::FINE][first:] for c, y in outputs.items()}
    return Made(loop.model, time[first:] - time[first], inputs, outputs, units, truth, f0)


def _states(rng, loop: Loop, given, force, late: dict[str, float], h: float, steps: int) -> np.ndarray:
    """(steps + 1, n) states. given : signals by channel. force : missing ones by joint. late : [s] by law."""
    joints, delay, lag = list(loop.joints.values()), late.get("feedback_delay", 0.0), late.get("muscle_lag", 0.0)
    usual = loop.noise * np.array([j.force for j in joints])
    shake = rng.standard_normal((steps, len(joints))) * usual * FINE**0.5
    u = {c: s(np.arange(2 * steps + 1) * h / 2) for c, s in given.items()}
    n, past = len(loop.start), []
    x = np.r_[loop.start, np.zeros(len(joints) if lag else 0)]
    seen = np.zeros((steps + 1, n))

    def signals(state) -> np.ndarray:
        return np.array([[j.position(state) for j in joints], [j.rate(state) for j in joints]])

    def late_signals(step: float) -> np.ndarray:
        i = max(int(np.floor(step)), 0)
        return past[i] + (step - i) * (past[i + 1] - past[i]) if step > 0 else past[0]

    def rates(state, k: int, halves: int):
        now = state[:n]
        asked = loop.feedback(*(late_signals(k + halves / 2 - delay / h) if delay else signals(now)))
        extra = [force[p](now) if p in force else 0.0 for p in loop.joints]
        acts = (state[n:] if lag else asked) + shake[k] + extra
        dx = loop.rates(now, {c: v[2 * k + halves] for c, v in u.items()}, acts)
        return np.r_[dx, (asked - state[n:]) / lag] if lag else np.asarray(dx)

    for k in range(steps):
        seen[k] = x[:n]
        if delay:
            past.append(signals(x[:n]))
        a = rates(x, k, 0)
        b = rates(x + 0.5 * h * a, k, 1)
        c = rates(x + 0.5 * h * b, k, 1)
        d = rates(x + h * c, k, 2)
        x = x + h / 6 * (a + 2 * b + 2 * c + d)
        if not np.abs(x).max() < UNSTABLE:
            raise FloatingPointError("the loop is not stable")
    seen[-1] = x[:n]
    return seen
