"""What there is to tell of a diagnosis, and how its numbers are written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.prove.evidence import Evidence
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.discrepancy.prove.held_out import Proof
from symid.discrepancy.say.diagnosis import Effect
from symid.estimation.fitting.fit import Fit
from symid.estimation.free_run import FreeRun
from symid.estimation.sensors.zero_phase import ZeroPhase
from symid.estimation.signals.data import Data
from symid.identification.fit import common_unit, rms_text
from symid.model import Model
from symid.units import quantity


def listed(items: Sequence[str], last: str = "and") -> str:
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} {last} {items[-1]}"


def capital(text: str) -> str:
    return text[:1].upper() + text[1:]


@dataclass(frozen=True, eq=False)
class Story:
    """What there is to tell.

    pieces : seconds of those in which a motion is compared that cannot be followed from one state for longer.
    input_noise : channel -> standard deviation [SI], where recorded inputs are taken to have noise.
    """

    verdict: str
    effects: tuple[Effect, ...]
    equivalent: tuple[Hypothesis, ...]
    ranking: Sequence[Hypothesis]
    evidence: Evidence
    audit: Audit
    base: Fit
    data: Data
    pieces: float | None = None
    input_noise: Mapping[str, float] = field(default_factory=dict)

    @property
    def left(self) -> Sequence[Test]:
        return self.evidence.left

    @property
    def runs(self) -> Mapping[str, FreeRun]:
        return self.evidence.runs

    @property
    def survived(self) -> tuple[Survival, ...]:
        return self.evidence.survived

    @property
    def halves(self) -> tuple[HalfVerdict, ...]:
        return self.evidence.halves

    @property
    def white(self) -> bool:
        return self.evidence.white

    @property
    def proof(self) -> Proof | None:
        return self.evidence.proof

    @property
    def chance(self) -> float | None:
        return self.evidence.chance

    @property
    def driven(self) -> bool:
        return self.base.kalman_gain is not None

    @property
    def filter(self) -> ZeroPhase | None:
        return self.data.filter

    @property
    def model(self) -> Model:
        return self.base.model

    def error(self, errors: np.ndarray, beside: np.ndarray | None = None) -> str:
        """The rms errors (m,) of the outputs, as one number where they share a unit; in units that suit those `beside`,
        with which they are compared.
        """
        if not np.all(np.isfinite(errors)):
            return "infinity, since it diverges"
        others = np.zeros_like(errors) if beside is None else beside
        unit = common_unit(y.unit for y in self.model.outputs.values())
        if unit is not None:
            rms, other = (float(np.sqrt(np.mean(np.square(e)))) for e in (errors, others))
            return rms_text(rms, unit, digits=3, beside=other)
        return listed(
            [
                f"{quantity(e, unit=y.unit, beside=o)} of {y.channel}"
                for e, o, y in zip(errors, others, self.model.outputs.values(), strict=True)
            ]
        )

    def channels(self, values: np.ndarray) -> str:
        """One number for each output, with its unit."""
        return listed(
            [quantity(float(v), unit=y.unit) for v, y in zip(values, self.model.outputs.values(), strict=True)]
        )
