"""What an identification found, by name, with units, errors and where it came from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symid import checked
from symid.errors import SolveError
from symid.identification.files.record import provenance, record
from symid.identification.fit import fit_measures
from symid.identification.likelihood.weighting import noise_levels
from symid.identification.studies.start_row import StartRow
from symid.identification.uncertainty.covariance import ParameterErrors, bound_active, parameter_errors
from symid.identification.uncertainty.sensitivity import outputs_and_targets
from symid.ipopt_solver import SolverResult
from symid.model import Model
from symid.recording import Recording
from symid.transcription import Transcription

if TYPE_CHECKING:
    import pandas as pd

    from symid.identification.checks.verify import Verification
    from symid.identification.problem import Identification


@dataclass(frozen=True, eq=False)
class Solution:
    """The best solution of an Identification.

    Attributes
    ----------
    problem : what was solved.
    result : what Ipopt returned for the best start.
    starts : one row for each start, in their order.
    best : which of them this is.
    fingerprint : of the model that was solved. created : when, as ISO 8601 in UTC.
    error_model : asked for: "auto", "white", "coloured" or "clustered"; see `with_errors`.

    Examples
    --------
    >>> solution = problem.solve()
    >>> row = solution.parameters.loc["damping"]
    >>> bool(abs(row.value - 0.4) < 3 * row.std_error), row.unit
    (True, '1/s')
    >>> list(solution.trajectories[0])
    ['angle', 'rate', 'measured', 'measured recorded']
    """

    problem: Identification
    result: SolverResult
    starts: tuple[StartRow, ...]
    best: int
    fingerprint: str
    created: str
    error_model: str = "auto"

    @property
    def transcription(self) -> Transcription:
        """The discretised problem that was solved; SolveError where the model has changed since."""
        if self.problem.model.fingerprint != self.fingerprint:
            raise SolveError(f"model '{self.problem.model.name}' changed since it was solved: solve it again")
        return self.problem.transcription

    @property
    def model(self) -> Model:
        """The model that was identified."""
        return self.problem.model

    @property
    def solved(self) -> bool:
        """Whether Ipopt found an optimum."""
        return self.result.solved

    @property
    def message(self) -> str:
        """What Ipopt's status means and what to do next."""
        return self.result.message

    @cached_property
    def values(self) -> dict[str, float]:
        """Free parameters by name, SI."""
        t = self.transcription
        return dict(zip(t.layout.parameter_names, map(float, t.layout.parameters(self.result.z)), strict=True))

    def with_errors(self, model: str) -> Solution:
        """The same solution with standard errors by another error model.

        model : "white" (noise without memory), "coloured" (stationary noise with a memory), "clustered"
            (any noise that is independent from recording to recording), or "auto": white where the
            residual's autocorrelation does not refute it, else coloured.
        """
        return replace(self, error_model=model)

    @cached_property
    def errors(self) -> ParameterErrors | None:
        """What the data say of the parameters, and by which error model; None where not solved."""
        if not self.solved:
            return None
        known = noise_levels(replace(self.problem, noise=None))
        return parameter_errors(
            self.transcription,
            self.result,
            known,
            self.error_model,
            self.problem.ridge * self.problem.episodes.count * len(self.problem.recordings),
            self.problem.loss,
        )

    @cached_property
    def covariance(self) -> pd.DataFrame:
        """Covariance of the free parameters [SI]: NaN for those at a bound, infinite variance where undetermined."""
        import pandas as pd

        names = list(self.values)
        matrix = np.full((len(names),) * 2, np.nan)
        if self.errors is not None:
            known = np.isfinite(self.errors.std_errors)
            matrix[np.ix_(known, known)] = self.errors.covariance[np.ix_(known, known)]
            np.fill_diagonal(matrix, self.errors.std_errors**2)
        return pd.DataFrame(matrix, index=names, columns=names)

    @cached_property
    def determined(self) -> dict[str, tuple[float, float]]:
        """Combinations of parameters that are determined where these alone are not -> (value, standard error) [SI]."""
        found = (
            []
            if self.errors is None
            else self.errors.determined(list(self.values), np.array(list(self.values.values())))
        )
        return {c.text: (c.value, error) for c, error in found}

    @cached_property
    def parameters(self) -> pd.DataFrame:
        """One row per free parameter: value, std_error, unit, lower, upper, at_bound, meaning."""
        import pandas as pd

        t = self.transcription
        first, scale = t.layout.offsets[-1], t.layout.parameter_scale
        parts = [self.model.parameters[name.split("[")[0]] for name in self.values]
        return pd.DataFrame(
            {
                "value": list(self.values.values()),
                "std_error": np.sqrt(np.diag(self.covariance)),
                "unit": [p.unit for p in parts],
                "lower": t.program.lower[first:] * scale,
                "upper": t.program.upper[first:] * scale,
                "at_bound": bound_active(t, self.result)[first:] if self.errors is None else self.errors.at_bound,
                "meaning": [p.meaning for p in parts],
            },
            index=pd.Index(self.values, name="parameter"),
        )

    @cached_property
    def cut_off(self) -> dict[str, float]:
        """States that lie at a bound of theirs, and at which share of the nodes: the motion is cut off there."""
        t = self.transcription
        free = t.program.lower < t.program.upper  # what a Boundary fixes is not cut off
        active = (bound_active(t, self.result) & free).astype(float)
        share = np.mean(np.concatenate([t.layout.states(active, e) != 0 for e in range(len(t.recording_of))]), axis=0)
        return {name: float(s) for name, s in zip(t.model.states, share, strict=True) if s > 0}

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """What should be looked at before the numbers are trusted, one sentence each: mistakes of units and signs that
        show in the recording, the body or the motion (`symid.plausibility`), and states that their bounds cut off."""
        from symid.identification.show import warnings

        return tuple(warnings(self))

    @cached_property
    def verification(self) -> Verification:
        """What a finer mesh, an integrator and the optimality conditions say of it, see `identification.verify`."""
        from symid.identification.checks.verify import verify

        return verify(self)

    def refined(self, factor: int | None = None) -> Solution:
        """Solved again from here with `factor` times as many collocation intervals, by default as many as leave a tenth
        of a standard error of the mesh's error, at most 16, at least 2.
        """
        if factor is None:
            from symid.identification.checks.verify import FINE

            mesh = self.verification.mesh
            worst = 0.0 if mesh is None else mesh["std_errors"].abs().max()
            factor = int(np.clip(np.ceil((worst / FINE) ** (1 / self.problem.scheme.order)), 2, 16))
        refine = checked.whole(factor, "refined: factor", SolveError, least=1) * self.problem.refine
        return replace(self.problem, refine=refine).solve(start=self, check=False, near=True)

    @cached_property
    def trajectories(self) -> tuple[pd.DataFrame, ...]:
        """A table per episode: states, controls, algebraic variables, outputs, "<output> recorded" over time_s, SI."""
        import pandas as pd

        t, frames = self.transcription, []
        for e, (y, d) in enumerate(outputs_and_targets(t, self.result.z)):
            m = t.measured[t.recording_of[e]]
            columns = dict(
                zip(t.layout.node_names, (t.layout.sample_view(self.result.z, e) * t.layout.node_scale).T, strict=True)
            )
            for i, name in enumerate(t.model.outputs):
                columns |= {name: y[:, i], f"{name} recorded": d[:, i]}
            frame = pd.DataFrame(columns, index=pd.Index(m.time[m.nodes], name="time_s"))
            frame.attrs.update(recording=m.name, episode=e)
            frames.append(frame)
        return tuple(frames)

    @cached_property
    def fit(self) -> dict[str, Any]:
        """Fit of the collocation trajectory over all episodes, see `identification.fit`."""
        pairs = outputs_and_targets(self.transcription, self.result.z)
        outputs = self.model.outputs
        return fit_measures(
            list(outputs),
            [y.unit for y in outputs.values()],
            *(np.concatenate(side) for side in zip(*pairs, strict=True)),
        )

    def fit_on(self, window: tuple[float, float], recording: Recording | None = None) -> dict[str, Any]:
        """Fit of the `free_run` on another window, or another recording."""
        return self.free_run(window, recording).fit

    def free_run(self, window: tuple[float, float], recording: Recording | None = None) -> Solution:
        """The model on another window, or another recording, with all parameters kept.

        It runs freely over the window, driven by the recorded inputs only; its initial state, and nothing else, is
        fitted to that window. Estimated disturbances (Control, Process) are zero; a Boundary holds where the window
        begins with its recording, as the fitted one did, and is left out elsewhere.

        Raises
        ------
        SolveError : parameters differ between recordings, or no such run was found.
        """
        from symid.identification.free_run import free_run

        return free_run(self, window, recording)

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Versions, data and options, enough to repeat the identification."""
        return provenance(self)

    def to_dict(self) -> dict[str, Any]:
        """All of the above but the trajectories, as plain JSON types; the command line writes this."""
        return record(self)

    @property
    def seconds(self) -> dict[str, float]:
        """Wall time [s]: build (with compile), compile, functions, linear_algebra (with the rest of Ipopt), total."""
        build, spent = self.transcription.seconds, self.result.seconds
        compiled = sum(v for k, v in build.items() if k != "build")
        return {
            "build": build["build"],
            "compile": compiled,
            "functions": spent["functions"],
            "linear_algebra": spent["solver"],
            "total": build["build"] + spent["total"],
        }

    def save(self, path: str | Path) -> None:
        """Write the result to the directory `path`, see `identification.saved`; `Identification.load` reads it."""
        from symid.identification.files.saved import save

        save(self, path)

    def plot(self) -> Any:
        """Figure of the fit over time; more of them in `symid.plots`."""
        # Drawing stands on the roof, and computing must not need it: fetched by name when asked for.
        return import_module("symid.plots").plot_fit(self)

    def __repr__(self) -> str:
        from symid.identification.show import text

        return text(self)

    def _repr_html_(self) -> str:
        from symid.identification.show import html

        return html(self)


def build_solution(problem: Identification, result: SolverResult, starts: tuple[StartRow, ...], best: int) -> Solution:
    """The solution of `problem` that has this result; SolveError where it cannot be that of this problem."""
    unknowns = problem.transcription.layout.size
    if result.z.size != unknowns:
        raise SolveError(
            f"the result that was read has {result.z.size} unknowns, and its problem {unknowns}: its files were "
            "exchanged; solve the problem again"
        )
    return Solution(
        problem, result, starts, best, problem.model.fingerprint, datetime.now(UTC).isoformat(timespec="seconds")
    )
