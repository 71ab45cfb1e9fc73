"""The order of the free vector, which nothing else knows.

episode 0: node 0 | interior 0 | own 0 | late 0 | node 1 | interior 1 | own 1 | late 1 | ... | node N
episode 1: ...
parameters

`node` has n states, then controls and algebraic variables; `interior` the scheme's interior slots (n
states each); `own` the algebraic variables at points that are no nodes; `late` the delayed signals by
point. One interval's unknowns are therefore contiguous and end with the next node, so that kernels
read the free vector itself through an overlapping view, and the optimality system is a chain with
the parameters (a free duration among them) as its border.
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
    state_scale (n,), parameter_scale (free parameters,), late_scale (L,), beside_scale, own_scale : z = value / scale.
    beside_names : controls, then algebraic variables, that stand at the nodes beside the states.
    own_names : algebraic variables at each of the `own_points` points of an interval.
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
    refine: int
    beside_names: tuple[str, ...]
    beside_scale: np.ndarray
    own_names: tuple[str, ...]
    own_scale: np.ndarray
    own_points: int

    @property
    def n(self) -> int:
        """Number of states."""
        return len(self.state_names)

    @property
    def node_names(self) -> tuple[str, ...]:
        """What a node holds: states, controls, algebraic variables."""
        return self.state_names + self.beside_names

    @property
    def node_scale(self) -> np.ndarray:
        """(width,)"""
        return np.concatenate([self.state_scale, self.beside_scale])

    @property
    def width(self) -> int:
        """Number of unknowns at a node."""
        return len(self.node_names)

    @property
    def own(self) -> int:
        """Number of algebraic unknowns of an interval that stand at no node."""
        return self.own_points * len(self.own_names)

    @property
    def late(self) -> int:
        """Number of late unknowns in an interval."""
        return self.points * len(self.late_names)

    @property
    def block(self) -> int:
        """Number of unknowns from one node to the next."""
        return self.width + self.n * self.interior + self.own + self.late

    @property
    def local(self) -> int:
        """Number of unknowns that one interval sees, both nodes included."""
        return self.block + self.width

    @property
    def offsets(self) -> np.ndarray:
        """(episodes + 1,) where each episode starts; the last is where the parameters start."""
        return np.concatenate([[0], np.cumsum([k * self.block + self.width for k in self.intervals])])

    @property
    def size(self) -> int:
        return int(self.offsets[-1]) + len(self.parameter_names)

    def local_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals, local) view into contiguous `z`: row k is all that interval k sees."""
        start, step = self.offsets[episode], z.strides[0]
        return as_strided(z[start:], (self.intervals[episode], self.local), (self.block * step, step))

    def node_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals + 1, width) view into `z`: the scaled states, controls and algebraics at the nodes."""
        start, step = self.offsets[episode], z.strides[0]
        return as_strided(z[start:], (self.intervals[episode] + 1, self.width), (self.block * step, step))

    def sample_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(samples, width) view into `z`: what stands at the nodes that are samples, scaled."""
        return self.node_view(z, episode)[:: self.refine]

    def late_view(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals, points, late signals) view into `z`."""
        start, step = self.offsets[episode] + self.block - self.late, z.strides[0]
        shape = (self.intervals[episode], self.points, len(self.late_names))
        return as_strided(z[start:], shape, (self.block * step, len(self.late_names) * step, step))

    def parameter_columns(self, episode: int) -> np.ndarray:
        """(q,) positions in z of the parameters that this episode's kernel sees."""
        return self.offsets[-1] + self.parameter_index[episode]

    def states(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals + 1, n) states at the nodes, in SI units, a copy."""
        return self.node_view(z, episode)[:, : self.n] * self.state_scale

    def nodes(self, z: np.ndarray, episode: int) -> np.ndarray:
        """(intervals + 1, width) states, controls and algebraics at the nodes, in SI units, a copy."""
        return self.node_view(z, episode) * self.node_scale

    def parameters(self, z: np.ndarray) -> np.ndarray:
        """(free parameters,) in SI units, a copy."""
        return z[self.offsets[-1] :] * self.parameter_scale

    def fill(self, nodes: list[np.ndarray], parameters: np.ndarray) -> np.ndarray:
        """A free vector with these values (nodes x n or width, SI) for each episode and these parameters (SI).

        Controls and algebraics that are not given are zero. Interior slots get the increment from node to node,
        algebraics at points the mean of the nodes; late signals are left at zero.
        """
        z = np.zeros(self.size)
        for e, x in enumerate(nodes):
            self.node_view(z, e)[:, : x.shape[1]] = x / self.node_scale[: x.shape[1]]
            at_nodes, local = self.node_view(z, e), self.local_view(z, e)
            first, end = self.width, self.width + self.n * self.interior
            local[:, first:end] = np.tile(np.diff(at_nodes[:, : self.n], axis=0), self.interior)
            if self.own and set(self.own_names) <= set(self.beside_names):
                own = at_nodes[:, self.width - len(self.own_names) :]
                local[:, end : end + self.own] = np.tile(0.5 * (own[:-1] + own[1:]), self.own_points)
        z[self.offsets[-1] :] = parameters / self.parameter_scale
        return z

    def spread(self, nodes: np.ndarray, own: np.ndarray, parameters: np.ndarray, other: float) -> np.ndarray:
        """A free vector, one value (SI) for all that a node holds, algebraic at points, per parameter, and `other`."""
        z = np.full(self.size, other)
        for e in range(len(self.intervals)):
            end = self.block - self.late
            self.local_view(z, e)[:, end - self.own : end] = np.tile(own / self.own_scale, self.own_points)
            self.node_view(z, e)[:] = nodes / self.node_scale
        z[self.offsets[-1] :] = parameters / self.parameter_scale
        return z

    def kind(self, name: str) -> str:
        return "state" if name in self.state_names else "algebraic" if name in self.own_names else "control"

    def describe(self, i: int) -> str:
        """What entry `i` of the free vector is, in words."""
        if i >= self.offsets[-1]:
            return f"parameter {self.parameter_names[i - self.offsets[-1]]}"
        episode = int(np.searchsorted(self.offsets, i, side="right")) - 1
        node, place = divmod(i - int(self.offsets[episode]), self.block)
        if place < self.width:
            name = self.node_names[place]
            return f"{self.kind(name)} {name} at node {node} of episode {episode + 1}"
        place -= self.width
        where = f"in interval {node} of episode {episode + 1}"
        if place < self.n * self.interior:
            return f"increment of state {self.state_names[place % self.n]} {where}"
        place -= self.n * self.interior
        if place < self.own:
            return f"algebraic {self.own_names[place % len(self.own_names)]} {where}"
        return f"late signal {self.late_names[(place - self.own) % len(self.late_names)]} {where}"
