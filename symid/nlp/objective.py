"""A nonlinear program whose objective is divided by its typical size, or taken away."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from symid.nlp.filling import Filling
from symid.nlp.program import NonlinearProgram


def with_unit_objective(nlp: NonlinearProgram) -> NonlinearProgram:
    """`nlp` with f / objective_scale as objective; its multipliers are those of `nlp` / objective_scale.

    Done here and not by a solver's own scaling, which looks at the size of the gradient first, or takes
    the scaling of the constraints away with it.
    """
    size = nlp.objective_scale
    if size == 1:
        return nlp
    return replace(
        nlp,
        objective=lambda z: nlp.objective(z) / size,
        gradient=lambda z: nlp.gradient(z) / size,
        hessian=_scaled(nlp.hessian, size),
        objective_scale=1.0,
    )


def _scaled(hessian: Callable | None, size: float) -> Callable | None:
    if hessian is None:
        return None
    if isinstance(hessian, Filling):
        return Filling(
            hessian.size, lambda out, z, multipliers, factor: hessian.fill(out, z, multipliers, factor / size)
        )
    return lambda z, multipliers, factor: hessian(z, multipliers, factor / size)


def without_objective(nlp: NonlinearProgram) -> NonlinearProgram:
    """`nlp` with zero as objective: what is left are its constraints and bounds."""
    return replace(
        nlp,
        objective=lambda z: 0.0,
        gradient=np.zeros_like,
        hessian=None if nlp.hessian is None else lambda z, multipliers, factor: nlp.hessian(z, multipliers, 0.0),
        objective_scale=1.0,
    )
