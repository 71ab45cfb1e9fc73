"""Recordings on which a diagnosis is examined: nothing missing, weak effects, several at once, and persons who sway.

Each function takes a whole number and gives one `Exam`, the same on every call. Half of the recordings are spoilt the
way laboratories spoil them: low-pass filtered without phase shift, with noise that remembers, coarse encoders, short.
Machines of other kinds are in `machines`, `mechanisms` and `controlled`.
"""

import tempfile
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path

import numpy as np
from controlled import LOOPS
from lacking import made
from loops import run_loop
from machines import MACHINES, MISSING, Made
from mechanisms import MECHANISMS
from scipy.signal import butter, filtfilt, lfilter

import symid as si
from symid import fetch
from symid.cases import Case
from symid.conceal import draw_case, write_case
from symid.conceal.conceal import Concealed, conceal
from symid.discrepancy.model.hypothesis import hypothesis
from symid.discrepancy.model.suspects import Suspect
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.mechanics import LIBRARY
from symid.simulation import simulator

SPOILT = ("plain", "filtered", "plain", "coloured", "plain", "coarse", "plain", "short")
CUTOFF_HZ, MEMORY_S = 6.0, 0.05
"""Of the filter; time constant of noise that remembers."""
MACHINES_SPOILT = ("plain", "filtered", "coloured", "coarse")
NOISE_LEVELS = (-3.0, -2.0)
"""Powers of ten of the motion that its sensors add as noise."""
COLOURED, COARSE = 1.5, 4.0
"""Size of that noise, and step of a coarse encoder, in standard deviations of the sensor."""
SHORT_S = 25.0
RATIOS = (15.0, 25.0, 40.0, 80.0)
"""Twice the log-likelihood ratio that is to be expected of a weak effect."""
DELAYS_S, CUTOFFS_HZ, RATES_HZ = (0.0, 0.0, 0.04, 0.07, 0.1), (4.0, 6.0, 8.0, 10.0), (50, 100)
TORQUE_NM, SPREAD, ANGLE_NOISE_DEG, RANGE_RAD = 6.0, 0.1, 0.02, 0.35
"""Of persons: random torque at each joint (sway as in the article's recording), scatter of the gains, sensors, how
far anybody leans."""
PERSON_S, WARM_UP_S = 200, 20
FULL_RATE_HZ = 100


@dataclass(frozen=True)
class Exam:
    """A case, and what is concealed in it: term -> values by key. facts : what tells this draw from others;
    `filter` is the order, cutoff [Hz] and sampling rate [Hz] of what the outputs went through."""

    case: Case
    truth: dict[si.Term, dict[str, float]]
    facts: dict = field(default_factory=dict)


# ---- persons and rigs of `symid conceal` -----------------------------------------------------------
def null(seed: int) -> Exam:
    """Nothing is missing; a person or a rig, one after the other, every second one spoilt."""
    system = ("standing", "rig")[seed // len(SPOILT) % 2]
    return _spoilt(draw_case(system, None, (9001, seed), "none"), SPOILT[seed % len(SPOILT)], seed)


def weak(seed: int) -> Exam:
    """One effect, as large as gives one of `RATIOS`, in recordings that nobody spoilt."""
    system, aim = ("standing", "rig")[seed // len(RATIOS) % 2], RATIOS[seed % len(RATIOS)]
    drawn = draw_case(system, None, (9002, seed), "single")
    (term, values), *_ = drawn.terms.items()
    setup = replace(drawn.setup, sway=drawn.sway)
    for _ in range(2):  # the ratio grows with the square of a small effect, less neatly of a large one
        size = (aim / max(ratio_of(drawn), 1.0)) ** 0.5
        values = {q.key: _scaled(q, values[q.key], size) for q in term.law.parameters}
        drawn = conceal(setup, {term: values}, seed=seed)
    return _spoilt(drawn, "plain", seed, aim=aim, ratio=ratio_of(drawn))


def three(seed: int) -> Exam:
    """Three effects at once, every second recording spoilt."""
    system = ("standing", "rig")[seed // len(SPOILT) % 2]
    for attempt in range(40):
        names = [t for k in range(3) for t in draw_case(system, None, (9003, seed, attempt, k), "single").terms]
        if len({t.name for t in names}) == len(names):
            try:
                case = draw_case(system, [(t.name, t.location, {}) for t in names], (9003, seed, attempt))
            except si.SymidError:
                continue
            return _spoilt(case, SPOILT[seed % len(SPOILT)], seed)
    raise SystemExit(f"no three effects fit together for {seed}")


def spoilt(seed: int) -> Exam:
    """One effect that is easily seen, or two, in a spoilt recording."""
    system, kind = ("standing", "rig")[seed // 8 % 2], ("single", "single", "two")[seed % 3]
    return _spoilt(draw_case(system, None, (9004, seed), kind), SPOILT[2 * (seed % 4) + 1], seed)


def _scaled(q: si.LawParameter, value: float, size: float) -> float:
    low, high = q.bounds
    return value if q.null is None else float(np.clip(q.null + (value - q.null) * size, low, high))


def ratio_of(drawn: Concealed) -> float:
    """Twice the log-likelihood ratio of the truth to the model without it, both fitted."""
    setup, (term, values) = drawn.setup, next(iter(drawn.terms.items()))
    pieces = segments_of(setup.model, drawn.recording, setup.windows[0], setup.segment)
    noise = np.full(len(setup.model.outputs), setup.sensor_noise)
    data = Data(pieces, noise, bool(setup.torque_noise), setup.resolution).thinned()
    base = fit_model(setup.model, data, dict(setup.parameters))
    suspect = Suspect(term)
    found = hypothesis([suspect], base, base, data, suspect.named(dict(values)))
    return found.log_ratio if found else 0.0


def _spoilt(drawn: Concealed, how: str, seed: int, **facts) -> Exam:
    with tempfile.TemporaryDirectory() as folder:
        case = si.read_case(write_case(drawn, Path(folder), "exam"))
    rng, rec, sigma = np.random.default_rng((9, seed)), case.recording, drawn.setup.sensor_noise
    channels = {y.channel: rec[y.channel] for y in case.model.outputs.values()}
    rate = drawn.setup.rate
    channels = {k: _measured(y, how, rng, rate, sigma, MEMORY_S, (2, CUTOFF_HZ)) for k, y in channels.items()}
    if how == "short":
        t0 = case.held_out_window[0]
        case = replace(case, fit_window=(max(0.0, t0 - SHORT_S), t0))
    if how not in ("plain", "short"):  # what was stated of the sensor does not hold any more
        case = replace(case, sensor_noise=None, recording=replace(rec, channels=dict(rec.channels) | channels))
    truth = {t: dict(v) for t, v in drawn.terms.items()}
    if how == "filtered":
        facts["filter"] = (2, CUTOFF_HZ, rate)
    return Exam(case, truth, {"system": drawn.setup.system, "spoilt": how} | facts)


def _measured(y, how, rng, rate, sigma, memory, filtered) -> np.ndarray:
    """What is left of a channel; memory in s, filtered with an order and a cutoff [Hz]."""
    if how == "filtered":
        return filtfilt(*butter(filtered[0], filtered[1] / (0.5 * rate)), y)
    if how == "coloured":
        return y + COLOURED * sigma * _remembering(np.exp(-1 / (rate * memory)), rng, len(y))
    if how == "coarse":
        return COARSE * sigma * np.round(y / (COARSE * sigma))
    return y


def _remembering(a: float, rng: np.random.Generator, count: int) -> np.ndarray:
    """An autoregression of order one and unit variance."""
    return lfilter([np.sqrt(1 - a**2)], [1, -a], rng.standard_normal(count + 500))[500:]


# ---- other machines -------------------------------------------------------------------------------------
def machine(seed: int) -> Exam:
    """One of `MACHINES`, by turns with nothing missing and with one of `MISSING`, spoilt in one of four ways."""
    rng = np.random.default_rng((9006, seed))
    of, how = MACHINES[seed % len(MACHINES)], MACHINES_SPOILT[seed // 5 % 4]
    name = MISSING[int(rng.integers(len(MISSING)))] if seed // 20 % 2 else None
    return _exam(of.__name__, of(rng, name), how, rng)


def mechanism(seed: int) -> Exam:
    """One of `MECHANISMS`, in three of four with a force, a drive or a sensor that its model lacks, spoilt likewise."""
    rng = np.random.default_rng((9007, seed))
    of, how = MECHANISMS[seed % len(MECHANISMS)], MACHINES_SPOILT[seed // 5 % 4]
    plant = of(rng)
    lacking = [plant.missing[int(rng.integers(len(plant.missing)))]] if seed // 20 % 4 else []
    return _exam(of.__name__, made(rng, plant, lacking), how, rng)


def two(seed: int) -> Exam:
    """One of `MECHANISMS` that nobody spoilt, of whose model two effects are missing, at two places."""
    rng = np.random.default_rng((9008, seed))
    of = MECHANISMS[seed % len(MECHANISMS)]
    plant = of(rng)
    one, other = 0, 0
    while plant.missing[one][1] == plant.missing[other][1]:
        one, other = rng.integers(len(plant.missing), size=2)
    return _exam(of.__name__, made(rng, plant, [plant.missing[one], plant.missing[other]]), "plain", rng)


def controlled(seed: int) -> Exam:
    """One of `LOOPS`, in two of three with a law that its model lacks, spoilt likewise."""
    of, how, attempt = LOOPS[seed % len(LOOPS)], MACHINES_SPOILT[seed // 3 % 4], 0
    while True:  # until what is missing leaves it stable
        rng = np.random.default_rng((9010, seed, attempt))
        loop = of(rng)
        lacking = loop.missing[int(rng.integers(len(loop.missing)))] if seed // 12 % 3 else None
        try:
            return _exam(of.__name__, run_loop(rng, loop, lacking), how, rng)
        except FloatingPointError:
            attempt += 1


def _exam(name: str, made: Made, how: str, rng: np.random.Generator) -> Exam:
    """What a machine did, recorded with noise and spoilt in one of `MACHINES_SPOILT`."""
    rate, level = 1 / (made.time[1] - made.time[0]), 10 ** rng.uniform(*NOISE_LEVELS)
    filtered = (int(rng.choice((2, 4))), rng.uniform(5, 9) * made.pace_Hz)
    channels = dict(made.inputs)
    for k, y in made.outputs.items():
        sigma = level * y.std()
        noisy = y + sigma * rng.standard_normal(len(y))
        channels[k] = _measured(noisy, how, rng, rate, sigma, 5 / rate, filtered)
    until = made.time[-1]
    windows = (0.0, 0.65 * until), (0.65 * until, until)
    case = Case(name, made.model, si.Recording(name, made.time, channels, made.units), *windows, None, None, True, 0.0)
    facts = {"filter": (*filtered, rate)} if how == "filtered" else {}
    return Exam(case, made.truth, {"system": name, "spoilt": how} | facts)


# ---- persons like that of the article ------------------------------------------------------------------
def person(seed: int) -> Exam:
    """Gains, platform and sway as of the article's recording, feedback late by one of `DELAYS_S`, filtered."""
    rng = np.random.default_rng((9005, seed))
    delay, cutoff = DELAYS_S[seed % len(DELAYS_S)], CUTOFFS_HZ[seed // len(DELAYS_S) % len(CUTOFFS_HZ)]
    rate = RATES_HZ[seed // len(DELAYS_S) // len(CUTOFFS_HZ) % len(RATES_HZ)]
    recording, _, model = _article()
    term = LIBRARY["feedback_delay"].at("global")
    truth = model.with_term(term) if delay else model
    n, gains = PERSON_S * FULL_RATE_HZ + 1, _gains(delay)
    warm = WARM_UP_S * FULL_RATE_HZ
    time = np.arange(n + warm) / FULL_RATE_HZ
    first = int(rng.integers(0, len(recording.time) - len(time)))
    moved = recording["platform_acceleration"][first : first + len(time)]
    for attempt in range(60):  # less and less like the article's, where the loop is nearly unstable
        spread = SPREAD / (1 + 0.1 * attempt)
        values = {k: v * (1 + spread * rng.standard_normal() * k.startswith("k")) for k, v in gains.items()}
        noise = {k: TORQUE_NM * rng.standard_normal(len(time)) for k in truth.noises}
        run = simulator(truth).simulate(
            values, np.zeros(4), time, {"platform_acceleration": moved}, noise=noise, keep="outputs"
        )
        if not run.diverged and np.abs(run.y).max() < RANGE_RAD:
            break
    else:
        raise SystemExit(f"person {seed} cannot be made to stand with a delay of {delay} s")
    y = run.y[warm:] + np.radians(ANGLE_NOISE_DEG) * rng.standard_normal((n, 2))
    y = filtfilt(*butter(2, cutoff / (0.5 * FULL_RATE_HZ)), y, axis=0)
    every = FULL_RATE_HZ // rate
    channels = {"ankle_angle": y[::every, 0], "hip_angle": y[::every, 1], "platform_acceleration": moved[warm::every]}
    units = {"ankle_angle": "rad", "hip_angle": "rad", "platform_acceleration": "m/s^2"}
    made = si.Recording("person", np.arange(n)[::every] / FULL_RATE_HZ, channels, units)
    windows = (0.0, PERSON_S / 2), (PERSON_S / 2, float(PERSON_S))
    case = Case("person", model, made, *windows, None, None, True, 0.0)
    facts = {"delay": delay, "cutoff": cutoff, "rate": rate, "filter": (2, cutoff, FULL_RATE_HZ)}
    return Exam(case, {term: {"delay_s": delay}} if delay else {}, facts)


@cache
def _article():
    folder = fetch.standing()
    body = si.mechanics.DoubleLinkPendulum.from_json(folder / "body.json")
    recordings = [si.read_recording(folder / f"recording_{rate}hz.csv") for rate in (100, 50)]
    return *recordings, body.with_feedback(si.mechanics.FullStatePD())


@cache
def _gains(delay: float) -> dict[str, float]:
    """Of the person in the article, if the feedback were so late and had to keep the body up in spite of noise."""
    _, recording, model = _article()
    plain = si.Identification(model, recording, window=(0, 100)).solve()
    if not delay:
        return plain.values
    term = LIBRARY["feedback_delay"].at("global")
    name = term.parameter_name("delay_s")
    late, episodes = model.with_term(term).fixed(**{name: delay}), si.Episodes(3, torque=TORQUE_NM)
    return si.Identification(late, recording, window=(0, 60), episodes=episodes).solve(start=plain.values).values | {
        name: delay
    }


DRAWS = {f.__name__: f for f in (null, weak, three, spoilt, machine, mechanism, two, controlled, person)}
