"""Where balances of first order may lack a flow between two of them, or what another state does to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import combinations, product

import sympy as sm

from symid.model import Model, Port
from symid.units import dimension


def flow_ports(model: Model, ports: Mapping[str, Port], residuals: Mapping[str, sm.Expr]) -> dict[str, Port]:
    """Ports of exchanges and couplings, by a name.

    An ``exchange`` joins two balances of one kind, and leaves one for the other; or a balance and an input of the kind
    of its state, which is a level outside, as an ambient temperature. A ``coupling`` is the way from another state into
    a balance in which that does not appear, as from the speed of a motor to its current.

    Parameters
    ----------
    ports, residuals : of the balances, by equation.
    """
    balances = {n: p for n, p in ports.items() if p.role == "balance"}
    kinds = {c.symbol: dimension(c.unit or "1") for c in (*model.states.values(), *model.inputs.values())}
    found = {}
    for (a, p), (b, q) in combinations(balances.items(), 2):
        if p.unit == q.unit and kinds[p.position] == kinds[q.position]:
            into = {**p.into, **{k: -v for k, v in q.into.items()}}
            found[f"{a}_{b}"] = _port(p, p.position - q.position, "exchange", f"{p.at}-{q.at}", into)
    levels = [u for u in model.inputs.values() if all(_is_level(u.symbol, residuals[n], p) for n, p in ports.items())]
    for (n, p), u in product(balances.items(), levels):
        if kinds[p.position] == kinds[u.symbol]:
            at = f"{p.at}-{u.channel or u.name}"
            found[f"{n}_{u.name}"] = _port(p, p.position - u.symbol, "exchange", at, p.into)
    others = {s.symbol: s.name for s in model.states.values() if s.role != "memory"}
    names = others | {p.rate if p.position == 0 else p.position: p.at for p in ports.values()}
    for (n, p), x in product(balances.items(), others):
        if not residuals[n].has(x):
            found[f"{n}_{others[x]}"] = _port(p, x, "coupling", f"{p.at} from {names[x]}", p.into)
    drives = [u for u in model.inputs.values() if u not in levels and any(r.has(u.symbol) for r in residuals.values())]
    for (n, p), u in product(ports.items(), drives if len(drives) > 1 else ()):
        if not residuals[n].has(u.symbol):
            at = f"{p.at} from {u.channel or u.name}"
            found[f"{n}_{u.name}_coupling"] = _port(p, u.symbol, "coupling", at, p.into)
    return found


def _port(of: Port, position: sm.Expr, role: str, at: str, into: Mapping[str, float]) -> Port:
    return replace(of, position=position, role=role, at=at, into=dict(into))


def _is_level(u: sm.Symbol, residual: sm.Expr, port: Port) -> bool:
    """Whether an input acts in a balance only by its difference from the state, if at all.

    Of an input that acts otherwise, as a heater's or an elevator's, nothing is known of such a level.
    """
    terms = sm.Add.make_args(sm.expand(residual))
    return all(-term.xreplace({u: port.position}) in terms for term in terms if term.has(u))
