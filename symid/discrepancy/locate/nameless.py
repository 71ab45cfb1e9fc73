"""What acts and has no name: the rest that is left, and a flexible law that takes its place in the model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import log

from symid.discrepancy.locate.flexible_law import FlexibleLaw, flexible_law
from symid.discrepancy.locate.rest import Rest, rest_of
from symid.discrepancy.model.hypothesis import Hypothesis, refit
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.estimation.independence import independent_share


@dataclass(frozen=True, eq=False)
class Nameless:
    """Of a diagnosis that ends with something unexplained; None where no force at a place explains more.

    Attributes
    ----------
    rest : what the model lacks, given the effects that are named (without these, where a flexible law explains more
        in their place). flexible : the flexible law.
    """

    rest: Rest | None = None
    flexible: FlexibleLaw | None = None


def nameless(found: Hypothesis, data: Data, progress: Callable[[str], None] = lambda text: None) -> Nameless:
    """Describe what `found` leaves, on top of the model as given and of that with the named effects."""
    named = [s for s in found.suspects if s.established]
    fits = [found.base]
    if named:
        with_names = found.fit if len(named) == len(found.suspects) else refit(named, found.fit, found.base, data)
        fits += [] if with_names is None else [with_names]
    progress("what has no name is described")
    flexible = flexible_law(fits, data, progress)
    return Nameless(rest_of(fits[-1] if flexible is None else flexible.base, data), flexible)


def improved(found: Hypothesis, flexible: FlexibleLaw | None) -> Fit:
    """The better fit of the two: what was found by name, or the flexible law, which pays log N for each unknown."""
    if flexible is None:
        return found.fit
    share = independent_share(flexible.fit.remaining)
    more = len(flexible.fit.values) - len(found.fit.values)
    price = log(max(share * flexible.data.samples, 2.0)) * more
    return flexible.fit if share * (flexible.fit.loglik2 - found.fit.loglik2) > price else found.fit
