"""Two laws that were found: one left out again, and others in their place."""

from types import SimpleNamespace

import pytest

from symid.discrepancy import Suspect
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name import search as searching
from symid.discrepancy.name.instead import exchanges
from symid.discrepancy.name.search import Search
from symid.mechanics import LIBRARY

SPRING, LEAK, WRONG, ALSO_WRONG = (
    Suspect(LIBRARY[law].at(place))
    for law, place in [
        ("cubic_stiffness", "knee"),
        ("orifice_loss", "muscle"),
        ("stated_value_error", "m1"),
        ("stated_value_error", "m2"),
    ]
)


def test_each_of_two_laws_is_left_out():
    """A leak that a stiff knee was taken for stayed beside it when that was found."""
    fit = SimpleNamespace(values={})
    sets = exchanges(Hypothesis((LEAK, SPRING), fit, fit, None), [])
    assert ([SPRING], None) in sets and ([LEAK], None) in sets


@pytest.mark.parametrize(
    ("two", "quiet", "asked"),
    [
        ((WRONG, SPRING), True, ["stated"]),  # of what leaves nothing other pairs are not asked
        ((WRONG, ALSO_WRONG), True, []),
        ((WRONG, SPRING), False, ["stated", "pairs"]),
    ],
)
def test_stated_values_that_are_wrong_together_rival_a_pair_that_holds_one(monkeypatch, two, quiet, asked):
    made, found = [], SimpleNamespace(suspects=two, log_ratio=1.0)
    monkeypatch.setattr(searching, "stated_together", lambda *_: made.append("stated"))
    search = SimpleNamespace(quiet=lambda h: quiet, pool=[], together=None, better=None, tried=[])
    search._other_pairs = lambda *_, **__: made.append("pairs") or []
    assert Search._rivals_of_two(search, found, None, []) == [] and made == asked


@pytest.mark.parametrize(("established", "most"), [(True, float("inf")), (False, 48.0)])
def test_noise_that_is_not_white_rivals_a_law_without_a_name_though_it_leaves_nothing(established, most):
    """Random forces that last for a sample looked like an inertia at an elbow."""
    one = SimpleNamespace(established=established, evidence=lambda share: 48.0)
    nothing = SimpleNamespace(evidence=lambda share: 0.0)
    search = SimpleNamespace(
        explained=lambda h: True, of_one=one, nothing=nothing, flexible=lambda: nothing, single=[one]
    )
    assert Search.most_of_one(search) == most
