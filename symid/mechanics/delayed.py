"""Linear feedback of delayed states, on a fixed grid of lags."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sm

from symid import checked
from symid.errors import ModelError
from symid.mechanics.feedback import Feedback, full_state_gains, references
from symid.model import Model


@dataclass(frozen=True, kw_only=True)
class DelayedFullState(Feedback):
    """Full-state feedback at several lags: T(t) = sum_k K_k (angles - refs, rates)(t - lag_k).

    The gains of the k-th lag are named as in `FullStatePD` with ``_k`` behind (``kp_ah_2``);
    their signs are free, since a lag may well be paired with one of opposite sign.

    Parameters
    ----------
    lags : times before now at which the states are read [s], not negative, increasing.

    Raises
    ------
    ModelError : lags that are negative or not increasing.

    Examples
    --------
    >>> len(Chain.uniform(1).with_feedback(DelayedFullState(lags=(0.05, 0.1))).parameters)
    5
    """

    lags: tuple[float, ...] = (0.06, 0.1, 0.14)

    def __post_init__(self) -> None:
        check_lags(self.lags, type(self).__name__)

    def torques(self, model: Model, joints: tuple[str, ...]) -> list[sm.Expr]:
        references(model, joints)
        sums = [sm.S.Zero] * len(joints)
        for k, lag in enumerate(self.lags, start=1):
            gains = full_state_gains(model, joints, suffix=f"_{k}")
            signals = self.signals(model, joints, references=True, lag=lag, suffix=f"_{k}")
            read = (*signals.errors, *signals.rates)
            sums = [t + sum(g * s for g, s in zip(row, read, strict=True)) for t, row in zip(sums, gains, strict=True)]
        return sums


def check_lags(lags: tuple[float, ...], owner: str) -> None:
    """ModelError unless there are lags, none negative, strictly increasing."""
    for lag in checked.kind(lags, (tuple, list), f"{owner}: lags", ModelError):
        checked.number(lag, f"{owner}: lags", ModelError)
    if not lags or lags[0] < 0 or any(b <= a for a, b in zip(lags, lags[1:], strict=False)):
        raise ModelError(f"{owner}: lags = {lags!r} [s] must be one or more times, not negative and increasing")
