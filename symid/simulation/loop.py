"""The integrating loop in Python, where there is no C compiler: the same steps as `loop.c`, some hundred times slower.

Sensitivities S = dx/dq obey M S' = -(r_x S + r_late S_late + r_p), as there; late signals are read from
the stored steps (`past.py`).
"""

from __future__ import annotations

import numpy as np

from symid.codegen.ode import OdeSource
from symid.simulation.past import Past, Step
from symid.simulation.run import METHODS, Run


class PythonLoop:
    """`simulate` and `linearise` of one model, as `CompiledLoop` has them."""

    backend = "numpy"

    def __init__(self, source: OdeSource):
        self.source, self.functions = source, source.in_python()
        s = source
        self.sizes = {
            "x": len(s.states),
            "l": len(s.late),
            "p": len(s.parameters),
            "w": len(s.noises),
            "xd": len(s.states),
        }
        self.rows = {"slopes": len(s.states), "observe_slopes": len(s.outputs), "lag_slopes": len(s.late)}

    def simulate(self, run: Run) -> int:
        """Fill the results of `run`; the number of samples reached."""
        with np.errstate(all="ignore"):  # NaN and infinity are results here, as they are in C
            return _Simulation(self, run).samples()

    def linearise(self, arguments: tuple[np.ndarray, ...], out: list[np.ndarray]) -> None:
        """As `CompiledLoop.linearise`."""
        call = (*arguments, 0.0)
        with np.errstate(all="ignore"):
            slopes, observed = self.slopes("slopes", call), self.slopes("observe_slopes", call)
            n = len(self.source.states)
            values = (
                self.functions["mass"](*call)[0].reshape(n, n),
                slopes["x"],
                slopes["l"],
                slopes["w"],
                observed["x"],
                observed["l"],
                self.functions["lags"](*call)[0],
            )
            for place, value in zip(out, values, strict=True):
                place[...] = value

    def slopes(self, name: str, call: tuple) -> dict[str, np.ndarray]:
        """Dense derivatives of a group of rows by group of symbols."""
        dense = {}
        for array, values in zip(self.source.functions[name], self.functions[name](*call), strict=True):
            group = array[1:]
            dense[group] = np.zeros((self.rows[name], self.sizes[group]))
            dense[group][self.source.entries[f"{name}_{group}"]] = values
        return dense


class _Simulation:
    """One run: the present state x (n,), its sensitivities S (n, nq), and the past where signals are late."""

    def __init__(self, loop: PythonLoop, run: Run):
        self.loop, self.run = loop, run
        self.functions, source = loop.functions, loop.source
        self.x, self.S = run.x0.copy(), np.zeros((len(run.x0), run.nq))
        self.S[run.qx, run.nqp + np.arange(run.nqx)] = 1
        self.still, zero = np.zeros(len(run.x0)), np.zeros(max(loop.sizes["x"], 1))
        call = (zero, self.x, zero, zero, zero, run.p, run.c, 0.0)
        late = len(source.late)
        lag, dlag = self.functions["lags"](*call)[0], np.zeros((late, run.nq))
        if late:
            dlag[:, : run.nqp] = loop.slopes("lag_slopes", call)["p"][:, run.qp]
        self.past = Past(run, source, lag, dlag)

    def samples(self) -> int:
        run, last = self.run, self.run.N - 1
        for k in range(run.N):
            if not np.all(np.abs(self.x) < run.limit):
                return k
            surprise = self._observed(k)
            if surprise is None:
                return k
            if k == last:
                break
            if run.gain is not None:
                self._correct(k, *surprise)
            h = (run.t[k + 1] - run.t[k]) / run.substeps
            for s in range(run.substeps):
                if not self._step(run.t[k] + s * h, h, k):
                    return k + 1
        return run.N

    def _observed(self, k: int) -> tuple[np.ndarray, np.ndarray] | None:
        """Store states and outputs of sample k; recorded minus output and its slopes, None where M is singular."""
        run, t = self.run, self.run.t[k]
        interval = k if k < run.N - 1 else max(k - 1, 0)
        xd, Sd = np.zeros_like(self.x), np.zeros_like(self.S)
        if self.loop.source.outputs_need_rates:
            found = self._rates(t, interval, self.x, self.S)
            if found is None:
                return None
            xd, Sd = found
        u, _ = self.past.inputs_at(t, k)
        late, lS = self.past.late_at(t, k, self.x, self.S)
        call = (xd, self.x, late, u, run.w[interval], run.p, run.c, t)
        y = self.functions["observe"](*call)[0]
        Sy = np.zeros((len(y), run.nq))
        if run.nq:
            d = self.loop.slopes("observe_slopes", call)
            Sy = d["x"] @ self.S + d["l"] @ lS + d["xd"] @ Sd
            Sy[:, : run.nqp] += d["p"][:, run.qp]
        for place, value in ((run.X, self.x), (run.Y, y), (run.SX, self.S), (run.SY, Sy)):
            if place is not None:
                place[k] = value
        return (np.zeros(len(y)) if run.recorded is None else run.recorded[k] - y), Sy

    def _rates(self, t: float, k: int, x: np.ndarray, S: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """x' and S', None where the mass matrix is singular."""
        run, n = self.run, len(x)
        u, _ = self.past.inputs_at(t, k)
        late, lS = self.past.late_at(t, k, x, S)
        given = (late, u, run.w[k], run.p, run.c, t)
        M, force = self.functions["mass"](self.still, x, *given)
        try:
            M = M.reshape(n, n)
            xd = np.linalg.solve(M, -force)
            if not run.nq:
                return xd, S
            d = self.loop.slopes("slopes", (xd, x, *given))
            right = -(d["x"] @ S + d["l"] @ lS)
            right[:, : run.nqp] -= d["p"][:, run.qp]
            return xd, np.linalg.solve(M, right)
        except np.linalg.LinAlgError:
            return None

    def _correct(self, k: int, e: np.ndarray, Sy: np.ndarray) -> None:
        """Move the state, and what late signals still read of the past, by what sample k says; NaN says nothing."""
        gain = self.run.gain if self.run.gain.ndim == 2 else self.run.gain[0]
        known = ~np.isnan(e)
        e, Sy = np.where(known, e, 0.0), np.where(known[:, None], Sy, 0.0)
        self.x = self.x + gain @ e
        self.S = self.S - gain @ Sy
        if self.run.npast:
            self.past.correct(self.run.t[k], self.run.t[k + 1] - self.run.t[k], e, Sy)

    def _step(self, t: float, h: float, k: int) -> bool:
        """One step of the integrator from t; False where the mass matrix is singular."""
        x, S, past = self.x, self.S, self.past
        past.begin(t, x, S)
        first = self._rates(t, k, x, S)
        if first is None:
            return False
        past.inside(*first)
        stages = [first]
        if self.run.method == METHODS["euler"]:
            middle, last = (2 * first[0], 2 * first[1]), first
            self.x, self.S = x + h * first[0], S + h * first[1]
        else:
            for part in (0.5, 0.5, 1.0):
                d, D = stages[-1]
                found = self._rates(t + part * h, k, x + part * h * d, S + part * h * D)
                if found is None:
                    return False
                stages.append(found)
            middle = stages[1][0] + stages[2][0], stages[1][1] + stages[2][1]
            last = stages[3]
            self.x = x + h / 6 * (first[0] + 2 * middle[0] + last[0])
            self.S = S + h / 6 * (first[1] + 2 * middle[1] + last[1])
        past.end(Step(t, h, [x, first[0], middle[0], last[0]], [S, first[1], middle[1], last[1]]))
        return True
