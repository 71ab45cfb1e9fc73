"""Saved solutions, studies and plans with altered fields, their sums made right again, as an attacker can: read, or
refused in one sentence, and whatever is read can be shown."""

import io
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import sympy as sm
from fuzz import few, of_json, spoiled, told
from hypothesis import given, settings, strategies as st
from test_stored import problem, study

import symid as si
from symid.discrepancy import read_answer
from symid.identification.studies.store import _sha256, _text

STORED = Path(__file__).parent / "stored" / "format_2_with_keys"
PROBLEM = problem(STORED)
fewer = settings(few, max_examples=max(few.max_examples // 5, 1))
"""Where a damaged solve is done again."""


def file_of(folder: Path, ending: str) -> Path:
    return next(f for f in sorted(folder.glob(f"*{ending}")) if f.stem not in ("study", "summary"))


@st.composite
def altered(draw, arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """One of the arrays shorter, of another kind, with odd numbers, or left out."""
    name = draw(st.sampled_from(sorted(arrays)))
    was = arrays[name]
    odd = [was[:-1], was[:0], was.astype(complex), was.astype(str), was[None], np.full_like(was, np.nan), was + 1e300]
    odd += [was.astype(int), was > 0, np.float64(1.0), np.zeros((3, 0)), None]
    new = draw(st.sampled_from(odd))
    return {k: v for k, v in arrays.items() if k != name} | ({} if new is None else {name: np.asarray(new)})


def packed(arrays: dict[str, np.ndarray]) -> bytes:
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def unpacked(file) -> dict[str, np.ndarray]:
    with np.load(file) as found:
        return dict(found)


def resealed(folder: Path, data) -> None:
    """The files of one solve, with something exchanged in one of them, and right sums."""
    words, numbers = file_of(folder, ".json"), file_of(folder, ".npz")
    content, arrays = json.loads(words.read_text()), unpacked(numbers)
    del content["sha256"]
    if data.draw(st.booleans()):
        content = data.draw(spoiled(content))
    else:
        arrays = data.draw(altered(arrays))
    numbers.write_bytes(packed(arrays))
    content["sha256"] = {"content": _sha256(_text(content)), "arrays": _sha256(numbers.read_bytes())}
    words.write_text(json.dumps(content))


def shown(solution) -> None:
    assert repr(solution) and solution._repr_html_() and len(solution.parameters) and solution.to_dict()
    json.dumps(solution.to_dict())


@pytest.mark.slow
@few
@given(st.data())
def test_solutions(tmp_path_factory, data):
    folder = shutil.copytree(STORED / "solution", tmp_path_factory.mktemp("s") / "solution")
    if data.draw(st.integers(0, 3)):
        resealed(folder, data)
    else:
        file = folder / data.draw(st.sampled_from(["summary.json", "study.json"]))
        file.write_text(json.dumps(data.draw(spoiled(json.loads(file.read_text())))))
    with np.errstate(all="ignore"):
        told(lambda: shown(PROBLEM.load(folder)))


@pytest.mark.slow
@fewer
@given(st.data())
def test_studies(tmp_path_factory, data):
    folder = shutil.copytree(STORED / "study", tmp_path_factory.mktemp("s") / "study")
    if data.draw(st.booleans()):
        resealed(folder, data)
    else:
        file = folder / "study.json"
        file.write_text(json.dumps(data.draw(spoiled(json.loads(file.read_text())))))

    def act():
        result = study(STORED, folder).run_here(on_finished=None)
        assert repr(result) and result._repr_html_() and len(result.table) == 2
        shown(result.best())

    with np.errstate(all="ignore"):
        told(act)


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    """A saved plan: its problem and its file."""
    m = si.Model("cart")
    m.x, m.v, m.force = si.State(unit="m"), si.State(unit="m/s"), si.Control(unit="m/s^2")
    m.motion = si.Equation({0: m.x.dot - m.v, 1: m.v.dot - m.force})
    m.ends = si.Boundary(initial={m.x: 0, m.v: 0}, terminal={m.x: 1, m.v: 0})
    m.effort = si.Objective(running=m.force**2 * sm.Rational(1, 2))
    optimization = si.Optimization(m, duration=1, nodes=11)
    file = tmp_path_factory.mktemp("p") / "plan.npz"
    optimization.solve().save(file)
    return optimization, file


@few
@given(st.data())
def test_plans(plan, tmp_path_factory, data):
    optimization, file = plan
    outer = unpacked(file)
    about, arrays = json.loads(str(outer["about"])), unpacked(io.BytesIO(outer["arrays"].tobytes()))
    if data.draw(st.booleans()):
        about = data.draw(spoiled(about))
    else:
        arrays = data.draw(altered(arrays))
    inner = packed(arrays)
    if "sha256" in about:
        about["sha256"] = _sha256(inner)
    new = tmp_path_factory.mktemp("p") / "plan.npz"
    new.write_bytes(packed({"about": np.array(json.dumps(about)), "arrays": np.frombuffer(inner, np.uint8)}))

    def act():
        found = optimization.load(new)
        assert repr(found) and found._repr_html_() and found["x"].size == 11

    with np.errstate(all="ignore"):
        told(act)


@few
@given(spoiled(json.loads((STORED / "diagnosis.json").read_text())), st.one_of(st.none(), of_json))
def test_answers(tmp_path, content, other):
    (tmp_path / "found.json").write_text(json.dumps(content if other is None else other))
    told(read_answer, tmp_path / "found.json")
