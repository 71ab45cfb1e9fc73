"""KKT matrices of chains, and the compiled solver for them as Ipopt calls it."""

import ctypes
from ctypes import byref, c_double, c_int

import numpy as np

from symid import kkt


class Solver:
    """Analysis on creation; then `factorise` and `solve`, as often as wanted, for a dense symmetric matrix."""

    def __init__(self, matrix: np.ndarray, threads: int = 1):
        kkt.begin(threads)
        self.library = ctypes.CDLL(str(kkt.library_path()))
        self.places = np.nonzero(np.tril(matrix != 0))
        n, diagonal = len(matrix), np.arange(len(matrix))  # Ipopt gives every diagonal, again
        self.rows = np.append(self.places[0], diagonal).astype(np.int32) + 1
        self.cols = np.append(self.places[1], diagonal).astype(np.int32) + 1
        self.n, self.nz, self.info = c_int(n), c_int(len(self.rows)), np.zeros(20, np.int32)
        self.icntl, self.cntl = np.zeros(30, np.int32), np.zeros(5)
        self.iw, self.ikeep = np.zeros(16, np.int32), np.zeros(3 * n, np.int32)
        self.one, self.steps, self.widest, self.ops = c_int(16), c_int(), c_int(), c_double()
        self.library.ma27id_(_at(self.icntl), _at(self.cntl))
        self.library.ma27ad_(
            byref(self.n),
            byref(self.nz),
            _at(self.rows),
            _at(self.cols),
            _at(self.iw),
            byref(self.one),
            _at(self.ikeep),
            None,
            byref(self.steps),
            byref(c_int(0)),
            _at(self.icntl),
            _at(self.cntl),
            _at(self.info),
            byref(self.ops),
        )

    def factorise(self, matrix: np.ndarray) -> tuple[int, int]:
        """(INFO(1), number of negative eigenvalues)."""
        self.values = np.append(matrix[self.places], np.zeros(self.n.value))
        self.cntl[0] = 1e-8
        self.library.ma27bd_(
            byref(self.n),
            byref(self.nz),
            _at(self.rows),
            _at(self.cols),
            _at(self.values),
            byref(self.one),
            _at(self.iw),
            byref(self.one),
            _at(self.ikeep),
            byref(self.steps),
            byref(self.widest),
            None,
            _at(self.icntl),
            _at(self.cntl),
            _at(self.info),
        )
        return int(self.info[0]), int(self.info[14])

    def solve(self, right: np.ndarray) -> np.ndarray:
        x = right.copy()
        self.library.ma27cd_(
            byref(self.n),
            _at(self.values),
            byref(self.one),
            _at(self.iw),
            byref(self.one),
            None,
            byref(self.widest),
            _at(x),
            None,
            byref(self.steps),
            _at(self.icntl),
            _at(self.cntl),
        )
        return x


def _at(array: np.ndarray):
    return array.ctypes.data_as(ctypes.c_void_p)


def chain(
    rng: np.random.Generator,
    nodes: int,
    states: int,
    border: int = 0,
    episodes: int = 1,
    *,
    linked: bool = False,
    window: int = 1,
    step: np.ndarray | None = None,
    curvature: float = 1.0,
) -> np.ndarray:
    """[[H, A'], [A, 0]] of episodes of `nodes` with `states` each and `border` parameters.

    window : nodes that an equation reaches ahead. step : (states, states) from node to node instead of random ones.
    curvature : size of H.
    """
    block, size = nodes * states, episodes * nodes * states + border
    shared, hessian, rows = np.arange(size - border, size), np.zeros((size, size)), []
    for e in range(episodes):
        at = e * block + np.arange(block).reshape(nodes, states)
        for k in range(nodes):
            hessian[np.ix_(at[k], at[k])] = rng.normal(size=(states, states)) * rng.integers(0, 2)
            hessian[np.ix_(at[k], shared)] = rng.normal(size=(states, border))
            if k + 1 < nodes:
                row = np.zeros((states, size))
                for ahead in at[k + 2 : k + 1 + window]:
                    row[:, ahead] = rng.normal(size=(states, states))
                row[:, at[k]] = rng.normal(size=(states, states)) if step is None else -step
                row[:, at[k + 1]] = rng.normal(size=(states, states)) if step is None else np.eye(states)
                row[:, shared] = rng.normal(size=(states, border))
                rows.append(row)
        if linked and e:
            row = np.zeros((states, size))
            row[:, at[0]], row[:, at[0] - block] = np.eye(states), -np.eye(states)
            rows.append(row)
    hessian = curvature * (hessian + hessian.T + np.diag(rng.uniform(size=size)))
    equations = np.vstack([np.zeros((0, size)), *rows])
    return np.block([[hessian, equations.T], [equations, np.zeros((len(equations),) * 2)]])
