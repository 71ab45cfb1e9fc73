"""A person who follows a target with what moves as fast as it is pushed, and a tank whose level is held."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.mechanics import LIBRARY
from symid.mechanics.places import with_places
from symid.simulation import simulator

LATE_S, GAIN, REMNANT, RATE_HZ, DURATION_S = 0.18, 2.5, 0.5, 50, 100
FREQUENCIES_HZ = (0.04, 0.11, 0.23, 0.37, 0.59)


def tracker() -> si.Model:
    m = si.Model("tracker")
    m.cursor, m.target, m.remnant = si.State(unit="m"), si.Input(unit="m"), si.Noise(unit="m/s")
    m.gain = si.Parameter(unit="1/s", bounds=(0, 20))
    m.loop = si.Equation(m.cursor.dot - m.gain * (m.target - m.cursor) - m.remnant)
    m.seen = si.Output(m.cursor, channel="cursor")
    return m


def tank() -> si.Model:
    """Whose valve lets in what the level lacks, and which drains through a hole."""
    m = si.Model("tank")
    m.level, m.wanted = si.State(unit="m"), si.Input(unit="m", hold="zero")
    m.valve, m.hole = si.Parameter(unit="1/s", bounds=(0, 1)), si.Parameter(unit="m**0.5/s", bounds=(0, 1))
    m.balance = si.Equation(m.level.dot - m.valve * (m.wanted - m.level) + m.hole * sm.sqrt(m.level))
    m.seen = si.Output(m.level, channel="gauge")
    return m


LAWS = {"late_correction", "late_observation", "correction_lag"}


def late_laws(model: si.Model) -> set[str]:
    return {s.term.name for s in si.suspects(model)} & LAWS


def test_what_is_corrected_towards_a_reference_may_be_late():
    leak = si.Model("leaking tank")
    leak.level, leak.tap = si.State(unit="m"), si.Input(unit="m/s")
    leak.hole = si.Parameter(unit="1/s", bounds=(0, 1))
    leak.balance = si.Equation(leak.level.dot + leak.hole * leak.level - leak.tap)
    leak.seen = si.Output(leak.level, channel="gauge")
    assert late_laws(tracker()) == late_laws(tank()) == LAWS
    assert not late_laws(leak)  # what it loses is never late


def test_a_late_correction_delays_what_is_told_and_what_is_observed_and_no_loss():
    model = with_places(tank())
    late = model.with_term(LIBRARY["late_correction"].at("gauge"))
    delays = {d.of for d in late.delays.values()}
    assert delays == {model["level"].symbol, model["wanted"].symbol}
    changed = sm.expand(late.residual()[0] - model.residual()[0])
    assert not changed.has(model["hole"].symbol)
    observed = model.with_term(LIBRARY["late_observation"].at("gauge"))
    assert {d.of for d in observed.delays.values()} == {model["level"].symbol}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "value", "seed", "within"),
    [
        ("late_correction", LATE_S, 3, 1),
        ("late_correction", LATE_S, 2, 10),
        ("correction_lag", 0.15, 2, 1),
        ("", 0.0, 2, 1),
    ],
)
def test_the_reaction_time_of_a_person_who_follows_a_target_is_found(law, value, seed, within):
    """Its random speeds last for a sample, or for a part of one: so many `within` it."""
    model, values = with_places(tracker()), {"gain": GAIN}
    time = np.arange(DURATION_S * RATE_HZ * within) / (RATE_HZ * within)
    if law:
        term = LIBRARY[law].at("cursor")
        model, values = model.with_term(term), values | {term.parameter_name(term.law.parameters[0].key): value}
    phases = np.random.default_rng(0).uniform(0, 2 * np.pi, len(FREQUENCIES_HZ))
    target = sum(np.sin(2 * np.pi * f * time + p) for f, p in zip(FREQUENCIES_HZ, phases, strict=True))
    rng, gusts = (
        np.random.default_rng(seed + 100),
        within**0.5 * REMNANT * np.random.default_rng(seed).standard_normal(len(time)),
    )
    run = simulator(model).simulate(
        values, np.zeros(len(model.states)), time, {"target": target}, noise={"remnant": gusts}
    )
    time, target = time[::within], target[::within]
    cursor = run.y[::within, 0] + 2e-3 * rng.standard_normal(len(time))
    recording = si.Recording(
        "tracker", time, {"cursor": cursor, "target": target}, units={"cursor": "m", "target": "m"}
    )
    found = si.diagnose(tracker(), recording, fit_window=(0, 60), held_out=(60, 100), threads=1)
    if not law:
        assert found.verdict == "adequate"
        return
    (effect,) = found.effects
    told, error = next(iter(effect.parameters.values()))
    assert effect.name == law and abs(told - value) < 3 * error < 0.3 * value
