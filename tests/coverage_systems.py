"""Systems whose 95 % intervals are counted: name -> a function of a seed that gives (identification, truth by name)."""

import numpy as np
from error_systems import free_motion, integrator, oscillator, spring, spring_with_sensor

import symid as si
from symid.mechanics import FullStatePD
from symid.synthetic import BODY, GAINS, standing_recording


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
    both = rng.multivariate_normal([0, 0], [[1e6, 3.0], [3.0, 1e-4]], len(time))
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


def standing(duration: float, **noise):
    model = BODY.with_feedback(FullStatePD())

    def problem(seed):
        recording = standing_recording(model, GAINS, seed=seed, duration=duration, **noise)
        return si.Identification(model, recording), GAINS

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
    "standing, sensor noise": standing(30, torque_noise=0.0, sensor_noise=3e-3),
    "standing, process noise": standing(60),
}
WHITE = tuple(SYSTEMS)[:8]
