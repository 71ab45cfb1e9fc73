"""How every solve of a study ended: a table, and the best of one problem."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from symid.errors import SolveError
from symid.identification.identity import digest
from symid.identification.solution import Solution, build_solution
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.store import Store

if TYPE_CHECKING:
    import pandas as pd

    from symid.identification.problem import Identification
    from symid.identification.studies.study import Solve


@dataclass(frozen=True, eq=False)
class StudyResult:
    """How every solve of a study ended.

    Attributes
    ----------
    solves, rows : by name, in the study's order.
    """

    solves: Mapping[str, Solve]
    rows: Mapping[str, StartRow]
    _store: Store

    @property
    def table(self) -> pd.DataFrame:
        """One row per solve: labels, number, kind, solved, status, objective, rms [SI], rms_deg (angles
        only), iterations, seconds, message, and every parameter [SI] in a column of its name."""
        import pandas as pd  # here and not at the top: most runs never need it

        records = []
        for name, row in self.rows.items():
            solve = self.solves[name]
            angles = all(y.unit == "rad" for y in solve.problem.model.outputs.values())
            said = {k: getattr(row, k) for k in ("number", "kind", "solved", "status", "objective", "rms")}
            records.append(
                dict(solve.labels)
                | said
                | {"rms_deg": np.rad2deg(row.rms) if angles else np.nan}
                | {k: getattr(row, k) for k in ("iterations", "seconds", "message")}
                | row.parameters
            )
        return pd.DataFrame(records, index=pd.Index(self.rows, name="solve"))

    @property
    def complete(self) -> bool:
        """Whether every solve ran to an end; if not, running the study again repeats the lost ones."""
        return all(row.final for row in self.rows.values())

    def best(self, accept: Callable[[StartRow], bool] = lambda row: True, **labels: Any) -> Solution:
        """The best solution of the one problem that these labels leave: solved, accepted, with the least objective.

        Draws of process noise may differ: the problem is the same.

        Raises
        ------
        SolveError
            They leave no solve or several problems, or no solve has a result.
        """
        names = [n for n, s in self.solves.items() if labels.items() <= dict(s.labels).items()]
        problems = {_besides_its_draw(self.solves[n].problem) for n in names}
        if len(problems) != 1:
            known = sorted({f"{k}={v!r}" for s in self.solves.values() for k, v in s.labels.items()})
            asked = ", ".join(f"{k}={v!r}" for k, v in labels.items())
            raise SolveError(
                f"best({asked}): {len(problems)} problems of the study have these labels, and only solves of "
                f"one problem compare; its labels: {', '.join(known)}"
            )
        rows = [self.rows[n] for n in names]
        place = min(
            range(len(rows)),
            key=lambda i: (
                not rows[i].solved,
                not rows[i].solved or not accept(rows[i]),
                np.nan_to_num(rows[i].objective, nan=np.inf),
            ),
        )
        outcome = self._store[self.solves[names[place]].key]
        if outcome.result is None:
            raise SolveError(
                f"none of {len(rows)} starts gave a result; the first says: {rows[0].message}"
                if len(rows) > 1
                else rows[0].message
            )
        return build_solution(self.solves[names[place]].problem, outcome.result, tuple(rows), place)

    def __repr__(self) -> str:
        ended = Counter(row.status for row in self.rows.values())
        return (
            f"<StudyResult of {len(self.rows)} solves: " + ", ".join(f"{n} {s}" for s, n in ended.most_common()) + ">"
        )

    def _repr_html_(self) -> str:
        return str(self.table.to_html(float_format=lambda x: f"{x:.5g}", border=0))


def _besides_its_draw(problem: Identification) -> str:
    """Fingerprint of a problem that is the same for every draw of its process noise."""
    episodes = {f.name: getattr(problem.episodes, f.name) for f in fields(problem.episodes) if f.name != "seed"}
    return digest(problem.identity | {"episodes": digest(episodes)})
