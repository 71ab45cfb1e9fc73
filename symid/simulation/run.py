"""What one simulation is given and fills: the same for the loop in C and the loop in Python."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.errors import SymidError

METHODS = {"rk4": 0, "euler": 1, "stiff": 2}


@dataclass(frozen=True, eq=False)
class Signals:
    """What a system is given at its samples, checked once for any number of runs: `Simulator.signals`.

    Attributes
    ----------
    early : rows of `times` and `given` before the start, for inputs that act late.
    times : (early + N,) [s]. given : (early + N, inputs).
    slopes, bends : first and second derivatives of `given`; None where no input has any.
    w : (N, noises). Where there are no inputs or no noises, one column of zeros.
    """

    early: int
    times: np.ndarray
    given: np.ndarray
    slopes: np.ndarray | None
    bends: np.ndarray | None
    w: np.ndarray


@dataclass(eq=False)
class Run:
    """Checked, contiguous arrays of one simulation over N samples.

    Attributes
    ----------
    substeps, method : of the integrator, a value of `METHODS`.
    limit : a state larger than this ends the run.
    signals : what it is given, of which `t`, `u`, `du` and `ddu` are the last N rows. p, c, x0 : values.
    qp, qx : (nqp,), (nqx,) parameters and initial states to differentiate by; nq of both and of what only the gain
        depends on.
    gain : (npast + 1, n, m) or (n, m) corrections at the samples and recorded : (N, m), or None.
    dgain : (npast + 1, n, m, nq) or (n, m, nq) slopes of the gain, or None where it depends on nothing.
    ht, hx : (nh,) and (nh, n) history before the start, or None. hs : (nh, n, nqp + nqx) its slopes, or None.
    X : (N, n), Y : (N, m), SX : (N, n, nq), SY : (N, m, nq): results; None where not wanted.
    stiff : result: steps of the integrator in which something was stiff.
    """

    substeps: int
    method: int
    limit: float
    signals: Signals
    p: np.ndarray
    c: np.ndarray
    x0: np.ndarray
    qp: np.ndarray
    qx: np.ndarray
    gain: np.ndarray | None
    dgain: np.ndarray | None
    recorded: np.ndarray | None
    ht: np.ndarray | None
    hx: np.ndarray | None
    hs: np.ndarray | None
    X: np.ndarray | None
    Y: np.ndarray
    SX: np.ndarray | None
    SY: np.ndarray | None
    stiff: int = 0

    @property
    def early(self) -> int:
        return self.signals.early

    @property
    def t(self) -> np.ndarray:
        return self.signals.times[self.early :]

    @property
    def u(self) -> np.ndarray:
        return self.signals.given[self.early :]

    @property
    def du(self) -> np.ndarray | None:
        return None if self.signals.slopes is None else self.signals.slopes[self.early :]

    @property
    def ddu(self) -> np.ndarray | None:
        return None if self.signals.bends is None else self.signals.bends[self.early :]

    @property
    def w(self) -> np.ndarray:
        return self.signals.w

    @property
    def N(self) -> int:
        return len(self.w)

    @property
    def nqp(self) -> int:
        return len(self.qp)

    @property
    def nqx(self) -> int:
        return len(self.qx)

    @property
    def nq(self) -> int:
        return self.nqp + self.nqx if self.dgain is None else self.dgain.shape[-1]

    @property
    def nh(self) -> int:
        return 0 if self.ht is None else len(self.ht)

    @property
    def npast(self) -> int:
        return 0 if self.gain is None or self.gain.ndim == 2 else len(self.gain) - 1


def history_of(history: tuple[np.ndarray, ...] | None, states: int, slopes: int) -> dict[str, np.ndarray | None]:
    """The fields of a `Run` that tell what was before it; `slopes` of them are asked for.

    Raises
    ------
    SymidError : the arrays are not of the shapes that `Simulator.simulate` states.
    """
    if history is None:
        return {"ht": None, "hx": None, "hs": None}
    given = [np.ascontiguousarray(h, dtype=float) for h in history]
    known = given if slopes else given[:2]
    wanted = [(len(given[0]),), (len(given[0]), states), (len(given[0]), states, slopes)]
    if len(given) not in (2, 3) or [h.shape for h in known] != wanted[: len(known)]:
        raise SymidError(
            f"history must be (K,) times, (K, {states}) states and, if any, (K, {states}, {slopes}) slopes; found "
            f"arrays of the shapes {[h.shape for h in given]}"
        )
    return dict(zip(("ht", "hx", "hs"), [*known, None], strict=False))
