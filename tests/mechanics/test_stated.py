"""Values of a plain model that may be stated wrongly, or change while it is recorded."""

import pytest
import sympy as sm

import symid as si
from symid.mechanics.places import with_places


def slide(**role: str) -> si.Model:
    m = si.Model("slide")
    m.x, m.v, m.push = si.State(unit="m"), si.State(unit="m/s"), si.Input(unit="N")
    m.mass, m.g = si.Constant(0.8, unit="kg", **role), si.Constant(9.81, unit="m/s^2")
    m.slope, m.unused = si.Constant(0.02, unit="1"), si.Constant(3.0, unit="kg")
    m.k = si.Parameter(unit="N/m", bounds=(0, 100))
    m.motion = si.Equation(m.x.dot - m.v)
    m.balance = si.Equation(m.mass * m.v.dot + m.k * m.x + m.mass * m.g * m.slope - m.push)
    m.seen = si.Output(m.x)
    return m


def test_what_is_stated_may_be_wrong_but_not_gravity():
    assert [c.at for c in with_places(slide()).find("stated")] == ["mass", "slope"]
    assert "stated_value_error@mass" in {str(s.term) for s in si.suspects(slide())}


def test_where_a_sensor_stands_may_be_stated_wrongly():
    m = slide()
    m.height = si.Constant(1.5, unit="m")
    m.beacon = si.Output(sm.sqrt(m.x**2 + m.height**2), channel="beacon", unit="m")
    assert [c.at for c in with_places(m).find("stated")] == ["mass", "slope", "height"]
    more = with_places(m).with_term(si.mechanics.LIBRARY["stated_value_error"].at("height"))
    factor = more.stated_value_error_height_factor.symbol
    assert more["beacon"].expr == m["beacon"].expr.xreplace({m.height.symbol: factor * m.height.symbol})


def test_a_constant_with_a_role_has_laws_of_its_own():
    assert [c.at for c in with_places(slide(role="mass", at="slide")).find("stated")] == ["slope"]


def test_the_factor_multiplies_the_constant_everywhere():
    m = with_places(slide())
    more = m.with_term(si.mechanics.LIBRARY["stated_value_error"].at("mass"))
    factor = more.stated_value_error_mass_factor.symbol
    assert more["balance"].expr == m["balance"].expr.xreplace({m.mass.symbol: factor * m.mass.symbol})


def test_a_user_of_ports_says_where_things_may_be_wrong():
    m = slide()
    m.slider = si.Port(position=m.x, rate=m.v, into={"balance": -1.0}, role="joint", at="slide", unit="N")
    assert not with_places(m).find("stated") and with_places(m)["mass"].value == pytest.approx(0.8)


def test_what_is_fitted_may_change_while_it_is_recorded():
    m = with_places(slide())
    assert [q.at for q in m.find("fitted")] == ["value:k"]
    ageing = m.with_term(si.mechanics.LIBRARY["changing_value"].at("value:k"))
    rate, k = ageing.changing_value_value_k_rate_1_s.symbol, m.k.symbol
    assert ageing["balance"].expr == m["balance"].expr.xreplace({k: k * (1 + rate * m.time)})
    broken = m.with_term(si.mechanics.LIBRARY["value_step"].at("value:k"))
    factor, at = (broken[f"value_step_value_k_{key}"].symbol for key in ("factor", "time_s"))
    values = {factor: 0.5, at: 3.0, broken.value_step_value_k_switching_time.symbol: 0.02}
    for time, part in ((0.0, 1.0), (3.0, 0.75), (6.0, 0.5)):
        now = broken["balance"].expr.xreplace(values | {m.time: time}) - m["balance"].expr
        assert float(sm.expand(now / (m.x.symbol * k))) == pytest.approx(part - 1, abs=1e-12)


def test_a_sudden_change_takes_as_long_as_the_model_states():
    m = slide()
    m.switching = si.Constant(2.0, unit="s", role="switching_time", at="global")
    broken = with_places(m).with_term(si.mechanics.LIBRARY["value_step"].at("value:k"))
    assert "value_step_value_k_switching_time" not in broken.constants
    assert broken["balance"].expr.has(m.switching.symbol)


def test_weights_and_lags_do_not_age():
    m = slide()
    m.lag = si.Parameter(unit="s", bounds=(0, 1))
    m.late = si.Equation(m.mass * m.v.dot + m.k * m.delayed(m.x, m.lag) - m.lag * m.v - m.push)
    assert [q.at for q in with_places(m).find("fitted")] == ["value:k"]
    total = 0
    for i in range(25):
        setattr(m, f"weight_{i}", si.Parameter(unit="1"))
        total += getattr(m, f"weight_{i}") * sm.tanh(i * m.x.symbol)
    m.net = si.Output(total, channel="net", unit="1")
    assert with_places(m).find("fitted") == []
