"""Models from sympy.physics.mechanics equal our own derivation, and bad input is listed in full."""

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Inertia,
    KanesMethod,
    LagrangesMethod,
    Lagrangian,
    Particle,
    Point,
    PrismaticJoint,
    ReferenceFrame,
    RigidBody,
    System,
    dynamicsymbols,
)

from symid.errors import ModelError
from symid.mechanics import BenchDoublePendulum, from_kane, from_lagrange, from_system
from symid.model.check import violations

VALUES = {"m1": 0.094, "m2": 0.138, "a1": 0.109, "a2": 0.117, "L1": 0.173, "I1": 4.4e-4, "I2": 1.27e-3, "g": 9.81}
UNITS = {"m1": "kg", "m2": "kg", "a1": "m", "a2": "m", "L1": "m", "I1": "kg*m^2", "I2": "kg*m^2", "g": "m/s^2"}
STATE_UNITS = {"q1": "rad", "q2": "rad", "u1": "rad/s", "u2": "rad/s"}


def double_pendulum(speeds):
    """Bodies, loads and frame of a hanging double pendulum with absolute angles, the textbook way."""
    q = dynamicsymbols("q1:3")
    u = dynamicsymbols("u1:3") if speeds else [x.diff() for x in q]
    m1, m2, a1, a2, L1, I1, I2, g = sm.symbols("m1 m2 a1 a2 L1 I1 I2 g")
    N, O = ReferenceFrame("N"), Point("O")  # noqa: E741 - the letters of the books
    O.set_vel(N, 0)
    bodies, loads, at = [], [], O
    for q_i, u_i, m, a, L, inertia in zip(q, u, (m1, m2), (a1, a2), (L1, 0), (I1, I2), strict=True):
        frame = N.orientnew("A", "Axis", [q_i, N.z])
        frame.set_ang_vel(N, u_i * N.z)
        com = at.locatenew("C", -a * frame.y)
        com.v2pt_theory(at, N, frame)
        body = RigidBody("B", com, frame, m, Inertia.from_inertia_scalars(com, frame, 0, 0, inertia))
        body.potential_energy = m * g * com.pos_from(O).dot(N.y)
        bodies.append(body)
        loads.append((com, -m * g * N.y))
        at = at.locatenew("J", -L * frame.y)
        at.v2pt_theory(com, N, frame)
    return N, q, u, bodies, loads


def kane():
    N, q, u, bodies, loads = double_pendulum(speeds=True)
    method = KanesMethod(N, q, u, kd_eqs=[a.diff() - b for a, b in zip(q, u, strict=True)])
    method.kanes_equations(bodies, loads)
    return method


def lagrange():
    N, q, _, bodies, _ = double_pendulum(speeds=False)
    method = LagrangesMethod(Lagrangian(N, *bodies), q, frame=N)
    method.form_lagranges_equations()
    return method


def rates(model, x):
    symbols, dots = [s.symbol for s in model.states.values()], [s.dot for s in model.states.values()]
    table = {c.symbol: c.value for c in model.constants.values()} | {n.symbol: 0 for n in model.noises.values()}
    f = sm.Matrix(model.residual()).xreplace(table | dict(zip(symbols, x, strict=True)))
    mass, force = f.jacobian(dots), f.xreplace(dict.fromkeys(dots, sm.S.Zero))
    return -np.linalg.solve(np.array(mass, float), np.array(force, float)[:, 0])


@pytest.mark.parametrize(
    "wrapped",
    [
        lambda: from_kane(kane(), UNITS | STATE_UNITS, constants=VALUES),
        lambda: from_lagrange(
            lagrange(), UNITS | {"q1": "rad", "q2": "rad", "q1_rate": "rad/s", "q2_rate": "rad/s"}, constants=VALUES
        ),
    ],
    ids=["kane", "lagrange"],
)
def test_wrapped_equations_equal_our_own_derivation(wrapped):
    model, own = wrapped(), BenchDoublePendulum(*VALUES.values()).plant()
    assert list(violations(model)) == []
    for x in ([0.4, -0.7, 1.5, -0.5], [2.0, 0.1, -3.0, 4.0]):
        assert np.allclose(rates(model, x), rates(own, x), rtol=1e-10)


def test_coordinates_become_outputs_and_places_for_forces():
    model = from_kane(kane(), UNITS | STATE_UNITS, constants=VALUES)
    assert list(model.outputs) == ["measured_q1", "measured_q2"]
    assert {p.at: dict(p.into) for p in model.ports.values()} == {"q1": {"u1_balance": 1}, "q2": {"u2_balance": 1}}


def driven(force):
    """A mass on a spring with this driving force, by Kane's method."""
    q, u = dynamicsymbols("x v")
    k, m = sm.symbols("k m")
    N, P = ReferenceFrame("N"), Point("P")
    P.set_vel(N, u * N.x)
    method = KanesMethod(N, [q], [u], kd_eqs=[q.diff() - u])
    method.kanes_equations([Particle("b", P, m)], [(P, (force - k * q) * N.x)])
    return method


def test_functions_of_time_become_inputs_and_unknown_symbols_parameters():
    model = from_kane(
        driven(dynamicsymbols("F")),
        {"x": "m", "v": "m/s", "F": "N", "k": "N/m", "m": "kg"},
        constants={"m": 2.0},
        bounds={"k": (0, 50)},
    )
    assert (list(model.inputs), list(model.parameters), list(model.constants)) == (["F"], ["k"], ["m"])
    assert model.k.bounds == (0, 50)
    assert model.x_joint.unit == "N"
    assert list(violations(model)) == []


def test_a_system_of_joints_is_wrapped_with_its_place_for_a_force():
    wall, block, k = RigidBody("wall"), Particle("b", mass=sm.Symbol("m")), sm.Symbol("k")
    q, u = dynamicsymbols("q u")
    slide = PrismaticJoint("j", wall, block, q, u, joint_axis=wall.x)
    system = System.from_newtonian(wall)
    system.add_joints(slide)
    system.add_loads(Force(block.masscenter, -k * q * wall.x))
    system.form_eoms()
    model = from_system(system, {"q": "m", "u": "m/s", "k": "N/m", "m": "kg"}, constants={"m": 2.0})
    assert sm.expand(model.u_balance.expr + model.k * model.q + model.m * model.u.dot) == 0
    assert dict(model.q_joint.into) == {"u_balance": 1}


def test_all_that_is_wrong_comes_in_one_error():
    with pytest.raises(ModelError) as caught:
        from_kane(
            driven(dynamicsymbols("F")),
            {"x": "m", "v": "m/s", "kk": "N/m"},
            constants={"mass": 2.0},
            bounds={"y": (0, 1)},
        )
    text = "\n".join(caught.value.violations)
    for expected in (
        "'F' has no unit",
        "'k' has no unit",
        "'m' has no unit",
        "units has 'kk'",
        "constants has 'mass'",
        "bounds has 'y'",
    ):
        assert expected in text


def test_a_derivative_of_an_input_is_refused():
    with pytest.raises(ModelError, match="derivative of an input: give it as an input of its own"):
        from_kane(driven(dynamicsymbols("F").diff()), {"x": "m", "v": "m/s", "F": "N", "k": "N/m", "m": "kg"})


def test_a_symbol_that_is_no_name_is_refused():
    with pytest.raises(ModelError, match="no plain name"):
        from_kane(driven(sm.Symbol("F max")), {"x": "m", "v": "m/s", "k": "N/m", "m": "kg", "F max": "N"})


def test_methods_without_equations_and_other_objects_are_refused():
    q, u = dynamicsymbols("x v")
    with pytest.raises(ModelError, match="call kanes_equations"):
        from_kane(KanesMethod(ReferenceFrame("N"), [q], [u], kd_eqs=[q.diff() - u]), {})
    with pytest.raises(ModelError, match="call form_lagranges_equations"):
        from_lagrange(LagrangesMethod(q.diff() ** 2, [q]), {})
    with pytest.raises(ModelError, match="needs a KanesMethod, found int"):
        from_kane(3, {})
    with pytest.raises(ModelError, match="needs a LagrangesMethod, found str"):
        from_lagrange("x", {})
    with pytest.raises(ModelError, match="call form_eoms"):
        from_system(System(), {})


def test_constraints_with_multipliers_are_refused():
    x, y = dynamicsymbols("x y")
    method = LagrangesMethod((x.diff() ** 2 + y.diff() ** 2) / 2, [x, y], hol_coneqs=[x - y])
    method.form_lagranges_equations()
    with pytest.raises(ModelError, match="multipliers"):
        from_lagrange(method, {})
