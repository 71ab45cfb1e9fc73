"""Lagrange's equations, and the energies of a planar chain of rigid links.

This is the only place where equations of motion come into being: every mechanism of this
package states its energies and gets its equations from `lagrange_residuals`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import sympy as sm

Symbols = tuple[sm.Symbol, ...]

Exprs = Sequence[sm.Expr]


@dataclass(frozen=True)
class Link:
    """Symbols of one rigid link: mass, joint to centre of mass, inertia about it, joint to joint."""

    mass: sm.Expr
    com: sm.Expr
    inertia: sm.Expr
    length: sm.Expr = sm.S.Zero


@dataclass(frozen=True)
class Surroundings:
    """What acts on the whole chain.

    Parameters
    ----------
    horizontal, vertical : components of gravity, forward and downward [m/s^2].
    base_acceleration : horizontal acceleration of the first joint, forward [m/s^2].
    """

    horizontal: sm.Expr
    vertical: sm.Expr
    base_acceleration: sm.Expr


def lagrange_residuals(kinetic: sm.Expr, potential: sm.Expr, q: Exprs, dq: Exprs, ddq: Exprs) -> tuple[sm.Expr, ...]:
    """Generalized forces minus rates of momentum, -(d/dt dL/ddq - dL/dq), one per coordinate.

    Zero where nothing else acts; a further generalized force along +q_i is added to entry i.

    Parameters
    ----------
    kinetic, potential : energies [J] as functions of q, dq (kinetic) and q (potential).
    q, dq, ddq : symbols of the n coordinates and of their first and second derivatives.

    Examples
    --------
    >>> q, w, a, m = sm.symbols("q w a m")
    >>> lagrange_residuals(m * w**2 / 2, 9.81 * m * q, [q], [w], [a])       # a falling mass
    (-a*m - 9.81*m,)
    """
    residuals = []
    for q_i, dq_i in zip(q, dq, strict=True):
        momentum = sm.diff(kinetic, dq_i)
        inertial = sum(sm.factor_terms(sm.expand(sm.diff(momentum, w))) * a for w, a in zip(dq, ddq, strict=True))
        moved = sum(sm.diff(momentum, x) * w for x, w in zip(q, dq, strict=True))
        velocity = sm.factor_terms(sm.expand(sm.diff(kinetic, q_i) - moved))
        residuals.append(velocity - sm.diff(potential, q_i) - inertial)
    return tuple(residuals)


def chain_energies(
    links: Sequence[Link], angles: Exprs, rates: Exprs, around: Surroundings, upright: bool
) -> tuple[sm.Expr, sm.Expr]:
    """Kinetic energy relative to the base, and potential energy, of a planar chain [J].

    The acceleration of the base acts as a uniform field, as in any frame that moves without
    turning (d'Alembert).

    Parameters
    ----------
    angles, rates : absolute angles of the links from the vertical, positive forward, and their
        rates; upward where `upright`, downward where the chain hangs.
    """
    up = 1 if upright else -1
    kinetic, potential = sm.S.Zero, sm.S.Zero
    for i, link in enumerate(links):
        arms = [*(k.length for k in links[:i]), link.com]
        pairs = [(j, k) for j in range(i + 1) for k in range(j + 1)]
        speed_squared = sum(
            (1 if j == k else 2) * arms[j] * arms[k] * rates[j] * rates[k] * sm.cos(angles[j] - angles[k])
            for j, k in pairs
        )
        kinetic += (link.mass * speed_squared + link.inertia * rates[i] ** 2) / 2
        forward = sum(r * sm.sin(a) for r, a in zip(arms, angles, strict=False))
        height = up * sum(r * sm.cos(a) for r, a in zip(arms, angles, strict=False))
        potential += link.mass * (around.vertical * height + (around.base_acceleration - around.horizontal) * forward)
    return kinetic, potential


@lru_cache(maxsize=32)
def chain_residuals(
    links: tuple[Link, ...], q: Symbols, dq: Symbols, ddq: Symbols, around: Surroundings, absolute: bool, upright: bool
) -> tuple[sm.Expr, ...]:
    """Residuals (forces minus rates of momentum [N m]) of a planar chain, one per coordinate.

    `q` are absolute angles of the links, or angles of each link relative to the one before.
    """
    angles = q if absolute else tuple(sum(q[: i + 1]) for i in range(len(q)))
    rates = dq if absolute else tuple(sum(dq[: i + 1]) for i in range(len(q)))
    kinetic, potential = chain_energies(links, angles, rates, around, upright)
    return lagrange_residuals(kinetic, potential, q, dq, ddq)
