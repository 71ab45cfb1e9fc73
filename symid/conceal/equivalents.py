"""Other answers that a recording cannot tell from the truth.

Each law that is easily taken for the concealed one is fitted, with all unknowns of the model, to
the noise-free recording. What it misses is whitened with the spectrum of the noise; its sum of
squares d2 is then the expected value of twice the log-likelihood by which the best test prefers
the truth, and such a test errs with probability Phi(-sqrt(d2)/2).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symid.conceal.conceal import Concealed, first_states, outputs_of, segments_of
from symid.conceal.fit import fit_free
from symid.discrepancy import Suspect
from symid.errors import SymidError
from symid.mechanics import LIBRARY
from symid.model import Term

EQUIVALENT, NEAR = 10.8, 50.0
"""Below the first d2 the best test errs in more than 5 %; below the second, credit is a matter of taste."""
CONFUSABLE = (
    ("feedback_delay", "muscle_lag", "torque_feedback", "acceleration_feedback", "input_delay"),
    ("input_gain", "sensor_gain", "extra_mass", "acceleration_feedback"),
    ("coulomb_friction", "sensory_dead_zone", "cubic_stiffness", "torque_saturation"),
    ("integral_feedback", "torque_feedback"),
    ("gain_change", "external_push", "periodic_torque"),
    ("viscous_friction", "coulomb_friction", "quadratic_drag"),
    ("gravity_tilt", "link_inertia_error", "torsional_spring", "sensor_offset"),
    ("base_motion", "periodic_torque"),
    ("sensor_delay", "viscous_friction"),
)
"""Laws that do nearly the same to a motion of one frequency or amplitude."""
ORDER = 12
"""Of the autoregression that whitens the noise."""
STARTS, EVALUATIONS = 2, 15


def with_equivalents(case: Concealed) -> Concealed:
    """`case` with the answers that are equivalent, or nearly so, to each of its effects.

    Parameters
    ----------
    case : what `conceal` or `draw_case` made.

    Examples
    --------
    >>> with_equivalents(case).equivalent                                        # doctest: +SKIP
    ((),)
    """
    white = _whitener(outputs_of(case.setup.model, case.recording) - case.clean)
    found = [_alternatives(case, term, white) for term in case.terms]
    return replace(
        case,
        equivalent=tuple(tuple(t for t, d2 in f if d2 < EQUIVALENT) for f in found),
        near=tuple(tuple(t for t, d2 in f if EQUIVALENT <= d2 < NEAR) for f in found),
    )


def _alternatives(case: Concealed, truth: Term, white) -> list[tuple[Term, float]]:
    """Other terms in the place of `truth`, the other effects kept, and d2 of each."""
    model, values = case.setup.model, dict(case.setup.parameters)
    for term in case.terms.keys() - {truth}:
        model = model.with_term(term)
        values |= {term.parameter_name(k): v for k, v in case.terms[term].items()}
    names = {n for group in CONFUSABLE if truth.name in group for n in group} | ({truth.name} & LIBRARY.keys())
    present = {str(t) for t in (*model.terms, truth)}
    terms = [LIBRARY[n].at(place) for n in sorted(names) for place in LIBRARY[n].places(model)]
    return [(t, _distance(case, model, values, t, white)) for t in terms if str(t) not in present]


def _distance(case: Concealed, model, values, term: Term, white) -> float:
    model = model.with_term(term)
    suspect, best = Suspect(term), np.inf
    segments = segments_of(case.setup, model, case.quiet, case.setup.windows[0])
    moment = case.setup.fit / 2
    for start in suspect.starts(off=False)[:STARTS]:
        start = {k: moment if k in ("start_s", "time_s") else v for k, v in start.items()}
        try:
            fit = fit_free(
                model,
                segments,
                values | suspect.named(start),
                first_states(model, segments),
                white=white,
                most=EVALUATIONS,
            )
        except SymidError:
            continue
        best = min(
            best, sum(float(np.sum(white(e.recorded - y) ** 2)) for e, y in zip(segments, fit.simulated, strict=True))
        )
    return best


def _whitener(noise: np.ndarray):
    """Filter (N, m, ...) -> same, that makes `noise` white with unit covariance: a vector autoregression."""
    past = np.hstack([noise[ORDER - k : -k] for k in range(1, ORDER + 1)])
    weights = np.linalg.lstsq(past, noise[ORDER:], rcond=None)[0]
    surprise = noise[ORDER:] - past @ weights
    unit = np.linalg.inv(np.linalg.cholesky(np.cov(surprise.T)))
    taps = [np.eye(noise.shape[1]), *(-weights.reshape(ORDER, noise.shape[1], -1).transpose(0, 2, 1))]
    taps = [unit @ t for t in taps]

    def white(errors: np.ndarray) -> np.ndarray:
        out = np.zeros_like(errors)
        for k, tap in enumerate(taps):
            out[k:] += np.einsum("ab,nb...->na...", tap, errors[: len(errors) - k])
        return out

    return white
