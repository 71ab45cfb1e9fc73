"""The model that the facts of a case describe: a standing person, or a rig on a bench."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from symid import checked
from symid.errors import ModelError
from symid.mechanics.chains.rig import rig_model
from symid.mechanics.chains.standing import DoubleLinkPendulum
from symid.mechanics.feedback import PD, FullStatePD
from symid.model import Model

CONTROLLERS = {"PD": PD, "FPD": FullStatePD}
_BODY = {
    "leg_length": "l_L_m",
    "leg_com": "d_L_m",
    "trunk_com": "d_T_m",
    "leg_mass": "m_L_kg",
    "trunk_mass": "m_T_kg",
    "leg_inertia": "I_L_kg_m2",
    "trunk_inertia": "I_T_kg_m2",
}


def model_of(facts: Mapping[str, Any], channels: Iterable[str] = ()) -> Model:
    """The model of a case from what its user knows, the content of a ``case.json``.

    Parameters
    ----------
    facts : with ``system`` ("standing" or "rig"), its ``body`` or ``parameters``, and ``baseline``:
        a standing person's ``controller``, a rig's ``terms`` (none: conservative).
    channels : of the recording, see `rig_model`.

    Raises
    ------
    ModelError : naming what is missing or unknown. RecordingError : about a rig's parameters.

    Examples
    --------
    >>> table = {"m1_kg": 0.1, "a1_m": 0.1, "I1_kg_m2": 4e-4}
    >>> model_of({"system": "rig", "parameters": table}, channels=["link1_angle"]).name
    'pendulum on a bench'
    """
    readers = {"standing": _standing, "rig": _rig}
    checked.kind(facts, Mapping, "model_of", ModelError)
    checked.choice(facts.get("system"), list(readers), "system", ModelError)
    return readers[facts["system"]](facts, channels)


def _table(facts: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    table = facts.get(key)
    if not isinstance(table, Mapping):
        raise ModelError(
            f"the key '{key}' is missing" if key not in facts else f"'{key}' is no table of names and numbers"
        )
    return table


def _standing(facts: Mapping[str, Any], channels: Iterable[str]) -> Model:
    body, controller = _table(facts, "body"), _table(facts, "baseline").get("controller")
    missing = [k for k in _BODY.values() if k not in body]
    if missing:
        raise ModelError(f"body has no '{missing[0]}'")
    law = CONTROLLERS[checked.choice(controller, list(CONTROLLERS), "baseline controller", ModelError)]
    person = DoubleLinkPendulum(**{k: body[v] for k, v in _BODY.items()}, gravity=facts.get("gravity_m_s2", 9.81))
    return person.with_feedback(law())


def _rig(facts: Mapping[str, Any], channels: Iterable[str]) -> Model:
    terms = _table(facts, "baseline").get("terms", ()) if "baseline" in facts else ()
    checked.kind(terms, (list, tuple), "baseline terms", ModelError)
    odd = [t for t in terms if t != "conservative" and not str(t).startswith("viscous_friction:")]
    if odd:
        raise ModelError(
            f"baseline has the term {checked.shown(odd[0])}; known: conservative, viscous_friction:<joint>"
        )
    return rig_model(_table(facts, "parameters"), channels, [t.partition(":")[2] for t in terms if ":" in t])
