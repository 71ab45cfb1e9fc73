"""Bench rigs: hanging chains of links from a table of parameters, as their recording drives them."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from math import inf
from typing import Any, cast

from symid.errors import ModelError, RecordingError
from symid.mechanics.chains.chain import MOST_LINKS, Chain
from symid.mechanics.chains.link import ChainLink
from symid.mechanics.missing.terms import LIBRARY
from symid.model import Input, Model
from symid.recording import read_body
from symid.recording.body import load_table

BASES = ("base", "cart", "pivot", "platform", "mount")
"""Names by which a recording may call what the first joint is fixed to."""
REACH = 0.3
"""Length of a chain of which nothing is known [m]."""
_QUANTITIES = {"m": "kg", "a": "m", "I": "kg*m^2", "L": "m"}
_LONG = {"mass": "m", "com": "a", "inertia": "I", "length": "L"}
_FIELDS = {"m": "mass", "a": "com", "I": "inertia", "L": "length"}
_COUNT = {1: "pendulum", 2: "double pendulum", 3: "triple pendulum"}


def rig_model(
    parameters: Mapping[str, object] | str | os.PathLike[str],
    channels: Iterable[str] = (),
    friction: Iterable[str] = (),
    reach: float = REACH,
) -> Model:
    """A chain of links that hangs from a mount, as its parameters and its recording say.

    Parameters
    ----------
    parameters : JSON file or its content, flat or under the key ``parameters``: masses ``m1_kg``,
        joint to centre of mass ``a1_m``, inertias about the centres of mass ``I1_kg_m2``, joint
        to joint ``L1_m`` for all links but the last, and ``g_m_s2`` (9.81 if left out); or
        ``link1_mass_kg``, ``link1_com_m``, ``link1_inertia_kg_m2``, ``link1_length_m``,
        ``gravity_m_s2``. Other keys, such as friction that somebody published, are left out. What is not known
        is ``null``, and a parameter of the model.
    channels : of the recording. Angles called ``joint1_angle`` are relative to the link before,
        ``link1_angle`` from the downward vertical. An acceleration of what carries the chain
        (``cart_acceleration``; see `BASES`) drives it, and so do torques (``joint1_torque``).
    friction : joints that the model gives an unknown viscous friction.
    reach : about how long the chain is [m], for the guesses of what is not known.

    Raises
    ------
    RecordingError : listing every key that is missing or has no usable value.
    ModelError : `friction` names a joint that the rig does not have.

    Examples
    --------
    >>> rig = rig_model({"m1_kg": 0.1, "a1_m": 0.1, "I1_kg_m2": 4e-4}, channels=["link1_angle"], friction=["joint1"])
    >>> list(rig.states), list(rig.parameters)
    (['link1_angle', 'link1_velocity'], ['viscous_friction_joint1_coefficient_Nms_rad'])
    """
    name = "rig" if isinstance(parameters, Mapping) else str(parameters)
    given = load_table(parameters)
    content = given.get("parameters", given)
    if not isinstance(content, Mapping):
        raise RecordingError(f"{name}: 'parameters' must be an object such as {{\"m1_kg\": 0.09}}")
    table = {_short(k): v for k, v in content.items()}
    numbers = [n for k in table for n in re.findall(r"^[maIL](\d+)_", k)]
    if any(len(n) > 3 or int(n) > MOST_LINKS for n in numbers):
        raise RecordingError(
            f"{name}: the parameters name link {max(numbers, key=len)[:12]}; a rig has {MOST_LINKS} links at most"
        )
    count = max(map(int, numbers), default=0)
    if count == 0:
        raise RecordingError(
            f"{name}: no link has a mass; give m1_kg, a1_m and I1_kg_m2 for one link, and m2_kg ... for more"
        )
    needed = {f"{q}{i}": unit for i in range(1, count + 1) for q, unit in _QUANTITIES.items() if q != "L" or i < count}
    gravity = {"g": "m/s^2"} if any(k.startswith("g_") for k in table) else {}
    own = {k: v for k, v in table.items() if k.split("_")[0] in needed | gravity}
    unknown = [k.split("_")[0] for k, v in own.items() if v is None and not k.startswith("g_")]
    known = {k: unit for k, unit in (needed | gravity).items() if k not in unknown}
    values = {"g": 9.81} | read_body({k: v for k, v in own.items() if k.split("_")[0] in known}, known, name)
    values |= _guesses(unknown, values, count, reach)
    links = tuple(
        ChainLink(
            f"link{i}",
            constants=tuple((_FIELDS[q], f"{q}{i}") for q in _QUANTITIES),
            **cast("dict[str, Any]", {_FIELDS[q]: values.get(f"{q}{i}") for q in _QUANTITIES}),
        )
        for i in range(1, count + 1)
    )
    model = _driven(
        Chain(links, gravity=values["g"], name=f"{_COUNT.get(count, f'chain of {count} links')} on a bench"),
        set(channels),
        tuple(friction),
    )
    return model.free(**dict.fromkeys(unknown, (0.0, inf))) if unknown else model


def _guesses(unknown: Iterable[str], known: Mapping[str, float], count: int, reach: float) -> dict[str, float]:
    """Those of a chain of equal rods, as heavy as the links that are known, or 1 kg each."""
    masses = [v for k, v in known.items() if k.startswith("m")]
    values = dict(known)
    for kind in "mLaI":
        for k in (k for k in unknown if k[0] == kind):
            length = values.get(f"L{k[1:]}", reach / count)
            usual = {"m": sum(masses) / len(masses) if masses else 1.0, "L": reach / count, "a": length / 2}
            values[k] = usual[kind] if kind in usual else values[f"m{k[1:]}"] * length**2 / 12
    return {k: values[k] for k in unknown}


def _short(key: str) -> str:
    """``link1_mass_kg`` as ``m1_kg``, ``gravity_m_s2`` as ``g_m_s2``, ``m_kg`` of a single link as ``m1_kg``."""
    key = re.sub(r"^link(\d+)_(mass|com|inertia|length)_", lambda k: f"{_LONG[k[2]]}{k[1]}_", key)
    key = re.sub(r"^gravity_", "g_", key)
    return re.sub(r"^([maI])_(?=kg|m)", r"\g<1>1_", key)


def _driven(chain: Chain, channels: set[str], friction: tuple[str, ...]) -> Model:
    """The model of a chain with the inputs that the recording has."""
    absolute = not any(f"{j}_angle" in channels for j in chain.joints)
    base = next((f"{b}_acceleration" for b in BASES if f"{b}_acceleration" in channels), "")
    model = replace(chain, absolute=absolute, base_channel=base).plant()
    for joint in chain.joints:
        if (torque := f"{joint}_torque") in channels:
            setattr(
                model,
                torque,
                Input(
                    unit="N*m",
                    channel=torque,
                    role="excitation",
                    at="input",
                    meaning=f"recorded torque of a drive at the {joint}",
                ),
            )
            model.add_effort(joint, model[torque].symbol)
    for joint in friction:
        if joint not in chain.joints:
            raise ModelError(
                f"friction at '{joint}': the {chain.name} has no such joint; it has {', '.join(chain.joints)}"
            )
        model = model.with_term(LIBRARY["viscous_friction"].at(joint))
    return model
