"""Small systems whose standard errors have a closed form: (model, recording, truth, standard errors for noise 0.05)."""

import numpy as np

import symid as si

NOISE = 0.05


def least_squares_errors(slopes: np.ndarray, sigma) -> np.ndarray:
    """Standard errors of a linear fit with slopes (rows, unknowns) and noise sigma of each row."""
    rooted = slopes / np.broadcast_to(np.asarray(sigma), len(slopes))[:, None]
    return np.sqrt(np.diag(np.linalg.inv(rooted.T @ rooted)))


def integrator(seed: int = 0, samples: int = 201, noise: float = NOISE, known: float | None = None):
    """x' = b u with a known input, x observed: the outputs are linear in b and in the initial state."""
    m = si.Model("integrator")
    m.x = si.State(unit="m")
    m.u = si.Input(unit="m/s")
    m.b = si.Parameter(unit="1", bounds=(-10, 10))
    m.motion = si.Equation(m.x.dot - m.b * m.u)
    m.y = si.Output(m.x)
    time = np.linspace(0, 10, samples)
    u = np.sin(1.3 * time) + 0.5
    area = np.concatenate(
        [[0], np.cumsum((u[1:] + u[:-1]) / 2 * np.diff(time))]
    )  # exact for an input linear between samples
    x = 0.3 + 2 * area + noise * np.random.default_rng(seed).standard_normal(samples)
    recording = si.Recording(
        "integrator", time, {"x": x, "u": u}, {"x": "m", "u": "m/s"}, noise={} if known is None else {"x": known}
    )
    return m, recording, {"b": 2.0}, {"b": least_squares_errors(np.column_stack([area, np.ones(samples)]), noise)[0]}


def free_motion(time, k, c, x0, v0):
    """Position of x'' + c x' + k x = 0."""
    w = np.sqrt(k - c**2 / 4)
    return np.exp(-c * time / 2) * (x0 * np.cos(w * time) + (v0 + c * x0 / 2) / w * np.sin(w * time))


def slopes_of(function, point, step: float = 1e-5) -> np.ndarray:
    """(rows, unknowns) central differences of a function of several numbers."""
    columns = []
    for i, p in enumerate(point):
        d = np.zeros(len(point))
        d[i] = step * max(1.0, abs(p))
        columns.append((function(*(point + d)) - function(*(point - d))) / (2 * d[i]))
    return np.column_stack(columns)


def spring() -> si.Model:
    m = si.Model("spring and mass")
    m.x = si.State(unit="m")
    m.v = si.State(unit="m/s")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 100))
    m.c = si.Parameter(unit="1/s", bounds=(-5, 20))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.k * m.x + m.c * m.v)
    return m


def oscillator(seed: int = 0, samples: int = 201, noise: float = NOISE):
    """A damped oscillator that swings out from a free initial state, x observed."""
    m = spring()
    m.y = si.Output(m.x)
    point = np.array([4.0, 0.3, 1.0, 0.0])
    time = np.linspace(0, 10, samples)
    x = free_motion(time, *point) + noise * np.random.default_rng(seed).standard_normal(samples)
    errors = least_squares_errors(slopes_of(lambda *p: free_motion(time, *p), point), noise)
    recording = si.Recording("oscillator", time, {"x": x}, {"x": "m"})
    return m, recording, {"k": 4.0, "c": 0.3}, {"k": errors[0], "c": errors[1]}


def spring_with_sensor(seed: int = 0, samples: int = 801, noise: float = NOISE):
    """The oscillator, its position with an unknown offset, its speed with an unknown gain, in other units and noise."""
    m = spring()
    m.offset = si.Parameter(unit="m", bounds=(-2, 2))
    m.gain = si.Parameter(unit="1", bounds=(0.1, 10))
    m.y = si.Output(m.x + m.offset, channel="x", unit="m")
    m.z = si.Output(m.gain * m.v, channel="v", unit="m/s")
    point = np.array([4.0, 0.3, 1.0, 0.0, 0.2, 1.5])
    time = np.linspace(0, 10, samples)

    def shown(k, c, x0, v0, offset, gain):
        h = 1e-5
        v = (free_motion(time + h, k, c, x0, v0) - free_motion(time - h, k, c, x0, v0)) / (2 * h)
        return np.concatenate([free_motion(time, k, c, x0, v0) + offset, gain * v])

    sigma = np.repeat([noise, 4 * noise], samples)
    y = shown(*point) + sigma * np.random.default_rng(seed).standard_normal(2 * samples)
    errors = least_squares_errors(slopes_of(shown, point), sigma)
    recording = si.Recording("sensor", time, {"x": y[:samples], "v": y[samples:]}, {"x": "m", "v": "m/s"})
    names = ("k", "c", "offset", "gain")
    return (
        m,
        recording,
        dict(zip(names, point[[0, 1, 4, 5]], strict=True)),
        dict(zip(names, errors[[0, 1, 4, 5]], strict=True)),
    )


def two_dampings(seed: int = 0):
    """A driven oscillator with two dampings that only their sum tells, and a state that nothing shows."""
    m = si.Model("two dampings")
    m.x = si.State(unit="m")
    m.v = si.State(unit="m/s")
    m.unseen = si.State(unit="m")
    m.f = si.Input(unit="m/s^2")
    m.k = si.Parameter(unit="1/s^2", bounds=(0, 100))
    m.c = si.Parameter(unit="1/s", bounds=(0, 5))
    m.c2 = si.Parameter(unit="1/s", bounds=(0, 5))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.k * m.x + (m.c + m.c2) * m.v - m.f)
    m.follows = si.Equation(m.unseen.dot + m.unseen / 2 - m.v)
    m.y = si.Output(m.x)
    time = np.linspace(0, 20, 401)
    drive = 3 * np.sin(1.7 * time)
    from scipy.integrate import solve_ivp

    x = solve_ivp(
        lambda t, s: [s[1], -4 * s[0] - 0.5 * s[1] + 3 * np.sin(1.7 * t)], (0, 20), [0.5, 0], t_eval=time, rtol=1e-9
    ).y[0]
    x = x + NOISE * np.random.default_rng(seed).standard_normal(len(time))
    return m, si.Recording("driven", time, {"x": x, "f": drive}, {"x": "m", "f": "m/s^2"})
