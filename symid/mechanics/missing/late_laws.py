"""What comes late in a machine whose controller is written into its equations: nobody told apart what feeds back."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace

import sympy as sm

from symid.errors import ModelError
from symid.mechanics.missing.drive_laws import follow, lagging
from symid.mechanics.missing.laws import LAG, effort_law, port_at
from symid.model import Law, LawParameter, Model, Port


def _late_damping(model: Model, port: Port, p: SimpleNamespace) -> sm.Expr:
    felt = {x.symbol: model.delayed(x.symbol, p.delay_s) for x in model.states.values() if port.rate.has(x.symbol)}
    return -p.coefficient_Nms_rad * port.rate.xreplace(felt)


def _late_loop(model: Model, place: str, p: SimpleNamespace) -> None:
    port = port_at(model, "joint", place)
    now = loop_force(model, port)
    model.add_effort(port.name, model.delayed(now, p.delay_s) - now)


def _late_sensors(model: Model, place: str, p: SimpleNamespace) -> None:
    port = port_at(model, "joint", place)
    now = loop_force(model, port)
    prompt = {s: sm.Dummy(str(s)) for s in _told(model, now)}
    late = model.delayed(now.xreplace(prompt), p.delay_s).xreplace({kept: s for s, kept in prompt.items()})
    model.add_effort(port.name, late - now)


def _lagging_drive(model: Model, place: str, p: SimpleNamespace) -> None:
    port = port_at(model, "joint", place)
    now = loop_force(model, port)
    felt = lagging(model, port, f"feedback_lag_{port.name}")
    follow(model, felt, p.time_constant_s, now)
    model.add_effort(port.name, felt - now)


def loop_force(model: Model, port: Port) -> sm.Expr:
    """The force at a port that unknown parameters make of states and inputs, as gains of a controller do; 0 if none.

    Those count that stand beside a state, beside no rate and in no power, and act as a force there does: in the same
    equations. Parameters of passive springs and dampers are among them; a delay is next to nothing to these.
    """
    written = {name: model.inline(e.expr) for name, e in model.equations.items()}
    states = {x.symbol for x in model.states.values()}
    states |= {late for late, d in model.delays.items() if d.of in states}
    rates = {x.dot for x in model.states.values()}
    gains = [q.symbol for q in model.parameters.values() if _is_gain(q.symbol, written, port, states, rates)]
    name, sign = next(iter(port.into.items()))
    return (written[name] - written[name].xreplace(dict.fromkeys(gains, sm.S.Zero))) / sign


def _is_gain(q: sm.Symbol, written: dict[str, sm.Expr], port: Port, states: set, rates: set) -> bool:
    """Whether the parameter q enters the `written` equations as a force at the port that follows `states` does."""
    entered = {name: sm.diff(e, q) for name, e in written.items() if e.has(q)}
    symbols = set().union(*(slope.free_symbols for slope in entered.values()))
    if entered.keys() != port.into.keys() or not symbols & states or symbols & rates or q in symbols:
        return False
    first, *others = (sm.expand(slope / port.into[name]) for name, slope in entered.items())
    return all(force == first for force in others)


def _has_loop(model: Model, place: str) -> bool:
    """Whether anything moves the machine that a controller could answer to, and it is none whose parts are told."""
    if model.find("feedback_torque") or not (model.inputs or model.noises):
        return False
    try:
        return loop_force(model, port_at(model, "joint", place)) != 0
    except ModelError:
        return False


def _has_reference(model: Model, place: str) -> bool:
    """Whether a controller compares what it senses with what it is told, which need not be as late."""
    return _has_loop(model, place) and bool(_told(model, loop_force(model, port_at(model, "joint", place))))


def _told(model: Model, force: sm.Expr) -> set[sm.Symbol]:
    """What of a force is no motion of a joint: inputs, late ones, and states through which they pass."""
    ports = [p for p in model.ports.values() if p.role == "joint"]
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
        _late_loop,
        "What holds the {place} comes {delay_s} late, as from nerves or from a computer",
        "Peterka 2002",
        applies=_has_loop,
    ),
    Law(
        "late_sensing",
        "joint",
        (_LATE,),
        _late_sensors,
        "What the controller of the {place} senses comes {delay_s} late, and what it is told does not",
        "Peterka 2002",
        applies=_has_reference,
    ),
    Law(
        "feedback_lag",
        "joint",
        (LAG,),
        _lagging_drive,
        "What holds the {place} follows its controller with a lag of {time_constant_s}, as of a motor or a muscle",
        "Ljung 1999",
        applies=_has_loop,
    ),
)
"""Of a controller that is written into the equations: all of it, what it senses, or what it drives."""

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
