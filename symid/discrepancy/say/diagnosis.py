"""The finding: what the model leaves out, where, how large, how sure."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from html import escape
from importlib import import_module
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from symid.analysis.bodies import Determined
from symid.errors import DiagnosisError
from symid.discrepancy.locate.audit import Audit
from symid.discrepancy.locate.flexible_law import FlexibleLaw
from symid.discrepancy.locate.remainder import Test
from symid.discrepancy.locate.rest import Rest
from symid.discrepancy.model.hypothesis import Hypothesis
from symid.discrepancy.name.closed_form import Proposal, proposal_table
from symid.discrepancy.prove.evidence import Evidence
from symid.discrepancy.prove.experiment import Experiment, experiments
from symid.discrepancy.prove.halves import HalfVerdict, Survival
from symid.discrepancy.prove.nameless import Nameless
from symid.discrepancy.prove.held_out import Proof
from symid.estimation.data import Data
from symid.estimation.fit import Fit
from symid.estimation.free_run import FreeRun
from symid.files import write_atomically
from symid.identification.fit import common_unit
from symid.mechanics.laws import parameter_name
from symid.model import Model
from symid.units import column_name, quantity

FORMAT = 1


@dataclass(frozen=True)
class Effect:
    """One piece of missing physics.

    Attributes
    ----------
    parameters : key -> (value, standard error), SI.
    window : start and end [s] of an effect that lasts only for a time, or that begins at one.
    log_ratio : growth of twice the log-likelihood that is lost without it.
    established : whether its name is an answer; else it says what something unexplained looks like.
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
        return {
            "format": FORMAT,
            "verdict": self.verdict,
            "effects": [
                {
                    "name": e.name,
                    "location": e.location,
                    "time_window_s": None if e.window is None else list(e.window),
                    "parameters": {k: _value(*v) for k, v in e.parameters.items()},
                }
                for e in self.effects
            ],
            "ranking": self._ranking(),
            "equivalent": [
                {
                    "name": c.suspect.term.name,
                    "location": c.suspect.term.location,
                    "why": f"explains the recording almost as well (score {c.score:.1f})",
                }
                for c in self.equivalent
            ],
            "confirmed": self.confirmed,
            "false_alarm_probability": self.false_alarm_probability,
            "proof": None if self.proof is None else asdict(self.proof),
            "fit": {"baseline": self._errors("baseline"), "augmented": self._errors("augmented")},
            "halves": [self._half(s) for s in self.halves],
            "verdicts_of_halves": [
                {
                    "span_s": list(v.span),
                    "verdict": v.verdict,
                    "better_explained_by": None
                    if v.rival is None
                    else {"name": v.rival.term.name, "location": v.rival.term.location},
                }
                for v in self.verdicts_of_halves
            ],
            "recording": self._recording(),
            "remainder": [
                {
                    "location": t.place,
                    "what": t.what,
                    "gain": t.log_ratio,
                    "degrees_of_freedom": t.size,
                    "minus_log10_probability": min(t.minus_log10_p, 300.0),
                }
                for t in self.remainder[:3]
            ],
            "rest": None if self.rest is None else self.rest.table(),
            "proposal": None if self.proposal is None else proposal_table(self.proposal),
            "flexible_law": None if self.flexible is None else self.flexible.table(),
            "bodies": [vars(b) for b in self.bodies],
            "words": self.words,
        }

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

    def _errors(self, when: str) -> dict[str, Any]:
        """RMS errors of free runs in the outputs' unit, by segment and by channel; radians under the old keys, too."""
        channels = [y.channel for y in self.baseline.model.outputs.values()]
        found: dict[str, Any] = {"unit": self.unit}
        for part in ("train", "heldout"):
            run = self.runs.get(f"{when}_{part}")
            if run is None:
                continue
            pieces = [r for _, r in run.of_segments()]
            errors = np.sqrt(np.mean((run.simulated - run.recorded) ** 2, axis=0))
            found |= {
                f"{part}_rms": run.rms,
                f"{part}_rms_by_channel": dict(zip(channels, map(float, errors), strict=True)),
            }
            found |= {f"{part}_rms_of_segments": pieces} if len(pieces) > 1 else {}
            if self.unit == "rad":
                found |= {f"{part}_rms_rad": run.rms} | (
                    {f"{part}_rms_rad_of_segments": pieces} if len(pieces) > 1 else {}
                )
        return found

    @staticmethod
    def _half(s: Survival) -> dict[str, Any]:
        return {
            "name": s.name,
            "location": s.location,
            "survives": not s.reason,
            "reason": s.reason or None,
            "halves": [
                {
                    "span_s": list(h.span),
                    "score": h.score if isfinite(h.score) else None,
                    "parameters": {k: _value(*v) for k, v in h.parameters.items()},
                }
                for h in s.halves
            ],
        }

    def _recording(self) -> dict[str, Any]:
        names = [y.channel for y in self.improved.outputs.values()]
        return {
            "sensor_noise": dict(zip(names, map(float, self.audit.noise), strict=True)),
            "sensor_noise_stated": bool(self.audit.stated.all()),
            "filtered_above_Hz": {
                k: f for k, f in zip(names, map(float, self.audit.cutoff), strict=True) if isfinite(f)
            },
        }

    def _ranking(self) -> list[dict[str, Any]]:
        """The effects that were found, then the other suspects by score."""
        found = [{"name": e.name, "location": e.location, "score": e.log_ratio} for e in self.effects]
        taken = {(e["name"], e["location"]) for e in found}
        return found + [
            {"name": t.name, "location": t.location, "score": c.score}
            for c in self.ranking
            if ((t := c.suspect.term).name, t.location) not in taken
        ]

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
        cell = "style='text-align:left;padding:2px 14px 2px 0'"
        rows = [["effect", "place", "value (± standard error)"]] if self.effects else []
        rows += [
            [
                e.name.replace("_", " "),
                e.location,
                ", ".join(f"{k}: {quantity(*v, self.unit_of(e, k))}" for k, v in e.parameters.items()) or e.sentence,
            ]
            for e in self.effects
        ]
        table = "".join(
            "<tr>" + "".join(f"<{kind} {cell}>{escape(x)}</{kind}>" for x in row) + "</tr>"
            for row, kind in zip(rows, ["th"] + ["td"] * len(rows), strict=False)
        )
        verdict = {"missing_physics": "Missing physics", "adequate": "Adequate", "unexplained": "Unexplained"}[
            self.verdict
        ]
        said = "".join(f"<p>{escape(line)}</p>" for line in self.words.split("\n"))
        return (
            f"<div style='max-width:46em'><p><b>{verdict}</b> &middot; {escape(self.baseline.model.name)}</p>{said}"
            + (f"<table>{table}</table>" if rows else "")
            + "</div>"
        )

    def unit_of(self, effect: Effect, key: str) -> str:
        """Unit of one parameter of an effect, as the improved model declares it; "1" for what is no parameter of it.

        Parameters
        ----------
        effect : one of `effects`. key : name of its parameter.
        """
        part = self.improved.parameters.get(parameter_name(effect.name, effect.location, key))
        return "1" if part is None else part.unit


def _value(value: float, error: float) -> dict[str, float | None]:
    return {"value": value, "std_error": error if isfinite(error) else None}


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
