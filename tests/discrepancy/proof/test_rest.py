"""What is left is described: where, when, which way energy goes; and a flexible law stands for it."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sm
from driven_cart import TRUE, cart, data_of, recorded
from rigs import ROD, law_of
from scipy.signal import lfilter

import symid as si
from symid.discrepancy.locate.chance import Chance
from symid.discrepancy.locate.flexible_law import flexible_law
from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.locate.remainder import WHITENESS_LAGS, _ljung_box
from symid.discrepancy.locate.rest import rest_of
from symid.discrepancy.say.rest import noun, rest_words
from symid.discrepancy.say.words import left_beside_noise
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.free_run import free_run
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.mechanics import LIBRARY, rig_model
from symid.mechanics.missing.spline_law import Block, knots_of, spline_law
from symid.mechanics.places import other_signals, places, with_places
from symid.plots import plot_rest
from symid.simulation import simulator, synthetic_recording


def swinging(term, values, viscous=1e-3, duration=30.0, start=0.5, length=None):
    """A rod that swings down with a loss that its model, of viscous friction alone, does not know."""
    model = rig_model(ROD, ["link1_angle"], ["joint1"])
    own = {"viscous_friction_joint1_coefficient_Nms_rad": viscous}
    recording = synthetic_recording(
        model.with_term(term),
        own | {term.parameter_name(k): v for k, v in values.items()},
        duration=duration,
        rate=50,
        seed=3,
        warm_up=0,
        sensor_noise={"link1_angle": 5e-4},
        initial_state={"link1_angle": start},
    )
    segments = segments_between(model, recording.time, dict(recording.channels), (0.0, duration), length)
    return fit_model(model, data := Data(segments, np.array([5e-4]), False)), data


# ---- splines ---------------------------------------------------------------------------------
def test_a_spline_is_what_scipy_calls_natural_and_straight_beyond_its_ends():
    from scipy.interpolate import CubicSpline

    knots = (-1.0, -0.2, 0.1, 0.8, 2.0)
    values = np.array([0.3, -1.0, 0.4, 2.0, 1.5])
    x, block = sm.Symbol("x", real=True), Block(sm.Symbol("x", real=True), sm.S.One, knots)
    inside = np.linspace(-1, 2, 50)
    peer = CubicSpline(knots, values, bc_type="natural")
    assert block.basis(inside) @ values == pytest.approx(peer(inside), abs=1e-12)
    beyond = np.array([2.5, 3.0, 3.5])
    assert np.diff(block.basis(beyond) @ values, 2) == pytest.approx(0, abs=1e-12)
    written = sm.lambdify(x, block.force(list(values)))
    assert [written(v) for v in (*inside[::7], *beyond)] == pytest.approx(
        block.basis(np.array([*inside[::7], *beyond])) @ values, abs=1e-12
    )


def test_knots_increase_and_stay_within_the_motion():
    signal = np.exp(-np.linspace(0, 4, 500)) * np.sin(np.linspace(0, 90, 500))
    knots = np.array(knots_of(signal, 9))
    assert np.all(np.diff(knots) > 0) and signal.min() <= knots[0] and knots[-1] <= signal.max()


def test_the_unknowns_of_a_flexible_law_have_units_that_fit():
    model = rig_model(ROD, ["link1_angle"], ["joint1"])
    port = places(model)[0]
    blocks = [Block(port.position, sm.S.One, (-1.0, 0.0, 1.0)), Block(port.position, port.rate, (-1.0, 0.0, 1.0))]
    more = model.with_term(spline_law(model, port, blocks).at(port.at)).check()
    assert {p.unit for k, p in more.parameters.items() if "flexible" in k} == {"N*m", "N*m*s/rad"}


# ---- places ----------------------------------------------------------------------------------
def tank(leak: float = 0.0) -> si.Model:
    """A tank whose model knows its outflow, and no port."""
    m = si.Model("tank")
    m.level = si.State(unit="m", bounds=(0, 10))
    m.pump = si.Input(unit="m^3/s")
    m.area = si.Constant(0.5, unit="m^2")
    m.outflow = si.Parameter(unit="m^2/s", bounds=(0, 1))
    m.balance = si.Equation(m.area * m.level.dot - m.pump + m.outflow * m.level + leak * m.level**3)
    m.seen = si.Output(m.level, role="sensor", at="sensor:level")
    return m


def test_a_balance_without_a_port_gets_a_place_with_its_own_unit():
    (port,) = places(with_places(tank()))
    assert (port.at, port.unit, port.rate, dict(port.into)) == ("level", "m^3/s", 0, {"balance": -1.0})


def test_a_joint_and_the_link_that_moves_alike_are_one_place_and_others_stay_apart():
    two = rig_model(ROD | {"L1_m": 0.3, "m2_kg": 0.1, "a2_m": 0.1, "I2_kg_m2": 1e-3}, ["link1_angle", "link2_angle"])
    assert [p.at for p in places(two)] == ["joint1", "joint2", "link2"]
    assert [str(s) for s in other_signals(two, two["joint2"])] == ["link1_angle", "link1_velocity"]


# ---- the rest in words -----------------------------------------------------------------------
def test_a_loss_that_is_too_small_at_the_end_and_at_small_amplitudes_is_said():
    fit, data = swinging(LIBRARY["coulomb_friction"].at("joint1"), {"torque_Nm": 2e-3})
    rest = rest_of(fit, data)
    first, _, last = rest.stretches
    assert first.power > 5 * first.error and last.power < -5 * last.error and last.small > 0.9
    text = " ".join(rest_words(rest))
    assert "In the last third (20 to 30 s, at small amplitudes, below" in text
    assert "there the model loses too little" in text and "µW" in text and "torque at joint 1" in text


def test_the_rest_is_the_force_that_was_left_out_less_what_the_model_has_in_its_place():
    fit, data = swinging(LIBRARY["joint_drag"].at("joint1"), {"coefficient_Nm_s2_rad2": 5e-4}, length=3.0)
    rest = rest_of(fit, data)
    (viscous,) = fit.values.values()
    true = -5e-4 * rest.rate * np.abs(rest.rate) + (viscous - 1e-3) * rest.rate
    assert np.corrcoef(true, rest.force)[0, 1] > 0.9
    assert rest.whole.rms == pytest.approx(np.sqrt(np.mean(true**2)), rel=0.25)


def test_the_rest_of_a_driven_cart_is_told_in_its_own_units():
    bump = law_of(lambda x, v: sm.exp(-((x - 0.03) ** 2) / 0.02**2)).at("cart")
    data = data_of(recorded(3, bump, {"size": 1.0}))
    rest = rest_of(fit_model(cart(), data), data)
    assert "force at the cart" in (text := " ".join(rest_words(rest))) and "position" in text and " N (rms" in text
    assert plot_rest(rest).png().startswith(b"\x89PNG")


def test_the_rest_of_a_tank_is_a_flow_and_nothing_is_said_of_energy():
    rng, time = np.random.default_rng(0), np.arange(0, 400, 1.0)
    pump = 0.05 + 0.04 * np.sin(0.03 * time) + 0.02 * np.sin(0.11 * time)
    run = simulator(tank(leak=0.03)).simulate([0.05], [1.0], time, {"pump": pump})
    level = run.y[:, 0] + 1e-3 * rng.standard_normal(len(time))
    segments = segments_between(with_places(tank()), time, {"level": level, "pump": pump}, (0.0, 400.0))
    data = Data(segments, np.array([1e-3]), False)
    fit = fit_model(with_places(tank()), data)
    rest = rest_of(fit, data)
    text = " ".join(rest_words(rest))
    assert "flow at the level" in text and "m³/s" in text and "energy" not in text
    true_flow = -0.03 * rest.position**3 + (fit.values["outflow"] - 0.05) * rest.position
    assert np.corrcoef(true_flow, rest.force)[0, 1] > 0.95


def test_nothing_is_described_where_nothing_is_missing():
    data = data_of(recorded(5))
    assert rest_of(fit_model(cart(), data), data) is None
    assert flexible_law([fit_model(cart(), data)], data) is None


# ---- the flexible law ------------------------------------------------------------------------
@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_a_flexible_law_closes_the_held_out_error_of_a_law_without_a_name(seed):
    brake = law_of(lambda x, v: -v * sm.exp(-((x / 0.03) ** 2))).at("cart")
    recording = recorded(seed, brake, {"size": 5.0})
    data, later = data_of(recording), data_of(recording, window=(40.0, 60.0))
    base = fit_model(cart(), data)
    best = fit_model(cart().with_term(brake), data, start=TRUE | {"truth_cart_size": 5.0})
    law = flexible_law([base], data)
    before, after, least = (free_run(f, later).rms for f in (base, law.fit, best))
    assert (before - after) / (before - least) > 0.7
    assert {str(s) for s in law.signals} == {"speed", "position"}
    x = np.array([[0.0, 0.2, 0.0], [0.09, 0.2, 0.0]])  # states, and an input
    force = law.force(x) - law.force(x * [1, 0, 1])
    assert force[0] - force[1] < -0.5  # it brakes in the middle


@pytest.mark.parametrize(("noises", "told"), [({}, True), ({"gust": None}, False)])
def test_a_rest_of_a_model_without_noise_says_how_random_forces_are_declared(noises, told):
    story = SimpleNamespace(
        verdict="unexplained",
        driven=False,
        data=SimpleNamespace(memory=0),
        runs={"augmented_train": SimpleNamespace(errors=np.array([3e-3]))},
        audit=SimpleNamespace(noise=np.array([1e-3])),
        model=SimpleNamespace(noises=noises),
        error=lambda errors: "3 mm",
    )
    assert ("declares a Noise" in " ".join(left_beside_noise(story))) is told


@pytest.mark.parametrize(
    ("unit", "name"), [("N*m", "torque"), ("rad/s^2", "acceleration"), ("L/s", "flow"), ("K/s", "rate"), ("A", "force")]
)
def test_what_acts_is_called_as_its_unit_says(unit, name):
    assert noun(unit) == name


def explained_by(lines: int, segments: int, samples: int) -> SimpleNamespace:
    """A projection whose own unknowns are polynomials with so many coefficients in each segment of two outputs."""
    one = np.linalg.qr(np.vander(np.linspace(-1, 1, samples), lines))[0] if lines else np.zeros((samples, 0))
    own = np.kron(np.eye(segments), np.kron(one, np.eye(2)))
    return SimpleNamespace(
        own=own, outputs=2, data=SimpleNamespace(segments=[SimpleNamespace(recorded=np.zeros((samples, 2)))] * segments)
    )


@pytest.mark.parametrize(
    ("lines", "segments", "samples"), [(0, 1, 20), (0, 1, 25), (0, 1, 400), (2, 40, 60), (4, 20, 30), (3, 100, 15)]
)
def test_white_errors_pass_for_white_however_short_the_segments_that_were_fitted(lines, segments, samples):
    projection, rng = explained_by(lines, segments, samples), np.random.default_rng(2)
    found = []
    for _ in range(40):
        white = rng.standard_normal(2 * segments * samples)
        white -= projection.own @ (projection.own.T @ white)
        found.append(_ljung_box(projection, white, 1))
    lags = min(WHITENESS_LAGS, samples - 1)
    assert 0.6 * lags < np.mean(found) < 1.25 * lags


def test_errors_that_follow_from_earlier_ones_are_told_in_short_segments():
    projection = explained_by(2, 40, 60)
    coloured = lfilter([1], [1, -0.3], np.random.default_rng(3).standard_normal((2400, 2)), axis=0).ravel()
    coloured -= projection.own @ (projection.own.T @ coloured)
    assert _ljung_box(projection, coloured, 0) > 4 * WHITENESS_LAGS


def larger_where_it_moves(seed: int, samples: int = 3000) -> tuple[np.ndarray, np.ndarray]:
    """A motion, and errors that are up to five times larger where it is fast."""
    rng = np.random.default_rng(seed)
    motion = lfilter([1], [1, -1.9, 0.93], rng.standard_normal(samples))
    motion /= motion.std()
    errors = (0.3 + np.abs(motion)) * rng.standard_normal(samples)
    return motion, errors / errors.std()


def test_errors_that_are_larger_at_times_pass_for_white():
    projection = SimpleNamespace(
        own=np.zeros((3000, 0)),
        outputs=1,
        data=SimpleNamespace(segments=[SimpleNamespace(recorded=np.zeros((3000, 1)))]),
    )
    found = [_ljung_box(projection, larger_where_it_moves(seed)[1], 0) for seed in range(40)]
    assert 0.8 * WHITENESS_LAGS < np.mean(found) < 1.1 * WHITENESS_LAGS


def test_what_follows_the_motion_is_weighed_against_errors_that_grow_with_it():
    """The gain of a true law stays; that by chance, 11 of errors that grow with the motion, is as of others."""

    def scored(errors: np.ndarray, columns: np.ndarray) -> float:
        projection = Projection.__new__(Projection)
        segment = SimpleNamespace(recorded=np.zeros((len(errors), 1)))
        projection.data = SimpleNamespace(segments=[segment], rounding=0.0)
        projection.fit = SimpleNamespace(kalman_gain=None)
        projection.own, projection.rest, projection.outputs = np.zeros((len(errors), 0)), errors, 1
        return Chance(projection).scored(columns)[0]

    same, growing = [], []
    for seed in range(60):
        motion, errors = larger_where_it_moves(seed)
        columns = np.column_stack([motion, motion**2, motion**3])
        growing.append(scored(errors, columns))
        even = np.random.default_rng(seed).standard_normal(len(errors))
        same.append(scored(even + 0.3 * motion, columns))
    assert 2.0 < np.mean(growing) < 4.2  # chi-square of three degrees
    assert 200 < np.mean(same) < 290  # 0.09 of 3000 samples, less what chance has
