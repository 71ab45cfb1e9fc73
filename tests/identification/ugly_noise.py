"""Ugly noise: quantised, proportional, remembering, of heavy tails, with gaps.

`measured(system, noise, seed)` draws a system with noise of one of `NOISES`.
"""

from dataclasses import replace

import numpy as np
from drawn_systems import System, log_uniform


def white(y, size, rng):
    return y + size * rng.standard_normal(len(y))


def proportional(y, size, rng):
    """Of the same root mean square as `white`, as large at each sample as the value there."""
    return y + size * (0.05 + np.abs(y) / np.sqrt(np.mean(y**2))) * rng.standard_normal(len(y))


def quantised(y, size, rng):
    step = size * np.sqrt(12)
    return step * np.round(y / step)


def remembering(y, size, rng, memory=0.9):
    e = rng.standard_normal(len(y) + 100)
    for k in range(1, len(e)):
        e[k] = memory * e[k - 1] + np.sqrt(1 - memory**2) * e[k]
    return y + size * e[100:]


def heavy(y, size, rng):
    return y + size / np.sqrt(3) * rng.standard_t(3, len(y))


def gappy(y, size, rng):
    """White, with every third sample missing at random and a tenth of the recording at a stretch."""
    spoilt = white(y, size, rng)
    spoilt[1:-1][rng.random(len(y) - 2) < 0.33] = np.nan
    first = rng.integers(1, max(2, int(0.85 * len(y))))
    spoilt[first : first + len(y) // 10] = np.nan
    return spoilt


NOISES = {f.__name__: f for f in (white, proportional, quantised, remembering, heavy, gappy)}


def measured(draw, noise: str, seed: int) -> System:
    """The system that `draw` makes without noise, with noise of 0.5 to 5 % of each output's standard deviation."""
    rng = np.random.default_rng([seed, 19])
    clean, size = draw(rng), log_uniform(rng, 0.005, 0.05)
    outputs, recordings, sigma = {y.channel for y in clean.model.outputs.values()}, [], {}
    for r in clean.recordings:
        channels = {}
        for name, y in r.channels.items():
            spread = size * np.std(y)
            channels[name] = NOISES[noise](y, spread, rng) if name in outputs else y
            if name in outputs:
                sigma.setdefault(name, []).append(spread)
        recordings.append(replace(r, channels=channels))
    return replace(
        clean, recordings=recordings, sigma={c: float(np.sqrt(np.mean(np.square(s)))) for c, s in sigma.items()}
    )
