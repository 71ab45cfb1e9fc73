"""The finding: what the model leaves out, where, how large, how sure."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from symid.discrepancy.design.experiment import Experiment, experiments
from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.flexible_law import FlexibleLaw
from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.locate.rest import Rest
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.closed_form import Proposal
from symid.discrepancy.prove.evidence import Evidence
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.discrepancy.prove.held_out import Proof
from symid.discrepancy.prove.nameless import Nameless
from symid.discrepancy.say.answer import answer_of
from symid.discrepancy.say.html import html_of
from symid.errors import DiagnosisError
from symid.estimation.bodies import Determined
from symid.estimation.fitting.fit import Fit
from symid.estimation.free_run import FreeRun
from symid.estimation.signals.data import Data
from symid.files import write_atomically
from symid.identification.fit import common_unit
from symid.mechanics.missing.laws.shared import parameter_name
from symid.model import Model
from symid.units import column_name


@dataclass(frozen=True)
class Effect:
    """One piece of missing physics.

    Attributes
    ----------
    parameters : key -> (value, standard error), SI.
    window : start and end [s] of an effect that lasts only for a time, or that begins at one.
    log_ratio : growth of twice the log-likelihood that is lost without it.
    established : whether its name is an answer; else it says what something unexplained looks like.
    name, location : the law, and the place at which it acts. sentence : what it does, with its size.

    Examples
    --------
    >>> for effect in found.effects:                                              # doctest: +SKIP
    ...     print(effect.sentence, effect.parameters)
    """

    name: str
    location: str
    parameters: dict[str, tuple[float, float]]
    window: tuple[float, float] | None
    log_ratio: float
    sentence: str = ""
    established: bool = True


@dataclass(frozen=True, eq=False, repr=False)
class Diagnosis:
    """What `diagnose` found.

    Attributes
    ----------
    verdict : ``"missing_physics"``, ``"adequate"`` or ``"unexplained"``.
    effects : what is missing; for ``unexplained`` one entry with the place and what it looks like.
    ranking : all suspects that were refitted, by score. equivalent : those that explain as much.
    baseline, final : fits before and after. improved : the model with the found terms.
    runs : free simulations by ``baseline_train``, ``baseline_heldout``, ``augmented_train``, ``augmented_heldout``.
    remainder : tests for something left over. words : the finding in sentences.
    audit : noise of the sensors, and whether the recording was filtered. halves : each effect on two halves;
    verdicts_of_halves : what either half alone says, where what is left is not random.
    proof : held-out errors before and after, compared; None without held-out data or effects.
    unnamed : what acts and has no name: `rest`, `flexible`, `proposal`. data : what the models were fitted to.
    bodies : what the motion determines of bodies that are not known.
    false_alarm_probability : that chance alone makes the best suspect look as good as the weakest effect that was found
        (of an adequate model: as the best suspect); None where that cannot be told.

    Examples
    --------
    >>> found = si.diagnose_case(si.read_case("data/concealed/cases/r01"))       # doctest: +SKIP
    >>> found.verdict, found.confirmed                                           # doctest: +SKIP
    ('missing_physics', True)
    """

    verdict: str
    effects: tuple[Effect, ...]
    ranking: tuple[Hypothesis, ...]
    equivalent: tuple[Hypothesis, ...]
    baseline: Fit
    final: Fit
    runs: dict[str, FreeRun]
    remainder: tuple[Test, ...]
    words: str
    audit: Audit
    halves: tuple[Survival, ...] = ()
    verdicts_of_halves: tuple[HalfVerdict, ...] = ()
    proof: Proof | None = None
    false_alarm_probability: float | None = None
    unnamed: Nameless = Nameless()
    data: Data | None = None
    bodies: tuple[Determined, ...] = ()

    @property
    def rest(self) -> Rest | None:
        """What an unexplained recording lacks, as a force along its motion; None for any other verdict."""
        return self.unnamed.rest

    @property
    def flexible(self) -> FlexibleLaw | None:
        """The flexible law that stands for it, a fit of its own: ``flexible.model``, ``flexible.fit.values``."""
        return self.unnamed.flexible

    @property
    def proposal(self) -> Proposal | None:
        """The simplest closed form that does as well: ``proposal.law``, ``proposal.expression``, ``proposal.model``."""
        return self.unnamed.proposal

    @property
    def improved(self) -> Model:
        """The model with the found terms."""
        return self.final.model

    @property
    def values(self) -> dict[str, float]:
        """Parameters of the improved model, SI."""
        return self.final.values

    def experiments(self, progress: Callable[[str], None] = lambda text: None) -> list[Experiment]:
        """For each of `equivalent` the experiment that would tell it from what was found, by simulation of both.

        ``e.design.words`` says what to do, ``e.log_ratio`` what is to be expected of it, ``e.splits`` whether that is
        enough, and ``e.recording(e.finding, seed=0)`` what would be recorded if the finding is true.

        Parameters
        ----------
        progress : called with a line of text now and then.
        """
        if self.data is None:
            return []
        finding = Hypothesis((), self.final, self.baseline, self.data)
        tried = [experiments(finding, rival, self.data, progress) for rival in self.equivalent]
        return [found[0] for found in tried if found]

    def answer(self) -> dict[str, Any]:
        """The finding as plain numbers and text, in the answer format."""
        return answer_of(self)

    @property
    def named(self) -> tuple[Effect, ...]:
        """Those of `effects` that a law names: not the unknown that is left."""
        return tuple(e for e in self.effects if e.name != "unknown")

    @property
    def confirmed(self) -> bool | None:
        """Whether held-out data prove what was found; None where there is neither."""
        return None if self.proof is None or not self.effects else self.proof.confirmed

    @property
    def unit(self) -> str:
        """SI unit of all outputs, or "mixed"."""
        return common_unit(y.unit for y in self.baseline.model.outputs.values()) or "mixed"

    def report(self, path: str | Path) -> Path:
        """Write a self-contained HTML report with figures.

        Parameters
        ----------
        path : of the file.

        Raises
        ------
        WriteError : the file cannot be written.
        """
        # Reports stand on the roof, and a diagnosis must not need them: fetched by name when asked for.
        write = import_module("symid.report").write_diagnosis_report
        return Path(write(self, path, f"Diagnosis of {self.baseline.model.name}"))

    def to_json(self, path: str | Path) -> Path:
        """Write the answer; the file appears when it is whole.

        Parameters
        ----------
        path : of the file.

        Raises
        ------
        WriteError : the file cannot be written.
        """
        return write_atomically(path, json.dumps(self.answer(), indent=1))

    def held_out_csv(self, path: str | Path) -> Path:
        """Write the improved model's prediction of the held-out window, columns as in the recording.

        Parameters
        ----------
        path : of the file.

        Raises
        ------
        WriteError : the file cannot be written.
        DiagnosisError : there was no held-out window.
        """
        run = self.runs.get("augmented_heldout")
        if run is None:
            raise DiagnosisError("held_out_csv: there was no held-out window; diagnose(..., held_out=(start, end))")
        names = [column_name(y.channel, y.unit) for y in self.improved.outputs.values()]
        rows = [
            ["time_s", *names],
            *([f"{t:.6f}", *(f"{v:.9g}" for v in y)] for t, y in zip(run.time, run.simulated, strict=True)),
        ]
        text = "".join(",".join(r) + "\n" for r in rows)
        return write_atomically(path, text)

    def __str__(self) -> str:
        return self.words

    def __repr__(self) -> str:
        found = ", ".join(f"{e.name} at {e.location}" for e in self.effects)
        return f"<Diagnosis: {self.verdict}{': ' * bool(found)}{found}>"

    def _repr_html_(self) -> str:
        return html_of(self)

    def unit_of(self, effect: Effect, key: str) -> str:
        """Unit of one parameter of an effect, as the improved model declares it; "1" for what is no parameter of it.

        Parameters
        ----------
        effect : one of `effects`. key : name of its parameter.
        """
        part = self.improved.parameters.get(parameter_name(effect.name, effect.location, key))
        return "1" if part is None else part.unit


def finding(
    verdict: str,
    effects: tuple[Effect, ...],
    equivalent: tuple[Hypothesis, ...],
    ranking: Sequence[Hypothesis],
    base: Fit,
    evidence: Evidence,
    audit: Audit,
    text: str,
) -> Diagnosis:
    """The finding, from what was judged and the evidence on which it rests."""
    e = evidence
    return Diagnosis(
        verdict,
        effects,
        tuple(ranking),
        equivalent,
        base,
        e.final,
        e.runs,
        tuple(e.left),
        text,
        audit,
        e.survived,
        e.halves,
        e.proof,
        e.chance,
        e.unnamed,
        e.found.data,
    )
