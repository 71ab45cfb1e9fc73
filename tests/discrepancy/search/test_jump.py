"""How abruptly dry friction sets in, told by a free motion once friction is found."""

from dataclasses import replace

import numpy as np
import pytest
from driven_cart import SENSOR, TRUE, cart, data_of, recorded

from symid.discrepancy import Suspect
from symid.discrepancy.model.dry import with_friction_speeds
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.trial import jump
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.name.trial.jump import with_fitted_jumps
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import LIBRARY
from symid.simulation import synthetic_recording

DRY = Suspect(LIBRARY["coulomb_friction"].at("cart"))
MADE = "cart_friction_speed"


def dry_cart(part: float) -> tuple[Hypothesis, float]:
    """A cart with dry friction that is found, and so many times the friction speed that was made, its true one."""

    def segments(recording):
        return segments_between(cart(), recording.time, dict(recording.channels), (0.0, 10.0), None)

    def moving(model, values):
        gust = {"gust": 0.0}
        return synthetic_recording(
            model, values, duration=10, rate=50, seed=1, process_noise=gust, sensor_noise={"position": SENSOR}
        )

    given = with_friction_speeds(cart(), segments(moving(cart(), TRUE)), np.array([100 * SENSOR]))
    true = given.with_constants(**{MADE: part * given.constants[MADE].value}).with_term(DRY.term)
    recording = moving(true, TRUE | {DRY.term.parameter_name("torque_Nm"): 0.4})
    data = Data(segments(recording), np.array([SENSOR]), False)
    base = fit_model(given, data)
    (found,) = explore(base, data, [DRY])
    return found, true.constants[MADE].value


def speed(found: Hypothesis) -> float:
    return found.base.model.constants[MADE].value


@pytest.mark.parametrize("part", [0.3, 1.0, 8.0])
def test_friction_sets_in_as_it_did_sharper_or_wider_than_the_jump_that_was_made(part):
    found, true = dry_cart(part)
    told = with_fitted_jumps(found, [MADE], cart())
    assert speed(told) == pytest.approx(true, rel=0.3)
    assert told.log_ratio >= found.log_ratio


def test_each_width_is_fitted_from_the_best_of_those_before(monkeypatch):
    """What the sharpest jump was fitted to may hold wrong values of all else: of a two-mass drive with a soft shaft it
    did, and a wide jump led to the right ones."""
    given = with_friction_speeds(cart(), data_of(recorded(1), False).segments, np.array([SENSOR]))
    data = data_of(recorded(1, DRY.term, {"torque_Nm": 0.4}, gust=0.0), False, (0.0, 10.0))
    (found,) = explore(fit_model(given, data), data, [DRY])
    best, refitted = [found.log_ratio], jump.refit

    def seen(suspects, near, base, data, *more, **options):
        assert near.loglik2 - base.loglik2 == pytest.approx(max(best))
        fit = refitted(suspects, near, base, data, *more, **options)
        best.append(fit.loglik2 - base.loglik2)
        return fit

    monkeypatch.setattr(jump, "refit", seen)
    with_fitted_jumps(found, [MADE], given)
    assert len(best) > 3


def test_another_law_at_the_joint_begins_from_the_width_that_was_told(monkeypatch):
    found, _ = dry_cart(8.0)
    scanned = with_fitted_jumps(found, [MADE], cart())
    widths, refitted = [], jump.refit

    def seen(suspects, near, base, *others, **options):
        widths.append(base.model.constants.get(MADE))
        return refitted(suspects, near, base, *others, **options)

    monkeypatch.setattr(jump, "refit", seen)
    told = with_fitted_jumps(found, [MADE], cart(), {MADE: speed(scanned)})
    assert speed(told) == pytest.approx(speed(scanned), rel=0.02)
    assert widths[0].value == speed(scanned) and len(widths) == 3  # itself, as an unknown, and what that came to


@pytest.mark.parametrize("off", [0.85, 1.17])
def test_a_width_that_is_a_little_off_is_found_between_its_neighbours(off):
    """What other inputs between the samples liked best was 17 % too wide, and a Stribeck curve made up for it."""
    found, true = dry_cart(8.0)
    base = replace(found.base, model=found.base.model.with_constants(**{MADE: off * true}))
    near = Hypothesis(found.suspects, jump.refit(found.suspects, found.fit, base, found.data), base, found.data)
    told = with_fitted_jumps(near, [MADE], cart())
    assert speed(told) == pytest.approx(true, rel=0.02)
    assert told.log_ratio > near.log_ratio + 100
