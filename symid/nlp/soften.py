"""Equations of a nonlinear program that may be violated, at a price."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.nlp.program import NonlinearProgram


def soften(nlp: NonlinearProgram, rows: np.ndarray, weight: float) -> NonlinearProgram:
    """`nlp` with a free slack in each of `rows`, and weight * objective_scale * their sum of squares in the objective.

    The slacks are the last variables and begin where the start satisfies the rows. In equations of
    motion they are process noise that is estimated: the motion may leave the model, so that no
    controller is too unstable to be followed, and Newton steps stay short (penalty method;
    Nocedal & Wright 2006, section 17.1).
    """
    n, count, weight = nlp.n, len(rows), weight * nlp.objective_scale
    slack, free = np.arange(n, n + count), np.full(count, np.inf)

    def constraints(y):
        values = nlp.constraints(y[:n]).copy()
        values[rows] += y[n:]
        return values

    def hessian(y, multipliers, factor):
        return np.append(nlp.hessian(y[:n], multipliers, factor), np.full(count, 2 * weight * factor))

    return replace(
        nlp,
        lower=np.append(nlp.lower, -free),
        upper=np.append(nlp.upper, free),
        start=np.append(nlp.start, -nlp.constraints(nlp.start)[rows]),
        objective=lambda y: nlp.objective(y[:n]) + weight * float(y[n:] @ y[n:]),
        gradient=lambda y: np.append(nlp.gradient(y[:n]), 2 * weight * y[n:]),
        constraints=constraints,
        jacobian=lambda y: np.append(nlp.jacobian(y[:n]), np.ones(count)),
        jacobian_rows=np.append(nlp.jacobian_rows, rows),
        jacobian_cols=np.append(nlp.jacobian_cols, slack),
        hessian=None if nlp.hessian is None else hessian,
        hessian_rows=np.append(nlp.hessian_rows, slack),
        hessian_cols=np.append(nlp.hessian_cols, slack),
        describe_variable=lambda i: (
            nlp.describe_variable(i) if i < n else f"slack of {nlp.describe_constraint(rows[i - n])}"
        ),
    )
