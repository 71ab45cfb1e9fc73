"""Held-out data prove, or do not; chance is counted."""

from types import SimpleNamespace

import numpy as np
import pytest
from driven_cart import cart
from scipy.signal import lfilter

from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.model.suspects import suspects
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove import certain
from symid.discrepancy.prove.evidence import Evidence
from symid.discrepancy.prove.held_out import compare
from symid.discrepancy.prove.nulls import _signs, false_alarm_probability
from symid.discrepancy.prove.opponents import refuted
from symid.estimation.free_run import FreeRun
from symid.estimation.sensors.independence import independent_share


def run(error, lengths=None):
    time, recorded = np.arange(len(error)) * 0.02, np.sin(np.arange(len(error)) * 0.05)[:, None]
    return FreeRun(
        time,
        recorded,
        recorded + error[:, None],
        np.sqrt(np.mean(error[:, None] ** 2, axis=0)),
        lengths or (len(error),),
    )


@pytest.mark.parametrize("seed", range(3))
def test_a_clear_fall_is_confirmed_and_none_is_not(seed):
    rng = np.random.default_rng(seed)
    large, small, other = (rng.standard_normal(2000) * s for s in (1.0, 0.5, 1.0))
    proof = compare(run(large), run(small))
    assert proof.confirmed and proof.margin == pytest.approx(0.5, abs=0.05) and proof.blocks == 13
    assert not compare(run(large), run(other)).confirmed
    worse = compare(run(small), run(large))
    assert not worse.confirmed and worse.margin < 0 and worse.needed is None and worse.probability < 0.05


def test_confirmations_of_nothing_are_as_rare_as_said():
    rng, z = np.random.default_rng(0), []
    for _ in range(400):
        before, after = (np.repeat(rng.standard_normal(20), 150) * 0.3 + rng.standard_normal(3000) for _ in range(2))
        z.append(compare(run(before), run(after)).probability > POLICY.confirm)
    assert np.mean(z) < 0.09


@pytest.mark.parametrize("seed", range(3))
def test_a_phase_that_runs_away_is_a_clear_fall_though_its_blocks_follow_one_another(seed):
    """The gains of the blocks fall where the wrong phase crosses the right one, and count as two: t said 0.92."""
    rng, at = np.random.default_rng(seed), np.linspace(-1, 1, 3000)
    noise = rng.standard_normal(3000)
    proof = compare(run(4 * at * np.cos(np.arange(3000) * 0.05) + noise), run(noise))
    assert proof.confirmed and proof.margin > 0.4
    assert compare(run(noise), run(0 * noise)).confirmed


def test_what_is_too_short_says_how_long_it_would_have_to_be():
    rng = np.random.default_rng(3)
    common = np.repeat(rng.lognormal(0, 1.0, 10), 150)
    proof = compare(run(common), run(common * np.repeat(rng.lognormal(-0.1, 0.5, 10), 150)))
    if not proof.confirmed and proof.margin > 0:
        assert proof.needed is None or proof.needed > proof.seconds


def test_values_that_predict_best_stay_unless_the_window_refutes_them():
    rng = np.random.default_rng(0)
    noise = rng.standard_normal(2000)
    predictive, followed, met = (run(noise * s) for s in (1.0, 0.998, 0.9))
    assert not refuted(predictive, followed, unknowns=6) and refuted(predictive, met, unknowns=6)
    # The same fall of a slow error, of which few samples are independent, is what a fit by free runs does to it.
    slow = lfilter([1.0], [1.0, -0.99], noise)
    assert not refuted(run(slow), run(0.9 * slow), unknowns=6)
    assert refuted(run(np.full(2000, np.inf)), run(noise), unknowns=6)


def test_the_tail_of_the_largest_of_many():
    rng = np.random.default_rng(1)
    maxima = rng.chisquare(1, (99, 40)).max(1)
    assert false_alarm_probability(float(np.median(maxima)), maxima) == pytest.approx(0.5, abs=0.12)
    assert false_alarm_probability(40.0, maxima) < 1e-5 and false_alarm_probability(3.0, np.zeros(0)) is None


def test_coloured_errors_hold_fewer_independent_samples():
    rng = np.random.default_rng(2)
    white = rng.standard_normal((4000, 2))
    assert independent_share([white[:2000], white[2000:]]) > 0.9
    a, slow = 0.9, np.zeros((4000, 1))
    for k in range(1, 4000):
        slow[k] = a * slow[k - 1] + white[k, :1]
    # For r_k = a^k: 1 / (1 + 2 a^2 / (1 - a^2)) = (1 - a^2) / (1 + a^2).
    assert independent_share([slow]) == pytest.approx((1 - a**2) / (1 + a**2), rel=0.35)


def test_outputs_of_other_units_count_by_how_much_they_move():
    rng = np.random.default_rng(0)
    recorded = rng.standard_normal((600, 2)) * [1e-3, 2.0]

    def of(small, large, unit=1.0):
        errors = rng.standard_normal((600, 2)) * [small, large]
        scale = np.array([unit, 1.0])
        rms = np.sqrt(np.mean(errors**2, axis=0))
        return FreeRun(0.05 * np.arange(600), recorded * scale, (recorded + errors) * scale, rms * scale, (600,))

    before, after = of(1e-3, 0.1), of(1e-5, 0.1)
    assert compare(before, after).confirmed and after.relative < 0.1 * before.relative
    rng = np.random.default_rng(1)
    metres = of(1e-3, 0.1)
    rng = np.random.default_rng(1)
    assert of(1e-3, 0.1, unit=1e3).relative == pytest.approx(metres.relative)


def two_frictions() -> Hypothesis:
    """Two suspects, five and three standard errors from nothing, of a fit that explains 1000 more than its base."""
    chosen = [s for s in suspects(cart()) if s.term.name in ("viscous_friction", "coulomb_friction")]
    names = [s.term.parameter_name(q.key) for s in chosen for q in s.law.parameters]
    fit = SimpleNamespace(
        values=dict(zip(names, (5.0, 3.0), strict=True)), errors=dict.fromkeys(names, 1.0), loglik2=1000.0
    )
    return Hypothesis(tuple(chosen), fit, SimpleNamespace(loglik2=0.0), data=None)


def test_the_least_certain_effect_counts_in_the_samples_of_its_errors():
    assert certain.weakest(two_frictions()) == pytest.approx(9.0)
    assert certain.weakest(two_frictions(), share=0.1) == pytest.approx(90.0)
    assert certain.weakest(two_frictions(), share=0.001) == pytest.approx(1000.0)


def test_a_push_is_as_certain_as_what_is_lost_without_it(monkeypatch):
    push = next(s for s in suspects(cart()) if s.term.name == "external_push")
    fit = SimpleNamespace(values={}, errors={}, loglik2=200.0)
    alone = Hypothesis((push,), fit, SimpleNamespace(loglik2=0.0), data=None)
    assert certain.weakest(alone) == pytest.approx(200.0)
    friction = two_frictions()
    both = Hypothesis((push, *friction.suspects), friction.fit, friction.base, data=None)
    monkeypatch.setattr(certain, "hypothesis", lambda rest, *_: SimpleNamespace(log_ratio=996.0))
    assert certain.weakest(both) == pytest.approx(4.0)


def test_effects_that_cannot_be_left_out_stay(monkeypatch):
    found, chance_makes_more = two_frictions(), np.linspace(400.0, 500.0, POLICY.nulls)
    monkeypatch.setattr(certain, "hypothesis", lambda *arguments: None)
    kept, chance = certain.beyond_chance(found, chance_makes_more, 0.0, white=True)
    assert kept is found and chance > POLICY.chance


@pytest.mark.parametrize(
    ("observed", "score", "odds", "established", "unsteady", "stays"),
    [
        (40.0, 5.0, 10.0, True, [], True),  # a push
        (40.0, 5.0, 0.0, True, [], True),
        (24.0, 5.0, 10.0, True, [], False),  # chance makes as much once in a thousand recordings
        (40.0, -1.0, 0.0, True, [], False),  # its unknowns explain no more than they cost
        (40.0, 5.0, 1000.0, True, [], False),  # a channel that is late by a hundredth of a sample
        (40.0, 5.0, 10.0, False, [], False),
        (40.0, 5.0, 10.0, True, ["a clock that half of the recording contradicts"], False),
    ],
)
def test_what_chance_hardly_ever_makes_is_found_though_it_does_not_pay(
    observed, score, odds, established, unsteady, stays, monkeypatch
):
    noise = 15.0 + 1.5 * np.random.default_rng(1).gumbel(size=POLICY.nulls)
    monkeypatch.setattr(certain, "null_maxima", lambda projection, fit: noise if fit == "what a push leaves" else None)
    monkeypatch.setattr(certain, "polished", lambda found: found)
    one = SimpleNamespace(log_ratio=observed, score=score, established=established, fit="what a push leaves")
    one.belief = lambda: odds
    search = SimpleNamespace(nothing="nothing", single=[one], projection=None, unsteady=lambda found: unsteady)
    found, chance = certain.far_beyond_chance(search, best=50.0)
    assert found is (one if stays else "nothing")
    assert chance == pytest.approx(false_alarm_probability(observed if stays else 50.0, noise))


def test_a_push_within_a_short_segment_is_no_constant():
    segment = SimpleNamespace(time=np.arange(600) * 0.001)  # a fifth of a block
    signs = _signs(np.random.default_rng(0), segment, pace=1.0).reshape(POLICY.fewest_blocks, -1, POLICY.nulls)
    assert np.all(signs == signs[:, :1]) and set(np.unique(signs)) == {-1.0, 1.0}
    assert np.all(np.ptp(signs[:, 0], axis=1) == 2) and np.ptp(np.abs(signs[:, 0].sum(axis=0))) > 0


def test_errors_without_any_correlation_all_count():
    assert independent_share([np.eye(20)[:, :1]]) == 1


@pytest.mark.parametrize(
    ("chance", "margin", "nameless", "by_chance"),
    [
        (0.4, -0.01, False, True),
        (0.4, 0.01, False, False),  # the held-out data do not speak against it
        (1e-3, -0.01, False, False),  # a short window may err
        (None, -0.01, False, False),
        (0.4, -0.01, True, False),  # something acts, whatever it is called
    ],
)
def test_what_chance_may_make_and_the_window_refutes_is_nothing(chance, margin, nameless, by_chance):
    seen = SimpleNamespace(chance=chance, proof=SimpleNamespace(margin=margin), nameless=nameless)
    assert Evidence.by_chance.fget(seen) is by_chance
