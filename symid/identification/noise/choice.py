"""Which error model a recording's residual asks for, and the covariance by it. Arrays as in `residual`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.checked import shown
from symid.errors import SolveError
from symid.identification.noise import hac
from symid.identification.noise.beside import Beside
from symid.identification.noise.clusters import FEWEST_CLUSTERS, clustered
from symid.identification.noise.memory import Memory, memory
from symid.identification.noise.residual import REFUTED, Errors, likeliest, white, whiteness
from symid.identification.noise.uneven import by_sample, said

CHOICES = ("auto", "white", "coloured", "clustered")
ASKED, EPISODES = "as asked for", "episodes with process noise leave residuals with a memory"
TOLD = 0.5
"""Probability of a memory from which on it is told beside a residual that does not show it: what it was before."""


@dataclass(frozen=True, eq=False)
class ErrorModel:
    """An error model, why it was chosen, and what is known of the noise's memory where that is one of few numbers, or
    of noise beside an estimated disturbance."""

    name: str
    why: str
    memory: Memory | None = None
    beside: Beside | None = None

    def covariance(self, errors: list[Errors], influences: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray, str]:
        """(q, q) covariance of scaled parameters, (recordings, m) standard deviations of the noise [SI], and why."""
        if self.beside is not None:
            return self._beside(errors, influences), np.sqrt(self.beside.variances), self.why
        if self.name == "clustered":
            return *clustered(errors, influences), self.why
        if self.name == "coloured" and self.memory is None:
            return *hac.coloured(errors, influences), self.why
        total, noise = (
            white(errors, influences)
            if self.memory is None
            else (self.memory.covariance(influences), self.memory.noise)
        )
        if self.name == "coloured" or not (doubt := said(errors, influences)):
            return total, noise, self.why
        own, noise = by_sample(errors, influences)
        if self.memory is not None:  # a memory makes them larger, whatever the sizes of the samples are
            even = np.diag(white(errors, influences)[0])
            times = np.sqrt(np.divide(np.diag(total), even, out=np.ones_like(even), where=even > 0))
            own = own * np.outer(times, times)
        return own, noise, f"{self.why}; {doubt}"

    def _beside(self, errors: list[Errors], influences: list[np.ndarray]) -> np.ndarray:
        if self.name == "white":
            return self.beside.covariance(influences)
        return (clustered if self.name == "clustered" else hac.coloured)(errors, influences)[0]


def choose(errors: list[Errors], choice: str, episodes: int, beside: Beside | None = None) -> ErrorModel:
    """The error model that is asked for, or that the residuals ask for.

    beside : of the same errors, where disturbances are estimated with the motion.
    """
    if not isinstance(choice, str) or choice not in CHOICES:
        raise SolveError(
            f"error model {shown(choice)}: known are {', '.join(CHOICES)}; "
            "blocks are drawn again by symid.bootstrap(solution)"
        )
    if choice == "clustered" and len(errors) < FEWEST_CLUSTERS:
        raise SolveError(
            f"clustered errors compare recordings with each other and need {FEWEST_CLUSTERS} of them; there "
            f"{'is' if len(errors) == 1 else 'are'} {len(errors)}: cut the recording into segments, or choose "
            "'coloured'"
        )
    if beside is not None:
        return _chosen_beside(beside, choice, episodes)
    if choice in ("white", "clustered"):
        return ErrorModel(choice, ASKED)
    found, why = memory(errors), ASKED
    if choice == "auto" and episodes > 1:
        why = EPISODES
    elif choice == "auto":
        chance = whiteness(likeliest(likeliest(errors)))
        if chance > REFUTED:
            stated = all(np.all(r.believed) for r in errors)  # as white, which is not doubted before it is refuted
            return ErrorModel("white", _white(errors, chance, found), None if stated else found)
        why = f"the residual is correlated in time (p {_chance(chance)})"
    if found is not None and whiteness(likeliest(likeliest(found.innovations()))) > REFUTED:
        return ErrorModel("coloured", f"{why}, {_told(found)}", found)
    return ErrorModel("coloured", why)


def _chosen_beside(beside: Beside, choice: str, episodes: int) -> ErrorModel:
    if choice != "auto":
        return ErrorModel(choice, ASKED, beside=beside)
    if episodes > 1:
        return ErrorModel("coloured", EPISODES, beside=beside)
    chance = f"(p {_chance(beside.whiteness)})"
    if why := beside.refuted():
        return ErrorModel("coloured", f"{why} {chance}", beside=beside)
    agreed = "beside an estimated disturbance, whose residual its autocorrelation does not refute"
    return ErrorModel("white", f"{agreed} {chance}", beside=beside)


def _white(errors: list[Errors], chance: float, found: Memory | None) -> str:
    agreed = [r.believed for r in errors]
    if np.all(agreed):
        return f"known, and the residual does not refute it (p {_chance(chance)})"
    why = f"{'partly known' if np.any(agreed) else 'estimated'}; the residual's autocorrelation does not refute it"
    hidden = 0.0 if found is None else 1 - found.white
    counted = f"; a memory that the fit hides is counted with its probability, {hidden:.0%}" if hidden > TOLD else ""
    return f"{why} (p {_chance(chance)}){counted}"


def _told(found: Memory) -> str:
    numbers = ", ".join(f"{c:.2g}" for c in found.mean)
    return f"like an autoregression that keeps {numbers} of the noise from one sample to the next"


def _chance(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"= {p:.2g}"
