"""Outputs without dynamics: a regression, whose covariance can be written out by hand."""

import numpy as np

import symid as si

TRUTH = {"a": 2.0, "b": 0.7}


def regression(parts=lambda m: (m.a * m.f + m.b * m.g, m.a * m.g), bounds=(-10, 10), priors=None) -> si.Model:
    """Two outputs of two inputs f and g, and two parameters that are on no scale of one."""
    m = si.Model("regression")
    m.f, m.g = si.Input(unit="1"), si.Input(unit="1")
    m.a, m.b = (si.Parameter(unit="m", bounds=bounds, prior=(priors or {}).get(k)) for k in ("a", "b"))
    m.y, m.z = (si.Output(part, unit="m") for part in parts(m))
    return m


def recording(seed=0, count=60, step=0.1, noise=(0.05, 0.2), level=1.0, like=None, known=None) -> si.Recording:
    rng = np.random.default_rng(seed)
    f, g = rng.normal(size=(2, count))
    g = g * level if like is None else like(f, g)
    y = TRUTH["a"] * f + TRUTH["b"] * g + noise[0] * rng.standard_normal(count)
    z = TRUTH["a"] * g + noise[1] * rng.standard_normal(count)
    units = dict.fromkeys("fg", "1") | dict.fromkeys("yz", "m")
    return si.Recording("r", step * np.arange(count), {"f": f, "g": g, "y": y, "z": z}, units, noise=known or {})


def with_gaps(r: si.Recording) -> si.Recording:
    y = r["y"].copy()
    y[5:15] = np.nan
    return si.Recording("gaps", r.time, dict(r.channels) | {"y": y}, r.units)


def slopes_of(r: si.Recording) -> np.ndarray:
    """(K, 2, 2) of both outputs to a and b, zero where nothing was recorded."""
    f, g, none = r["f"], r["g"], np.zeros(len(r))
    slopes = np.stack([np.stack([f, g], axis=1), np.stack([g, none], axis=1)], axis=1)
    return slopes * np.isfinite(np.stack([r["y"], r["z"]], axis=1))[:, :, None]


def weights_of(solution, r: int) -> np.ndarray:
    p = solution.transcription.program
    return p.data[r].step * p.weights[r]
