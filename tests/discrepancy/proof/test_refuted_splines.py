"""Splines stay in the improved model only where held-out data do not speak against them."""

from functools import cache

import numpy as np
import pytest
import sympy as sm
from rigs import ROD, law_of

from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished
from symid.discrepancy.model.sizes import sizes_of
from symid.discrepancy.model.suspects import suspects
from symid.discrepancy.prove.nameless import improved, nameless
from symid.discrepancy.say.rest import nameless_words
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import rig_model
from symid.simulation import simulator

NOISE, FRICTION = 1e-4, 1e-3
UNLISTED = law_of(lambda x, v: -sm.exp(-((x - 0.3) ** 2) / 0.01) * v)


def swing(seed: int, size: float, begin: float) -> Data:
    """Sixteen seconds of a rod with dry friction and, where `size` is not zero, a brake at one angle."""
    model = rig_model(ROD, ["link1_angle"], ["joint1"])
    friction = next(s for s in suspects(model) if str(s.term) == "coulomb_friction@joint1")
    true = model.with_term(friction.term).with_term(UNLISTED.at("joint1"))
    sim, time = simulator(true), np.arange(0, 16, 0.04)
    values = dict.fromkeys(sim.parameters, 0.0) | {
        friction.term.parameter_name("torque_Nm"): FRICTION,
        UNLISTED.at("joint1").parameter_name("size"): size,
    }
    run = sim.simulate(values, [begin, 0.0], time, substeps=8)
    noisy = run.y[:, 0] + NOISE * np.random.default_rng(seed).standard_normal(len(time))
    parts = segments_between(model, time, {"link1_angle": noisy}, (0.0, 15.9), 4.0)
    return Data(parts, np.array([NOISE]), driven=False)


@cache
def found() -> Hypothesis:
    data = swing(1, 0.01, 0.7)
    base = fit_model(rig_model(ROD, ["link1_angle"], ["joint1"]), data)
    friction = [s for s in suspects(base.model, sizes_of(base, data)) if str(s.term) == "coulomb_friction@joint1"]
    return polished(hypothesis(friction, base, base, data, friction[0].named(friction[0].starts()[0])))


@pytest.mark.parametrize(("size", "holds"), [pytest.param(0.01, True, marks=pytest.mark.slow), (0.0, False)])
def test_a_flexible_law_that_held_out_data_refute_is_left_out_of_the_improved_model(size, holds):
    names = found()
    unnamed = nameless(names, names.data, swing(2, size, 0.6))
    assert unnamed.flexible is not None and unnamed.flexible.log_ratio > 100
    assert unnamed.refuted is not holds
    assert (improved(names, unnamed) is not names.fit) is holds
    without, splines = (float(unnamed.errors[key][0]) for key in ("names", "flexible"))
    assert (splines < without) is holds
    said = " ".join(nameless_words(unnamed, lambda e: f"{float(e[0]):.2g} rad"))
    assert ("the improved model leaves it out" in said) is not holds


def test_without_held_out_data_nothing_is_refuted():
    unnamed = nameless(found(), found().data, None)
    assert not unnamed.refuted and not unnamed.errors and unnamed.fits
