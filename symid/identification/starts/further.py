"""Further starts, where the solve from the usual one ends far above what a smoother leaves of the recording.

Then another optimum may be better, or the motion has process noise, or the model lacks something. Where the problem is
large, a look at simulations that are led along the recording tells the first from the others before more is solved.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from symid.identification.starts.bounds import guesses
from symid.identification.starts.default import equation_error
from symid.identification.starts.led import along, around, free, tracked
from symid.identification.starts.shooting import Shooting, can_shoot, hides, with_hidden
from symid.identification.uncertainty.sensitivity import outputs_and_targets
from symid.threads import one_blas_thread
from symid.transcription import Transcription

FAR, FAR_SMALL, DOUBTED = 1.5, 1.15, 1.1
"""Residual over what a smoother leaves, from which on other optima are looked for; the second where the problem is
small, and a needless look costs a second, the third there by the `led_starts`, which cost a tenth of that. The best
fits of white noise have 0.9 to 1.3, most of them less than 1.1; two of 400 pendulums that turn over, with noise of a
radian and more, ended at 1.24 and 1.39, with turns lost."""
NOTHING = 1e-3
"""Residual, as a share of the channel's standard deviation, that is never far: without noise the mesh leaves it."""
SMALL = 2000
"""Samples up to which all further starts are tried at once: they take a second or less."""
LED, PULLED, ASKED = (0.3, 0.1), 1.2, 1.5
"""Gains with which simulations are led, and the ratio of their errors, with the solution's parameters to those with the
regressed ones, from which on other starts are tried, and said to be needed. With process noise of standing it is 0.9 to
1.15 for the optimum of a right model, 1.3 of a wrong model, and 1.6 to 6 for wrong optima of Lorenz's and Duffing's."""


def excess(t: Transcription, z: np.ndarray) -> np.ndarray:
    """(recordings, m) root mean square error of each output over what a free smoother leaves of its recording."""
    left = np.array([m.left for m in t.measured])
    size = np.array([m.targets[m.nodes].std(axis=0) for m in t.measured])
    pairs = dict(zip(t.recording_of, outputs_and_targets(t, z), strict=True))
    rms = np.array([np.sqrt(np.nanmean((pairs[r][0] - pairs[r][1]) ** 2, axis=0)) for r in range(len(t.measured))])
    return rms / np.maximum(np.maximum(left, NOTHING * size), np.finfo(float).tiny)


def far(t: Transcription, z: np.ndarray) -> bool:
    """Whether an output errs so much more than a smoother that another optimum may be better."""
    return bool(np.any(excess(t, z) > (FAR if _large(t) else FAR_SMALL)))


@one_blas_thread
def led_starts(t: Transcription, z: np.ndarray) -> Iterator[np.ndarray]:
    """Free vectors of simulations that are led along the recording, from a solution `z` that is in doubt.

    Of a large problem, whose solve takes no longer than this, only where states are hidden: seen ones lose no turn.
    """
    if _large(t) and not hides(t):
        return
    if np.any(excess(t, z) > (FAR if _large(t) else DOUBTED)) and can_shoot(t):
        shooting = Shooting(t)
        for found in along(shooting, shooting.of_solution(z)):
            yield t.start(*found)


@one_blas_thread
def further_starts(t: Transcription, z: np.ndarray, solved: bool) -> Iterator[tuple[np.ndarray, bool]]:
    """Free vectors from which a better end than `z` may be found, and whether they are simulations (led ones).

    solved : whether `z` is a solution. Of a large problem it must be in doubt then, for more to be tried than the
        recorded motion, which is tried where simulations with the regressed parameters do not follow it: the optimum
        that led simulations end in need not be the one that is nearest to the recording.
    """
    shooting = Shooting(t) if can_shoot(t) else None
    large, seen = _large(t), shooting is not None and not shooting.hidden
    if large and solved and not seen:
        return
    regressed, recorded = _recorded_motion(t)
    settled = large and solved and _doubt(shooting, z, regressed) < PULLED
    if settled and shooting.follows(shooting.unknowns(regressed)):
        return
    yield recorded, False
    if settled:
        return
    if seen or (shooting is not None and not large):
        others = [regressed, equation_error(t, guesses(t))[0]]
        for found in tracked(shooting, [shooting.unknowns(p) for p in others]):
            yield t.start(*found), True
    if shooting is not None and not (seen or large):
        for found in free(shooting):
            yield t.start(*found), True
    if shooting is not None and solved and not large:
        for found in around(shooting, shooting.of_solution(z)):
            yield t.start(*found), True


def _recorded_motion(t: Transcription) -> tuple[np.ndarray, np.ndarray]:
    """(free parameters,) SI that a regression on the smoothed recording finds, and the free vector of both."""
    regressed = equation_error(t, guesses(t), t.smooth_motion)[0]
    return regressed, t.start(regressed, with_hidden(t, t.smooth_motion))


@one_blas_thread
def drawn_starts(t: Transcription) -> Iterator[np.ndarray]:
    """Free vectors of led simulations from random parameters, where these were not among the `further_starts`; none of
    a large problem, where so many fits take long.

    A regression on noisy accelerations makes unknown masses too small, down to their bounds, from where no simulation
    comes back.
    """
    if _large(t) or not can_shoot(t) or (shooting := Shooting(t)).hidden:
        return
    for found in tracked(shooting, [], anywhere=True):
        yield t.start(*found)


def _large(t: Transcription) -> bool:
    return sum(m.intervals for m in t.measured) > SMALL


def _doubt(shooting: Shooting, z: np.ndarray, regressed: np.ndarray) -> float:
    """How much better simulations that are led along the recording follow it with the regressed parameters."""
    here, there = shooting.of_solution(z), shooting.unknowns(regressed)
    return max(shooting.led_error(here, g) / max(shooting.led_error(there, g), np.finfo(float).tiny) for g in LED)


def asked_for(t: Transcription, z: np.ndarray) -> np.ndarray | None:
    """(free parameters,) SI that led simulations ask for, where those of `z` are in doubt."""
    if not can_shoot(t):
        return None
    regressed = equation_error(t, guesses(t), t.smooth_motion)[0]
    return regressed if _doubt(Shooting(t), z, regressed) > ASKED else None
