"""How outputs and estimates depend on parameters, initial states and samples at a solution, to first order."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy

from symid.codegen import compile_program
from symid.codegen.equations.interval import output_program
from symid.errors import SolveError
from symid.transcription import Transcription

DAMPING = 1e-11
"""Curvature, relative to the largest, added to every state in units of its motion (or of its scale, if that is larger):
an unobserved one would make the system singular."""
ROUNDS = 3
"""Turns in which the damping is about the last answer and not about zero, so that none of it is left (proximal point:
Rockafellar 1976). With it four parameters of a motor seemed determined, of which its speed shows three combinations."""
ACTIVE = 1e-8
"""Multiplier of an inequality from which on it counts as one that holds, as for bounds."""
PROBES = 2
"""Random right-hand sides beyond the expected rank with which a range is found (Halko, Martinsson & Tropp 2011)."""


def output_arguments(t: Transcription, z: np.ndarray, e: int) -> tuple[np.ndarray, ...]:
    layout, node = t.layout, t.program.data[e].node
    return (
        np.ascontiguousarray(layout.sample_view(z, e)),
        z[layout.parameter_columns(e)],
        np.ascontiguousarray(node[:, : node.shape[1] - len(t.model.outputs)]),
        t.program.error_constants,
    )


def outputs_and_targets(t: Transcription, z: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Per episode the model's outputs and the recorded ones, (samples, m) each, SI; NaN where none was recorded."""
    kernel = compile_program(output_program(t.model), backend="numpy")
    return [(kernel.residual(*output_arguments(t, z, e)), t.measured[r].recorded) for e, r in enumerate(t.recording_of)]


def sample_counts(t: Transcription) -> list[int]:
    """Samples of each episode."""
    return [t.measured[r].intervals + 1 for r in t.recording_of]


def output_jacobian(t: Transcription, z: np.ndarray) -> scipy.sparse.csr_matrix:
    """Derivatives of all outputs to the free vector: rows by episode, sample and output."""
    kernel, layout = compile_program(output_program(t.model), backend="numpy"), t.layout
    rows, columns, values, first = [], [], [], 0
    for e, samples in enumerate(sample_counts(t)):
        places = np.hstack(
            [
                layout.sample_view(np.arange(layout.size), e),
                np.broadcast_to(layout.parameter_columns(e), (samples, kernel.n_shared)),
            ]
        )
        rows.append((first + kernel.m * np.arange(samples)[:, None] + kernel.jacobian_rows).ravel())
        columns.append(places[:, kernel.jacobian_cols].ravel())
        values.append(kernel.jacobian(*output_arguments(t, z, e)).ravel())
        first += kernel.m * samples
    values, rows, columns = map(np.concatenate, (values, rows, columns))
    return scipy.sparse.coo_matrix((values, (rows, columns)), shape=(first, layout.size)).tocsr()


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """A solution, linearised: the program's constraints hold, unknowns at a bound stay there.

    Parameters
    ----------
    z, multipliers : the solution. fixed : (n,) whether an unknown stays where it is.
    penalty : curvature that a ridge adds to the objective for each scaled parameter, halved.
    loss : output name -> width of a robust loss [SI].
    """

    t: Transcription
    z: np.ndarray
    multipliers: np.ndarray
    fixed: np.ndarray
    penalty: float = 0.0
    loss: dict[str, float] = field(default_factory=dict)

    @cached_property
    def columns(self) -> tuple[np.ndarray, np.ndarray]:
        """Places in z of the free states (and other unknowns over time), and of the free parameters."""
        keep, first = np.flatnonzero(~self.fixed), self.t.layout.offsets[-1]
        return keep[keep < first], keep[keep >= first]

    @cached_property
    def outputs(self) -> scipy.sparse.csr_matrix:
        return output_jacobian(self.t, self.z)

    @cached_property
    def errors(self) -> list[np.ndarray]:
        """Per episode (samples, m) output minus recorded output, zero where none was recorded."""
        return [np.nan_to_num(y - d) for y, d in outputs_and_targets(self.t, self.z)]

    @cached_property
    def widths(self) -> np.ndarray:
        """(m,) errors from which a robust loss bends, infinite for squares."""
        return np.array([self.loss.get(name, np.inf) for name in self.t.model.outputs])

    @cached_property
    def weights(self) -> np.ndarray:
        """(rows,) of the objective, a sum of weighted squares, ordered as `outputs`; zero where none was recorded."""
        p, t = self.t.program, self.t
        return np.concatenate(
            [
                (np.isfinite(t.measured[r].recorded) * (d.step * w)).ravel()
                for d, w, r in zip(p.data, p.weights, t.recording_of, strict=True)
            ]
        )

    @cached_property
    def curvatures(self) -> np.ndarray:
        """(rows,) weights times half the second derivative of the loss, which is one for squares."""
        return self.weights * np.concatenate([(1 + (e / self.widths) ** 2) ** -1.5 for e in self.errors]).ravel()

    @cached_property
    def pulls(self) -> list[np.ndarray]:
        """Per episode (samples, m) half the first derivative of the loss: the error itself for squares."""
        return [e / np.sqrt(1 + (e / self.widths) ** 2) for e in self.errors]

    @cached_property
    def constraints(self) -> scipy.sparse.csc_matrix:
        """Derivatives of the rows that hold: equations, and inequalities that push."""
        p = self.t.program
        rows = (p.constraint_lower == p.constraint_upper) | (np.abs(self.multipliers) > ACTIVE)
        jacobian = scipy.sparse.coo_matrix(
            (p.jacobian(self.z), (np.asarray(p.jacobian_rows), np.asarray(p.jacobian_cols))),
            shape=(p.rows, len(self.z)),
        )
        return jacobian.tocsr()[rows].tocsc()

    def symmetric(self, values: np.ndarray) -> scipy.sparse.csr_matrix:
        """(n, n) the matrix of half these values of the program's lower triangle."""
        p, n = self.t.program, len(self.z)
        places = (np.asarray(p.hessian_rows), np.asarray(p.hessian_cols))
        lower = scipy.sparse.coo_matrix((0.5 * values, places), shape=(n, n))
        return (lower + lower.T - scipy.sparse.diags(lower.diagonal())).tocsr()

    @cached_property
    def beside(self) -> scipy.sparse.csr_matrix:
        """Half the curvature of what the objective holds beside output errors: priors, process noise, costs."""
        return self.symmetric(self.t.program.curvature_beside_errors(self.z))

    @cached_property
    def prior(self) -> scipy.sparse.csr_matrix:
        """The part of `beside` that is a likelihood: it counts as data, of which a sample is worth `information`."""
        return self.symmetric(self.t.program.curvature_beside_errors(self.z, likelihood_only=True))

    def gauss_newton(self) -> Reduced:
        """Without the curvature of outputs and constraints: the expected information.

        Not kept here: a circle of the two would keep a large factorisation until Python looks for circles.
        """
        rooted = self.outputs.multiply(np.sqrt(self.curvatures)[:, None]).tocsr()
        return Reduced(self, (rooted.T @ rooted + self.beside).tocsr())

    def exact(self) -> Reduced:
        """With the curvature of outputs and constraints."""
        return Reduced(self, self.symmetric(self.t.program.hessian(self.z, self.multipliers, 1.0)))

    def by_recording(self, rows: np.ndarray, over=np.mean, channels: int | None = None) -> list[np.ndarray]:
        """(rows, q) in the order of `outputs` -> per recording (K + 1, m, q), the mean (or sum) over its episodes.

        channels : m, where they are not the outputs.
        """
        m = len(self.t.model.outputs) if channels is None else channels
        counts = sample_counts(self.t)
        blocks = [
            b.reshape(k, m, rows.shape[1])
            for b, k in zip(np.split(rows, np.cumsum([m * k for k in counts])[:-1]), counts, strict=True)
        ]
        return [
            over([b for b, of in zip(blocks, self.t.recording_of, strict=True) if of == r], axis=0)
            for r in range(len(self.t.measured))
        ]


def motion_sizes(t: Transcription, z: np.ndarray) -> np.ndarray:
    """(n,) the largest size of each unknown over time, as it is scaled; its own of a parameter."""
    sizes, block = np.abs(z), max(t.layout.block, 1)
    for first, end in itertools.pairwise(t.layout.offsets):
        over_time = np.pad(sizes[first:end], (0, -(end - first) % block)).reshape(-1, block).max(axis=0, initial=0.0)
        sizes[first:end] = np.resize(over_time, end - first)
    return sizes


def _factor(matrix: scipy.sparse.csc_matrix) -> scipy.sparse.linalg.SuperLU:
    try:
        return scipy.sparse.linalg.splu(matrix, permc_spec="COLAMD")
    except RuntimeError:  # SuperLU: "Factor is exactly singular"
        raise SolveError(
            "standard errors cannot be computed here: the optimality system is singular, as at a point with infinite "
            "or huge values or multipliers; solve the problem again, from another start"
        ) from None


class Reduced:
    """The quadratic model of the objective, reduced to the parameters: all else follows them.

    The parameters touch every interval. Without them what is left is a band along time, which
    factorises quickly; they come back through their Schur complement.
    """

    def __init__(self, s: Sensitivity, hessian: scipy.sparse.csr_matrix):
        self.s = s
        self.states, self.parameters = s.columns
        unit = s.t.program.objective_scale  # the factors do not depend on the units of the outputs
        hessian = hessian / unit
        inner = hessian[self.states][:, self.states]
        damping = DAMPING * (abs(inner.diagonal()).max(initial=0.0) or 1.0)
        damping = damping / np.maximum(1.0, motion_sizes(s.t, s.z)[self.states]) ** 2
        inner = inner + scipy.sparse.diags(damping)
        a = s.constraints[:, self.states]
        nothing = -1e-14 * scipy.sparse.identity(
            a.shape[0]
        )  # where a bound cuts the motion off there are more rows than states
        self.factor = _factor(scipy.sparse.block_array([[inner, a.T], [a, nothing]], format="csc"))
        border = scipy.sparse.vstack(
            [hessian[self.states][:, self.parameters], s.constraints[:, self.parameters]]
        ).toarray()
        solved, about = self.factor.solve(border), border.copy()
        for _ in range(ROUNDS):
            about[: len(self.states)] = border[: len(self.states)] + damping[:, None] * solved[: len(self.states)]
            solved = self.factor.solve(about)
        self.follow = -solved[: len(self.states)]
        self.beside, self.prior = (self._reduced(m, self.follow) for m in (s.beside, s.prior))
        self.slopes = s.outputs[:, self.parameters].toarray() - s.outputs[:, self.states] @ solved[: len(self.states)]
        self.curvature = hessian[self.parameters][:, self.parameters].toarray() - border.T @ solved
        self.curvature = 0.5 * unit * (self.curvature + self.curvature.T) + s.penalty * np.eye(len(self.parameters))

    def _reduced(self, matrix: scipy.sparse.csr_matrix, follow: np.ndarray) -> np.ndarray:
        """(q, q) a quadratic form of all unknowns, where the states follow the parameters."""
        if not matrix.nnz:
            return np.zeros((len(self.parameters),) * 2)
        step = np.zeros((matrix.shape[0], len(self.parameters)))
        step[self.states], step[self.parameters] = follow, np.eye(len(self.parameters))
        return step.T @ (matrix @ step)

    def initial_slopes(self, count: int) -> np.ndarray:
        """(rows, count) outputs that the motion can add by itself, parameters kept: a random basis of them."""
        probes = np.random.default_rng(0).standard_normal((self.s.outputs.shape[0], count))
        pull = self.s.outputs[:, self.states].T @ (self.s.curvatures[:, None] * probes)
        solved = self.factor.solve(
            np.vstack([pull / self.s.t.program.objective_scale, np.zeros((self.s.constraints.shape[0], count))])
        )
        return self.s.outputs[:, self.states] @ solved[: len(self.states)]
