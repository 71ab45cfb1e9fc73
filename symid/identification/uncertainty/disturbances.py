"""Estimated disturbances beside the errors of the outputs: what a solution leaves of both, and what noise would leave.

A smooth Control and process noise are penalised by squares. For the optimum their rates, or they themselves, are
therefore further outputs of which zero was recorded: the estimate is that of least squares for both kinds of errors
together (mixed model: Henderson 1975; Robinson 1991), and what is left of both together is one projection of the noise
in both together. The residual of the outputs alone is that of a smoother, which is correlated in time if the noise is
white, most of all where the control follows everything slow. A Control without penalty has no such output; it follows
what it can.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from symid.identification.uncertainty.sensitivity import Reduced
from symid.model import Model
from symid.transcription import Transcription


def penalised(model: Model) -> list[str]:
    """Disturbances that the objective pulls to zero: smooth controls by their rates, and process noise."""
    return [name for name, u in model.controls.items() if u.smooth or name in model.processes]


@dataclass(frozen=True, eq=False)
class Disturbances:
    """What is left of outputs and penalised disturbances; `inverse` of half the objective's curvature (q, q).

    Channels are outputs, then disturbances: the mean over a sample interval of a control's rate or of process noise,
    times the root of the interval over the mean one, so that white noise of all of them has one size. None belongs to
    a recording's last sample.
    """

    reduced: Reduced
    inverse: np.ndarray

    @property
    def t(self) -> Transcription:
        return self.reduced.s.t

    @cached_property
    def names(self) -> list[str]:
        return penalised(self.t.model)

    @cached_property
    def rows(self) -> scipy.sparse.csr_matrix:
        """Derivatives of the disturbances to the free vector, which are the disturbances themselves: rows by episode,
        sample and name."""
        t, layout, blocks = self.t, self.t.layout, []
        index = np.arange(layout.size)
        for e, r in enumerate(t.recording_of):
            m, nodes = t.measured[r], layout.node_view(index, e)
            root = np.sqrt(m.steps / m.step)
            entries = []
            for place, name in enumerate(self.names):
                column = layout.node_names.index(name)
                at, scale = nodes[:, column], layout.node_scale[column]
                row = place + len(self.names) * np.arange(m.intervals)
                if name in t.model.processes:
                    inside = at[:-1].reshape(m.intervals, layout.refine)
                    entries += [(row, inside[:, k], scale / layout.refine * root) for k in range(layout.refine)]
                else:
                    ends, rate = at[:: layout.refine], scale * root / m.steps
                    entries += [(row, ends[1:], rate), (row, ends[:-1], -rate)]
            rows, columns, values = (np.concatenate(x) for x in zip(*entries, strict=True)) if entries else ([], [], [])
            shape = ((m.intervals + 1) * len(self.names), layout.size)
            blocks.append(scipy.sparse.coo_matrix((values, (rows, columns)), shape=shape))
        return scipy.sparse.vstack(blocks).tocsr()

    @cached_property
    def weights(self) -> list[np.ndarray]:
        """Per recording (d,) of the squares in the objective."""
        t = self.t
        own = [
            t.information / t.model[name].size ** 2 if name in t.model.processes else t.cost * t.model[name].smooth
            for name in self.names
        ]
        return [m.step * np.array(own) for m in t.measured]

    @property
    def known(self) -> list[np.ndarray]:
        """Per recording (d,) standard deviations, those of process noise; NaN where unknown."""
        sizes = np.array([getattr(self.t.model[name], "size", np.nan) for name in self.names], dtype=float)
        return [sizes / np.sqrt(m.step) for m in self.t.measured]

    @cached_property
    def prior(self) -> np.ndarray:
        """(q, q) `reduced.prior` without process noise, which is a channel here."""
        r, t = self.reduced, self.t
        own = np.array([name in t.model.processes for name in self.names])
        rooted = (
            np.sqrt(np.tile(own, len(self._row_weights) // max(len(own), 1)) * self._row_weights)[:, None]
            * self._follow
        )
        return r.prior - rooted.T @ rooted

    @cached_property
    def present(self) -> list[np.ndarray]:
        """Per recording (K + 1, m + d) whether there is such an error."""
        return [
            np.concatenate(
                [np.isfinite(m.recorded), np.arange(m.intervals + 1)[:, None] < [m.intervals] * len(self.names)], axis=1
            )
            for m in self.t.measured
        ]

    @cached_property
    def error(self) -> list[np.ndarray]:
        """Per recording (K + 1, m + d) of the outputs, and the disturbances, means over episodes [SI]."""
        s = self.reduced.s
        return [x[:, :, 0] for x in self._together(np.concatenate(s.pulls).reshape(-1, 1), self.rows @ s.z[:, None])]

    @cached_property
    def slopes(self) -> list[np.ndarray]:
        """Per recording (K + 1, m + d, q) by the parameters, means over episodes."""
        return self._together(self.reduced.slopes, self._follow)

    @cached_property
    def influences(self) -> list[np.ndarray]:
        """Per recording (K + 1, m + d, q) of errors on the parameters."""
        r = self.reduced
        pulls = self._together(r.s.weights[:, None] * r.slopes, self._row_weights[:, None] * self._follow, np.sum)
        return [g @ self.inverse for g in pulls]

    def left(self, noise: list[np.ndarray]) -> list[np.ndarray]:
        """Per recording (K + 1, m + d, number), the same in all episodes -> what the solution leaves of it."""
        s, r, t = self.reduced.s, self.reduced, self.t
        m, number = len(t.model.outputs), noise[0].shape[2]
        outputs, rows = (
            np.concatenate([noise[of][:, part].reshape(-1, number) for of in t.recording_of])
            for part in (slice(None, m), slice(m, None))
        )
        pull = s.outputs.T @ (s.curvatures[:, None] * outputs) + self.rows.T @ (self._row_weights[:, None] * rows)
        inner = np.vstack([pull[r.states] / t.program.objective_scale, np.zeros((s.constraints.shape[0], number))])
        step = np.zeros_like(pull)
        step[r.parameters] = self.inverse @ (pull[r.parameters] + r.follow.T @ pull[r.states])
        step[r.states] = r.factor.solve(inner)[: len(r.states)] + r.follow @ step[r.parameters]
        left = self._together(outputs - s.outputs @ step, rows - self.rows @ step)
        return [x * there[:, :, None] for x, there in zip(left, self.present, strict=True)]

    @cached_property
    def _follow(self) -> np.ndarray:
        """(rows, q) disturbances by the parameters."""
        r = self.reduced
        return self.rows[:, r.states] @ r.follow if self.names else np.zeros((0, r.follow.shape[1]))

    @cached_property
    def _row_weights(self) -> np.ndarray:
        return np.concatenate([np.tile(self.weights[r], self.t.measured[r].intervals + 1) for r in self.t.recording_of])

    def _together(self, outputs: np.ndarray, rows: np.ndarray, over=np.mean) -> list[np.ndarray]:
        """Rows of outputs and of disturbances (rows, q) -> per recording (K + 1, m + d, q), over its episodes."""
        s, d = self.reduced.s, len(self.names)
        pairs = zip(s.by_recording(outputs, over), s.by_recording(rows, over, d), strict=True)
        return [np.concatenate(pair, axis=1) for pair in pairs]
