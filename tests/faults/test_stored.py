"""What earlier versions of symid wrote is read: `stored/` holds a solution, a study and a diagnosis of each format.

`PYTHONPATH=tests python tests/faults/test_stored.py FOLDER` writes them as of today, from recordings that are simulated
here; a folder that was written once is never changed again.
"""

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import pendulum, pendulum_recording

import symid as si
from symid.discrepancy import read_answer
from symid.errors import DiagnosisError, SolveError

STORED = sorted((Path(__file__).parent / "stored").iterdir())


def problem(folder: Path) -> si.Identification:
    return si.Identification(pendulum(), si.read_recording(folder / "recording.csv"))


def study(folder: Path, store: Path) -> si.Study:
    return si.Study.product({"light": problem(folder)}, 2, seed=3, store=store)


@pytest.fixture(params=STORED, ids=lambda folder: folder.name)
def stored(request, tmp_path) -> Path:
    """A copy, and what was true when it was written."""
    return Path(shutil.copytree(request.param, tmp_path / request.param.name))


def test_a_solution_is_read(stored):
    truth = json.loads((stored / "truth.json").read_text())
    solution = problem(stored).load(stored / "solution")
    assert solution.values == truth["solution"] and solution.solved
    assert np.isfinite(solution.parameters.std_error["damping"])


def test_a_study_is_read_and_nothing_is_solved_again(stored, monkeypatch):
    truth = json.loads((stored / "truth.json").read_text())
    monkeypatch.setattr("symid.identification.studies.worker.solve_here", lambda *_: pytest.fail("solved again"))
    result = study(stored, stored / "study").run_here(on_finished=None)
    assert result.complete and {k: row.parameters for k, row in result.rows.items()} == truth["study"]
    assert result.best().values["damping"] == pytest.approx(0.4, abs=0.02)


def test_a_study_of_an_earlier_version_is_taken_as_it_is_and_said(stored, monkeypatch):
    monkeypatch.setattr("symid.identification.identity.version", lambda name: "99.0")
    with pytest.warns(UserWarning, match=r"was begun by symid 0\..*taken as it is"):
        result = study(stored, stored / "study").run_here(on_finished=None)
    assert {k: r.parameters for k, r in result.rows.items()} == json.loads((stored / "truth.json").read_text())["study"]


def test_a_diagnosis_is_read(stored):
    answer = read_answer(stored / "diagnosis.json")
    assert answer["verdict"] == "missing_physics" and answer["effects"][0]["name"] == "viscous_friction"


def test_keys_of_a_register_are_those_of_its_solves(stored):
    """An exchange would hand out one solve's result as another's; a path would be read and written."""
    file = stored / "study" / "study.json"
    whole = file.read_text()
    keys = [parts["key"] for parts in json.loads(whole)["solves"].values()]
    for text in (whole.replace(keys[0], keys[1]), whole.replace(keys[0], f"../{keys[0]}")):
        file.write_text(text)
        with pytest.raises(SolveError, match="damaged"):
            study(stored, stored / "study")


@pytest.mark.parametrize("text", ["[]", "{}", '{"format": 1}', '{"format": 99, "verdict": "", "effects": []}'])
def test_what_is_no_answer_is_refused(tmp_path, text):
    (tmp_path / "found.json").write_text(text)
    with pytest.raises(DiagnosisError, match="is no answer of a diagnosis|has the format 99"):
        read_answer(tmp_path / "found.json")


def write(folder: Path) -> None:
    folder.mkdir(parents=True)
    pendulum_recording(duration=2.0, step=0.05, noise=0.005).to_csv(folder / "recording.csv")
    solution = problem(folder).solve()
    solution.save(folder / "solution")
    result = study(folder, folder / "study").run_here(on_finished=None)
    truth = {"solution": solution.values, "study": {k: row.parameters for k, row in result.rows.items()}}
    (folder / "truth.json").write_text(json.dumps(truth, indent=1))
    free = rig()
    few = [s for s in si.suspects(free) if s.term.name == "viscous_friction"]
    swing = pendulum_recording(damping=0.05, duration=12.0, noise=1e-3, strength=0.0)
    swing = swing.select("angle").rename({"angle": "link1_angle"})
    found = si.diagnose(free, swing, fit_window=(0, 8), held_out=(8, 12), suspects=few, threads=1)
    found.to_json(folder / "diagnosis.json")


def rig() -> si.Model:
    return si.mechanics.rig_model({"m1_kg": 1.0, "a1_m": 0.5, "I1_kg_m2": 0.97625}, ["link1_angle"])


if __name__ == "__main__":
    write(Path(sys.argv[1]))
