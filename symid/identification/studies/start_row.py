"""One start of an identification in a line: how it ended, and where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symid.identification.uncertainty.sensitivity import outputs_and_targets
from symid.ipopt_solver import SolverResult
from symid.transcription import Transcription


@dataclass(frozen=True)
class StartRow:
    """One start and how it ended: RMS over all outputs in their SI unit (rad for angles).

    `status` is Ipopt's, or "failed" (symid refused, `message` says why), or "lost" (its worker died, or the machine
    failed otherwise).
    """

    number: int
    kind: str
    solved: bool
    status: str
    objective: float
    rms: float
    iterations: int
    seconds: float
    parameters: dict[str, float]
    message: str = ""

    @property
    def final(self) -> bool:
        """Whether doing it again would give the same: not where the machine is to blame."""
        return self.status not in ("lost", "Insufficient_Memory")

    @classmethod
    def of(cls, t: Transcription, result: SolverResult, kind, number: int, at_start: float) -> StartRow:
        error = np.concatenate([(y - d).ravel() for y, d in outputs_and_targets(t, result.z)])
        values = dict(zip(t.layout.parameter_names, map(float, t.layout.parameters(result.z)), strict=True))
        return cls(
            number=number,
            kind=kind if isinstance(kind, str) else "given",
            solved=result.solved,
            status=result.status_name,
            objective=result.objective,
            rms=float(np.sqrt(np.nanmean(error**2))),
            iterations=result.iterations,
            seconds=result.seconds["total"] + at_start,
            parameters=values,
            message=result.message,
        )

    @classmethod
    def without_result(cls, status: str, kind, number: int, message: str) -> StartRow:
        return cls(
            number=number,
            kind=kind if isinstance(kind, str) else "given",
            solved=False,
            status=status,
            objective=np.nan,
            rms=np.nan,
            iterations=0,
            seconds=0.0,
            parameters={},
            message=message,
        )
