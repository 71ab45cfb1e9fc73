"""The order of the free vector, which nothing else knows.

episode 0: node 0 | interior 0 | late 0 | node 1 | interior 1 | late 1 | ... | node N
episode 1: ...
parameters

`node` has n states, `interior` the scheme's interior slots (n states each), `late` the delayed
signals by point. One interval's unknowns are therefore contiguous and end with the next node,
so that kernels read the free vector itself through an overlapping view.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import as_strided


@dataclass(frozen=True, eq=False)
class Layout:
    """Where everything stands in the free vector z, and in which scale.

    Parameters
    ----------
    state_names, parameter_names, late_names : names in the order of the kernel's symbols.
        `parameter_names` has one entry per *free* parameter: a parameter that differs between
        recordings appears once for each, as ``name[recording]``.
    interior, points : of the scheme's stencil.
    intervals : number of collocation intervals of each episode.
    refine : collocation intervals in a sample interval: every `refine`-th node is a sample.
    parameter_index : (episodes, q) which free parameter each kernel parameter is.
    state_scale (n,), parameter_scale (free parameters,), late_scale (L,) : z = value / scale.
    """

    state_names: tuple[str, ...]
    parameter_names: tuple[str, ...]
    late_names: tuple[str, ...]
    interior: int
    points: int
    intervals: tuple[int, ...]
    parameter_index: np.ndarray
    state_scale: np.ndarray
    parameter_scale: np.ndarray
    late_scale: np.ndarray
    refine: int = 1

    @property
    def n(self) -> int:
        """Number of states."""
        return len(self.state_names)

    @property
    def late(self) -> int:
        """Number of late unknowns in an interval."""
        return self.points * len(self.late_names)

    @property
    def block(self) -> int:
        """Number of unknowns from one node to the next."""
        return self.n * (1 + self.interior) + self.late

    @property
    def local(self) -> int:
        """Number of unknowns that one interval sees, both nodes included."""
        return self.block + self.n

    @property
    def offsets(self) -> np.ndarray:
        """(episodes + 1,) where each episode starts; the last is where the parameters start."""
        return np.concatenate([[0], np.cumsum([k * self.block + self.n for k in self.intervals])])

    @property
    def size(self) -> int:
        return int(self.offsets[-1]) + len(self.parameter_names)

    def local_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals, local) view into contiguous `z`: row k is all that interval k sees."""
        start, step = self.offsets[episode], z.strides[0]
        return as_strided(z[start:], (self.intervals[episode], self.local), (self.block * step, step))

    def node_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals + 1, n) view into `z`: the scaled states at the nodes."""
        start, step = self.offsets[episode], z.strides[0]
        return as_strided(z[start:], (self.intervals[episode] + 1, self.n), (self.block * step, step))

    def sample_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(samples, n) view into `z`: the scaled states at the nodes that are samples."""
        return self.node_view(z, episode)[::self.refine]

    def late_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals, points, late signals) view into `z`."""
        start, step = self.offsets[episode] + self.n * (1 + self.interior), z.strides[0]
        shape = (self.intervals[episode], self.points, len(self.late_names))
        return as_strided(z[start:], shape, (self.block * step, len(self.late_names) * step, step))

    def parameter_columns(self, episode: int) -> np.ndarray:
        """(q,) positions in z of the parameters that this episode's kernel sees."""
        return self.offsets[-1] + self.parameter_index[episode]

    def states(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals + 1, n) states at the nodes, in SI units, a copy."""
        return self.node_view(z, episode) * self.state_scale

    def parameters(self, z: np.ndarray) -> np.ndarray:
        """(free parameters,) in SI units, a copy."""
        return z[self.offsets[-1]:] * self.parameter_scale

    def fill(self, states: list[np.ndarray], parameters: np.ndarray) -> np.ndarray:
        """A free vector with these states (nodes x n, SI) for each episode and these parameters (SI).

        Interior slots get the increment from node to node; late signals are left at zero.
        """
        z = np.zeros(self.size)
        for e, x in enumerate(states):
            self.node_view(z, e)[:] = x / self.state_scale
            inner = self.local_view(z, e)[:, self.n:self.n * (1 + self.interior)]
            inner[:] = np.tile(np.diff(x, axis=0) / self.state_scale, self.interior)
        z[self.offsets[-1]:] = parameters / self.parameter_scale
        return z

    def spread(self, states: np.ndarray, parameters: np.ndarray, other: float) -> np.ndarray:
        """A free vector with one value (SI) per state at all nodes, per parameter, and `other` elsewhere."""
        z = np.full(self.size, other)
        for e in range(len(self.intervals)):
            self.node_view(z, e)[:] = states / self.state_scale
        z[self.offsets[-1]:] = parameters / self.parameter_scale
        return z

    def describe(self, i: int) -> str:
        """What entry `i` of the free vector is, in words."""
        if i >= self.offsets[-1]:
            return f"parameter {self.parameter_names[i - self.offsets[-1]]}"
        episode = int(np.searchsorted(self.offsets, i, side="right")) - 1
        node, place = divmod(i - int(self.offsets[episode]), self.block)
        slot, state = divmod(place, self.n)
        if slot == 0:
            return f"state {self.state_names[state]} at node {node} of episode {episode + 1}"
        if slot <= self.interior:
            return f"increment of state {self.state_names[state]} in interval {node} of episode {episode + 1}"
        name = self.late_names[(place - self.n * (1 + self.interior)) % len(self.late_names)]
        return f"late signal {name} in interval {node} of episode {episode + 1}"
