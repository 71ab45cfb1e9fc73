"""The integrating loop in Python, where there is no C compiler: the same steps as `loop.c`, some hundred times slower.

Sensitivities S = dx/dq obey M S' = -(r_x S + r_late S_late + r_p), as there; late signals are read from
the stored steps (`past.py`).
"""

from __future__ import annotations

import numpy as np

from symid.codegen.ode import OdeSource
from symid.simulation.past import Past, Step
from symid.simulation.run import METHODS, Run
from symid.simulation.step_errors import UNEQUAL, UNSEEN, StepErrors

FAST, GAMMA, EVEN, HALVINGS = 2.0, 1 - 2**-0.5, 0.5, 10
SMOOTH = 6.0, 50.0
CUTS_A_STEP, MOST_CUTS = 30, 2000
"""Of stiff steps, as in `steps.c`."""
Rates = tuple[np.ndarray, np.ndarray]
"""(n,) of the state and (n, nq) of its sensitivities."""
Stages = tuple[Rates, Rates, Rates]
"""At the start, twice those in the middle, and at the end."""
Halves = tuple[bool, bool]
"""Of a step that is to be cut: whether the rates bend in each."""
BOTH: Halves = (True, True)


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

    def linearise(self, points: np.ndarray, late: np.ndarray, rest: dict[str, np.ndarray], out: list[np.ndarray]):
        """As `CompiledLoop.linearise`."""
        n = len(self.source.states)
        for x, at in zip(points, late, strict=True):
            call = (rest["xd"], x, at, rest["u"], rest["w"], rest["p"], rest["c"], 0.0)
            with np.errstate(all="ignore"):
                slopes, observed = self.slopes("slopes", call), self.slopes("observe_slopes", call)
                values = (
                    self.functions["mass"](*call)[0].reshape(n, n),
                    slopes["x"],
                    slopes["l"],
                    slopes["w"],
                    observed["x"],
                    observed["l"],
                    self.functions["lags"](*call)[0],
                )
                for mean, value in zip(out, values, strict=True):
                    mean += np.asarray(value) / len(points)

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
        self.errors, self.still = StepErrors(len(run.x0)), np.zeros(len(run.x0))
        self.begun = self.cuts = 0
        zero = np.zeros(max(loop.sizes["x"], 1))
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
            h, halvings = (run.t[k + 1] - run.t[k]) / run.substeps, 0 if len(self.loop.source.late) else HALVINGS
            for s in range(run.substeps):
                self.begun += 1
                if not self._step(run.t[k] + s * h, h, k, halvings, False):
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

    def _rates(self, t: float, k: int, x: np.ndarray, S: np.ndarray | None) -> Rates | None:
        """Rates of x and, unless None, of S; None where the mass matrix is singular."""
        run, n = self.run, len(x)
        u, _ = self.past.inputs_at(t, k)
        late, lS = self.past.late_at(t, k, x, self.S if S is None else S)
        given = (late, u, run.w[k], run.p, run.c, t)
        M, force = self.functions["mass"](self.still, x, *given)
        try:
            M = M.reshape(n, n)
            xd = np.linalg.solve(M, -force)
            if S is None or not run.nq:
                return xd, self.S
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
        if self.run.dgain is not None:
            slopes = self.run.dgain if self.run.gain.ndim == 2 else self.run.dgain[0]
            self.S = self.S + e @ slopes
        if self.run.npast and known.any():
            self.past.correct(self.run.t[k], self.run.t[k + 1] - self.run.t[k], e, Sy)

    def _step(self, t: float, h: float, k: int, halvings: int, bend: bool) -> bool:
        """One step of the integrator from t, which may be halved so often; False where a matrix is singular, or too
        many steps were cut.

        bend : whether the rates bend in it.
        """
        x, S, past = self.x, self.S, self.past
        past.begin(t, h, x, S)
        found = self._rates(t, k, x, S)
        if found is None:
            return False
        past.inside(*found)
        self.errors.size = np.maximum(self.errors.size, np.maximum(np.abs(x), h * np.abs(found[0])))
        try:
            stages = self._stages(t, h, k, found, halvings, bend)
        except np.linalg.LinAlgError:
            return False
        if len(stages) == 2:
            self.cuts += 1
            if self.cuts > MOST_CUTS + CUTS_A_STEP * self.begun:
                return False
            halves = ((t, stages[0]), (t + h / 2, stages[1]))
            return all(self._step(start, h / 2, k, halvings - 1, bends) for start, bends in halves)
        first, middle, last = stages
        self.x = x + h / 6 * (first[0] + 2 * middle[0] + last[0])
        self.S = S + h / 6 * (first[1] + 2 * middle[1] + last[1])
        past.end(Step(t, h, [x, first[0], middle[0], last[0]], [S, first[1], middle[1], last[1]]))
        return True

    def _stages(self, t: float, h: float, k: int, first: Rates, halvings: int, bend: bool) -> Stages | Halves:
        """Rates at the start, twice those in the middle, and at the end; halves where the step is to be cut."""
        method = self.run.method
        if method == METHODS["euler"]:
            return _straight(first)
        A = self._derivative(t, k, self.x, self.S, first) if method == METHODS["stiff"] else None
        if A is not None and -np.trace(A) * h > FAST:
            return self._implicit(t, h, k, A, first, halvings)
        stages, fast = [first], A
        for part in (0.5, 0.5, 1.0):
            x, S = self.x + part * h * stages[-1][0], self.S + part * h * stages[-1][1]
            stages.append(self._found(t + part * h, k, x, S))
            if A is not None:
                fast = min(fast, self._derivative(t + part * h, k, x, S, stages[-1]), key=np.trace)
        if A is not None and -np.trace(fast) * h > FAST:
            self.run.stiff += 1
            return BOTH if halvings else self._implicit(t, h, k, fast, first, 0)
        middle = stages[1][0] + stages[2][0], stages[1][1] + stages[2][1]
        end = self.x + h / 6 * (first[0] + 2 * middle[0] + stages[3][0])
        bends = self._bends(t, h, k, end, halvings, bend) if A is not None and halvings else None
        return bends or (first, middle, stages[3])

    def _bends(self, t: float, h: float, k: int, end: np.ndarray, halvings: int, bend: bool) -> Halves | None:
        """In which halves of an explicit step to `end` the rates bend so that it errs; both, in a known `bend`."""
        error, middle = self._error(t, h, k, self.x, end)
        whole, uncut, found = self.errors.largest(error), halvings == HALVINGS, None
        expected, sudden = uncut and self.errors.as_before(h, error), uncut and self.errors.is_sudden(whole)
        if whole > UNSEEN and (bend or sudden):
            found = BOTH
        elif whole > UNSEEN and not expected:
            end = self._state(t + h / 2, h / 2, k, middle)
            first = self.errors.largest(self._error(t, h / 2, k, self.x, middle)[0])
            second = self.errors.largest(self._error(t + h / 2, h / 2, k, middle, end)[0])
            if first > UNEQUAL * second or second > UNEQUAL * first:
                found = first > UNEQUAL * second, second > UNEQUAL * first
            elif not SMOOTH[0] * (first + second) < whole < SMOOTH[1] * (first + second):
                found = BOTH
        if found:
            self.errors.smooth = []
        return found

    def _error(self, t: float, h: float, k: int, x: np.ndarray, end: np.ndarray) -> Rates:
        """What a step from x to `end` errs by, and where its first half ends."""
        middle = self._state(t, h / 2, k, x)
        return self._state(t + h / 2, h / 2, k, middle) - end, middle

    def _state(self, t: float, h: float, k: int, x: np.ndarray) -> np.ndarray:
        """The state alone, one step of Runge-Kutta 4 after x."""
        k1 = self._found(t, k, x, None)[0]
        k2 = self._found(t + h / 2, k, x + h / 2 * k1, None)[0]
        k3 = self._found(t + h / 2, k, x + h / 2 * k2, None)[0]
        k4 = self._found(t + h, k, x + h * k3, None)[0]
        return x + h / 6 * (k1 + 2 * (k2 + k3) + k4)

    def _found(self, t: float, k: int, x: np.ndarray, S: np.ndarray | None) -> Rates:
        """`_rates`; LinAlgError where the mass matrix is singular."""
        found = self._rates(t, k, x, S)
        if found is None:
            raise np.linalg.LinAlgError
        return found

    def _derivative(self, t: float, k: int, x: np.ndarray, S: np.ndarray, rates: Rates) -> np.ndarray:
        """(n, n) of the rates by the state."""
        u, _ = self.past.inputs_at(t, k)
        late, _ = self.past.late_at(t, k, x, S)
        call = (rates[0], x, late, u, self.run.w[k], self.run.p, self.run.c, t)
        M, _ = self.functions["mass"](*call)
        return -np.linalg.solve(M.reshape(len(x), len(x)), self.loop.slopes("slopes", call)["x"])

    def _implicit(self, t: float, h: float, k: int, A: np.ndarray, first: Rates, halvings: int) -> Stages | Halves:
        """Stages of ROS2, or, where its matrix changes much, of the linearly implicit Euler method or halves."""
        self.run.stiff += 1
        W = np.linalg.inv(np.eye(len(A)) - GAMMA * h * A)
        g = GAMMA * (self._found(t + h, k, self.x, self.S)[0] - first[0])
        d = W @ (first[0] + g)
        x = self.x + h * d
        G = GAMMA * (self._found(t + h, k, x, self.S)[1] - first[1])
        D = W @ (first[1] + G)
        S = self.S + h * D
        found = self._found(t + h, k, x, S)
        before, after = -np.trace(A), -np.trace(self._derivative(t + h, k, x, S, found))
        if not (after > EVEN * before and before > EVEN * after):
            return BOTH if halvings else self._damped(t + h, h, k, A)
        return _straight((1.5 * d + 0.5 * W @ (found[0] - 2 * d - g), 1.5 * D + 0.5 * W @ (found[1] - 2 * D - G)))

    def _damped(self, t: float, h: float, k: int, A: np.ndarray) -> Stages:
        """Stages of a step of the linearly implicit Euler method, which forgets what is fast for good."""
        W, (d, D) = np.linalg.inv(np.eye(len(A)) - h * A), self._found(t, k, self.x, self.S)
        return _straight((W @ d, W @ D))


def _straight(rates: Rates) -> Stages:
    """The stages of a step along a straight line."""
    return rates, (2 * rates[0], 2 * rates[1]), rates
