"""Random cases: draws are repeated until the loop is stable and the effect can be seen."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from symid.conceal.conceal import Concealed, Unsuitable, conceal, needed
from symid.conceal.facts import rig_facts, standing_facts
from symid.conceal.magnitudes import draw_terms, draw_values
from symid.conceal.setup import SWAY, Setup, setup_from_facts
from symid.errors import SymidError
from symid.mechanics import CANONICAL, LIBRARY
from symid.model import Law, Term
from symid.simulation import simulator

KINDS = {"none": 0.25, "single": 0.5, "two": 0.15, "unlisted": 0.1}
"""Shares of the kinds among random cases."""
VISIBLE = {"standing": (0.5, 3.0), "rig": (0.5, 40.0)}
"""What the model cannot absorb, over the noise."""
FRICTION_VISIBLE = 120.0
"""On a rig without any friction in its model, which is soon wrong, this much is allowed."""
WORSE = (1.05, 5.0)
"""A standing model must be this many times as wrong as the truth on the held-out window."""
STABLE = -0.3
"""Largest real part [1/s] of the eigenvalues of a standing person's loop."""
ATTEMPTS = 80


def draw_case(
    system: str | Mapping,
    effects: Sequence[tuple[str, str, Mapping[str, float]]] | None,
    seed: Sequence[int],
    kind: str | None = None,
    laws: Mapping[str, Law] = LIBRARY,
    listed: Collection[str] = CANONICAL,
) -> Concealed:
    """A case with the effects asked for, or (None) with random ones.

    Parameters
    ----------
    system : ``"standing"``, ``"rig"``, or the content of a ``case.json`` to be imitated.
    effects : name, place and given parameters of each; what is not given is drawn.
    seed : whole numbers; the same numbers give the same case.
    kind : of `KINDS`, for random effects; drawn if None.
    laws : by name, those of the library and a user's own. listed : names that an answer may give.

    Raises
    ------
    SymidError : no suitable case is found in many attempts; the message says why the last one failed.

    Examples
    --------
    >>> case = draw_case("rig", [("coulomb_friction", "joint2", {"torque_Nm": 1e-3})], seed=(1,))  # doctest: +SKIP
    >>> case.kind                                                                                  # doctest: +SKIP
    'single'
    """
    rng = np.random.default_rng(seed)
    if effects is None:
        kind = kind or str(rng.choice(list(KINDS), p=list(KINDS.values())))
    problem: SymidError | None = None
    for _ in range(ATTEMPTS):
        setup = _setup(system, effects, kind, rng)
        terms = draw_terms(setup, kind, rng) if effects is None else [_term(n, p, laws) for n, p, _ in effects]
        given = [v for *_, v in effects] if effects is not None else [{}] * len(terms)
        chosen = {t: draw_values(t, setup, rng, v) for t, v in zip(terms, given, strict=True)}
        aim, noise_seed = _aim(setup.system, rng), int(rng.integers(2**31))
        if not terms and setup.sway is None:
            setup = replace(setup, sway=float(np.exp(rng.uniform(*np.log(SWAY)))))
        try:
            _refuse_unstable(setup)
            case = conceal(setup, chosen, seed=noise_seed, visibility=aim, listed=listed)
            _refuse_invisible(case)
        except Unsuitable as error:
            problem = error
            continue
        return case
    raise SymidError(f"no suitable case in {ATTEMPTS} draws; the last one failed because {problem}")


def _setup(system, effects, kind, rng: np.random.Generator) -> Setup:
    if isinstance(system, Mapping):
        return setup_from_facts(system, rng)
    if system == "standing":
        return setup_from_facts(standing_facts(rng), rng)
    if system != "rig":
        raise SymidError(f"no system '{system}'; give standing, rig or the path of a case.json")
    if effects:
        conservative = any("friction" in name or "drag" in name for name, *_ in effects)
    else:
        conservative = kind != "unlisted" and rng.random() < (0.5 if kind == "two" else 0.3)
    # A mechanism without any friction is no likely null.
    return setup_from_facts(rig_facts(rng, conservative and kind != "none"), rng)


def _term(name: str, place: str, laws) -> Term:
    return laws[name].at(place)


def _aim(system: str, rng: np.random.Generator) -> float:
    low, high = VISIBLE.get(system, (0.5, 3.0))
    return float(rng.uniform(low, 0.9) if rng.random() < 0.5 else np.exp(rng.uniform(np.log(0.9), np.log(high))))


def _refuse_unstable(setup: Setup) -> None:
    if setup.system != "standing":
        return
    linear = simulator(setup.model).linearise(dict(setup.parameters), dict.fromkeys(setup.model.states, 0.0))
    if np.linalg.eigvals(linear.without_delay()[0]).real.max() > STABLE:
        raise Unsuitable("the feedback does not hold the body up well enough")


def _refuse_invisible(case: Concealed) -> None:
    if not case.terms:
        return
    low, high = VISIBLE.get(case.setup.system, (0.0, np.inf))
    if case.setup.system == "rig" and not case.setup.model.terms:
        high = FRICTION_VISIBLE
    if not low * 0.95 <= case.visibility <= high * 1.05:
        raise Unsuitable(
            f"what the model cannot absorb is {case.visibility:.3g} times the noise, not {low:g} to {high:g}"
        )
    base, truth = (case.reference[k]["heldout_rms_rad"] for k in ("baseline", "true_parameters"))
    passing = any(t.name == "external_push" for t in case.terms)
    if (
        case.setup.system == "standing"
        and not (passing or WORSE[0] <= base / truth)
        or base / truth > WORSE[1] * (1 if case.setup.system == "standing" else np.inf)
    ):
        raise Unsuitable(f"on the held-out window the model is {base / truth:.3g} times as wrong as the truth")
    if not needed(case):
        raise Unsuitable("one of the effects does not show beside the other")
