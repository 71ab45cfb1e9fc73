"""A forward simulator for any Model, with lags, sensitivities and sample corrections."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

import numpy as np

from symid.checked import nearest
from symid.codegen.build import or_numpy
from symid.codegen.kept import kept_source
from symid.codegen.ode import BETWEEN, OdeSource, ode_source
from symid.deadline import check
from symid.errors import SymidError
from symid.model import Model
from symid.recording.signals.between import CURVES, derivatives
from symid.simulation.compiled import CompiledLoop
from symid.simulation.linear import Linearised, is_singular
from symid.simulation.loop import PythonLoop
from symid.simulation.run import METHODS, Run, Signals, history_of
from symid.simulation.trajectory import Trajectory

LARGEST = 1e100
"""A state [SI] beyond this ends a run by default: no machine has it in any unit, and its square is still a number."""


class Simulator:
    """Forward simulation of one model, compiled once and cached by its equations.

    Residuals are solved for the rates at every stage and integrated by Runge-Kutta 4 (or
    explicit Euler) with fixed substeps. Inputs do between samples what they state (`Input.hold`); noise is
    constant over a sample interval, delayed states come from the run's own dense output.

    Parameters
    ----------
    model : to be simulated.
    backend : ``"c"``; ``"numpy"`` (slower, needs no compiler, same results); ``"auto"`` takes C, and
        NumPy with a `CodegenWarning` where there is no working compiler.

    Examples
    --------
    >>> run = Simulator(model).simulate({"damping": 0.3}, {"angle": 0.5, "rate": 0.0}, np.arange(0, 5, 0.01),
    ...                                 {"drive": np.zeros(500)})
    >>> bool(abs(run.states["angle"][-1]) < 0.5)
    True
    """

    def __init__(self, model: Model, backend: str = "auto"):
        self.model = model
        self.source: OdeSource = kept_source(model) if backend != "numpy" else ode_source(model)
        self._loop = or_numpy(backend, lambda: CompiledLoop(self.source), lambda: PythonLoop(ode_source(model)))
        s = self.source
        self.states, self.outputs, self.parameters = s.states, s.outputs, s.parameters
        self.constants = np.array([c.value for c in model.constants.values()], dtype=float)

    # ---- running ---------------------------------------------------------------------
    def simulate(
        self,
        parameters: Mapping[str, float] | np.ndarray,
        initial_state: Mapping[str, float] | np.ndarray,
        time: np.ndarray | Signals,
        inputs: Mapping[str, np.ndarray] | None = None,
        *,
        noise: Mapping[str, np.ndarray] | None = None,
        sensitivity: Sequence[str] = (),
        initial_sensitivity: Sequence[str] = (),
        substeps: int = 1,
        method: str = "rk4",
        history: tuple[np.ndarray, ...] | None = None,
        earlier: tuple[np.ndarray, Mapping[str, np.ndarray]] | None = None,
        gain: np.ndarray | None = None,
        recorded: np.ndarray | None = None,
        gain_slopes: np.ndarray | None = None,
        limit: float = LARGEST,
        keep: str = "all",
    ) -> Trajectory:
        """Integrate over `time` and report states and outputs at its samples.

        Parameters
        ----------
        parameters : value [SI] of every parameter, by name or as an array in declared order.
        initial_state : likewise for the states at ``time[0]``.
        time : (N,) increasing [s]; inputs and noise : name -> (N,), noise of an interval at its start.
            `signals` gives one thing in place of these and of `earlier`, for many runs.
        sensitivity, initial_sensitivity : parameters and states (initial values) to differentiate by.
        substeps : steps of the integrator per sample interval. method : ``"rk4"``, ``"euler"``, or ``"stiff"``: as
            ``"rk4"``, but steps in which something dies out faster than that can follow are implicit, of order 2, and
            those within which rates bend, as where dry friction changes its sign, are halved around it as often as
            needed (at most ten times; in a model with late signals not at all). A run whose steps would be
            halved everywhere ends.
        history : (K,) times before ``time[0]`` and (K, n) states, for delayed signals; without it
            the initial state held before the start. And (K, n, q) slopes of these by the parameters of `sensitivity`
            and the initial values of `initial_sensitivity`; without them these states do not move.
        earlier : (E,) times before ``time[0]`` and name -> (E,) inputs there, for delayed inputs; without it, and for
            names that it lacks, the first input held before the start.
        gain, recorded : (n, m) and (N, m): after each sample the state is moved by
            gain @ (recorded - y), as in an observer or Kalman filter; NaN is skipped. With
            (1 + k, n, m), what the state was 1 ... k samples before is moved too, for delayed signals.
        gain_slopes : (q + r, *gain.shape) slopes of the gain by each parameter of `sensitivity`, and by r numbers that
            nothing else depends on, whose sensitivities then come last.
        limit : a state larger than this ends the run (`Trajectory.diverged`).
        keep : ``"outputs"`` leaves out the states, ``"states"`` only their sensitivities.

        Raises
        ------
        SymidError : a value, input or name is missing, of the wrong length or not finite; or a `deadline` has passed.
        """
        check()
        signals = time if isinstance(time, Signals) else self.signals(time, inputs, noise, earlier)
        n, q, corrected, slopes = len(signals.w), len(sensitivity) + len(initial_sensitivity), gain is not None, None
        if corrected and gain_slopes is not None:
            slopes = self._slopes_of(_array(gain), _array(gain_slopes), len(sensitivity))
            slopes = np.insert(slopes, [len(sensitivity)] * len(initial_sensitivity), 0.0, axis=0)
            q, slopes = len(slopes), np.ascontiguousarray(np.moveaxis(slopes, 0, -1))
        run = Run(
            substeps,
            METHODS[method],
            limit,
            signals,
            self._vector("parameter", self.parameters, parameters),
            self.constants,
            self._vector("initial state", self.states, initial_state),
            self._indices("parameter", self.parameters, sensitivity),
            self._indices("state", self.states, initial_sensitivity),
            gain=_array(gain) if corrected else None,
            dgain=slopes,
            recorded=_array(recorded) if corrected else None,
            **history_of(history, len(self.states), len(sensitivity) + len(initial_sensitivity)),
            X=np.full((n, len(self.states)), np.nan) if keep != "outputs" else None,
            Y=np.full((n, len(self.outputs)), np.nan),
            SX=np.full((n, len(self.states), q), np.nan) if q and keep == "all" else None,
            SY=np.full((n, len(self.outputs), q), np.nan) if q else None,
        )
        reached = self._loop.simulate(run)
        if reached < 0:
            raise MemoryError(f"simulation of '{self.model.name}' over {n} samples with {q} sensitivities")
        wrt = (*sensitivity, *(f"{s}(0)" for s in initial_sensitivity))
        wrt += tuple(f"gain {i + 1}" for i in range(q - len(wrt)))
        return Trajectory(run.t, run.X, run.Y, self.states, self.outputs, wrt, run.SX, run.SY, reached, run.stiff)

    def signals(
        self,
        time: np.ndarray,
        inputs: Mapping[str, np.ndarray] | None = None,
        noise: Mapping[str, np.ndarray] | None = None,
        earlier: tuple[np.ndarray, Mapping[str, np.ndarray]] | None = None,
    ) -> Signals:
        """What `simulate` is given at its samples, checked, for many runs: in place of its `time`.

        Parameters
        ----------
        time, inputs, noise, earlier : as of `simulate`.

        Raises
        ------
        SymidError : an input or name is missing, of the wrong length or not finite, or times do not increase.
        """
        time = _array(time)
        times, n = time if earlier is None else np.concatenate([_array(earlier[0]), time]), len(time)
        if n < 2 or not np.all(np.diff(times) > 0):
            raise SymidError(
                f"simulation of '{self.model.name}': time needs at least two increasing samples, found {n}, and any "
                "earlier ones before them"
            )
        given = self._columns("input", self.source.inputs, inputs, n)
        given = given if earlier is None else np.vstack([self._before(given[0], earlier), given])
        w = self._columns("noise", self.source.noises, noise, n, missing=0.0)
        holds = [BETWEEN[k] for k in self.source.input_between]
        slopes, bends = derivatives(times, given, holds) if {*holds} & {*CURVES} else (None, None)
        return Signals(len(times) - n, times, given, slopes, bends, w)

    def batch(self, runs: Sequence[Mapping], *, threads: int = 2, **common: object) -> list[Trajectory]:
        """`simulate(**common, **run)` for every run of `runs`, on `threads`; the same numbers as a loop."""
        with ThreadPoolExecutor(threads) as pool:
            return list(pool.map(lambda run: self.simulate(**common, **run), runs))

    def linearise(
        self,
        parameters: Mapping[str, float] | np.ndarray,
        state: Mapping[str, float] | np.ndarray,
        inputs: np.ndarray | None = None,
    ) -> Linearised:
        """The model linearised at one `state` [SI array or names], or on average over (P, n) states.

        Rates, noise and `inputs` are zero unless given; late signals have the signal's own value; `parameters` as for
        `simulate`.

        Raises
        ------
        SymidError : a name or number is missing, or the mass matrix is singular there.
        """
        s = self.source
        points = np.atleast_2d(self._vector("state", self.states, state) if np.ndim(state) < 2 else _array(state))
        late_of = tuple(str(self.model.delays[_late(self.model, y)].of) for y in s.late)
        n, m, late, w = len(s.states), len(s.outputs), len(s.late), len(s.noises)
        zero, p = np.zeros(max(n, w, len(s.inputs), 1)), self._vector("parameter", self.parameters, parameters)
        u = zero if inputs is None else _array(inputs)
        at = [
            points[:, s.states.index(o)] if o in s.states else np.full(len(points), u[s.inputs.index(o)])
            for o in late_of
        ]
        at = np.ascontiguousarray(np.column_stack(at)) if at else np.zeros((len(points), 0))
        mean = [np.zeros(k) for k in ((n, n), (n, n), (n, late), (n, w), (m, n), (m, late), (late,))]
        self._loop.linearise(points, at, {"xd": zero, "u": u, "w": zero, "p": p, "c": self.constants}, mean)
        mass = mean[0]
        if not all(np.isfinite(k).all() for k in mean) or is_singular(mass):
            raise SymidError(
                f"simulation of '{self.model.name}': the rates cannot be solved for at the state "
                f"{points.mean(axis=0)}; the mass matrix is singular or not finite there"
            )
        return Linearised.from_residual(*mean, s.states, late_of)

    # ---- checking --------------------------------------------------------------------
    def _vector(self, kind: str, names: tuple[str, ...], values) -> np.ndarray:
        if isinstance(values, Mapping):
            missing = [k for k in names if k not in values]
            if missing:
                raise SymidError(
                    f"simulation of '{self.model.name}' needs a value of the {kind} {missing[0]!r}; "
                    f"{nearest(missing[0], values)}"
                )
            values = [values[k] for k in names]
        out = _array(values)
        if out.shape != (len(names),) or not np.all(np.isfinite(out)):
            raise SymidError(
                f"simulation of '{self.model.name}': {kind} must be {len(names)} finite numbers in the order "
                f"{names}, found {out}"
            )
        return out

    def _slopes_of(self, gain: np.ndarray, slopes: np.ndarray, parameters: int) -> np.ndarray:
        if slopes.shape[1:] != gain.shape or len(slopes) < parameters:
            raise SymidError(
                f"simulation of '{self.model.name}': gain_slopes must be at least {parameters} arrays of the gain's "
                f"shape {gain.shape}, one for each parameter of sensitivity first; found shape {slopes.shape}"
            )
        return slopes

    def _columns(self, kind: str, names, signals, n: int, missing: float | None = None) -> np.ndarray:
        table = np.zeros((n, max(len(names), 1)))
        for i, name in enumerate(names):
            if not signals or name not in signals:
                if missing is None:
                    raise SymidError(f"simulation of '{self.model.name}' needs the {kind} {name!r} at all {n} samples")
                continue
            column = _array(signals[name])
            if column.shape != (n,) or not np.all(np.isfinite(column)):
                raise SymidError(
                    f"simulation of '{self.model.name}': {kind} {name!r} must be {n} finite numbers, "
                    f"found shape {column.shape} with {np.sum(~np.isfinite(column))} not finite"
                )
            table[:, i] = column
        return table

    def _before(self, first: np.ndarray, earlier: tuple[np.ndarray, Mapping[str, np.ndarray]]) -> np.ndarray:
        """(E, inputs) before a run that begins with the inputs `first`."""
        held = {u: np.full(len(earlier[0]), v) for u, v in zip(self.source.inputs, first, strict=False)}
        return self._columns("input", self.source.inputs, held | dict(earlier[1]), len(earlier[0]))

    def _indices(self, kind: str, names, chosen) -> np.ndarray:
        for c in chosen:
            if c not in names:
                raise SymidError(f"simulation of '{self.model.name}' has no {kind} {c!r}; {nearest(c, names)}")
        return np.array([names.index(c) for c in chosen], dtype=np.intc)


class _Keyed:
    """A model that compares by its equations and constants, for the cache of simulators."""

    def __init__(self, model: Model):
        self.model = model
        self.key = (model.fingerprint, tuple((c.name, c.value) for c in model.constants.values()))

    def __hash__(self):
        return hash(self.key)

    def __eq__(self, other):
        return self.key == other.key


@lru_cache(maxsize=512)
def _cached(keyed: _Keyed) -> Simulator:
    return Simulator(keyed.model)


def simulator(model: Model) -> Simulator:
    """The Simulator of `model`; the same object for equal equations and constants."""
    return _cached(_Keyed(model))


def _late(model: Model, name: str):
    return next(s for s in model.delays if str(s) == name)


def _array(values) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=float)
