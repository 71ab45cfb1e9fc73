"""A better start where the loop is stable: output error by simulation, without a nonlinear program.

Single shooting with exact sensitivities takes a fraction of a second and ends close to the
optimum of the collocation, which then needs a few iterations. It needs a loop that follows the
recording somewhat: from a worse one, or an unstable one, it could end in another local optimum.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy

from symid.identification.starts.shooting import Shooting, can_shoot, hides, with_hidden
from symid.transcription import Transcription

GAINS = (0.7, 0.3, 0.1, 0.03)
"""Shares of the output error by which a simulation is led back to the recording at each sample, one fit after the other
(homotopy: Vyasarayani, Uchida & McPhee 2012). Led strongly, no model runs away from the recording, and what is fitted
is nearly the equation error, which has one optimum; led by nothing it is the output error."""
FINE_GAINS = (0.7, 0.3, 0.1, 0.06, 0.03, 0.02, 0.01, 0.006, 0.003, 0.002, 0.001, 0.0)
"""The same in smaller steps: the optimum moves less from one to the next. From 0.03 to nothing at once, a pendulum that
turns over, a Lorenz and a Duffing system lose it."""
STRONG = GAINS[:2]
"""Gains by which a lost turn is found: of three phase-locked loops that slip in all, with 0.1 in two, 0.03 in one."""
RUNAWAY = 4.0
"""Cost over the least of the gains before, above which the optimum has been lost."""
DRAWS, BEST, PATIENCE = 24, 4, 60
"""Random parameters tried where states are hidden, how many of all fits with the strongest gain go on, and the
evaluations that each may take from there."""
MOST_DRAWN, LOOKED_AT = 300, 600_000
"""So many are drawn, of which the best `DRAWS` are fitted; fewer where their simulations would have more samples than
that together. A fit takes as long as a hundred looks. Of a two-mass drive (motor speed alone measured, wide bounds) one
draw of eight ended at 1.47 times the noise from 24 draws that nobody looked at."""
SAME = 1e-2
"""Starts whose unknowns differ by no more than this part lead to the same end. Of a standing person two regressions, on
the recorded and on the smoothed motion, differ by a thousandth, and each takes a third of the time of the whole."""
ALIKE = 1.02
"""Costs within 2 % are taken for those of the same optimum."""

HOPS, FARTHEST, LEAST = 40, 1.5, 1e-3
"""Fits from beside an optimum, of which a step has up to ten to the second standard errors; and the least singular
value, relative to the largest, that makes these errors: along what the outputs do not show, there is no end. Of a
pendulum that turns over in noise of two radians most of them find the turn that was lost."""
SHARES = (1.0, 0.1, 0.01)
"""Of the size of a hidden state, from which its initial value is looked for: bounds may be all that is known of it."""

Motion = tuple[np.ndarray, list[np.ndarray]]
"""(free parameters,) SI and, of every episode, states (samples, n)."""


def shoot(t: Transcription, candidates: Sequence[np.ndarray]) -> Motion | None:
    """Parameters and states of every episode that fit the recordings' outputs, or None.

    The search begins from each of the `candidates` (free parameters,) SI, and the best end is kept.
    Process noise enters only the final simulation of each episode. None where parameters belong to
    single recordings or the model has no states, or controls or algebraic variables, where from every candidate the
    first simulation errs by more than the recorded outputs vary, or where an episode cannot be simulated.
    """
    if not can_shoot(t):
        return None
    shooting = Shooting(t)
    starts = different([shooting.unknowns(c) for c in candidates])
    ends = [shooting.fit(z) for z in starts if shooting.follows(z)]
    if not agree([end.cost for end in ends], len(starts)) or shooting.hidden:
        ends += led(shooting, starts)
    if not ends:
        return None
    found = min(ends, key=lambda end: end.cost).x
    runs = [shooting.run(found, r, noise=noise) for r, noise in zip(t.recording_of, _noise(t), strict=True)]
    if any(run.diverged for run in runs):
        return None
    return (found * shooting.scale)[: len(t.layout.parameter_names)], [run.x for run in runs]


def different(starts: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Without those that are one before, but for `SAME` of each unknown: of clear data all regressions agree."""
    kept: list[np.ndarray] = []
    for z in starts:
        if not any(np.allclose(z, other, rtol=SAME, atol=0.0) for other in kept):
            kept.append(z)
    return kept


def motion_with(t: Transcription, parameters: np.ndarray) -> list[np.ndarray] | None:
    """Per episode states (samples, n) to begin from with these parameters (free,) SI, where the recording hides some.

    Those of simulations with them from the initial states that follow the recording best, led to it ever more weakly;
    where they do not follow it at last, the recorded states and the hidden ones of a simulation that is led. None where
    the recording shows all states.
    """
    if not hides(t):
        return None
    recorded = [t.measured[r].states[t.measured[r].nodes] for r in t.recording_of]
    if not can_shoot(t):
        return with_hidden(t, recorded)
    shooting = Shooting(t)
    firsts = [shooting.fit(shooting.unknowns(parameters, s), GAINS[0], kept=shooting.q) for s in SHARES]
    first = free = min(firsts, key=lambda end: end.cost).x
    for gain in (*GAINS[1:], 0.0):
        free = shooting.fit(free, gain, PATIENCE, kept=shooting.q).x
    if shooting.follows(free):
        return shooting.runs(free)
    return with_hidden(t, recorded, shooting.runs(first, GAINS[0]))


def agree(costs: Sequence[float], count: int) -> bool:
    """Whether all of `count` fits ended, with like costs."""
    return len(costs) == count and max(costs) <= ALIKE * min(costs)


def unlike(ends: Sequence[scipy.optimize.OptimizeResult]) -> list[scipy.optimize.OptimizeResult]:
    """Ends, sorted by cost, without those of the same optimum."""
    kept = list(ends[:1])
    for end in ends[1:]:
        if end.cost > ALIKE * kept[-1].cost:
            kept.append(end)
    return kept


def led(shooting: Shooting, starts: Sequence[np.ndarray]) -> list[scipy.optimize.OptimizeResult]:
    """Output-error fits that begin where fits of led simulations end."""
    draws = likely(shooting, GAINS[0]) if shooting.hidden else []
    ends = unlike(sorted((shooting.fit(z, GAINS[0]) for z in (*starts, *draws)), key=lambda end: end.cost))[:BEST]
    for gain in (*GAINS[1:], 0.0):
        ends = [shooting.fit(end.x, gain, PATIENCE) for end in ends]
    return [end for end in ends if shooting.follows(end.x)]


def tracked(shooting: Shooting, starts: Sequence[np.ndarray], anywhere: bool = False) -> Iterator[Motion]:
    """Parameters and states of every episode, of simulations that follow the recording, led as weakly as may be.

    anywhere : whether to begin from random parameters, too, as it does where states are hidden.

    Where the optimum is lost on the way, what was found before that is led still: states that jump a little at the
    samples are a start of a collocation where simulations alone lose the recording, as of chaotic systems.
    """
    anywhere = anywhere or shooting.hidden
    draws = likely(shooting, FINE_GAINS[0]) if anywhere else []
    ends = sorted((shooting.fit(z, FINE_GAINS[0], PATIENCE) for z in (*starts, *draws)), key=lambda end: end.cost)
    for end in unlike(ends)[: BEST if anywhere else len(starts)]:
        least, kept = end.cost, (end.x, FINE_GAINS[0])
        for gain in FINE_GAINS[1:]:
            end = shooting.fit(end.x, gain, PATIENCE)
            if end.cost <= RUNAWAY * least:
                least, kept = min(least, end.cost), (end.x, gain)
        found = _ended(shooting, *kept)
        if found is not None:
            yield found


def free(shooting: Shooting) -> Iterator[Motion]:
    """Simulations that nothing leads, fitted from the random parameters with which they err least.

    Where states are hidden, a strong lead can follow the recording best where these hardly change: of two tanks where
    the upper one, as large as a lake, feeds the lower one evenly. All led simulations then end there. And where the
    recorded motion is small, the parameters that move nothing err least: as many are fitted that nobody looked at.
    """
    draws = [*likely(shooting, 0.0), *(drawn(shooting, k) for k in range(DRAWS))]
    ends = sorted((shooting.fit(z, 0.0, PATIENCE) for z in draws), key=lambda end: end.cost)
    for end in unlike(ends)[:BEST]:
        found = _ended(shooting, end.x, 0.0)
        if found is not None:
            yield found


def along(shooting: Shooting, z: np.ndarray) -> Iterator[Motion]:
    """Simulations that are led strongly along the recording, fitted from the unknowns `z` of an optimum.

    Where its motion has lost a turn in the midst of the recording, or has one too many, no step of the parameters gives
    it back. Led, the motion makes the turns that are recorded, also of an angle of which a rate alone is.
    """
    for gain in STRONG:
        found = _ended(shooting, shooting.fit(z, gain, PATIENCE).x, gain) if shooting.leads(gain) else None
        if found is not None:
            yield found


def around(shooting: Shooting, z: np.ndarray) -> Iterator[Motion]:
    """Simulations that nothing leads, of less error than that of `z`, fitted from unknowns beside it.

    A motion that has lost a turn, or follows a slow part of it by a slower one, is some standard errors from one that
    has not; from parameters anywhere within their bounds hardly a fit comes near to either.
    """
    jacobian, residual = shooting.jacobian(z), shooting.residual(z)
    size = np.linalg.norm(jacobian, axis=0)
    size = np.where(size > 0, size, 1.0)
    _, values, directions = np.linalg.svd(jacobian / size, full_matrices=False)
    if not values[0] > 0:
        return  # nothing that was simulated moves an output
    error = np.sqrt(np.mean(residual**2)) / np.maximum(values, LEAST * values[0])
    draw, ends = np.random.default_rng(0), []
    for _ in range(HOPS):
        step = (draw.standard_normal(len(error)) * error) @ directions / size
        ends.append(shooting.fit(z + 10 ** draw.uniform(0, FARTHEST) * step, 0.0, PATIENCE))
    better = sorted((e for e in ends if ALIKE * e.cost < 0.5 * residual @ residual), key=lambda end: end.cost)
    for end in unlike(better)[:BEST]:
        found = _ended(shooting, end.x, 0.0)
        if found is not None:
            yield found


def _ended(shooting: Shooting, z: np.ndarray, gain: float) -> Motion | None:
    runs = shooting.runs(z, gain)
    return None if runs is None else ((z * shooting.scale)[: shooting.q], runs)


def likely(shooting: Shooting, gain: float) -> list[np.ndarray]:
    """z of `DRAWS` of many random parameters, with which simulations that are led by `gain` err least."""
    samples = sum(m.intervals for m in shooting.t.measured)
    draws = [drawn(shooting, k) for k in range(max(DRAWS, min(MOST_DRAWN, LOOKED_AT // samples)))]
    return sorted(draws, key=lambda z: shooting.led_error(z, gain))[:DRAWS]


def drawn(shooting: Shooting, number: int) -> np.ndarray:
    """z of random parameters within their bounds, over four decades where these do not change sign.

    Of every second one hidden states are drawn likewise: their size follows from parameters that are not known.
    """
    draw = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(number,)))
    lower, upper = (b * shooting.scale[: len(b)] for b in (shooting.lower[: shooting.q], shooting.upper[: shooting.q]))
    size = shooting.scale[: shooting.q]
    low, high = np.where(np.isfinite(lower), lower, -size), np.where(np.isfinite(upper), upper, size)
    top = np.where(high > 0, high, 1.0)
    even, decades = draw.uniform(low, high), top * 10 ** draw.uniform(np.log10(np.maximum(low / top, 1e-4)), 0)
    share = 10 ** draw.uniform(-4, 0, shooting.t.layout.n) if number % 2 else 1.0
    return shooting.unknowns(np.where(low >= 0, decades, even), share)


def _noise(t: Transcription) -> list[dict[str, np.ndarray]]:
    """Per episode the noise by name at all nodes; the last node's is not used."""
    last = np.zeros((1, len(t.model.noises)))
    return [dict(zip(t.model.noises, np.vstack([d.noise, last]).T, strict=True)) for d in t.program.data]
