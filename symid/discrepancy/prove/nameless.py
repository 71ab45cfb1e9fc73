"""What acts without a name: the rest, a flexible law in its place, and a closed form that does as well."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from symid.discrepancy.locate.flexible_law import FlexibleLaw, flexible_law
from symid.discrepancy.locate.rest import Rest, rest_of
from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.discrepancy.name.closed_form import Proposal, closed_form
from symid.discrepancy.policy import POLICY
from symid.discrepancy.prove.held_out import compare
from symid.estimation.fitting.fit import Fit
from symid.estimation.free_run import free_run
from symid.estimation.sensors.independence import independent_share, price_of_one
from symid.estimation.signals.data import Data

WORSE = 1.1
"""A closed form does as well as the flexible law if its held-out error is at most so many times that of the law."""


@dataclass(frozen=True, eq=False)
class Nameless:
    """Of a diagnosis that ends with something unexplained; None where no force at a place explains more.

    Attributes
    ----------
    rest : what the model lacks, given the effects that are named (without these, where a flexible law explains more
        in their place). flexible : the flexible law. proposal : the simplest closed form that does as well.
    errors : rms (m,) of the free runs on the held-out window of ``flexible`` and ``proposal`` and, where nothing random
        moves the system, of the ``names`` alone; empty without a window.
    refuted : whether the flexible law follows the held-out window worse than the names alone: splines that follow the
        rest of a wide swing need not do so in a small one. No closed form is proposed that does.
    """

    rest: Rest | None = None
    flexible: FlexibleLaw | None = None
    proposal: Proposal | None = None
    errors: dict[str, np.ndarray] = field(default_factory=dict)
    refuted: bool = False

    @property
    def fits(self) -> list[Fit]:
        """Of the flexible law, where the held-out data do not speak against it, and of the proposal."""
        flexible = None if self.refuted else self.flexible
        return [law.fit for law in (flexible, self.proposal) if law is not None]


def nameless(
    found: Hypothesis, data: Data, held_out: Data | None, progress: Callable[[str], None] = lambda text: None
) -> Nameless:
    """Describe what `found` leaves, on top of the model as given and of that with the named effects."""
    named = [s for s in found.suspects if found.is_named(s)]
    fits = [found.base]
    if named:
        with_names = found.fit if len(named) == len(found.suspects) else refit(named, found.fit, found.base, data)
        fits += [] if with_names is None else [with_names]
    progress("what has no name is described")
    flexible = flexible_law(fits, data, progress)
    if flexible is None or improved(found, Nameless(flexible=flexible)) is found.fit:
        return Nameless(rest_of(fits[-1], data))  # a law of the library, if only a hypothesis, explains more
    rest, proposal = rest_of(flexible.base, data), closed_form(flexible, progress)
    if held_out is None:
        return Nameless(rest, flexible, proposal)
    run = free_run(flexible.fit, held_out)
    errors, enough = {"flexible": run.errors}, np.inf
    if found.suspects and found.fit.kalman_gain is None:
        names = free_run(found.fit, held_out)
        errors, enough = errors | {"names": names.errors}, names.relative
    if proposal is not None:
        other = free_run(proposal.fit, held_out)
        as_well = other.relative <= WORSE * run.relative or compare(other, run).probability < POLICY.confirm
        proposal = proposal if as_well and other.relative <= enough else None
        errors |= {"proposal": other.errors} if proposal is not None else {}
    refuted = "names" in errors and not run.relative <= enough  # nor where it diverges
    return Nameless(rest, flexible, proposal, errors, refuted)


def improved(found: Hypothesis, unnamed: Nameless) -> Fit:
    """The best of all fits: of what was found by name, of the flexible law, of the closed form; unknowns pay log N."""
    fits = [found.fit, *unnamed.fits]
    share = independent_share(max(fits, key=lambda f: f.loglik2).remaining)
    price = price_of_one(share * found.data.samples)
    return max(fits, key=lambda f: share * f.loglik2 - price * len(f.values))
