"""Where the joints of a planar chain are, from its states: what a stick figure draws."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid import checked
from symid.errors import ModelError
from symid.model import Model

UPRIGHT, HANGING = "angle_from_upward_vertical", "angle_from_downward_vertical"
"""Roles of the first angle of a chain."""


@dataclass(frozen=True, eq=False)
class Skeleton:
    """The links of a planar chain, drawn from joint to joint.

    Attributes
    ----------
    links : their names, from the base on. lengths : (links,) [m]; of the last link twice the way to its centre of mass.
    states : names of the states. turns : (links, states) each link's angle from the vertical, as a sum of states.
    upright : whether the vertical points up.

    Examples
    --------
    >>> skeleton(Chain.uniform(2, length=0.5, upright=True).plant()).upright
    True
    """

    links: tuple[str, ...]
    lengths: np.ndarray
    states: tuple[str, ...]
    turns: np.ndarray
    upright: bool

    def positions(self, states: np.ndarray) -> np.ndarray:
        """(N, links + 1, 2) forward and upward position [m] of the base, each joint and the end, from (N, n) states."""
        angles = np.asarray(states) @ self.turns.T
        up = self.lengths * np.cos(angles) * (1 if self.upright else -1)
        steps = np.stack([self.lengths * np.sin(angles), up], axis=2)
        return np.concatenate([np.zeros((len(steps), 1, 2)), np.cumsum(steps, axis=1)], axis=1)


def skeleton(model: Model) -> Skeleton:
    """The skeleton of a model of the chains in this room, with or without feedback and further terms.

    Raises
    ------
    ModelError : the model is no such chain.

    Examples
    --------
    >>> from symid.mechanics import Chain, skeleton
    >>> skeleton(Chain.uniform(2, length=0.5).plant()).positions([[0.0, 0.0, 0.0, 0.0]])[0, :, 1]
    array([ 0. , -0.5, -1. ])
    """
    ports = checked.kind(model, Model, "skeleton", ModelError).find("link")
    upright = model.find(UPRIGHT)
    if not ports or not upright and not model.find(HANGING):
        raise ModelError(
            f"model '{model.name}' is no planar chain of links, so it has no stick figure; those of "
            "symid.mechanics (DoubleLinkPendulum, Chain, rig_model) are"
        )
    names = tuple(model.states)
    turns = [[float(model.inline(p.position).diff(model.states[n].symbol)) for n in names] for p in ports]
    return Skeleton(
        tuple(p.at for p in ports),
        np.array([_length(model, p.at) for p in ports]),
        names,
        np.array(turns),
        bool(upright),
    )


def _length(model: Model, link: str) -> float:
    whole = model.find("length", link)
    return float(whole[0].value) if whole else 2 * float(model.find("center_of_mass", link)[0].value)
