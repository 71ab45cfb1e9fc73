"""Simulation, collocation and verification take an input to be the same between its samples, stated or not."""

import numpy as np
import pytest

import symid as si
from symid.identification.checks.held import said_of_inputs
from symid.identification.checks.verify import integrated
from symid.model.parts.quantities import HOLDS
from symid.simulation import simulator

TRUTH = {"gain": 3.0, "rate": 2.0, "stiffness": 40.0}
NOISE = 1e-5


def stage(hold: str) -> si.Model:
    m = si.Model("stage")
    m.x, m.v, m.volts = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="V", hold=hold)
    m.gain = si.Parameter(unit="m/s^2/V", bounds=(0, 50))
    m.rate = si.Parameter(unit="1/s", bounds=(0, 50))
    m.stiffness = si.Parameter(unit="1/s^2", bounds=(0, 500))
    m.kinematics = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.v.dot + m.rate * m.v + m.stiffness * m.x - m.gain * m.volts)
    m.seen = si.Output(m.x, channel="seen")
    return m


def recorded(hold: str, seed: int) -> si.Recording:
    """Twelve to forty samples a period, and clear sensors."""
    rng, time = np.random.default_rng(seed), np.arange(0, 12, 0.05)
    volts = np.sin(2 * np.pi * 1.6 * time + rng.uniform(0, 6)) + np.sin(2 * np.pi * 0.5 * time)
    run = simulator(stage(hold)).simulate(TRUTH, [0.0, 0.0], time, {"volts": volts}, substeps=20)
    seen = run.y[:, 0] + NOISE * rng.standard_normal(len(time))
    return si.Recording("stage", time, {"volts": volts, "seen": seen}, {"volts": "V", "seen": "m"})


@pytest.mark.parametrize("hold", HOLDS)
def test_a_fit_of_a_simulation_lands_within_its_errors_and_is_the_motion_that_was_simulated(hold):
    problem = si.Identification(stage(hold), recorded(hold, 3), scheme=si.HermiteSimpson(), refine=2)
    solution = problem.solve(check=False)
    table = solution.parameters
    assert all(abs(table.value[k] - v) < 4 * table.std_error[k] for k, v in TRUTH.items()), table
    assert table.std_error["gain"] < 2e-3 * TRUTH["gain"]  # clearer than what another curve would shift
    assert solution.fit["rms"]["seen"] < 1.2 * NOISE and np.max(integrated(solution)) < 0.3 * NOISE


@pytest.mark.parametrize("truth", ["zero", "linear", "smooth"])
@pytest.mark.parametrize("scheme", [si.Midpoint(), si.HermiteSimpson()], ids=["midpoint", "hermite_simpson"])
def test_what_an_input_seems_to_do_between_its_samples_is_said_where_nobody_stated_it(truth, scheme):
    """Without a word gains erred by many standard errors: of a drone, whose thrust a computer holds, by fifteen."""
    noisy = recorded(truth, 5)
    noisy = noisy.with_channel("seen", noisy["seen"] + 2e-4 * np.random.default_rng(6).standard_normal(240), "m")
    said = said_of_inputs(si.Identification(stage("smooth"), noisy, scheme=scheme, refine=2).solve(check=False))
    assert [f"Input(hold='{truth}')" in text for text in said] == ([] if truth == "smooth" else [True])


def test_schemes_agree_on_an_unstated_input_as_their_meshes_are_refined():
    recording = recorded("smooth", 4)
    best = si.Identification(stage("smooth"), recording, scheme=si.HermiteSimpson(), refine=4).solve(check=False)
    far = []
    for refine in (4, 8):
        coarse = si.Identification(stage("smooth"), recording, scheme=si.Midpoint(), refine=refine).solve(check=False)
        far.append(max(abs(coarse.values[k] / best.values[k] - 1) for k in TRUTH))
    assert far[0] / far[1] == pytest.approx(4, rel=0.1)  # of second order, down to the same motion
