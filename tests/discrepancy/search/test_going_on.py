"""Where a search goes on: from what is known, where that is worth anything; and where it ends."""

from dataclasses import dataclass, field
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest

import symid as si
from symid.discrepancy.name import error_model
from symid.discrepancy.name.judge import Judge
from symid.discrepancy.policy import POLICY
from symid.errors import DiagnosisError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between


@dataclass
class Ended:
    """Where a fit ended: states (E, n) with which pieces begin."""

    states: tuple[str, ...] = ("x",)
    initial: np.ndarray = field(default_factory=lambda: np.zeros((1, 1)))

    @property
    def simulator(self):
        return self


@dataclass
class Known:
    suspects: tuple[str, ...] = ("gain",)
    fit: Ended = field(default_factory=Ended)
    base: object = None
    data: object = None
    score: float = 0.0
    log_ratio: float = 0.0
    share: float = 1.0

    def evidence(self, share: float) -> float:
        return share * self.score


@dataclass
class Stub:
    """worthwhile : whether what is known explains enough beside the noise of this search."""

    worthwhile: bool
    base: object = None
    nothing: object = None
    clocks: tuple = ()
    jumps: tuple = ()
    known: list = field(default_factory=list)
    tried: list = field(default_factory=list)

    def worth(self, more, less) -> bool:
        return self.worthwhile

    def better(self, one: Known, other: Known) -> Known:
        return other if other.score > one.score else one


@pytest.mark.parametrize("worthwhile", [True, False])
def test_a_search_begins_anew_where_the_model_as_given_explains_as_much_beside_the_noise(monkeypatch, worthwhile):
    """A standing person with coloured sensors had an input that was 1.007 +- 0.011 times what was recorded: a finding
    that explained nothing, and was never weighed."""
    monkeypatch.setattr(error_model, "_refitted", lambda base, fit, data: base)
    monkeypatch.setattr(error_model, "with_jumps_again", lambda found, jumps: found)
    first = Known()
    again = error_model._going_on(Stub(worthwhile), [first], None, lambda base, data: Stub(worthwhile))
    assert again.known == ([first] if worthwhile else [])


@pytest.mark.parametrize(("score", "leader"), [(9.0, "gain"), (11.0, "drag")])
def test_what_is_believed_more_there_leads(monkeypatch, score, leader):
    """With inputs that are held another suspect may explain more than the one that was found."""
    monkeypatch.setattr(error_model, "_refitted", lambda base, fit, data: base)
    monkeypatch.setattr(error_model, "with_jumps_again", lambda found, jumps: found)
    monkeypatch.setattr(error_model, "hypothesis", lambda suspects, *others: Known(suspects, score=score))
    search = Stub(True, base=SimpleNamespace(values={}))
    known = [Known(score=10.0), Known(("drag",), score=1.0)]
    again = error_model._going_on(search, known, None, lambda base, data: Stub(True, base=base))
    assert [h.suspects for h in again.known] == [(leader,), ("drag" if leader == "gain" else "gain",)]


def test_pieces_that_another_cutoff_cut_begin_as_those_of_what_was_fitted_to_them():
    """A rotary pendulum (draw 607 of "mechanism"): a fit to two pieces was refitted to one, and ended in an error."""
    other = Ended(("x", "v", "memory"), np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]))
    own = Ended(("v", "lagged", "x"), np.array([[7.0, 8.0, 9.0]]))
    assert np.array_equal(error_model._begun_as(other, own).initial, [[2.0, 0.0, 1.0], [5.0, 0.0, 4.0]])
    same = Ended(("v",), np.array([[1.0], [2.0]]))
    assert error_model._begun_as(other, same) is same


def test_a_model_that_holds_together_from_no_values_that_are_known_is_fitted_from_nothing(monkeypatch):
    """A cylinder behind a valve without its dead zone: the whole diagnosis ended with an error."""
    model = si.Model("spring")
    model.x, model.v = si.State(unit="m"), si.State(unit="m/s")
    model.k = si.Parameter(unit="1/s^2", bounds=(0.1, 100))
    model.moves, model.swings = si.Equation(model.x.dot - model.v), si.Equation(model.v.dot + model.k * model.x)
    model.seen = si.Output(model.x)
    time = np.arange(0, 6, 0.02)
    channels = {"x": np.cos(2 * time) + 1e-3 * np.random.default_rng(0).standard_normal(time.size)}
    data = Data(segments_between(model, time, channels, (0.0, 6.0), None), np.full(1, 1e-3), False)
    base = fit_model(model, data)

    class Diverges(mock.MagicMock):
        def again(self, fit):
            raise DiagnosisError("it diverges")

    monkeypatch.setattr(error_model, "Fitter", Diverges)
    assert error_model._refitted(base, base, data).values["k"] == pytest.approx(4.0, rel=1e-3)


def test_noise_under_which_what_was_found_diverges_is_fitted_without_it(monkeypatch):
    """An arm that turned eleven times diverged from the values of the likeliest suspect under correlated forces."""

    def diverges(*asked):
        raise DiagnosisError("it diverges")

    monkeypatch.setattr(error_model, "coloured", lambda fit, data: ("coloured data", "coloured fit"))
    monkeypatch.setattr(error_model, "gain", lambda *fits: 5.0)
    monkeypatch.setattr(error_model, "_beside_colour", lambda search: {Known(suspects=()): 9.0})
    monkeypatch.setattr(error_model, "in_words", lambda fit, data: "noise")
    monkeypatch.setattr(error_model, "_going_on", diverges)
    monkeypatch.setattr(error_model, "unheld", lambda fit, data, unstated: fit)
    search = SimpleNamespace(most_of_one=lambda: 1.0, base=None, data=None, unstated=())
    monkeypatch.setattr(Known, "__hash__", object.__hash__)
    monkeypatch.setattr(Known, "suspect", SimpleNamespace(term="a law"), raising=False)
    again = error_model._with_colour(search, lambda base, data: (base, data), lambda text: None)
    assert again == ("coloured fit", "coloured data")


@pytest.mark.parametrize(
    ("flexible", "more", "nearly"), [(283.0, False, True), (295.0, True, True), (260.0, False, False)]
)
def test_a_flexible_law_that_explains_about_as_much_as_several_laws_ends_the_search(
    monkeypatch, flexible, more, nearly
):
    """A standing person: 277.5 for a lag and a mount that gives, 283.0 for a flexible law at one sensor."""
    several, one = (SimpleNamespace(log_ratio=e, share=1.0, evidence=lambda share, e=e: e) for e in (277.5, flexible))
    monkeypatch.setattr(Judge, "_enough", lambda judge, found: True)
    judge = Judge(None, None, [], lambda: one)
    assert judge.beaten(several) is more
    assert judge.beaten(several, -POLICY.equivalent) is nearly
