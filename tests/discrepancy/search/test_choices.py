"""Which suspects a search looks at, and how: told by what they promise and what those alike explain."""

from types import SimpleNamespace

import numpy as np
import pytest
from driven_cart import cart

import symid.discrepancy.name.error_model as error_model
import symid.discrepancy.name.trial.candidate as candidate
import symid.discrepancy.name.trial.explore as exploring
import symid.discrepancy.name.trial.scan as scanning
from symid.discrepancy import Suspect
from symid.discrepancy.name.error_model import _likeliest, _of_settled
from symid.discrepancy.name.judge import Judge
from symid.discrepancy.policy import POLICY
from symid.errors import DiagnosisError
from symid.mechanics import LIBRARY
from symid.simulation import simulator


def tried_beside(monkeypatch, leader: str, *alike: str, explains: float) -> set[str]:
    """Names of the suspects that are fitted where the first explains so much of the 50 that it promises, and others
    alike promise nothing."""
    laws = [leader, *alike, *["cubic_stiffness"] * POLICY.always_refitted]
    pool = [Suspect(LIBRARY[name].at(f"place{max(0, i - 2)}")) for i, name in enumerate(laws)]
    pool.append(Suspect(LIBRARY[alike[0]].at("another")))
    promised = {leader: 50.0, "cubic_stiffness": 20.0}
    fit = SimpleNamespace(converged=True, kalman_gain=None)

    def starts(_fit, _data, _projection, s):
        return [exploring.Start(promised.get(s.term.name, 0.0), s, {s.strength.key: s.strength.null})]

    def begin(_fit, _data, starts):
        s = starts[0].suspect
        begun.add(f"{s.term.name} at {s.term.location}")
        ratio = explains if s is pool[0] else 0.0
        return SimpleNamespace(suspect=s, log_ratio=ratio, forecast=promised.get(s.term.name, 0.0), fit=fit, data=None)

    begun: set[str] = set()
    monkeypatch.setattr(exploring, "starts_of", starts)
    monkeypatch.setattr(exploring, "begin", begin)
    monkeypatch.setattr(exploring, "converged_from", lambda fit, data, first, others, jumps: first)
    monkeypatch.setattr(exploring, "continued", lambda data, begun, exact: begun)
    monkeypatch.setattr(exploring, "by_score", lambda found: found)
    monkeypatch.setattr(exploring, "is_met", lambda fit, data, times: True)
    exploring.explore(fit, None, pool, projection=object())
    return begun


LAGS = "muscle_lag", "second_order_muscle_lag"


def test_lags_alike_to_a_delay_that_leads_are_fitted_whatever_they_promise(monkeypatch):
    begun = tried_beside(monkeypatch, "feedback_delay", *LAGS, explains=100.0)
    assert {"muscle_lag at place0", "second_order_muscle_lag at place0"} <= begun
    assert "muscle_lag at another" not in begun


def test_lags_alike_to_a_delay_that_explains_little_are_left_alone(monkeypatch):
    begun = tried_beside(monkeypatch, "feedback_delay", *LAGS, explains=1.0)
    assert not any("lag" in name for name in begun)


@pytest.mark.parametrize(("explains", "fitted"), [(1000.0, True), (60.0, False)])
def test_simpler_friction_is_fitted_beside_one_that_explains_far_more_than_it_promised(monkeypatch, explains, fitted):
    """A ball on a beam: its rolling friction promised little, and was named after what has three unknowns."""
    begun = tried_beside(monkeypatch, "stribeck_friction", "coulomb_friction", explains=explains)
    assert ("coulomb_friction at place0" in begun) is fitted
    assert "coulomb_friction at another" not in begun


@pytest.mark.parametrize(
    ("damping", "pieces", "steady"),
    [(8.0, 1, True), (0.2, 1, False), (8.0, 2, False)],  # of a second piece that begins anew no answer is steady
)
def test_a_motion_that_forgets_how_it_began_is_swept_for_frequencies(monkeypatch, damping, pieces, steady):
    """A cart on a spring over ten seconds; a comb stands for one that still swings as it began."""
    model, time = cart(), np.linspace(0.0, 10.0, 11)
    fit = SimpleNamespace(simulator=simulator(model), values={"stiffness": 30.0, "damping": damping})
    data = SimpleNamespace(
        segments=[SimpleNamespace(time=time, step=1.0)] * pieces,
        driven=False,
        pace=1.0,
        mean_inputs=dict.fromkeys(model.inputs, 0.0),
    )
    suspect = SimpleNamespace(
        scanned=SimpleNamespace(clock="frequency"), strength=SimpleNamespace(key="size", bounds=(0.0, 1.0))
    )
    looked = []
    monkeypatch.setattr(scanning, "fitted_path", lambda *_: np.zeros((2, 2)))
    monkeypatch.setattr(scanning, "sweep", lambda *_: looked.append("sweep") or [])
    monkeypatch.setattr(scanning, "comb", lambda *_: looked.append("comb") or [])
    scanning.scan(SimpleNamespace(fit=fit, data=data), suspect, model)
    assert looked == ["sweep" if steady else "comb"]


@pytest.mark.parametrize(("best", "free", "chosen"), [(9.0, 0.0, 1), (2.0, 0.0, 0), (9.0, 5.0, 0)])
def test_the_few_suspects_that_explain_most_tell_which_data_are_likeliest(monkeypatch, best, free, chosen):
    """The first data may be likelier by `free` where its inputs are not held, as the model as given made them look."""
    asked = []

    def explaining(loglik2):
        return SimpleNamespace(suspect=f"explains {loglik2}", fit=SimpleNamespace(loglik2=loglik2))

    def alone(suspects):
        asked.append(suspects)
        return [explaining(best) for _ in suspects]

    def unheld(fit, data, unstated):
        return SimpleNamespace(loglik2=fit.loglik2 + (free if data == "first" else 0.0))

    monkeypatch.setattr(error_model, "unheld", unheld)
    first = SimpleNamespace(
        nothing=explaining(1.0), states_alone=[explaining(5.0 - k) for k in range(5)], data="first", unstated=()
    )
    other = SimpleNamespace(nothing=explaining(0.0), alone=alone, data="other", unstated=())
    searches = [first, other]
    assert _likeliest(searches) is searches[chosen]
    assert asked == [["explains 5.0", "explains 4.0", "explains 3.0"]]


@pytest.mark.parametrize(("others", "fails"), [(0, False), (1, False), (1, True)])
def test_what_was_measured_is_asked_with_the_cutoff_that_the_best_suspect_likes(monkeypatch, others, fails):
    """A person whose feedback is late: the model without the delay liked half the cutoff, and then filtered inputs.

    The delay goes on from its fit there: from the model as given it was not found again.
    """
    asked = []

    def settle(fit, data):
        asked.append((fit, data))
        if fails:
            raise DiagnosisError("cannot be begun anew")
        yield from ((f"settled {k}", f"fit {k}") for k in range(1 + others))

    monkeypatch.setattr(error_model, "has_settled", lambda fit, data: data != "half")
    monkeypatch.setattr(error_model, "_refitted", lambda base, fit, data: f"{base} near {fit}")
    one = SimpleNamespace(fit="with delay", suspects=("delay",))
    first = SimpleNamespace(of_one=one, data="half", base="base")
    searches = [first, *["inputs filtered"] * others]
    found = _of_settled(searches, lambda base, data: SimpleNamespace(base=base, data=data), settle, lambda text: None)
    assert asked == [("with delay", "half")]
    if fails:
        assert found == searches
    else:
        assert [(s.base, s.data) for s in found] == [(f"base near fit {k}", f"settled {k}") for k in range(1 + others)]
        met = [(h.suspects, h.fit, h.base, h.data) for s in found for h in s.met]
        assert met == [(("delay",), f"fit {k}", s.base, s.data) for k, s in enumerate(found)]
    first.data = "settled"
    assert _of_settled(searches, None, settle, lambda text: None) is searches and len(asked) == 1


def test_the_same_laws_are_believed_anew_only_with_values_that_are_far_likelier():
    """A play began from two sizes of gap: one ended where a tenth of the spring was left."""
    law = object()
    more = SimpleNamespace(suspects=(law,), fit=SimpleNamespace(loglik2=100.0))
    assert Judge.is_new(more, {})
    assert Judge.is_new(more, {frozenset([law]): 50.0})
    assert not Judge.is_new(more, {frozenset([law]): 99.0})


def test_a_candidate_that_diverges_with_exact_steps_is_none(monkeypatch):
    def diverges(fit, data):
        raise DiagnosisError("diverges")

    monkeypatch.setattr(candidate.Fitter, "of", diverges)
    leading, other = (SimpleNamespace(log_ratio=v, fit=None, data=None) for v in (10.0, 1.0))
    assert exploring.exact_where_leading([leading, other], near=5.0) == [other]
