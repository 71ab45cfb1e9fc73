"""Does a finding survive on each half of the recording alone?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot

import numpy as np

from symid.discrepancy.locate.remainder import remainder
from symid.discrepancy.model.hypothesis import penalty, refit
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.name.trial.explore import explore
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.fitting.fitter import Fitter
from symid.estimation.fitting.robust_errors import with_robust_errors
from symid.estimation.signals.data import Data
from symid.threads import in_threads
from symid.units import without_unit

ITERATIONS = 15


@dataclass(frozen=True)
class Half:
    """One effect on one half of the fit window.

    Attributes
    ----------
    span : start and end [s]. score : log-likelihood ratio that is lost without the effect, less its penalty.
    parameters : key -> (value, standard error), SI.
    """

    span: tuple[float, float]
    score: float
    parameters: dict[str, tuple[float, float]]


@dataclass(frozen=True)
class Survival:
    """One effect on both halves. `reason` is empty where it survives."""

    name: str
    location: str
    halves: tuple[Half, Half]
    reason: str = ""


@dataclass(frozen=True)
class HalfVerdict:
    """One half of the fit window alone: start and end [s], the verdict, and a suspect that explains more, if any."""

    span: tuple[float, float]
    verdict: str
    rival: Suspect | None = None


def verdicts(
    suspects: Sequence[Suspect], fit: Fit, base: Fit, data: Data, rivals: Sequence[Suspect]
) -> tuple[HalfVerdict, ...]:
    """The verdict on each of two disjoint halves, with what was found and each of `rivals` in its place.

    Empty where a half cannot be fitted.
    """

    def verdict(one: tuple[Data, np.ndarray]) -> HalfVerdict | None:
        half, near = one[0], replace(fit, initial=one[1])
        given, whole = (refit(added, near, base, half, iterations=ITERATIONS) for added in ((), suspects))
        if given is None or whole is None:
            return None
        score = whole.loglik2 - given.loglik2 - penalty(suspects, half, given, whole)
        left = remainder(whole, half)[0].minus_log10_p > POLICY.remainder
        said = "unexplained" if left else "missing_physics" if score > 0 and suspects else "adequate"
        return HalfVerdict(half.span, said, _better(rivals, score, given, half) if len(suspects) == 1 else None)

    found = in_threads(verdict, zip(data.halves(), _states(fit, data), strict=True))
    return () if None in found else tuple(found)


def _better(rivals: Sequence[Suspect], score: float, given: Fit, half: Data) -> Suspect | None:
    """The rival that explains a half better than the score of what was found, if one does."""
    found = [c for c in explore(given, half, rivals) if c.score > score] if rivals else []
    return found[0].suspect if found else None


def survivals(
    suspects: Sequence[Suspect], fit: Fit, base: Fit, data: Data, white: bool, others: Sequence[Suspect] = ()
) -> tuple[Survival, ...]:
    """Every lasting effect of `suspects` refitted on two disjoint halves, each against the model that lacks only it.

    Effects that last for a time only, or begin at one, are left out: a half need not contain them.

    Parameters
    ----------
    others : all suspects in `fit`, where those asked for are not all.
    white : whether innovations are white, so that plain standard errors are believed.
    """
    lasting = [s for s in suspects if s.scanned is None or s.scanned.clock in ("frequency", "turn")]
    if not lasting or not fit.errors:
        return ()
    all_suspects = list(others or suspects)
    found = in_threads(
        lambda half: _on_half(lasting, all_suspects, replace(fit, initial=half[1]), base, half[0], white),
        zip(data.halves(), _states(fit, data), strict=True),
    )
    if None in found:
        return ()
    pairs = zip(*found, strict=True)
    return tuple(
        Survival(s.term.name, s.term.location, pair, _reason(pair)) for s, pair in zip(lasting, pairs, strict=True)
    )


def _states(fit: Fit, data: Data) -> tuple[np.ndarray, np.ndarray]:
    """Where the initial states of the halves are looked for."""
    if len(data.segments) > 1:
        n = len(data.segments) // 2
        return fit.initial[:n], fit.initial[n:]
    fitter = Fitter.of(fit, data)
    (run,) = fitter.run(fit.values, fit.initial, fit.kalman_gain, sensitivities=False, keep="states")
    return fit.initial, run.x[[len(run.x) // 2]]


def _on_half(
    lasting: list[Suspect], suspects: list[Suspect], near: Fit, base: Fit, data: Data, white: bool
) -> list[Half] | None:
    """The lasting effects on one half, or None where the found model cannot be fitted to it."""
    whole = refit(suspects, near, base, data, iterations=ITERATIONS)
    if whole is None:
        return None
    trusted, halves = whole if white else with_robust_errors(whole, data), []
    for s in lasting:
        less = refit([t for t in suspects if t is not s], near, base, data, iterations=ITERATIONS)
        score = np.inf if less is None else whole.loglik2 - less.loglik2 - penalty([s], data, less, whole)
        names = {q.key: s.term.parameter_name(q.key) for q in s.law.parameters}
        halves.append(
            Half(data.span, float(score), {key: (trusted.values[k], trusted.errors[k]) for key, k in names.items()})
        )
    return halves


def _reason(halves: tuple[Half, Half]) -> str:
    """Why an effect does not survive, or nothing."""
    for half, which in zip(halves, ("first", "second"), strict=True):
        if half.score <= 0:
            return f"the {which} half alone does not ask for it"
    for key in halves[0].parameters:
        (a, s), (b, r) = (h.parameters[key] for h in halves)
        error = hypot(s, r)  # zero where both are held by their bounds
        if error and abs(a - b) > POLICY.apart * error:
            return f"its {without_unit(key)} differs between the halves by {abs(a - b) / error:.0f} standard errors"
    return ""
