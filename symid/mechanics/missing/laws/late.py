"""What comes late in a machine whose controller is written into its equations: nobody told apart what feeds back."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.errors import ModelError
from symid.mechanics.missing.laws.drive import follow, lagging
from symid.mechanics.missing.laws.shared import LAG, effort_law, port_at
from symid.model import Law, LawParameter, Model, Port


def _late_damping(model: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    felt = {x.symbol: model.delayed(x.symbol, p.delay_s) for x in model.states.values() if port.rate.has(x.symbol)}
    return -p.coefficient_Nms_rad * port.rate.xreplace(felt)


Build = Callable[[Model, str, SimpleNamespace], None]


def _late_loop(role: str) -> Build:
    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        port = port_at(model, role, place)
        now = loop_force(model, port)
        model.add_effort(port.name, model.delayed(now, p.delay_s) - now)

    return build


def _late_sensors(role: str) -> Build:
    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        port = port_at(model, role, place)
        now = loop_force(model, port)
        prompt = {s: sm.Dummy(str(s)) for s in _told(model, port, now)}
        late = model.delayed(now.xreplace(prompt), p.delay_s).xreplace({kept: s for s, kept in prompt.items()})
        model.add_effort(port.name, late - now)

    return build


def _lagging_drive(role: str, law: str) -> Build:
    def build(model: Model, place: str, p: SimpleNamespace) -> None:
        port = port_at(model, role, place)
        now = loop_force(model, port)
        felt = lagging(model, port, f"{law}_{port.name}")
        follow(model, felt, p.time_constant_s, now)
        model.add_effort(port.name, felt - now)

    return build


def loop_force(model: Model, port: Port) -> sm.Expr:
    """The force at a port that unknown parameters make of states and inputs, as gains of a controller do; 0 if none.

    Those count that stand beside a state, beside no rate and in no power, and act as a force there does: in the same
    equations. Parameters of passive springs and dampers are among them; a delay is next to nothing to these. A balance
    of first order has no damping to be fed back, and what it loses is not late: there they stand beside a reference.
    """
    written = {name: model.inline(e.expr) for name, e in model.equations.items()}
    states = {x.symbol for x in model.states.values()}
    states |= {late for late, d in model.delays.items() if d.of in states}
    rates = {x.dot for x in model.states.values()}
    gains = [q.symbol for q in model.parameters.values() if _is_gain(q.symbol, written, port, states, rates)]
    name, sign = next(iter(port.into.items()))
    if port.role == "balance":
        gains = [q for q in gains if _told(model, port, sm.diff(written[name], q))]
    return (written[name] - written[name].xreplace(dict.fromkeys(gains, sm.S.Zero))) / sign


def _is_gain(q: sm.Symbol, written: dict[str, sm.Expr], port: Port, states: set, rates: set) -> bool:
    """Whether the parameter q enters the `written` equations as a force at the port that follows `states` does."""
    entered = {name: sm.diff(e, q) for name, e in written.items() if e.has(q)}
    symbols = set().union(*(slope.free_symbols for slope in entered.values()))
    if entered.keys() != port.into.keys() or not symbols & states or symbols & rates or q in symbols:
        return False
    first, *others = (sm.expand(slope / port.into[name]) for name, slope in entered.items())
    return all(force == first for force in others)


def _has_loop(model: Model, place: str, role: str = "joint") -> bool:
    """Whether anything moves the machine that a controller could answer to, and it is none whose parts are told."""
    if model.find("feedback_torque") or not (model.inputs or model.noises):
        return False
    try:
        return loop_force(model, port_at(model, role, place)) != 0
    except ModelError:
        return False


def _has_reference(model: Model, place: str, role: str = "joint") -> bool:
    """Whether a controller compares what it senses with what it is told, which need not be as late."""
    if not _has_loop(model, place, role):
        return False
    port = port_at(model, role, place)
    return bool(_told(model, port, loop_force(model, port)))


def _corrects(model: Model, place: str) -> bool:
    """Whether a balance of first order is driven towards a reference: else its loop is a leak, which is never late."""
    return _has_reference(model, place, "balance")


def _told(model: Model, port: Port, force: sm.Expr) -> set[sm.Symbol]:
    """What of a force is no motion at a port of that kind: inputs, late ones, and states through which they pass."""
    ports = [p for p in model.ports.values() if p.role == port.role]
    moving = set().union(*(p.position.free_symbols | p.rate.free_symbols for p in ports))
    signals = {part.symbol for part in [*model.states.values(), *model.inputs.values()]}
    sources = {s: s for s in signals} | {late: d.of for late, d in model.delays.items()}
    return {s for s in force.free_symbols if s in sources and sources[s] not in moving}


_LATE = LawParameter("delay_s", "s", (0.0, 0.5), 0.0, (0.03, 0.08, 0.15), 0.1)

LOOP_LAWS: tuple[Law, ...] = (
    Law(
        "late_feedback",
        "joint",
        (_LATE,),
        _late_loop("joint"),
        "What holds the {place} comes {delay_s} late, as from nerves or from a computer",
        "Peterka 2002",
        applies=_has_loop,
    ),
    Law(
        "late_sensing",
        "joint",
        (_LATE,),
        _late_sensors("joint"),
        "What the controller of the {place} senses comes {delay_s} late, and what it is told does not",
        "Peterka 2002",
        applies=_has_reference,
    ),
    Law(
        "feedback_lag",
        "joint",
        (LAG,),
        _lagging_drive("joint", "feedback_lag"),
        "What holds the {place} follows its controller with a lag of {time_constant_s}, as of a motor or a muscle",
        "Ljung 1999",
        applies=_has_loop,
    ),
    Law(
        "late_correction",
        "balance",
        (_LATE,),
        _late_loop("balance"),
        "What corrects the {place} comes {delay_s} late, as from nerves or from a computer",
        "McRuer & Jex 1967",
        applies=_corrects,
    ),
    Law(
        "late_observation",
        "balance",
        (_LATE,),
        _late_sensors("balance"),
        "What the controller of the {place} observes comes {delay_s} late, and what it is told does not",
        "McRuer & Jex 1967",
        applies=_corrects,
    ),
    Law(
        "correction_lag",
        "balance",
        (LAG,),
        _lagging_drive("balance", "correction_lag"),
        "What corrects the {place} follows its controller with a lag of {time_constant_s}, as of a motor or a muscle",
        "Ljung 1999",
        applies=_corrects,
    ),
)
"""Of a controller that is written into the equations: all of it, what it senses, or what it drives. At a joint, or at a
balance of first order, as where a person follows a target with what moves as fast as it is pushed."""

LATE_LAWS: tuple[Law, ...] = (
    effort_law(
        "late_damping",
        "joint",
        (
            LawParameter("coefficient_Nms_rad", "N*m*s/rad", (-inf, inf)),
            LawParameter("delay_s", "s", (0.01, 0.3), None, (0.04, 0.1), 0.05),
        ),
        _late_damping,
        "The {place} feels the speed that it had {delay_s} earlier, {coefficient_Nms_rad}, as by a stretch reflex",
        "Liddell & Sherrington 1924",
    ),
    *LOOP_LAWS,
)
