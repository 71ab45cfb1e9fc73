"""States that outputs show together: exact motions come back, and nothing is made up."""

import numpy as np
import pytest
import sympy as sm

import symid as si
from symid.transcription.inverse import seen_together

TIME = np.arange(0, 6, 0.02)


def arm(*outputs) -> si.Model:
    """Two links of 0.5 m and 0.4 m; each output is a function of the model, named by its place."""
    m = si.Model("arm")
    m.p, m.q, m.near, m.far = (
        *(si.State(unit="rad") for _ in "pq"),
        si.Constant(0.5, unit="m"),
        si.Constant(0.4, unit="m"),
    )
    m.one, m.two = si.Equation(m.p.dot - m.q), si.Equation(m.q.dot + m.p)
    for k, of in enumerate(outputs):
        setattr(m, f"y{k}", si.Output(of(m), unit="m", channel=f"y{k}"))
    return m


MARKERS = (
    lambda m: m.near * sm.sin(m.p),
    lambda m: -m.near * sm.cos(m.p),
    lambda m: m.near * sm.sin(m.p) + m.far * sm.sin(m.q),
    lambda m: -m.near * sm.cos(m.p) - m.far * sm.cos(m.q),
)


def motion(turning: float) -> dict[str, np.ndarray]:
    return {"p": 0.8 * np.sin(3 * TIME) + 0.3, "q": turning * TIME - 0.9 * np.cos(2 * TIME)}


def shown(p: np.ndarray, q: np.ndarray) -> dict[str, np.ndarray]:
    x, y = 0.5 * np.sin(p), -0.5 * np.cos(p)
    return {"y0": x, "y1": y, "y2": x + 0.4 * np.sin(q), "y3": y - 0.4 * np.cos(q)}


@pytest.mark.parametrize("turning", [0.0, 4.0])
def test_markers_give_the_angles_also_over_the_top(turning):
    truth = motion(turning)
    found = seen_together(arm(*MARKERS), shown(**truth), {})
    for name, values in truth.items():
        np.testing.assert_allclose(found[name], values, atol=1e-9)


def test_a_gear_is_undone_and_a_known_angle_is_used():
    truth = motion(0.0)
    found = seen_together(arm(lambda m: m.p / 20), {"y0": truth["p"] / 20}, {})
    np.testing.assert_allclose(found["p"], truth["p"], atol=1e-9)
    both = arm(lambda m: m.p + m.q)
    np.testing.assert_allclose(
        seen_together(both, {"y0": truth["p"] + truth["q"]}, {"p": truth["p"]})["q"], truth["q"], atol=1e-9
    )


def test_an_offset_of_a_sensor_does_not_hide_what_it_shows():
    """Gyroscopes with biases: all rates began at zero, and a tumbling body ended at 37 times its noise."""
    truth = motion(0.0)
    m = arm(lambda m: m.p)
    m.bias = si.Parameter(unit="rad", bounds=(-0.1, 0.3))
    m.redefine("y0", m.p + m.bias)
    np.testing.assert_allclose(seen_together(m, {"y0": truth["p"]}, {})["p"], truth["p"] - 0.1, atol=1e-9)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_units_do_not_matter(size):
    """Length and angle from the place of a bob, in metres or in nanometres."""
    m = arm()
    m.l = si.State(unit="m")
    m.x, m.h = (si.Output(e, unit="m", channel=c) for c, e in (("x", m.l * sm.sin(m.p)), ("h", -m.l * sm.cos(m.p))))
    angle, length = 0.5 * np.sin(3 * TIME), size * (1 + 0.2 * np.sin(5 * TIME))
    found = seen_together(m, {"x": length * np.sin(angle), "h": -length * np.cos(angle)}, {})
    np.testing.assert_allclose(found["p"], angle, atol=1e-9)
    np.testing.assert_allclose(found["l"] / size, length / size, atol=1e-9)


def test_too_few_outputs_unknown_gains_and_impossible_recordings_show_nothing():
    truth = motion(0.0)
    assert seen_together(arm(lambda m: m.p + m.q), {"y0": truth["p"] + truth["q"]}, {}) == {}
    m = arm(MARKERS[0])
    m.gain = si.Parameter(unit="1", bounds=(0, 2))
    m.redefine("y0", m.gain * m.p)
    assert seen_together(m, {"y0": truth["p"]}, {}) == {}
    assert seen_together(arm(MARKERS[0]), {"y0": 3 + np.sin(TIME)}, {}) == {}
    held = arm(lambda m: m.p / 20)
    assert seen_together(held.with_bounds(p=(-0.1, 0.1)), {"y0": truth["p"] / 20}, {}) == {}


def test_a_pendulum_on_a_spring_is_identified_from_the_place_of_its_bob():
    """Its length and angle were unknown to the start, which was at length zero, where the equations are singular."""
    m = si.Model("pendulum on a spring")
    m.l, m.q, m.vl, m.w = si.State(unit="m"), si.State(unit="rad"), si.State(unit="m/s"), si.State(unit="rad/s")
    m.k, m.rest = si.Parameter(unit="1/s^2", bounds=(0, 1e4)), si.Parameter(unit="m", bounds=(0.05, 5))
    m.one, m.two = si.Equation(m.l.dot - m.vl), si.Equation(m.q.dot - m.w)
    m.three = si.Equation(m.vl.dot - m.l * m.w**2 + m.k * (m.l - m.rest) - 9.81 * sm.cos(m.q))
    m.four = si.Equation(m.l * m.w.dot + 2 * m.vl * m.w + 9.81 * sm.sin(m.q))
    m.x, m.h = (si.Output(e, unit="m", channel=c) for c, e in (("x", m.l * sm.sin(m.q)), ("h", -m.l * sm.cos(m.q))))
    from symid.simulation import simulator

    run = simulator(m).simulate({"k": 70.0, "rest": 0.9}, [1.1, 0.3, 0.0, 0.5], TIME, {}, substeps=20)
    seen = run.y + 1e-3 * np.random.default_rng(0).standard_normal(run.y.shape)
    recording = si.Recording("bob", TIME, dict(zip("xh", seen.T, strict=True)), {"x": "m", "h": "m"})
    solution = si.Identification(m, recording, scheme=si.HermiteSimpson()).solve(check=False)
    assert solution.result.iterations <= 5 and solution.fit["rms"]["all"] < 1.1e-3
    assert all(
        abs(solution.values[n] - v) < 4 * solution.parameters["std_error"][n] for n, v in (("k", 70), ("rest", 0.9))
    )
