"""Systems whose 95 % intervals are counted: name -> a function of a seed that gives (identification, truth by name)."""

import numpy as np
from error_systems import NOISE, free_motion, integrator, oscillator, spring, spring_with_sensor

import symid as si
from symid.mechanics import FullStatePD
from symid.simulation import simulator
from symid.synthetic import BODY, GAINS, standing_recording

ALGEBRAIC = np.array([[1e6, 3.0], [3.0, 1e-4]])
"""Covariance of the noise of the two channels of `algebraic`."""
SENSOR = 3e-3
"""Noise of the angles of the standing person [rad]."""


def of(make, **options):
    def problem(seed):
        model, recording, truth, _ = make(seed=seed, **options)
        return si.Identification(model, recording), truth

    return problem


def vyasarayani(seed):
    """theta'' + p sin theta = 0 with p = 10 over 50 s (Vyasarayani et al. 2011), from SciPy's integrator."""
    from scipy.integrate import solve_ivp

    m = si.Model("pendulum of Vyasarayani")
    m.angle = si.State(unit="rad")
    m.rate = si.State(unit="rad/s")
    m.p = si.Parameter(unit="1/s^2", bounds=(1, 30))
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    import sympy as sm

    m.balance = si.Equation(m.rate.dot + m.p * sm.sin(m.angle))
    m.y = si.Output(m.angle)
    time = np.linspace(0, 50, 1001)
    x = solve_ivp(lambda t, x: [x[1], -10 * np.sin(x[0])], (0, 50), [1.0, 0.0], t_eval=time, rtol=1e-9, atol=1e-10).y[0]
    x = x + 0.05 * np.random.default_rng(seed).standard_normal(len(time))
    return si.Identification(
        m, si.Recording("pendulum", time, {"angle": x}, {"angle": "rad"}), scheme=si.HermiteSimpson()
    ), {"p": 10.0}


def two_rates(seed):
    """The oscillator at 5 Hz with a quarter of the noise of the one at 250 Hz."""
    model, slow, truth, _ = oscillator(seed=2 * seed, samples=51, noise=0.0125)
    fast = oscillator(seed=2 * seed + 1, samples=2501)[1]
    return si.Identification(model, [slow, fast], scheme=si.HermiteSimpson()), truth


def algebraic(seed):
    """Two channels that are functions of an input alone, noise that they share, parameters of very different size."""
    rng, time = np.random.default_rng(seed), np.linspace(0, 10, 301)
    m = si.Model("algebraic")
    m.rest = si.State(unit="1")
    m.u = si.Input(unit="1")
    m.a = si.Parameter(unit="1", bounds=(-1e7, 1e7))
    m.b = si.Parameter(unit="1", bounds=(-1e-2, 1e-2))
    m.c = si.Parameter(unit="1", bounds=(-10, 10))
    m.still = si.Equation(m.rest.dot)
    m.y = si.Output(m.a * m.u + m.c, unit="1", channel="y")
    m.z = si.Output(m.b * m.u**2 + m.c + m.rest, unit="1", channel="z")
    u = np.sin(time)
    both = rng.multivariate_normal([0, 0], ALGEBRAIC, len(time))
    recording = si.Recording(
        "static",
        time,
        {"y": 2e5 * u + 1 + both[:, 0], "z": 3e-3 * u**2 + 1.5 + both[:, 1], "u": u},
        dict.fromkeys(("y", "z", "u"), "1"),
    )
    return si.Identification(m, recording), {"a": 2e5, "b": 3e-3}


def segments(seed):
    """Eight short oscillations from states of their own, with noise that has a memory."""
    model, rng = spring(), np.random.default_rng(seed)
    model.y = si.Output(model.x)
    recordings, time = [], np.linspace(0, 6, 241)
    for k in range(8):
        noise = rng.standard_normal(len(time) + 50)
        for i in range(1, len(noise)):
            noise[i] += 0.8 * noise[i - 1]
        x = free_motion(time, 4.0, 0.3, *rng.uniform(-1, 1, 2)) + 0.02 * noise[50:]
        recordings.append(si.Recording(f"segment {k}", time, {"x": x}, {"x": "m"}))
    return si.Identification(model, recordings, scheme=si.HermiteSimpson()), {"k": 4.0, "c": 0.3}


def standing(duration: float, scheme, **noise):
    """At 50 Hz and without process noise the midpoint rule shifts kp_ha by 0.65 standard errors, and says so."""
    model = BODY.with_feedback(FullStatePD())

    def problem(seed):
        recording = standing_recording(model, GAINS, seed=seed, duration=duration, **noise)
        return si.Identification(model, recording, scheme=scheme), GAINS

    return problem


def fine(make, **options):
    """With Hermite-Simpson: the midpoint rule's own error is no matter of noise."""

    def problem(seed):
        model, recording, truth, _ = make(seed=seed, **options)
        return si.Identification(model, recording, scheme=si.HermiteSimpson()), truth

    return problem


SYSTEMS = {
    "integrator": of(integrator),
    "integrator, 5001 samples": of(integrator, samples=5001),
    "oscillator": fine(oscillator),
    "oscillator, 5001 samples": of(oscillator, samples=5001),
    "Vyasarayani": vyasarayani,
    "offset and gain of sensors": fine(spring_with_sensor),
    "two rates and noises": two_rates,
    "algebraic, channels together": algebraic,
    "segments, coloured noise": segments,
    "standing, sensor noise": standing(30, si.HermiteSimpson(), torque_noise=0.0, sensor_noise=SENSOR),
    "standing, process noise": standing(60, si.Midpoint()),
}
WHITE = {
    "integrator": [NOISE],
    "integrator, 5001 samples": [NOISE],
    "oscillator": [NOISE],
    "oscillator, 5001 samples": [NOISE],
    "Vyasarayani": [NOISE],
    "offset and gain of sensors": [[NOISE, 4 * NOISE]],
    "two rates and noises": [0.0125, NOISE],
    "algebraic, channels together": [ALGEBRAIC],
    "standing, sensor noise": [SENSOR],
}
"""Systems with white noise -> for each recording its standard deviation (one, or of each output) or its covariance."""


def expected_errors(solution: si.Solution, noise: list) -> dict[str, float]:
    """Standard errors of least squares weighted by the variances of white noise, from the simulator's sensitivities.

    The simulator shares no formula with the collocation whose standard errors are judged by it. Its
    motion begins at the solution, whose distance from the truth is of second order here.
    """
    p, names = solution.problem, list(solution.values)
    loop, slopes, covariances = simulator(p.model), [], []
    for r, (recording, frame, given) in enumerate(zip(p.recordings, solution.trajectories, noise, strict=True)):
        run = loop.simulate(
            solution.values,
            frame[list(p.model.states)].iloc[0].to_numpy(),
            recording.time,
            {u: recording[x.channel] for u, x in p.model.inputs.items()},
            sensitivity=names,
            initial_sensitivity=list(p.model.states),
            substeps=4,
        )
        own = run.dy[..., len(names) :]
        block = np.zeros((*run.dy.shape[:2], len(names) + own.shape[2] * len(noise)))
        block[..., : len(names)], first = run.dy[..., : len(names)], len(names) + own.shape[2] * r
        block[..., first : first + own.shape[2]] = own
        slopes.append(block)
        m = block.shape[1]
        covariances.append(given if np.ndim(given) == 2 else np.diag(np.broadcast_to(given, m) ** 2.0))
    return dict(zip(names, sandwich_errors(slopes, covariances), strict=False))


def sandwich_errors(slopes: list[np.ndarray], covariances: list[np.ndarray]) -> np.ndarray:
    """Of an estimate weighted by variances alone: by recording, slopes (samples, m, unknowns), covariance (m, m)."""
    size = np.sqrt(sum(np.sum(x**2, axis=(0, 1)) for x in slopes))
    curvature = spread = 0.0
    for x, c in zip(slopes, covariances, strict=True):
        x = x / size / np.sqrt(np.diag(c))[:, None]
        curvature = curvature + np.einsum("kiq,kip->qp", x, x)
        alike = c / np.sqrt(np.outer(np.diag(c), np.diag(c)))
        spread = spread + np.einsum("kiq,ij,kjp->qp", x, alike, x)
    inverse = np.linalg.inv(curvature)
    return np.sqrt(np.diag(inverse @ spread @ inverse)) / size
