"""Covariance of the identified parameters, from the optimality system and the residual's own colour."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from symid.ipopt_solver import SolverResult
from symid.threads import one_blas_thread
from symid.transcription import Transcription


@one_blas_thread
def parameter_covariance(t: Transcription, result: SolverResult, errors: list[np.ndarray],
                         output_slopes: list[np.ndarray]) -> np.ndarray:
    """(free parameters, free parameters) covariance in SI units; NaN for parameters at a bound.

    A change of one recorded sample moves the optimum by the inverse of the optimality (KKT)
    matrix times the mixed derivative of the objective. The covariance is that influence applied
    to the residual's autocovariance, estimated from the residual itself: process noise colours
    the output error, so that white noise would make the errors far too small (sandwich
    estimator; Ljung 1999, section 9.4; Newey & West 1987 for the taper).

    Parameters
    ----------
    errors : per recording (K + 1, m) output error, mean over episodes; NaN where none was recorded.
    output_slopes : per episode (K + 1, m, n) derivative of the outputs to the scaled states.
    """
    first, free = t.layout.offsets[-1], len(t.layout.parameter_names)
    at_bound = bound_active(t, result)
    keep = np.flatnonzero(~at_bound[first:])
    covariance = np.full((free, free), np.nan)
    if not len(keep):
        return covariance
    response = _parameter_rows_of_inverse(t, result, at_bound)
    total = np.zeros((len(keep), len(keep)))
    for r, error in enumerate(errors):
        influence = sum(_influence(t, e, response, output_slopes[e]) for e, of in enumerate(t.recording_of) if of == r)
        there = np.isfinite(error)
        total += _coloured(influence * there[:, :, None], np.where(there, error, 0.0)) / there.mean()
    scale = t.layout.parameter_scale[keep]
    covariance[np.ix_(keep, keep)] = total * np.outer(scale, scale)
    return covariance


def bound_active(t: Transcription, result: SolverResult) -> np.ndarray:
    """(n,) whether each unknown sits at one of its bounds."""
    lower, upper, z = t.program.lower, t.program.upper, result.z
    near = 1e-5 * np.maximum(1.0, np.abs(z))
    with np.errstate(invalid="ignore"):
        return ((z - lower < near) & (result.bound_multipliers_lower > 1e-8)) | \
               ((upper - z < near) & (result.bound_multipliers_upper > 1e-8))


def _parameter_rows_of_inverse(t: Transcription, result: SolverResult, at_bound: np.ndarray) -> np.ndarray:
    """(n, free parameters not at a bound): columns of the inverse KKT matrix, states' part included."""
    p, n = t.program, t.layout.size
    values = p.hessian(result.z, result.multipliers, 1.0)
    lower = sparse.coo_matrix((values, (p.hessian_rows, p.hessian_cols)), shape=(n, n))
    hessian = (lower + lower.T - sparse.diags(lower.diagonal())).tocsr()
    jacobian = sparse.coo_matrix((p.jacobian(result.z), (p.jacobian_rows, p.jacobian_cols)), shape=(p.rows, n)).tocsc()
    first, keep = t.layout.offsets[-1], np.flatnonzero(~at_bound)
    states, parameters = keep[keep < first], keep[keep >= first]
    inner = sparse.block_array([[hessian[states][:, states], jacobian[:, states].T], [jacobian[:, states], None]],
                               format="csc")
    border = sparse.vstack([hessian[states][:, parameters], jacobian[:, parameters]]).toarray()
    # The parameters touch every interval. Without them what is left is a band along time, which
    # factorises quickly; they come back through their Schur complement.
    solved = splu(inner, permc_spec="COLAMD").solve(border)
    own = np.linalg.inv(hessian[parameters][:, parameters].toarray() - border.T @ solved)
    response = np.zeros((n, len(parameters)))
    response[parameters] = own
    response[states] = -(solved @ own)[:len(states)]
    return response


def _influence(t: Transcription, episode: int, response: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """(K + 1, m, q) change of the scaled parameters per change of each recorded sample."""
    layout, weights = t.layout, t.program.error_constants[-len(t.model.outputs):]
    nodes = np.stack([layout.sample_view(np.ascontiguousarray(column), episode) for column in response.T], axis=-1)
    return 2 * t.program.data[episode].step * np.einsum("j,kjs,ksq->kjq", weights, slopes, nodes)


def _coloured(influence: np.ndarray, error: np.ndarray) -> np.ndarray:
    """(q, q) influence' R influence, with R the tapered autocovariance of `error` at all lags."""
    from scipy.signal import fftconvolve  # here and not at the top: takes half the time that a worker needs to start
    samples, channels = error.shape
    lags = samples // 4
    taper = 1 - np.arange(-lags, lags + 1) / (lags + 1) * np.sign(np.arange(-lags, lags + 1))
    total = np.zeros((influence.shape[2],) * 2)
    for i in range(channels):
        for j in range(channels):
            covariance = fftconvolve(error[:, i], error[::-1, j])[samples - 1 - lags:samples + lags] / samples * taper
            spread = fftconvolve(influence[:, j], covariance[:, None], axes=0)[lags:lags + samples]
            total += influence[:, i].T @ spread
    return 0.5 * (total + total.T)
