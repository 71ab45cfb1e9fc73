"""A law of which the fitted window shows too little is found with what the held-out data say of it, and only then."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

import symid as si
from symid.discrepancy.prove import short_of_price
from symid.discrepancy.prove.held_out import compare
from symid.discrepancy.prove.short_of_price import with_one_more
from symid.errors import DiagnosisError

STIFFNESS, DAMPING, STEP_S, LONG_S = 9.0, 0.6, 0.05, 90.0
WINDOWS = {"fit_window": (0, 30), "held_out": (30, 90)}


def cart() -> si.Model:
    model = si.Model("cart")
    model.x, model.v = si.State(unit="m"), si.State(unit="m/s")
    model.u = si.Input(unit="m/s^2", channel="push")
    model.k, model.c = si.Parameter(unit="1/s^2", bounds=(1, 100)), si.Parameter(unit="1/s", bounds=(0.01, 10))
    model.kinematics = si.Equation(model.x.dot - model.v)
    model.balance = si.Equation(model.v.dot + model.k * model.x + model.c * model.v - model.u)
    model.seen = si.Output(model.x, channel="place")
    parts = {"position": model.x, "rate": model.v, "into": {"balance": -1.0}}
    model.port = si.Port(**parts, role="joint", at="spring", unit="m/s^2")
    return model


def recording(seed: int, hardening: float) -> si.Recording:
    rng, time = np.random.default_rng(seed), np.arange(0, LONG_S, STEP_S)
    push = gaussian_filter1d(rng.normal(size=time.size), 3)
    push *= 2 / push.std()
    pushed = CubicSpline(time, push)

    def rates(t, x):
        return [x[1], pushed(t) - STIFFNESS * x[0] - DAMPING * x[1] - hardening * x[0] ** 3]

    place = solve_ivp(rates, (0, LONG_S), [0, 0], t_eval=time, rtol=1e-9, atol=1e-11).y[0]
    seen = {"place": place + rng.normal(0, 0.02, time.size), "push": push}
    return si.Recording("cart", time, seen, {"place": "m", "push": "m/s^2"})


@pytest.mark.parametrize(("seed", "hardening"), [(5, 0.2), (6, 0.1), (7, 0.2)])
def test_what_the_fitted_window_hardly_shows_is_found_by_what_it_foretells(seed, hardening):
    told = si.diagnose(cart(), recording(seed, hardening), **WINDOWS, driven=False, threads=1)
    assert [e.name for e in told.effects] == ["cubic_stiffness"], str(told)
    assert "is not certain enough by the fit window alone" in told.words
    once = compare(told.runs["baseline_heldout"], told.runs["augmented_heldout"]).probability
    assert told.proof.probability == pytest.approx(max(1 - 2 * (1 - once), 0)) and once < 1  # they were asked twice
    alone = si.diagnose(cart(), recording(seed, hardening), fit_window=(0, 30), driven=False, threads=1)
    assert alone.verdict == "adequate" and "not certain enough" not in alone.words


@pytest.mark.parametrize("seed", [4, 5, 6, 7])
def test_nothing_more_is_found_where_nothing_is_missing(seed):
    told = si.diagnose(cart(), recording(seed, 0.0), **WINDOWS, driven=False, threads=1)
    assert told.verdict == "adequate", str(told)


# ---- the rule alone ---------------------------------------------------------------------------
def short_by(*missing: float) -> SimpleNamespace:
    """A search that tried suspects which lack so much evidence each; nothing has a value of 0."""
    nothing = SimpleNamespace(suspects=(), fit="nothing")
    tried = [
        SimpleNamespace(suspects=(str(i),), fit=i, established=True, share=0.5, lacks=m) for i, m in enumerate(missing)
    ]
    values = {h.fit: -h.lacks for h in tried} | {"nothing": 0.0}
    return SimpleNamespace(
        nothing=nothing, tried=tried, added=lambda found: tried, value=lambda h, share: values[h.fit]
    )


@pytest.fixture
def densities(monkeypatch):
    """Sets what each fit's predictions of the held-out data have for logarithms of their density."""

    def predicted(by_fit):
        def predictions(fit, held_out):
            if by_fit[fit] is None:
                raise DiagnosisError("it cannot follow these data")
            return SimpleNamespace(density=np.array([by_fit[fit]]))

        monkeypatch.setattr(short_of_price, "predictions", predictions)
        monkeypatch.setattr(short_of_price, "polished", lambda h: h)

    return predicted


def test_the_held_out_data_pay_what_is_short(densities):
    densities({"nothing": 0.0, 0: 4.1})
    search = short_by(4.0)
    assert with_one_more(search.nothing, search, None).fit == 0
    densities({"nothing": 0.0, 0: 3.9})
    assert with_one_more(search.nothing, search, None) is search.nothing


def test_of_several_each_pays_for_being_one_of_them(densities):
    search = short_by(4.0, 4.5)  # the second needs 4.5 + 2 log 2 = 5.9
    densities({"nothing": 0.0, 0: 0.0, 1: 5.8})
    assert with_one_more(search.nothing, search, None) is search.nothing
    densities({"nothing": 0.0, 0: 0.0, 1: 6.0})
    assert with_one_more(search.nothing, search, None).fit == 1


@pytest.mark.parametrize("lacks", [-1.0, 11.0], ids=["refused by tests", "far short"])
def test_what_had_paid_or_lacks_too_much_is_not_asked_for(densities, lacks):
    densities({"nothing": 0.0, 0: 100.0})
    search = short_by(lacks)
    assert with_one_more(search.nothing, search, None) is search.nothing


@pytest.mark.parametrize("of", ["nothing", 0])
def test_data_that_cannot_be_followed_pay_nothing(densities, of):
    densities({"nothing": 0.0, 0: 100.0} | {of: None})
    search = short_by(4.0)
    assert with_one_more(search.nothing, search, None) is search.nothing


def test_others_that_the_search_left_out_take_part(densities):
    densities({"nothing": 0.0, 0: 6.0, 1: 8.0})
    search = short_by(4.0, 4.0)
    search.tried, first = search.tried[:1], search.tried
    search.added = lambda found: first
    assert with_one_more(search.nothing, search, None).fit == 1
