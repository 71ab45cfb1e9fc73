"""Oscillations that one half of a recording contradicts are no finding, and nothing is looked for on top of them."""

from dataclasses import replace

import pytest
from driven_cart import cart, data_of, recorded

from symid.discrepancy import Suspect
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis
from symid.discrepancy.name import search as module
from symid.discrepancy.name.search import Search
from symid.discrepancy.prove.certain import unsteady
from symid.estimation.fitting.cold_start import fit_model
from symid.mechanics import LIBRARY

PERIODIC, FRICTION = (Suspect(LIBRARY[name].at("cart")) for name in ("periodic_torque", "coulomb_friction"))
TORQUE = {"amplitude_Nm": 0.5, "frequency_Hz": 0.4, "phase_rad": 0.3}


def alone(suspect: Suspect, data, values: dict) -> Hypothesis:
    base = fit_model(cart(), data)
    return hypothesis([suspect], base, base, data, suspect.named(values))


def test_an_oscillation_keeps_its_size_on_both_halves():
    there = data_of(recorded(4, PERIODIC.term, TORQUE))
    assert unsteady(alone(PERIODIC, there, TORQUE)) == []


def test_what_only_noise_asks_for_is_unsteady():
    nothing = data_of(recorded(5))
    assert unsteady(alone(PERIODIC, nothing, TORQUE | {"amplitude_Nm": 0.01})) == [PERIODIC]


@pytest.mark.parametrize("contradicted", [True, False])
def test_the_next_best_is_taken_instead_of_an_unsteady_oscillation(contradicted):
    data = data_of(recorded(4, FRICTION.term, {"torque_Nm": 0.35}))
    dry = alone(FRICTION, data, {"torque_Nm": 0.3})
    sine = alone(PERIODIC, data, TORQUE)
    sine = replace(sine, fit=replace(sine.fit, loglik2=dry.fit.loglik2 + 500.0))
    nothing = Hypothesis((), dry.base, dry.base, data)
    found = {"unsteady": lambda found: [PERIODIC] if contradicted else []}
    search = Search(dry.base, data, [PERIODIC, FRICTION], lambda: nothing, **found)
    assert search._steady(nothing, [sine, dry]) is (dry if contradicted else sine)


@pytest.mark.parametrize(
    ("driven", "more", "chosen"), [(False, 10.0, FRICTION), (False, 55.0, PERIODIC), (True, 10.0, PERIODIC)]
)
def test_of_a_free_motion_what_follows_the_state_comes_before_a_clock_that_explains_hardly_more(driven, more, chosen):
    """more : what the sine is believed more; answers within 12 cannot be told apart."""
    data = data_of(recorded(4, FRICTION.term, {"torque_Nm": 0.35}))
    dry, sine = alone(FRICTION, data, {"torque_Nm": 0.3}), alone(PERIODIC, data, TORQUE)
    if not driven:
        still = data.with_segments(replace(s, inputs={k: 0 * u for k, u in s.inputs.items()}) for s in data.segments)
        dry, sine = (replace(h, data=still, fit=replace(h.fit, kalman_gain=None)) for h in (dry, sine))
    nothing = Hypothesis((), dry.base, dry.base, data)
    search = Search(dry.base, data, [PERIODIC, FRICTION], lambda: nothing)
    search.explained = lambda found: True
    apart = search.value(dry, dry.share) - search.value(sine, dry.share)
    sine = replace(sine, fit=replace(sine.fit, loglik2=sine.fit.loglik2 + (apart + more) / dry.share))
    assert search._preferred(nothing, [sine, dry]).suspect is chosen


@pytest.mark.parametrize(("more", "chosen"), [(500.0, None), (5.0, PERIODIC)])
def test_no_clock_is_taken_where_one_explains_more_that_strikes_with_the_harmonics(more, chosen, monkeypatch):
    """A shake of the base was named where a torque shook a joint as fast as its rig swings (draw 541 of `three`)."""
    data = data_of(recorded(4, PERIODIC.term, TORQUE))
    still = data.with_segments(replace(s, inputs={k: 0 * u for k, u in s.inputs.items()}) for s in data.segments)
    sine = alone(PERIODIC, data, TORQUE)
    sine = replace(sine, data=still, fit=replace(sine.fit, kalman_gain=None))
    own = replace(sine, fit=replace(sine.fit, loglik2=sine.fit.loglik2 + more))
    monkeypatch.setattr(Hypothesis, "_is_harmonic", lambda self, suspect: self is own)
    nothing = Hypothesis((), sine.base, sine.base, data)
    search = Search(sine.base, data, [PERIODIC, FRICTION], lambda: nothing)
    search.explained = lambda found: True
    best = search._preferred(nothing, [own, sine])
    assert (best and best.suspect) is chosen and best is not own


def test_a_search_ends_where_the_best_of_several_pairs_is_a_clock_that_imitates(monkeypatch):
    data = data_of(recorded(4, PERIODIC.term, TORQUE))
    sine = alone(PERIODIC, data, TORQUE)
    pair = replace(sine, suspects=(FRICTION, PERIODIC))
    search = Search(sine.base, data, [PERIODIC, FRICTION], lambda: Hypothesis((), sine.base, sine.base, data))
    search.quiet = search.beaten = lambda found: False
    monkeypatch.setattr(search, "added", lambda best: [pair])
    monkeypatch.setattr(search, "_steady", lambda less, found: pair)
    monkeypatch.setattr(search, "_other_pairs", lambda *_, **__: [])
    monkeypatch.setattr(search, "_preferred", lambda less, found: None)
    assert search._more(sine, [sine]) is None


def test_a_search_ends_where_it_comes_back_to_what_it_had(monkeypatch):
    monkeypatch.setattr(module, "with_likeliest_holds", lambda fit, data, taken: fit)
    data = data_of(recorded(4, FRICTION.term, {"torque_Nm": 0.35}))
    dry = alone(FRICTION, data, {"torque_Nm": 0.3})
    search = Search(dry.base, data, [FRICTION], lambda: Hypothesis((), dry.base, dry.base, data))
    asked = []
    search.single, search.quiet = [dry], lambda found: False

    def same_again(best, single):
        asked.append(best)
        assert len(asked) < 4, "it comes back again and again"
        return dry

    search._more = same_again
    found, _ = search.run(to_end=True)
    assert len(asked) == 2 and found.suspects == (FRICTION,)


@pytest.mark.parametrize("free", [True, False])
def test_where_a_flexible_law_explains_more_only_the_losses_of_a_free_motion_stay(free, monkeypatch):
    if free:
        monkeypatch.setattr(Hypothesis, "is_free", True)
    data = data_of(recorded(4, FRICTION.term, {"torque_Nm": 0.35}))
    dry = alone(FRICTION, data, {"torque_Nm": 0.3})
    both = hypothesis([FRICTION, PERIODIC], dry.fit, dry.base, data, PERIODIC.named(TORQUE))
    nothing, flexible = Hypothesis((), dry.base, dry.base, data), Hypothesis((), dry.fit, dry.base, data)
    search = Search(dry.base, data, [PERIODIC, FRICTION], lambda: flexible)
    search.beaten, search.explained = lambda found: True, lambda found: False
    assert search.settled(nothing) is flexible
    left = search.settled(both)
    assert left.suspects == (FRICTION,) if free else left is flexible
