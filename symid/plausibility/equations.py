"""A model's equations at the recorded motion: recorded rates less those that they predict, and derivatives of these."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from symid.codegen import compile_program
from symid.codegen.equations.balance import balance_program
from symid.codegen.equations.rates import late_of
from symid.model import Model, shown_states
from symid.plausibility.motion import Motion, low_pass
from symid.units import FloatArray

EDGE = 5
"""Samples at each end of a piece that are left out, where a filter has not settled."""
PLACES = (0.02, 0.1, 0.4)
"""Shares of the range between their bounds, far from each other, at which parameters are tried."""
FLOOR = 1e-12
"""Least relative spread of errors in any direction, for accelerations that are always alike."""
FEW = 5
"""Samples that tell whether masses or slopes depend on the parameters."""


@dataclass(frozen=True)
class Change:
    """What is done to a recording or to a body before it is put into the equations.

    Parameters
    ----------
    said : the mistake that this would undo, as a clause.
    factors : channel or constant -> factor. time : factor of the times. swapped : two outputs or two inputs, exchanged.
    """

    said: str = ""
    factors: Mapping[str, float] = field(default_factory=dict)
    time: float = 1.0
    swapped: tuple[str, str] | None = None

    @property
    def is_of_sign(self) -> bool:
        """Whether numbers keep their sizes: a sign, or two columns."""
        return self.swapped is not None or (self.time == 1.0 and all(f == -1.0 for f in self.factors.values()))


AS_RECORDED = Change()


class RecordedEquations:
    """The equations 0 = f(x', x, u, p) of a model, with the rates, states and inputs that were recorded.

    Parameters
    ----------
    law_open : as of a `Witness`.
    """

    def __init__(self, model: Model, motion: Motion, law_open: bool = False):
        self.model, self.motion, self.open = model, motion, None
        self.kernel = compile_program(balance_program(model), backend="numpy")
        parameters = model.parameters.values()
        self.lower, self.upper = (np.array([p.bounds[i] for p in parameters], dtype=float) for i in (0, 1))
        self.shown, self.rates = shown_states(model), model.rates()
        self.order = [int(self.rates.get(s) in self.shown) for s in model.states]  # 1: the rate of a recorded state
        # The others are kinematic.
        self.explained = [i for i, s in enumerate(model.states) if s not in self.rates.values()]
        self.steady = self.alike("mass")
        if law_open:
            shown = [c[order] for c in motion.curves.values() for order in (0, 1)]
            self.open, _ = np.linalg.qr(self._filtered(np.column_stack([np.ones(motion.time.size), *shown])))

    def given(self, change: Change, p: FloatArray):
        """Arguments of the kernel and sizes of the accelerations, and the covariance of these in their sizes; they
        depend on the parameters by lags alone."""
        local, data, constants = self._arguments(change, p)
        accelerations = self._filtered(local[:, : len(self.order)][:, self.explained])
        size = np.std(accelerations, axis=0)
        inverse = self._inverse_mass(local, p, data, constants) if self.steady else None
        return (local, data, constants, size, inverse), covariance((accelerations - accelerations.mean(axis=0)) / size)

    def errors(self, given, p: FloatArray) -> FloatArray:
        """(N, accelerations) recorded less predicted ones, in their sizes, filtered."""
        return self._filtered(self._missed(given, p)[0][:, self.explained] / given[3])

    def _inverse_mass(self, local, p, data, constants) -> FloatArray:
        return np.linalg.inv(self._slopes(local, p, data, constants, slice(0, len(self.order))))

    def _missed(self, given, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(N, states) recorded rates less predicted ones, and (N, states, equations) inverse masses."""
        local, data, constants, _, inverse = given
        if inverse is None:
            inverse = self._inverse_mass(local, p, data, constants)
        return (inverse @ self.kernel.residual(local, p, data, constants)[:, :, None])[:, :, 0], inverse

    def linearised(self, given, p: FloatArray) -> tuple[FloatArray, FloatArray]:
        """`errors` and their derivatives (N, accelerations, parameters): the residual's at the predicted rates."""
        local, data, constants, size, _ = given
        missed, inverse = self._missed(given, p)
        there = local.copy()
        there[:, : len(self.order)] -= missed
        slopes = self._slopes(there, p, data, constants, slice(self.kernel.n_local, None))
        both = np.concatenate([missed[:, :, None], inverse @ slopes], axis=2)[:, self.explained] / size[:, None]
        filtered = self._filtered(both)
        return filtered[:, :, 0], filtered[:, :, 1:]

    def alike(self, which: str) -> bool:
        """Whether masses, or slopes by the parameters, are the same whatever the parameters are."""
        one, other = self.few(which, self._within(PLACES[0]))
        return bool(np.allclose(one, other, rtol=1e-9, atol=1e-12 * np.abs(one).max(initial=0.0)))

    def _within(self, part: float) -> FloatArray:
        reach = np.where(np.isfinite(self.upper - self.lower), self.upper - self.lower, 1.0)
        return np.where(np.isfinite(self.lower), self.lower, 0.0) + part * reach

    def few(self, which: str, p: FloatArray) -> list[FloatArray]:
        """Masses, or slopes by the parameters, of a few samples: at `p`, and far within the bounds."""
        columns = slice(0, len(self.order)) if which == "mass" else slice(self.kernel.n_local, None)
        local, data, constants = (x[:FEW] if np.ndim(x) == 2 else x for x in self._arguments(AS_RECORDED, p))
        return [self._slopes(local, q, data, constants, columns) for q in (p, self._within(PLACES[-1]))]

    def _arguments(self, change: Change, p: FloatArray):
        """Local values, data and constants of the kernel, with the change made."""
        motion, names, curves = self.motion, list(self.model.states), dict(self.motion.curves)
        of_inputs = {u.channel: motion.inputs[u.channel] for u in self.model.inputs.values()}
        if change.swapped:
            a, b = change.swapped
            for table in (curves, of_inputs):
                if a in table:
                    table[a], table[b] = table[b], table[a]
        states, slopes = np.empty((motion.time.size, len(names))), np.empty((motion.time.size, len(names)))
        for i, name in enumerate(names):
            order = self.order[i]
            channel = self.shown[self.rates[name]] if order else self.shown[name]
            factor = change.factors.get(channel, 1.0) / change.time**order
            states[:, i], slopes[:, i] = (
                curves[channel][order] * factor,
                curves[channel][order + 1] * factor / change.time,
            )
        inputs = {u.name: of_inputs[u.channel] * change.factors.get(u.channel, 1.0) for u in self.model.inputs.values()}
        time = motion.time * change.time
        data = np.zeros((time.size, len(inputs) + len(self.model.noises) + 1))
        data[:, : len(inputs)], data[:, -1] = np.column_stack([*inputs.values()]) if inputs else 0.0, time
        values = dict(zip(self.model.parameters, p, strict=True))
        signals = dict(zip(names, states.T, strict=True)) | inputs
        late = [np.interp(time - lag, time, signals[of]) for of, lag in late_of(self.model, values)]
        local = np.column_stack([slopes, states, *late])
        constants = np.array(
            [c.value * change.factors.get(c.name, 1.0) for c in self.model.constants.values()], dtype=float
        )
        return np.ascontiguousarray(local), data, constants

    def _slopes(self, local, p, data, constants, which: slice) -> FloatArray:
        """(N, equations, columns) derivatives of the residuals by some of the columns."""
        kernel = self.kernel
        dense = np.zeros((len(local), kernel.m, kernel.n_local + kernel.n_shared))
        dense[:, kernel.jacobian_rows, kernel.jacobian_cols] = kernel.jacobian(local, p, data, constants)
        return dense[:, :, which]

    def _filtered(self, x: FloatArray) -> FloatArray:
        m = self.motion
        left = np.concatenate([low_pass(x[p], m.band, m.step)[EDGE:-EDGE] for p in m.pieces])
        if self.open is None:
            return left
        rows = left.reshape(len(left), -1)
        return (rows - self.open @ (self.open.T @ rows)).reshape(left.shape)


def covariance(errors: FloatArray) -> FloatArray:
    """(m, m) mean product of the columns of errors (N, m), none of whose combinations is quite zero."""
    product = errors.T @ errors / len(errors)
    return product + FLOOR * np.trace(product) * np.eye(len(product))
