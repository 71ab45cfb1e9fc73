"""What a recording is trusted for: noise, filtering, rounding; errors, effects that do not believe in white noise."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import pendulum
from scipy.signal import butter, filtfilt

from symid.discrepancy.locate.audit import audit
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.prove.halves import Half, HalfVerdict, _reason, survivals, verdicts
from symid.discrepancy.say.diagnosis import Effect
from symid.discrepancy.say.names import law_name, place_name, sentence
from symid.discrepancy.say.proof import verdicts_of_halves
from symid.discrepancy.say.words import _finding
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.fitting.robust_errors import with_robust_errors
from symid.estimation.sensors.sensor_noise import white_noise
from symid.estimation.signals.data import Data
from symid.estimation.signals.segment import Segment
from symid.mechanics import LIBRARY, rig_model
from symid.recording import Recording
from symid.simulation import simulator

TIME = np.arange(0, 60, 0.01)
MOTION = np.sin(2 * np.pi * 0.7 * TIME) + 0.3 * np.sin(2 * np.pi * 1.9 * TIME + 1)
SINGLE = {"m1_kg": 0.12, "a1_m": 0.15, "I1_kg_m2": 9e-4}


def audited(angle, given=None, noise=None):
    model = rig_model(SINGLE)
    r = Recording("r", TIME, {"link1_angle": angle}, {"link1_angle": "rad"}, noise=noise or {})
    return audit(model, r, (Segment(TIME, angle[:, None], {}),), given)


def test_noise_is_told_from_the_highest_frequencies():
    a = audited(MOTION + 2e-3 * np.random.default_rng(1).standard_normal(len(TIME)))
    assert a.noise[0] == pytest.approx(2e-3, rel=0.05) and not a.stated.any() and not a.filtered and a.rounding[0] == 0


def test_noise_that_is_stated_is_taken():
    assert audited(MOTION, 3e-4).noise[0] == 3e-4 and audited(MOTION, 3e-4).stated.all()
    assert audited(MOTION, noise={"link1_angle": 5e-4}).noise[0] == 5e-4


def test_rounding_is_seen_with_its_step():
    step = 2 * np.pi / 4096
    a = audited(np.round((MOTION + 0.2) / step) * step)
    assert a.rounding[0] == pytest.approx(step, rel=1e-4) and a.noise[0] == pytest.approx(step / 12**0.5, rel=0.3)


@pytest.mark.parametrize("cutoff", [5.0, 8.0])
def test_a_recording_that_was_filtered_is_found_out(cutoff):
    b, c = butter(2, cutoff / 50)
    noisy = MOTION + 5e-2 * np.random.default_rng(2).standard_normal(len(TIME))
    a = audited(filtfilt(b, c, noisy))
    assert a.filtered and cutoff < a.cutoff[0] < 6 * cutoff
    assert a.filter.order == 2 and a.filter.cutoff == pytest.approx(cutoff, rel=0.15) and audited(noisy).filter is None
    assert a.noise[0] == pytest.approx(5e-2, rel=0.3)


def test_white_noise_of_pieces():
    rng = np.random.default_rng(3)
    assert white_noise([rng.standard_normal(500) for _ in range(8)]) == pytest.approx(1.0, rel=0.1)


# ---- errors ----------------------------------------------------------------------------------
def fits(colour: float, seeds=range(24)):
    """Estimates of the pendulum's damping with plain and robust errors, sensor noise with memory `colour`."""
    model, time, out = pendulum(), np.arange(0, 30, 0.02), []
    drive = 1.5 * np.sin(2.1 * time) + np.cos(0.7 * time)
    y = simulator(model).simulate({"damping": 0.4}, np.array([0.3, 0.0]), time, {"drive": drive}, substeps=2).y
    for seed in seeds:
        e = np.random.default_rng(seed).standard_normal(len(time))
        for k in range(1, len(e)):
            e[k] += colour * e[k - 1]
        data = Data((Segment(time, y + 0.01 * e[:, None], {"drive": drive}),), np.array([0.01]), driven=False)
        fit = fit_model(model, data, {"damping": 0.4})
        out.append((fit.values["damping"], fit.errors["damping"], with_robust_errors(fit, data).errors["damping"]))
    return np.array(out).T


def test_errors_from_blocks_hold_where_noise_has_a_memory():
    value, plain, robust = fits(0.9)
    spread = 1.48 * np.median(np.abs(value - np.median(value)))
    assert np.median(plain) < 0.5 * spread  # what white noise would promise
    assert 0.5 * spread < np.median(robust) < 1.6 * spread


def test_errors_from_blocks_are_no_smaller_and_alike_where_noise_is_white():
    value, plain, robust = fits(0.0)
    assert np.all(robust >= plain) and robust.mean() < 1.35 * plain.mean()
    assert plain.mean() == pytest.approx(value.std(ddof=1), rel=0.4)


# ---- halves ----------------------------------------------------------------------------------
def swings(torque_of_half, segments=6, named="coulomb_friction"):
    """Pendulum whose dry friction may differ between the halves: the suspect named, fits with and without it, data."""
    term, model = LIBRARY["coulomb_friction"].at("joint1"), rig_model(SINGLE)
    sim, rng, found = simulator(model.with_term(term)), np.random.default_rng(1), []
    time = np.arange(0, 4, 0.01)
    for k in range(segments):
        torque = torque_of_half[2 * k // segments]
        y = sim.simulate(
            {term.parameter_name("torque_Nm"): torque}, np.array([0.9 - 0.05 * k, 0.0]), time, substeps=2
        ).y
        found.append(Segment(time + 4 * k, y + 5e-4 * rng.standard_normal(y.shape), {}))
    data = Data(tuple(found), np.array([5e-4]), driven=False)
    said = LIBRARY[named].at("joint1")
    return [Suspect(said)], fit_model(model.with_term(said), data), fit_model(model, data), data


def test_an_effect_that_acts_all_the_time_survives_on_both_halves():
    (found,) = survivals(*swings((1e-3, 1e-3)), white=True)
    assert found.reason == "" and [h.span for h in found.halves] == [
        pytest.approx((0.0, 11.99)),
        pytest.approx((12.0, 23.99)),
    ]
    for half in found.halves:
        value, error = half.parameters["torque_Nm"]
        assert abs(value - 1e-3) < 4 * error and half.score > 100


def test_an_effect_that_changes_does_not_survive_and_the_words_say_why():
    (found,) = survivals(*swings((1e-3, 1.3e-3)), white=True)
    assert found.reason.startswith("its torque differs between the halves by")
    (found,) = survivals(*swings((1e-3, 0.0)), white=True)
    assert found.reason == "the second half alone does not ask for it"


def test_either_half_has_a_verdict_of_its_own():
    assert [v.verdict for v in verdicts(*swings((1e-3, 1e-3)), rivals=[])] == ["missing_physics", "missing_physics"]
    assert [v.verdict for v in verdicts(*swings((1e-3, 0.0)), rivals=[])] == ["missing_physics", "adequate"]


def test_a_suspect_that_explains_a_half_better_is_seen():
    dry = Suspect(LIBRARY["coulomb_friction"].at("joint1"))
    assert [v.rival for v in verdicts(*swings((1e-3, 1e-3), named="viscous_friction"), rivals=[dry])] == [dry, dry]
    wet = Suspect(LIBRARY["viscous_friction"].at("joint1"))
    assert [v.rival for v in verdicts(*swings((1e-3, 1e-3)), rivals=[wet])] == [None, None]


def test_values_that_bounds_hold_on_both_halves_do_not_differ_by_standard_errors():
    held, free = ((0.001, 0.0), (0.01, 0.0)), ((0.001, 0.0), (0.01, 1e-3))
    reasons = [_reason(tuple(Half((0.0, 1.0), 5.0, {"speed_rad_s": v}) for v in pair)) for pair in (held, free)]
    assert reasons[0] == "" and "differs between the halves by 9" in reasons[1]


def test_the_words_say_whether_the_halves_agree():
    wet = Suspect(LIBRARY["viscous_friction"].at("joint1"))
    agree, differ = HalfVerdict((0, 1), "unexplained"), HalfVerdict((1, 2), "missing_physics", wet)
    assert verdicts_of_halves(SimpleNamespace(verdict="unexplained", halves=(agree, agree))) == [
        "Either half alone leads to the same verdict."
    ]
    assert verdicts_of_halves(SimpleNamespace(verdict="unexplained", halves=(agree, differ))) == [
        "Taken alone, the second half leads to 'missing physics': another verdict than on the whole.",
        "On the second half alone viscous friction at joint 1 explains more than what was found.",
    ]


def test_one_recording_is_cut_in_its_middle():
    e = Segment(TIME, MOTION[:, None], {"drive": MOTION})
    a, b = Data((e,), np.ones(1), True).halves()
    assert len(a.segments[0].time) + len(b.segments[0].time) == len(TIME) and b.span[0] == pytest.approx(30.0)
    assert list(b.segments[0].inputs["drive"]) == list(MOTION[3000:])


def test_reasons_name_the_quantity_without_its_unit():
    one = Half((0, 1), 5.0, {"time_constant_s": (0.1, 0.001)})
    assert "its time constant differs" in _reason((one, replace(one, parameters={"time_constant_s": (0.2, 0.001)})))


# ---- words -----------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("location", "said"),
    [
        ("joint1", "joint 1"),
        ("sensor:link2", "the sensor of link 2"),
        ("a1-a2", "a1-a2"),
        ("ankle", "the ankle"),
        ("sensor:hip", "the sensor of the hip"),
        ("global", "the whole system"),
        ("base", "the base"),
    ],
)
def test_places_are_said_as_a_person_would(location, said):
    assert place_name(location) == said


@pytest.mark.parametrize(
    ("law", "place", "values", "said"),
    [
        (
            "coulomb_friction",
            "joint2",
            {"torque_Nm": (5.2e-4, 1e-5)},
            "Joint 2 is held back by a dry friction of 520 ± 10 µN m whatever its speed",
        ),
        (
            "sensor_offset",
            "sensor:link1",
            {"offset_rad": (0.01, 0.001)},
            "The sensor of link 1 is off by 0.573 ± 0.057 deg",
        ),
        (
            "integral_feedback",
            "ankle",
            {"gain_Nm_rad_s": (20.0, 2.0)},
            "The feedback at the ankle also acts on the accumulated error, 20.0 ± 2.0 N m/(rad s)",
        ),
    ],
)
def test_sentences(law, place, values, said):
    assert sentence(Suspect(LIBRARY[law].at(place)), values) == said


@pytest.mark.parametrize("name", LIBRARY)
def test_every_sentence_reads_well_at_every_kind_of_place(name):
    law = LIBRARY[name]
    for place in ("joint1", "ankle", "sensor:link1"):
        text = sentence(Suspect(law.at(place)), {q.key: (0.5, 0.01) for q in law.parameters})
        assert text[:1].isupper() and "{" not in text and "he joint 1" not in text and "the the" not in text.lower(), (
            text
        )


def test_a_value_that_is_not_determined_says_so():
    assert (
        law_name("gravity_tilt", "global") == "gravity tilt"
        and law_name("viscous_friction", "hip") == "viscous friction at the hip"
        and law_name("bouc_wen_hysteresis", "rail") == "Bouc-Wen hysteresis at the rail"
    )


def test_a_hypothesis_beside_an_unknown_rest_is_not_asserted():
    unknown = Effect("unknown", "joint1", {}, None, 50.0, "a force that depends on time", established=False)
    guess = Effect("vertical_base_motion", "base", {}, None, 50.0, "The base moves up and down", established=False)
    sure = Effect("sensor_offset", "sensor:link1", {}, None, 50.0, "The first sensor is off")

    def said(*effects):
        return " ".join(
            _finding(SimpleNamespace(verdict="unexplained", effects=effects, evidence=SimpleNamespace(elsewhere=None)))
        )

    assert said(unknown, guess) == (
        "Something systematic acts at joint 1 that no established effect explains. It looks like this: a force that "
        "depends on time. In part it looks like this: the base moves up and down."
    )
    assert said(unknown, guess, sure).startswith("The first sensor is off. That is not all")
    assert said(unknown, guess, sure).endswith("In part it looks like this: the base moves up and down.")
