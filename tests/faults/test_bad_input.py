"""Every kind of bad input ends in one clear sentence, exit code 2 or a typed exception, and no file."""

import json
import math

import numpy as np
import pytest
import sympy as sm
from conftest import ROOT, pendulum, pendulum_recording

import symid as si
from symid.cli import main
from symid.errors import ModelError, RecordingError, SolveError, SymidError, TranscriptionError

DATA = ROOT / "data" / "standing_synthetic"
LINES = (DATA / "recording.csv").read_text().splitlines()[:202]  # header and 4 s
BODY = json.loads((DATA / "body.json").read_text())
TRUTH = json.loads((DATA / "truth.json").read_text())["parameters"]


@pytest.fixture
def folder(tmp_path):
    """A good recording, body and parameters, for a test to spoil; results would go to `out`."""
    (tmp_path / "recording.csv").write_text("\n".join(LINES) + "\n")
    (tmp_path / "body.json").write_text(json.dumps(BODY))
    (tmp_path / "values.json").write_text(json.dumps(TRUTH))
    (tmp_path / "out").mkdir()
    return tmp_path


def run(folder, *arguments, capsys) -> tuple[int, str]:
    """Exit code and what was said on stderr as an error."""
    try:
        code = main([str(a) for a in arguments])
    except SystemExit as stopped:  # argparse
        code = stopped.code
    said = [line for line in capsys.readouterr().err.splitlines() if "error:" in line]
    return code, "\n".join(said)


def identify(folder, *options, capsys):
    files = ("--body", folder / "body.json", "--json", folder / "out" / "a.json", "--report", folder / "out" / "a.html")
    return run(folder, "identify", folder / "recording.csv", *files, *options, capsys=capsys)


def check(folder, code: int, said: str, words: str) -> None:
    assert code == 2
    assert words in said
    assert len(said.splitlines()) == 1 and "Traceback" not in said and len(said) < 500
    assert list((folder / "out").iterdir()) == [], "nothing may be written"


def edited(row: int, column: int, text: str) -> list[str]:
    """The recording's lines with another text in one cell; row 0 is the header."""
    cells = LINES[row].split(",")
    cells[column] = text
    return [*LINES[:row], ",".join(cells), *LINES[row + 1 :]]


RECORDINGS = {
    "empty file": ([], "the file is empty"),
    "header without samples": (LINES[:1], "there is a header but no row with samples"),
    "no header": (LINES[1:], "the first line holds numbers"),
    "no time column": (edited(0, 0, "clock_s"), "there is no time column"),
    "almost the time column": (edited(0, 0, "time__s"), "there is no time column (time_s); 'time__s' may be meant"),
    "column without a unit": (edited(0, 1, "ankle_angle"), "'ankle_angle'"),
    "unknown unit": (edited(0, 1, "ankle_angle_degrees"), "ankle_angle_degrees"),
    "angle in metres": (edited(0, 1, "ankle_angle_m"), "is in m, but angle is measured in rad"),
    "column twice": (edited(0, 2, "ankle_angle_deg"), "occurs twice"),
    "same channel in two units": (edited(0, 2, "ankle_angle_rad"), "both give ankle_angle"),
    "column without a name": (edited(0, 1, ""), "column 2 of 8 has no name"),
    "text in a number's place": (edited(7, 2, "n/a?"), "hip_angle_deg"),
    "blank cell": (edited(7, 2, ""), "missing"),
    "infinite value": (edited(7, 2, "inf"), "hip_angle_deg"),
    "decimal comma": (edited(7, 2, '"1,5"'), "hip_angle_deg"),
    "row cut short": ([*LINES[:9], "0.16,1.0", *LINES[10:]], "line 10"),
    "time goes back": (edited(20, 0, "0.1"), "time"),
    "rows missing": (LINES[:50] + LINES[90:], "row 50 (line 51"),
    "channel missing": ([",".join(np.delete(line.split(","), 2)) for line in LINES], "needs the channel 'hip_angle'"),
    "wrong channel name": (edited(0, 2, "hipp_angle_deg"), "did you mean 'hipp_angle'"),
    "two samples": (LINES[:3], "holds only 2 samples"),
}


@pytest.mark.parametrize(("lines", "words"), RECORDINGS.values(), ids=RECORDINGS)
def test_bad_recording(folder, lines, words, capsys):
    (folder / "recording.csv").write_text("\n".join(lines) + "\n" if lines else "")
    check(folder, *identify(folder, capsys=capsys), words)


def test_recording_that_is_not_there_or_not_text(folder, capsys):
    (folder / "recording.csv").rename(folder / "recordings.csv")
    check(folder, *identify(folder, capsys=capsys), "in the same folder there is recordings.csv")
    (folder / "recording.csv").write_bytes(b"\x89PNG\r\n\x1a\n\x00\xff\xfe")
    check(folder, *identify(folder, capsys=capsys), "is not a text file of separated values")
    (folder / "recording.csv").unlink()
    (folder / "recording.csv").mkdir()
    check(folder, *identify(folder, capsys=capsys), "cannot be read")


BODIES = {
    "not JSON": ("{leg_length_m: 1}", "is not JSON"),
    "a list": ("[1, 2]", "a JSON object"),
    "key missing": (json.dumps({k: v for k, v in BODY.items() if k != "leg_mass_kg"}), "'leg_mass' [kg] is missing"),
    "unknown key": (json.dumps(BODY | {"leg_color_m": 1.0}), "'leg_color_m' is not expected"),
    "key without a unit": (json.dumps(BODY | {"leg_mass": 20.0}), "'leg_mass' has no unit"),
    "wrong dimension": (
        json.dumps({("leg_mass_m" if k == "leg_mass_kg" else k): v for k, v in BODY.items()}),
        "leg_mass is measured in kg",
    ),
    "negative mass": (json.dumps(BODY | {"leg_mass_kg": -20.0}), "must be greater than zero, found -20"),
    "text for a number": (json.dumps(BODY | {"leg_mass_kg": "20 kg"}), "must be a number"),
    "NaN": (json.dumps(BODY | {"leg_mass_kg": math.nan}), "must be finite"),
    "key twice": (json.dumps(BODY)[:-1] + ', "leg_mass_kg": 3.0}', "occurs twice"),
}


@pytest.mark.parametrize(("text", "words"), BODIES.values(), ids=BODIES)
def test_bad_body(folder, text, words, capsys):
    (folder / "body.json").write_text(text)
    check(folder, *identify(folder, capsys=capsys), words)


def test_body_that_is_not_there(folder, capsys):
    (folder / "body.json").unlink()
    check(folder, *identify(folder, capsys=capsys), "there is no such body file")


OPTIONS = {
    "window outside": (["--window", "2", "99"], "does not lie in recording"),
    "window backwards": (["--window", "3", "1"], "does not lie in recording"),
    "window of nothing": (["--window", "1", "1.01"], "sample"),
    "window that is no number": (["--window", "nan", "2"], "does not lie in recording"),
    "window in words": (["--window", "start", "end"], "invalid float value"),
    "held-out window outside": (["--window", "0", "2", "--held-out", "2", "99"], "does not lie in recording"),
    "unknown scheme": (["--scheme", "midpiont"], "midpiont"),
    "unknown controller": (["--controller", "lqr"], "invalid choice"),
    "no starts": (["--starts", "0"], "starts=0"),
    "half a start": (["--starts", "0.5"], "invalid int value"),
    "no episodes": (["--episodes", "0"], "whole number of at least 1"),
    "negative noise": (["--episodes", "2", "--noise", "-1"], "at least 0"),
    "episodes without noise": (["--episodes", "2", "--noise", "0"], "without any noise"),
    "no iterations": (["--max-iterations", "-1"], "max"),
    "no processes": (["--jobs", "0"], "jobs"),
    "unknown option": (["--windows", "0", "1"], "unrecognized arguments"),
    "a name that no file has": (["--report", "a\0b"], "null character"),
}


@pytest.mark.parametrize(("options", "words"), OPTIONS.values(), ids=OPTIONS)
def test_bad_option(folder, options, words, capsys):
    check(folder, *identify(folder, *options, capsys=capsys), words)


SIMULATIONS = {
    "value missing": ({k: v for k, v in TRUTH.items() if k != "kd_aa"}, [], "'kd_aa' is missing"),
    "value too many": (TRUTH | {"kq_aa": 1.0}, [], "'kq_aa' is no parameter"),
    "value not finite": (TRUTH | {"kp_aa": math.nan}, [], "must be a finite number"),
    "value in words": (TRUTH | {"kp_aa": "stiff"}, [], "must be a finite number"),
    "a list of values": ([1, 2, 3], [], "a JSON object"),
    "a body that falls": (TRUTH | {"kp_aa": 0.0, "kp_ah": 0.0}, ["--duration", "10"], "the body falls"),
    "negative duration": (TRUTH, ["--duration", "-1"], "--duration -1 is not possible"),
    "rate not finite": (TRUTH, ["--rate", "inf"], "--rate inf is not possible"),
    "negative noise": (TRUTH, ["--torque-noise", "-1"], "--torque-noise -1 is not possible"),
    "platform without acceleration": (TRUTH, ["--platform", "body.json"], "body.json"),
}


@pytest.mark.parametrize("name", ["recording.csv", "body.json", "out/../recording.csv", "out/a.json"])
def test_a_result_replaces_nothing_that_is_read_nor_another_result(folder, name, capsys):
    before = {f.name: f.read_bytes() for f in folder.iterdir() if f.is_file()}
    check(folder, *identify(folder, "--report", folder / name, capsys=capsys), "would replace")
    assert before == {f.name: f.read_bytes() for f in folder.iterdir() if f.is_file()}


@pytest.mark.parametrize(("values", "options", "words"), SIMULATIONS.values(), ids=SIMULATIONS)
def test_bad_simulation(folder, values, options, words, capsys):
    (folder / "values.json").write_text(json.dumps(values))
    options = [folder / o if o.endswith(".json") else o for o in options]
    check(
        folder,
        *run(
            folder,
            "simulate",
            folder / "out" / "new.csv",
            "--body",
            folder / "body.json",
            "--parameters",
            folder / "values.json",
            *options,
            capsys=capsys,
        ),
        words,
    )


def test_results_that_cannot_be_written(folder, capsys):
    blocked = folder / "body.json" / "a.json"  # a file stands where a folder should
    code, said = run(
        folder,
        "simulate",
        blocked,
        "--body",
        folder / "body.json",
        "--parameters",
        folder / "values.json",
        "--duration",
        "1",
        capsys=capsys,
    )
    assert code == 2 and "body.json" in said and len(said.splitlines()) == 1


# ---- through Python: typed exceptions ----------------------------------------------------


def problem(model=None, **options):
    return si.Identification(model or pendulum(), pendulum_recording(), **options)


def not_a_number(argument) -> si.Model:
    """A pendulum with one more torque, which is no real number where the argument is negative."""
    model = pendulum()
    model.add_effort_of = si.Expression(0.1 * sm.sqrt(argument(model)), unit="")
    model.components["balance"] = si.Equation(model.balance.expr + model.add_effort_of.symbol, name="balance")
    return model


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"damping": 99.0}, "damping=99 is outside its bounds 0 to 5"),
        ({"damping": -1.0}, "damping=-1 is outside its bounds 0 to 5"),
        ({"dampin": 1.0}, "no parameter 'dampin'; did you mean 'damping'"),
        ({"damping": math.nan}, "damping=nan: give a number"),
    ],
)
def test_bad_initial_guess(given, words):
    with pytest.raises(SolveError, match=words):
        problem().solve(start=given)


def test_start_from_a_word_that_means_nothing():
    with pytest.raises(SymidError, match="'defualt' is not known"):
        problem().solve(start="defualt")


def test_guess_outside_of_bounds_is_a_violation():
    model = si.Model("one")
    model.x = si.State(unit="m")
    model.rate = si.Parameter(unit="m/s", bounds=(0, 1), guess=2.0)
    model.rule = si.Equation(model.x.dot - model.rate)
    with pytest.raises(ModelError, match="guess 2 of parameter 'rate' is outside its bounds"):
        model.check()


def test_nan_from_an_expression_names_equation_and_time():
    with pytest.raises(SolveError, match="balance") as caught:
        problem(not_a_number(lambda m: m.angle)).solve()
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"window": [(0, 1), (1, 2)]}, TranscriptionError, "2 windows were given for 1 recording"),
        ({"weights": {"mesured": 2.0}}, TranscriptionError, "mesured"),
        ({"weights": {"measured": -1.0}}, TranscriptionError, "weight"),
        ({"per_recording": ["dampin"]}, SymidError, "dampin"),
        ({"backend": "fortran"}, SymidError, "fortran"),
    ],
)
def test_bad_problem(options, error, words):
    with pytest.raises(error, match=words):
        problem(**options).transcription  # noqa: B018


def test_recording_that_does_not_fit_the_model():
    other = pendulum_recording()
    with pytest.raises(TranscriptionError, match="needs the channel 'drive'"):
        si.Identification(pendulum(), other.select("angle")).solve()
    with pytest.raises(TranscriptionError, match="cannot be compared"):
        wrong = si.Recording("r", other.time, dict(other.channels), dict(other.units) | {"angle": "m"})
        si.Identification(pendulum(), wrong).solve()
    with pytest.raises(RecordingError, match="has no unit"):
        si.Recording("r", other.time, dict(other.channels), {"angle": "rad"})


def test_solution_of_a_model_that_changed_is_refused():
    changed = problem()
    solution = changed.solve()
    changed.model.redefine("measured", 2 * changed.model.angle)
    with pytest.raises(SolveError, match="changed since it was solved"):
        solution.transcription  # noqa: B018
