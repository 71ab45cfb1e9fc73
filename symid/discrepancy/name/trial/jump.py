"""How abruptly dry friction sets in, told by the recording: before friction is looked for, or once it is found.

Likewise within which width a level counts as zero, of a loss that follows its sign or its root.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from math import inf

import numpy as np

from symid.discrepancy.locate.projection import Projection
from symid.discrepancy.model.dry import PARTS, WIDER, widths
from symid.discrepancy.model.hypothesis import Hypothesis, hypothesis, polished, refit
from symid.discrepancy.model.levels import level_widths
from symid.discrepancy.model.suspects import Suspect
from symid.discrepancy.policy import POLICY
from symid.estimation.fitting.fit import Fit
from symid.estimation.sensors.independence import price_of_one
from symid.estimation.signals.data import Data
from symid.mechanics.missing.laws.shared import port_at
from symid.mechanics.missing.terms import LIBRARY
from symid.model import Constant, Model
from symid.simulation import simulator
from symid.threads import in_threads

FINER = 1.7, 1.3, 1.15
"""Factors by which neighbours of the best width are tried, one after the other: it ends within a tenth."""
COARSE = 10.0
"""Factor between the widths that are fitted once friction is found. From the best of them it is one more unknown: where
a sensor is very good a few percent leave an error that can be seen."""
NEARBY = 1.5
"""Factor at which a likelihood that rises from the width that was made shows it, to a wider one or a sharper."""
ITERATIONS = 10
"""Of a fit with another width."""


def with_likeliest_jumps(given: Model, fit: Fit, data: Data) -> Fit:
    """The same fit of a model whose dry friction sets in as abruptly as its innovations like best.

    Only where random forces act: each sample then corrects the path along which friction is tried (Rao's score;
    1948). A wider jump than the sharpest must be worth an unknown.

    Parameters
    ----------
    given : the model as its user stated it; the friction speeds that it states keep their values.
    """
    made = [c for c in fit.model.find("friction_speed") if c.name not in given.constants]
    if fit.kalman_gain is None or not made:
        return fit
    projection = Projection(fit, data)
    return replace(fit, model=fit.model.with_constants(**{c.name: _likeliest(c, projection) for c in made}))


def _likeliest(width: Constant, projection: Projection) -> float:
    """The value of one friction speed, [m/s] or [rad/s], by the score of dry friction at its joint.

    Friction with the speed may act, too: without it a wide jump would imitate the two.
    """
    model, data = projection.fit.model, projection.data

    def columns(law: str, key: str, speed: float) -> list[np.ndarray]:
        suspect = Suspect(LIBRARY[law].at(width.at))
        tried = model.with_constants(**{width.name: speed}).with_term(suspect.term)
        found = projection.response(suspect, simulator(tried), {key: 0.0})
        return [] if found is None else [found]

    viscous = columns("viscous_friction", "coefficient_Nms_rad", width.value)

    @cache
    def score(speed: float) -> float:
        dry = columns("coulomb_friction", "torque_Nm", speed)
        return projection.score(np.hstack([*dry, *viscous]))[0] if dry else 0.0

    sharp, *wider = _widths_at(model, width, data)
    best = max([sharp, *wider], key=score)
    for factor in FINER if best != sharp else ():
        best = max([best / factor, best, best * factor], key=score)
    return best if score(best) > score(sharp) + POLICY.accept else sharp


def with_fitted_jumps(
    found: Hypothesis,
    made: Sequence[str],
    known: Model,
    told: Mapping[str, float] | None = None,
    moves: Data | None = None,
) -> Hypothesis:
    """The same suspects with dry friction that sets in as abruptly as the recording likes best, of a free motion.

    Another jump than the one that was made must be worth an unknown.

    Parameters
    ----------
    made : the friction speeds and level widths that nobody stated. known : those count on which this model does not
        depend yet.
    told : what another law at their joint likes best, from which this one begins.
    moves : data whose speeds say how wide a jump may be, where those that are fitted are slower.
    """
    if found.fit.kalman_gain is not None:
        return found
    for name in _used(found, made, known):
        found = _Widths(found, name, moves).best((told or {}).get(name))
    return found


def with_jumps_again(found: Hypothesis, made: Sequence[str]) -> Hypothesis:
    """The same suspects with another abruptness of dry friction, wherever it is, or else near its present one.

    Other inputs between their samples ask for another one. Parameters as of `with_fitted_jumps`.
    """
    for name in _used(found, made, found.base.model):
        widths_of = _Widths(found, name)
        scanned = widths_of.best(None)
        found = widths_of.best(widths_of.sharp) if scanned is found else scanned
    return found


def with_jumps_beside(found: Hypothesis, made: Sequence[str], less: Hypothesis) -> Hypothesis:
    """The same suspects with dry friction that `less` had already as abrupt as it is likeliest beside what is new.

    Where a sensor is very good, the last percents of it would become a wrong gain or length. Parameters as of
    `with_fitted_jumps`.
    """
    if found.fit.kalman_gain is None:
        had = _used(less, made, less.base.model)
        for name in (n for n in _used(found, made, found.base.model) if n in had):
            before = None
            while found is not before:  # a free width stays within a decade of where it began
                before, widths_of = found, _Widths(found, name)
                found = widths_of.best(widths_of.sharp)
    return found


def with_sharp_jumps(found: Hypothesis, made: Sequence[str], pool: Sequence[Suspect]) -> Hypothesis:
    """The same suspects with dry friction that jumps, or friction with the speed beside it, if that is believed more.

    Dry friction that sets in over speeds at which a joint moves imitates the two, with as many unknowns; and another
    suspect may make up for what it does not.
    """
    for name in _used(found, made, found.base.model):
        found = _sharpened(found, found.base.model[name], pool)
    return found


def _sharpened(found: Hypothesis, width: Constant, pool: Sequence[Suspect]) -> Hypothesis:
    """`with_sharp_jumps` at one joint."""
    sharp, wide, *_ = _widths_at(found.base.model, width, found.data)
    if width.value < wide:
        return found
    viscous = [s for s in pool if s.term.name == "viscous_friction" and s.term.location == width.at]
    beside = [s for s in viscous if s.term not in {t.term for t in found.suspects}]
    off = beside[0].off if beside else {}
    base = replace(found.base, model=found.base.model.with_constants(**{width.name: sharp}))
    dry = [s for s in found.suspects if width.symbol in _symbols(base.model.with_term(s.term)) - _symbols(base.model)]
    spare = [t for t in found.suspects if t not in dry and t not in viscous]
    kept = [found.suspects, *([s for s in found.suspects if s is not t] for t in spare)]
    sets = [[*k, *beside] for k in kept] + [list(found.suspects)] * len(beside)
    tried = in_threads(lambda s: hypothesis(s, found.fit, base, found.data, off), sets)
    both = [h for h in tried if h is not None]
    share = max([found, *both], key=lambda h: h.log_ratio).share

    def believed(h: Hypothesis) -> float:
        return h.evidence(share) - h.belief()

    best = max(both, key=believed, default=found)
    one_less = price_of_one(share * found.data.samples)
    return polished(best) if best is not found and believed(best) > believed(found) - one_less else found


def with_jumps_of(fit: Fit, base: Fit, made: Sequence[str]) -> Fit:
    """`base` with dry friction that sets in as in the model of `fit`: itself, where it does."""
    other = {n: fit.model.constants[n].value for n in made}
    if all(base.model.constants[n].value == v for n, v in other.items()):
        return base
    return replace(base, model=base.model.with_constants(**other))


class _Widths:
    """A hypothesis fitted with other values of one friction speed or level width."""

    def __init__(self, found: Hypothesis, name: str, moves: Data | None = None):
        self.found, self.name, self.model = found, name, found.base.model
        self.sharp = self.model.constants[name].value
        _, self.wide, *_, self.widest = _widths_at(self.model, self.model[name], moves or found.data)
        self.tried: dict[float, Hypothesis | None] = {self.sharp: found}

    def best(self, told: float | None) -> Hypothesis:
        """The hypothesis with the likeliest width if that is worth an unknown; from `told`, else from a scan."""
        found = self.found
        if told is None or (told != self.sharp and self.score(told) <= found.log_ratio):
            told = self._scanned()
            if told == self.sharp and not self._is_peak():
                return found
        free = self._freed(told)
        if free is not None:
            width = free.values[self.name]
            self.tried.setdefault(width, self._fitted(width, free))
        width = max(self.tried, key=self.score)
        # What is as good as a jump says nothing else than one; a wide one would imitate friction with the speed.
        share = found.share if width >= self.wide else 1.0
        price = POLICY.accept + price_of_one(share * found.data.samples)
        likelier = self.tried[width]
        return polished(likelier) if share * (likelier.log_ratio - found.log_ratio) > price else found

    def fitted(self, width: float) -> Hypothesis | None:
        if width not in self.tried:
            # What the sharpest jump was fitted to may be wrong values of all else, which a wider one leads away from.
            nearest = self.tried[max(self.tried, key=self.score)]
            self.tried[width] = self._fitted(width, nearest.fit)
        return self.tried[width]

    def score(self, width: float) -> float:
        fitted = self.fitted(width)
        return -inf if fitted is None else fitted.log_ratio

    def _fitted(self, width: float, near: Fit) -> Hypothesis | None:
        suspects, data = self.found.suspects, self.found.data
        base = replace(self.found.base, model=self.model.with_constants(**{self.name: width}))
        fit = refit(suspects, replace(near, substeps=1, coarse=1), base, data, iterations=ITERATIONS)
        return None if fit is None else Hypothesis(suspects, fit, base, data)

    def _scanned(self) -> float:
        """The best of a few widths, from wide to sharp: sharp corners ask for short steps of the integrator."""
        best, width = self.sharp, self.widest
        while width > self.sharp and (best == self.sharp or self.score(width) >= self.score(best)):
            best, width = max(best, width, key=self.score), width / COARSE
        if best != self.sharp:
            return best
        # It may lie before the last that was wider; or sensors, many samples together, see more than was thought.
        return next((w for w in self._nearby() if self.score(w) > self.score(best)), best)

    def _nearby(self) -> tuple[float, float]:
        return NEARBY * self.sharp, self.sharp / NEARBY

    def _is_peak(self) -> bool:
        """Whether the likelihood falls to both sides of the width that was made, so that its peak is between them.

        A width that was fitted to another model is as near: that of a rotary pendulum's arm was 17 % too wide, and what
        that left was taken for a Stribeck curve (tests/discrepancy/search/test_jump.py).
        """
        return all(self.score(w) < self.found.log_ratio - POLICY.accept for w in self._nearby())

    def _freed(self, width: float) -> Fit | None:
        """The fit with the width as one more unknown, from one that was fitted."""
        least = self.sharp if width > self.sharp else PARTS[0] * self.widest / WIDER[-1]  # that part of the usual speed
        bounds = max(width / COARSE, least), min(width * COARSE, self.widest)
        free = self.model.with_constants(**{self.name: width}).free(**{self.name: bounds})
        base = replace(self.found.base, model=free)
        return refit(self.found.suspects, self.tried[width].fit, base, self.found.data, {self.name: width})


def _widths_at(model: Model, width: Constant, data: Data) -> tuple[float, ...]:
    if width.role == "level_width":
        return level_widths(model, width.at, data.segments)
    return widths(model, port_at(model, "joint", width.at), data.segments, data.sensor_noise)


def _used(found: Hypothesis, made: Sequence[str], known: Model) -> list[str]:
    """Those of the widths on which the model of a fit depends, and a `known` one does not."""
    model = found.fit.model
    return [n for n in made if model[n].symbol in _symbols(model) - _symbols(known)]


def _symbols(model: Model) -> set:
    return set().union(*(e.free_symbols for e in model.residual()))
