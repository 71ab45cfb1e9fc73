"""Rigs whose bodies are not all known: what is held, what is estimated, and what the motion determines of them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from symid.errors import DiagnosisError
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.gauss_newton.normal_equations import covariance_of, normal_equations
from symid.estimation.signals.data import Data
from symid.estimation.signals.swings import swing
from symid.estimation.signals.windows import segments_of
from symid.mechanics import rig_model
from symid.mechanics.chains.combined import combined_of
from symid.model import Model
from symid.recording import Recording
from symid.units import STANDARD_GRAVITY, quantity

ORDER = "LIam"
"""Which of the unknown numbers of a body are estimated first where not all are determined; the last ones are held."""
INDEPENDENT = 1e-5
"""A number whose effect on the outputs lies within those of others up to this part of its size is not determined."""
TOLD = 1e-3
"""A combination that moves by less than this part of its size along what is not determined is determined."""
SEGMENTS, SWINGS = 3, 3
"""From so many segments, and swings of each, is told which numbers have effects of their own."""
SMALL = 1e-4
"""Size of a friction of which nothing is known, for that purpose [SI]."""
Parameters = str | os.PathLike[str] | Mapping[str, object]


@dataclass(frozen=True)
class Determined:
    """A number that the motion determines: what it is, value, standard error, unit, all SI."""

    meaning: str
    expression: str
    value: float
    error: float
    unit: str


def rig_with_unknown_bodies(
    parameters: Parameters, recording: Recording, friction: Iterable[str], part: tuple[float, float] | str
) -> tuple[Model, Model]:
    """The model of a rig with all numbers of its bodies that the motion of a part of a recording can determine.

    What cannot be determined beside the others is held at its guess, so that only combinations of the estimated
    values mean anything. Returns the model, and the one with all unknown numbers free.
    """
    model = rig_model(parameters, recording.channels, friction)
    unknown = unknown_bodies(model)
    if not unknown:
        return model, model
    segments = segments_of(model, recording, part)
    period = float(np.median([swing(s) for s in segments]))
    given = rig_model(parameters, recording.channels, friction, reach=STANDARD_GRAVITY * (period / (2 * np.pi)) ** 2)
    free = _independent(given, Data(segments, np.ones(len(given.outputs)), False))
    held = {k: given.parameters[k].guess for k in unknown if k not in free}
    if not held:
        return given, given
    # What is estimated stands for others, too, and may take values that no body has.
    return given.fixed(**held).with_bounds(**{k: (-inf, inf) for k in unknown if k in free and k[0] in "Ia"}), given


def unknown_bodies(model: Model) -> tuple[str, ...]:
    """Numbers of the bodies of a rig that are parameters."""
    return tuple(k for k in model.parameters if k not in _of_terms(model))


def _of_terms(model: Model) -> set[str]:
    return {t.parameter_name(q.key) for t in model.terms for q in t.law.parameters}


def _independent(model: Model, data: Data) -> list[str]:
    """Parameters that are determined one after the other, in the order of preference, at the guesses."""
    names = [k for k in model.parameters if k in _of_terms(model)]
    names += sorted((k for k in model.parameters if k not in names), key=lambda k: (ORDER.index(k[0]), k))
    shown, states = {str(y.expr): i for i, y in enumerate(model.outputs.values())}, list(model.states)
    start = np.array([[s.recorded[0, shown[x]] if x in shown else 0.0 for x in states] for s in data.segments])
    values = {k: model.parameters[k].guess or SMALL for k in names}
    columns, basis, found = _columns(model, values, data, start), [], []
    for k in names:
        rest = columns[k]
        for b in (*basis, *basis):  # twice is enough (Parlett 1998, section 6.9)
            rest = rest - b * (b @ rest)
        if np.linalg.norm(rest) > INDEPENDENT * max(np.linalg.norm(columns[k]), 1e-300):
            basis.append(rest / np.linalg.norm(rest))
            found.append(k)
    return found


def _columns(model: Model, values: Mapping[str, float], data: Data, start: np.ndarray) -> dict[str, np.ndarray]:
    """Parameter -> change of the outputs per its own size in a few swings, less what the states at the start can do."""
    few = [s.head(max(8, int(SWINGS * swing(s) / s.step))) for s in data.segments[:SEGMENTS]]
    fitter = Fitter(model, data.with_segments(few))
    runs = fitter.run(values, start[:SEGMENTS], None, sensitivities=True)
    if runs is None:
        raise DiagnosisError(f"{model.name}: its motion with {dict(values)} diverges; give more of its numbers")
    q, blocks = len(fitter.free), []
    for t in runs:
        a = t.dy.reshape(-1, t.dy.shape[2])
        own, _ = np.linalg.qr(a[:, q:])
        blocks.append(a[:, :q] - own @ (own.T @ a[:, :q]))
    return {k: c * (abs(values[k]) or 1.0) for k, c in zip(fitter.free, np.vstack(blocks).T, strict=True)}


# ---- what came out ---------------------------------------------------------------------------
def determined(fit: Fit, data: Data, given: Model, unknown: Sequence[str]) -> list[Determined]:
    """The numbers that unknown bodies make together and that the motion determines, with their errors.

    Parameters
    ----------
    fit : of a model in which some of them are held. data : what it was fitted to. given : the model with all free.
    """
    for term in fit.model.terms[len(given.terms) :]:
        given = given.with_term(term)
    names = list(given.parameters)
    values = {k: fit.values.get(k, getattr(fit.model[k], "value", 0.0)) for k in names}
    numbers = {c.symbol: c.value for c in fit.model.constants.values()} | {
        given[k].symbol: v for k, v in values.items()
    }
    sizes = np.array([abs(values[k]) or 1.0 for k in names])
    columns = _columns(given, values, data, fit.initial)
    _, s, v = np.linalg.svd(np.column_stack([columns[k] for k in names]), full_matrices=True)
    null = v[np.append(s, np.zeros(len(v) - len(s))) < INDEPENDENT * s[0]].T
    covariance, rows, found = _covariance(fit, data), np.zeros((0, len(names))), []
    for c in combined_of(given):
        slopes = np.array([float(c.expr.diff(given[k].symbol).subs(numbers)) for k in names])
        row = slopes * sizes / max(np.linalg.norm(slopes * sizes), 1e-300)
        more = np.vstack([rows, row])
        concerned = any(c.expr.has(given[k].symbol) for k in unknown)
        if np.linalg.norm(row @ null) > TOLD or np.linalg.matrix_rank(more, tol=1e-6) < len(more):
            continue
        rows = more
        if concerned:
            own = np.array([slopes[names.index(k)] for k in fit.values])
            error = float(np.sqrt(max(own @ covariance @ own, 0.0)))
            found.append(Determined(c.meaning, str(c.expr), float(c.expr.subs(numbers)), error, c.unit))
    return found


def _covariance(fit: Fit, data: Data) -> np.ndarray:
    """(q, q) of the parameters of a fit [SI]."""
    fitter = Fitter(fit.model, data)
    p = np.array([fit.values[k] for k in fitter.sim.parameters])
    H, _, q = normal_equations(fitter, p, fit.initial, fit.kalman_gain, fit.process, fit.initial)
    return covariance_of(H)[:q, :q]


def bodies_words(found: Sequence[Determined], unknown: Sequence[str]) -> str:
    """What was not known, and what the motion says of it."""
    said = [f"{d.meaning}, {quantity(d.value, d.error, d.unit)}" for d in found]
    alone = {d.meaning for d in found}
    lost = [k for k in unknown if k not in alone]
    text = f"The motion determines {'; '.join(said)}." if said else "The motion determines none of what is not known."
    if lost:
        text += f" {', '.join(lost)} cannot be told one by one."
    return text
