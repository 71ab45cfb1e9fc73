"""Twelve smooth laws that the library lacks, on three mechanisms: how much a flexible law closes, what is proposed.

``pytest -m slow tests/discrepancy/laws/test_smooth_laws.py -s`` prints the table; a few minutes.
"""

import numpy as np
import pytest
import sympy as sm
from driven_cart import TRUE, cart, data_of, recorded
from rigs import DOUBLE, ROD, law_of

from symid.discrepancy.locate.flexible_law import flexible_law
from symid.discrepancy.name.closed_form import closed_form
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.free_run import free_run
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import rig_model
from symid.simulation import synthetic_recording

LAWS = {
    "van der Pol": lambda x, v: -(x**2) * v,
    "cubic damping": lambda x, v: -(v**3),
    "magnet": lambda x, v: -sm.sin(3 * x),
    "quintic": lambda x, v: -(x**5),
    "bent spring": lambda x, v: -x * sm.Abs(x),
    "soft spring": lambda x, v: -sm.tanh(3 * x),
    "slip": lambda x, v: -v / sm.sqrt(1 + (4 * v) ** 2),
    "eddy brake": lambda x, v: -v * sm.exp(-((3 * x) ** 2)),
    "hill": lambda x, v: sm.exp(-((3 * x - 1) ** 2)),
    "x v^2": lambda x, v: -x * v**2,
    "loaded damping": lambda x, v: -v * sm.Abs(x),
    "exponential": lambda x, v: -sm.exp(2 * x),
}
"""Forces of position and rate, each in units of what the mechanism reaches."""
FEWEST = 12


def on_cart(force):
    term = law_of(lambda x, v: force(x / 0.1, v / 0.4)).at("cart")
    recording = recorded(1, term, {"size": 1.0})
    later = data_of(recording, window=(40.0, 60.0))
    return cart(), term, data_of(recording), later, TRUE


def on_rig(body, place, size, friction, rate):
    def make(force):
        count = sum(k.startswith("m") for k in body)
        channels = [f"link{i + 1}_angle" for i in range(count)]
        model = rig_model(body, channels, [f"joint{i + 1}" for i in range(count)])
        term = law_of(lambda x, v: size * force(x, v / rate)).at(place)
        values = dict(zip(model.parameters, friction, strict=True))
        recording = synthetic_recording(
            model.with_term(term),
            values | {term.parameter_name("size"): 1.0},
            duration=36,
            rate=100,
            seed=1,
            warm_up=0,
            sensor_noise=dict.fromkeys(channels, 5e-4),
            initial_state=dict(zip(channels, (0.9, -0.8), strict=False)),
        )
        fit, later = (
            Data(
                segments_between(model, recording.time, dict(recording.channels), window, 4.0),
                np.full(count, 5e-4),
                False,
            )
            for window in ((0.0, 24.0), (24.0, 36.0))
        )
        return model, term, fit, later, values

    return make


MECHANISMS = {
    "driven cart": on_cart,
    "rod": on_rig(ROD, "joint1", 0.01, [1e-3], 5.0),
    "double pendulum": on_rig(DOUBLE, "joint2", 2e-3, [1e-4, 1e-5], 8.0),
}


def outcome(make, force) -> tuple[float, bool]:
    """Part of the removable held-out error that a flexible law closes, and whether the true form is proposed."""
    model, term, data, later, values = make(force)
    base = fit_model(model, data, values)
    best = fit_model(model.with_term(term), data, base.values | {term.parameter_name("size"): 1e-9})
    law = flexible_law([base], data)
    if law is None:
        return 0.0, False
    before, after, least = (free_run(f, later).rms for f in (base, law.fit, best))
    proposal = closed_form(law)
    # The true form explains what the truth does, with the fewest unknowns; another one does not.
    found = proposal is not None and abs(proposal.fit.loglik2 - best.loglik2) < 12 and len(proposal.shapes) == 1
    return (before - after) / (before - least), found


@pytest.mark.slow
@pytest.mark.parametrize("mechanism", MECHANISMS)
def test_most_of_the_removable_error_is_closed_and_most_laws_are_proposed(mechanism):
    found = {name: outcome(MECHANISMS[mechanism], force) for name, force in LAWS.items()}
    for name, (share, named) in found.items():
        print(f"{mechanism:16s} {name:15s} closed {share:6.2f}  {'proposed' if named else ''}")
    shares, named = zip(*found.values(), strict=True)
    assert len(shares) >= FEWEST and np.median(shares) >= 0.7 and sum(named) >= len(named) / 2
