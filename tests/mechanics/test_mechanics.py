"""Equations of motion: conservation, linearisation, published eigenvalues, independent derivations."""

import importlib.util
import json

import numpy as np
import pytest
import sympy as sm
from conftest import SHARED
from scipy.integrate import solve_ivp

from symid.errors import ModelError, RecordingError
from symid.mechanics import PD, BenchDoublePendulum, Chain, ChainLink, DoubleLinkPendulum, FullStatePD
from symid.mechanics.lagrange import Link, Surroundings, chain_energies
from symid.model.check import violations

needs_shared = pytest.mark.skipif(not SHARED.is_dir(), reason="needs the folder 'shared' beside the checkout")
BODY = DoubleLinkPendulum(0.84, 0.47, 0.33, 22.7, 48.4, 1.72, 3.29)
BENCH = BenchDoublePendulum(0.094, 0.138, 0.109, 0.117, 0.173, 4.4e-4, 1.27e-3)


def numbers(model, **values):
    """Values of everything but states and their rates: constants, parameters, inputs, noises."""
    table = {c.symbol: c.value for c in model.constants.values()}
    table |= {c.symbol: 0.0 for c in (*model.inputs.values(), *model.noises.values())}
    return table | {model[k].symbol: v for k, v in values.items()}


def rates_function(model, **values):
    """x -> x' of the model with everything else fixed."""
    x, dx = [s.symbol for s in model.states.values()], [s.dot for s in model.states.values()]
    f = sm.Matrix(model.residual()).xreplace(numbers(model, **values))
    mass, force = f.jacobian(dx), f.xreplace(dict.fromkeys(dx, sm.S.Zero))
    evaluate = sm.lambdify([x], [mass, force])

    def rates(state):
        m, r = evaluate(state)
        return -np.linalg.solve(np.array(m, float), np.array(r, float)[:, 0])

    return rates


def energy_function(model, chain):
    """State -> energy of a chain [J], from the masses stated in its model."""
    links = [
        Link(
            *(model.find(role, k.name)[0].symbol for role in ("mass", "center_of_mass", "inertia")),
            *(c.symbol for c in model.find("length", k.name)),
        )
        for k in chain.links
    ]
    x = [s.symbol for s in model.states.values()]
    q, dq = x[: len(links)], x[len(links) :]
    angles = q if chain.absolute else [sum(q[: i + 1]) for i in range(len(q))]
    speeds = dq if chain.absolute else [sum(dq[: i + 1]) for i in range(len(q))]
    kinetic, potential = chain_energies(links, angles, speeds, Surroundings(0, model.gravity.symbol, 0), chain.upright)
    return sm.lambdify([x], (kinetic + potential).xreplace(numbers(model)))


def three_links(**options):
    return Chain(
        (
            ChainLink("link1", 0.4, 0.11, 2e-3, 0.3),
            ChainLink("link2", 0.3, 0.12, 1e-3, 0.2),
            ChainLink("link3", 0.2, 0.05, 5e-4),
        ),
        **options,
    )


@pytest.mark.parametrize(
    "chain",
    [three_links(), three_links(absolute=True), three_links(upright=True), three_links(absolute=True, upright=True)],
)
def test_energy_is_kept_without_forces(chain):
    model = chain.plant()
    energy, rates = energy_function(model, chain), rates_function(model)
    start = np.array([0.9, -0.4, 0.7, 0.5, -1.0, 2.0])
    run = solve_ivp(lambda t, x: rates(x), (0, 2), start, method="DOP853", rtol=1e-10, atol=1e-10)
    drift = np.abs(np.array([energy(x) for x in run.y.T]) - energy(start))
    assert np.ptp(run.y[0]) > 0.5
    assert drift.max() < 1e-7


def test_angular_momentum_about_the_pivot_is_kept_without_gravity():
    chain = three_links(absolute=True, gravity=0.0)
    model = chain.plant()
    x = [s.symbol for s in model.states.values()]
    links = [
        Link(
            *(model.find(r, k.name)[0].symbol for r in ("mass", "center_of_mass", "inertia")),
            *(c.symbol for c in model.find("length", k.name)),
        )
        for k in chain.links
    ]
    kinetic, _ = chain_energies(links, x[:3], x[3:], Surroundings(0, 0, 0), False)
    momentum = sm.lambdify([x], sum(sm.diff(kinetic, w) for w in x[3:]).xreplace(numbers(model)))
    start = np.array([0.2, 1.0, -0.5, 3.0, -1.0, 2.0])
    rates = rates_function(model)
    run = solve_ivp(lambda t, y: rates(y), (0, 2), start, method="DOP853", rtol=1e-10, atol=1e-10)
    assert np.allclose([momentum(y) for y in run.y.T], momentum(start), rtol=1e-7)


def test_a_single_rod_swings_with_its_known_period():
    rates = rates_function(Chain.uniform(1, length=0.8, mass=2.0).plant())
    run = solve_ivp(lambda t, x: rates(x), (0, 5), [1e-3, 0], rtol=1e-10, atol=1e-13, events=lambda t, x: x[0])
    period = 2 * np.mean(np.diff(run.t_events[0]))
    assert period == pytest.approx(2 * np.pi * np.sqrt(2 * 0.8 / (3 * 9.81)), rel=1e-5)


def test_relative_and_absolute_angles_describe_one_motion():
    relative, absolute = three_links().plant(), three_links(absolute=True).plant()
    to_absolute = np.kron(np.eye(2), np.tril(np.ones((3, 3))))
    x = np.array([0.5, -0.3, 0.8, 1.0, -2.0, 0.4])
    assert np.allclose(to_absolute @ rates_function(relative)(x), rates_function(absolute)(to_absolute @ x))


def test_two_link_chain_is_the_double_pendulum():
    chain = Chain(
        (ChainLink("link1", 0.094, 0.109, 4.4e-4, 0.173), ChainLink("link2", 0.138, 0.117, 1.27e-3)), absolute=True
    )
    x = np.array([0.5, -0.3, 1.0, -2.0])
    assert np.allclose(rates_function(chain.plant())(x), rates_function(BENCH.plant())(x), rtol=1e-14)


def test_textbook_double_pendulum_of_point_masses():
    """Point masses 1 kg on rods of 1 m (Goldstein 1980): the accelerations in closed form."""
    m = BenchDoublePendulum(1.0, 1.0, 1.0, 1.0, 1.0, 1e-300, 1e-300, 9.81).plant()
    a, b, u, v = 0.4, -0.7, 1.5, -0.5
    d, g = a - b, 9.81
    below = 3 - np.cos(2 * d)
    du = (-3 * g * np.sin(a) - g * np.sin(a - 2 * b) - 2 * np.sin(d) * (v**2 + u**2 * np.cos(d))) / below
    dv = 2 * np.sin(d) * (2 * u**2 + 2 * g * np.cos(a) + v**2 * np.cos(d)) / below
    assert np.allclose(rates_function(m)([a, b, u, v]), [u, v, du, dv])


@pytest.mark.parametrize("chain", [three_links(), three_links(absolute=True, upright=True)])
def test_a_force_at_a_port_brings_in_its_power(chain):
    plain = chain.plant()
    x = np.array([0.9, -0.4, 0.7, 0.5, -1.0, 2.0])
    energy = energy_function(plain, chain)
    for port in plain.ports.values():
        model = plain.copy()
        model.add_effort(port.name, 0.37)
        dx = rates_function(model)(x)
        step = 1e-6
        power = (energy(x + step * dx) - energy(x - step * dx)) / (2 * step)
        rate = float(port.rate.subs(dict(zip((s.symbol for s in plain.states.values()), x, strict=True))))
        assert power == pytest.approx(0.37 * rate, rel=1e-6, abs=1e-8), port.name


def test_a_hanging_chain_trails_behind_its_accelerated_base():
    model = Chain.uniform(2, absolute=True, base_channel="base").plant()
    trailing = -np.arctan(2.0 / 9.81)
    assert np.allclose(rates_function(model, base=2.0)([trailing, trailing, 0, 0]), 0, atol=1e-12)


def test_a_platform_that_starts_forward_leaves_the_body_behind():
    rates = rates_function(BODY.plant(), platform_acceleration=1.0)([0, 0, 0, 0])
    assert rates[2] < 0


@pytest.mark.elsewhere
@needs_shared
def test_published_eigenvalues_follow_from_published_gains():
    body = DoubleLinkPendulum.from_json(SHARED / "recordings/standing_subject05/body.json")
    results = json.loads((SHARED / "reference/paper_results.json").read_text())["results"]
    published = [r for r in results if "eigenvalues_re_im" in r]
    assert len(published) == 8
    for result in published:
        model = body.with_feedback({"PD": PD(), "FPD": FullStatePD()}[result["controller"]])
        gains = {k: 0.0 if k.startswith("ref") else v for k, v in result["gains_mean"].items()}
        rates, step = rates_function(model, **gains), 1e-6
        matrix = np.stack([(rates(step * e) - rates(-step * e)) / (2 * step) for e in np.eye(4)], axis=1)
        found = np.sort_complex(np.linalg.eigvals(matrix))
        printed = np.sort_complex([complex(*e) for e in result["eigenvalues_re_im"]])
        assert np.all(np.abs(found - printed) < 6e-4 * np.abs(printed))


@needs_shared
@pytest.mark.parametrize(
    ("controller", "law", "order"),
    [
        ("PD", PD(), "kp_ankle kd_ankle kp_hip kd_hip ref_ankle ref_hip"),
        ("FPD", FullStatePD(), "kp_aa kp_ah kd_aa kd_ah kp_ha kp_hh kd_ha kd_hh ref_ankle ref_hip"),
    ],
)
def test_equations_equal_an_independent_derivation(controller, law, order):
    spec = importlib.util.spec_from_file_location("anchor", SHARED / "anchors/standing.py")
    anchor = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(anchor)
    model = DoubleLinkPendulum.from_json(SHARED / "recordings/standing_subject05/body.json").with_feedback(law)
    rng = np.random.default_rng(4)
    for _ in range(5):
        x, v, p, w, a = (
            rng.normal(size=4),
            rng.normal(size=4),
            rng.normal(size=len(order.split())),
            rng.normal(size=2),
            rng.normal(),
        )
        table = numbers(
            model,
            platform_acceleration=a,
            ankle_torque_noise=w[0],
            hip_torque_noise=w[1],
            **dict(zip(order.split(), p, strict=True)),
        )
        for s, x_i, v_i in zip(model.states.values(), x, v, strict=True):
            table |= {s.symbol: x_i, s.dot: v_i}
        expected = anchor.residual(controller, x, v, p, -a, w, anchor.body(1.0), np.sin, np.cos)
        assert np.allclose([float(r.xreplace(table)) for r in model.residual()], expected, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    "model",
    [BODY.plant(), BODY.with_feedback(PD()), BENCH.plant(("joint1", "joint2")), Chain.uniform(4).plant()],
    ids=lambda m: m.name,
)
def test_mechanisms_pass_the_model_check_and_keep_their_names(model):
    assert list(violations(model)) == []
    assert all(c.latex or c.role for c in model.states.values())


def test_names_of_the_standing_model_are_those_of_its_recording():
    model = BODY.with_feedback(PD())
    assert list(model.states) == ["ankle_angle", "hip_angle", "ankle_velocity", "hip_velocity"]
    assert {o.name: o.channel for o in model.outputs.values()} == {
        "measured_ankle_angle": "ankle_angle",
        "measured_hip_angle": "hip_angle",
    }
    assert list(model.equations) == ["ankle_kinematics", "hip_kinematics", "ankle_balance", "hip_balance"]
    assert model.ankle_angle.bounds == (-1.0, 1.0)
    assert model.hip_velocity.bounds == (-2.0, 2.0)


def test_body_and_bench_files_are_refused_by_key(tmp_path):
    path = tmp_path / "body.json"
    path.write_text(json.dumps({"leg_length_m": 0.8}))
    with pytest.raises(RecordingError, match="trunk_mass"):
        DoubleLinkPendulum.from_json(path)
    with pytest.raises(RecordingError, match="'m2' \\[kg\\] is missing"):
        BenchDoublePendulum.from_parameters({"m1_kg": 1.0})


def test_bench_parameters_leave_identified_numbers_out():
    keys = {
        "m1_kg": 0.1,
        "m2_kg": 0.1,
        "a1_m": 0.1,
        "a2_m": 0.1,
        "L1_m": 0.2,
        "I1_kg_m2": 1e-3,
        "I2_kg_m2": 1e-3,
        "g_m_s2": 9.8,
    }
    assert BenchDoublePendulum.from_parameters(keys | {"k1_N_m_s_rad": 1e-4}).g == 9.8


@pytest.mark.parametrize(
    ("links", "joints"), [((), ()), ((ChainLink("a", 1, 1, 1),), ("a",)), ((ChainLink("a", 1, 1, 1),), ("b", "c"))]
)
def test_a_chain_with_confused_names_is_refused(links, joints):
    with pytest.raises(ModelError, match="one joint before each link"):
        Chain(links, joints)


def test_a_rod_whose_inertia_is_no_number_is_refused():
    with pytest.raises(ModelError, match="a rod has a positive length and mass, not 1.34"):
        Chain.uniform(1, 1.3407807929942597e154)
