"""A study's directory: every finished solve in two small files, written when it finishes.

``study.json`` says which solves belong to the study and what determines each. ``<key>.npz`` holds
the arrays of one solve, ``<key>.json`` the rest, with the checksums of both. The JSON is written
last: where it is there and its checksums are right, the solve is whole.
"""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Protocol

from symid import checked
from symid.errors import SolveError
from symid.files import content_of, plain, write_atomically, write_json
from symid.identification.identity import VERSION, digest
from symid.identification.studies.start_row import StartRow
from symid.identification.studies.worker import Outcome
from symid.ipopt_solver.kept import as_declared, put_together, taken_apart

FORMAT = "symid study 2"


class Store(Protocol):
    """Outcomes by key: a dictionary, or a StudyDirectory."""

    def get(self, key: str, /) -> Outcome | None: ...

    def __getitem__(self, key: str, /) -> Outcome: ...

    def __setitem__(self, key: str, outcome: Outcome, /) -> None: ...


class StudyDirectory:
    """Outcomes by key, on disk: `get`, `[]` and `[]=` as of a dictionary.

    Parameters
    ----------
    path : made if it is not there.
    identities : name of each solve -> part -> fingerprint, with the solve's own under "key".

    Raises
    ------
    SolveError
        The directory belongs to another study, was written in another format, or cannot be written.
    """

    def __init__(self, path: str | Path, identities: Mapping[str, Mapping[str, str]]):
        self.path = checked.path(path, "the directory of a study or solution", SolveError)
        known = self._read_register()
        self._keys = _keys_on_disk(self.path, known, identities)
        if not known.keys() >= identities.keys():
            solves = dict(identities) | known
            self._write(lambda: write_json(self.path / "study.json", {"format": FORMAT, "solves": solves}))

    def _read_register(self) -> dict:
        file = self.path / "study.json"
        try:
            register = json.loads(content_of(file))
            found, solves = register["format"], register["solves"]
        except FileNotFoundError:
            if self.path.is_dir() and any(f.suffix != ".part" for f in self.path.iterdir()):
                raise SolveError(
                    f"{self.path} holds other files and no study.json: give an empty or new directory for the study"
                ) from None
            return {}
        except NotADirectoryError:
            raise SolveError(f"{self.path} is a file: give a directory for the study") from None
        except OSError as problem:
            raise SolveError(
                f"{file} cannot be read ({problem.strerror}): give another directory for the study"
            ) from None
        except (ValueError, KeyError, TypeError, RecursionError) as damage:
            raise SolveError(f"{file} is damaged ({str(damage)[:200]}): give another directory for the study") from None
        if found != FORMAT:
            raise SolveError(
                f"{file} has the format {str(found)[:60]!r}, and this version of symid reads '{FORMAT}': give "
                "another directory, or use the version that wrote it"
            )
        if not (
            isinstance(solves, dict)
            and all(isinstance(parts, dict) and str(parts.get("key", "/")).isalnum() for parts in solves.values())
        ):
            raise SolveError(
                f"{file} is damaged (its 'solves' are no names with their keys): give another directory for the study"
            )
        return solves

    def _write(self, act) -> None:
        try:
            act()
        except OSError as problem:
            raise SolveError(
                f"the study cannot write to {self.path} ({problem.strerror}); what was finished before is "
                "kept: make room or give the right to write, and run the study again"
            ) from problem

    def __setitem__(self, key: str, outcome: Outcome) -> None:
        key = self._keys.get(key, key)
        content, arrays = _taken_apart(outcome)
        content["key"] = key  # files that changed their names are another solve's
        content["sha256"] = {"content": _sha256(_text(content)), "arrays": _sha256(arrays)}

        def both():
            for file in (self.path / f"{key}.npz", self.path / f"{key}.json"):
                if file.exists() and not file.is_file():
                    file.unlink()  # a pipe would be written to, and nobody need ever read it
            write_atomically(self.path / f"{key}.npz", arrays)
            write_json(self.path / f"{key}.json", content)

        self._write(both)

    def get(self, key: str) -> Outcome | None:
        """The outcome as it was put in; None where there is none or a file of it is damaged."""
        key = self._keys.get(key, key)
        try:
            content = json.loads(content_of(self.path / f"{key}.json"))
            arrays = content_of(self.path / f"{key}.npz")
            sums = content.pop("sha256")
            whole = sums == {"content": _sha256(_text(content)), "arrays": _sha256(arrays)}
            whole = whole and content.get("key", key) == key  # earlier versions did not write it
            return _put_together(content, arrays) if whole else None
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None

    def __getitem__(self, key: str) -> Outcome:
        outcome = self.get(key)
        if outcome is None:
            raise SolveError(
                f"{self.path / self._keys.get(key, key)}.json or .npz was removed or damaged: "
                "run the study again, which repeats this solve alone"
            )
        return outcome


def _keys_on_disk(path: Path, known: Mapping, wanted: Mapping) -> dict[str, str]:
    """Key of each solve -> that of its files, which another version of symid may have written."""
    keys, versions = {}, set()
    for name, parts in wanted.items():
        old = known.get(name, parts)
        differs = [p for p in parts if p not in ("key", VERSION) and old.get(p) != parts[p]]
        if differs:
            raise SolveError(
                f"{path} belongs to another study: its solve '{name}' differs in {' and '.join(differs)}. "
                "Give another directory, or the problem as it was"
            )
        if old["key"] not in (parts["key"], digest({p: v for p, v in old.items() if p != "key"})):
            raise SolveError(f"{path / 'study.json'} is damaged (solve '{name}'): give another directory for the study")
        keys[parts["key"]] = old["key"]
        versions |= {str(old.get(VERSION))} - {parts.get(VERSION, "None")}
    if versions:
        warnings.warn(
            f"{path} was begun by symid {' and '.join(sorted(versions))}; what is finished there is taken as it is",
            stacklevel=4,
        )
    return keys


def _taken_apart(outcome: Outcome) -> tuple[dict, bytes]:
    """JSON content and the bytes of an npz file."""
    result, arrays = taken_apart(outcome.result)
    return plain({"format": FORMAT, "row": asdict(outcome.row), "result": result}), arrays


def _put_together(content: dict, arrays: bytes) -> Outcome:
    return Outcome(StartRow(**as_declared(content["row"], StartRow)), put_together(content["result"], arrays))


def _text(content: dict) -> bytes:
    return json.dumps(content, sort_keys=True).encode()


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
