"""The command line from end to end, on the synthetic recording: output, files, exit codes."""

import json
import subprocess
import sys

import numpy as np
import pytest
from agreement import assert_same_table
from conftest import ROOT

from symid.cli import main
from symid.cli.main import BAD_INPUT, INTERRUPTED, NOT_SOLVED, SOLVED, command_names
from symid.recording import read_recording

DATA = ROOT / "data" / "standing_synthetic"
TRUTH = json.loads((DATA / "truth.json").read_text())["parameters"]
IDENTIFY = ["identify", str(DATA / "recording.csv"), "--body", str(DATA / "body.json")]


@pytest.mark.slow
@pytest.mark.elsewhere
def test_identify_writes_summary_json_and_report(tmp_path, capsys):
    out, report = tmp_path / "a.json", tmp_path / "a.html"
    code = main(
        [*IDENTIFY, "--window", "0", "60", "--held-out", "60", "100", "--json", str(out), "--report", str(report)]
    )
    printed = capsys.readouterr()
    assert code == SOLVED
    assert "Solved" in printed.out and "kp_aa" in printed.out and "Held-out 60 to 100 s" in printed.out
    assert "iteration" in printed.err
    content = json.loads(out.read_text())
    assert set(content) >= {"parameters", "fit", "solver", "starts", "provenance"}
    assert set(content["parameters"]) == set(TRUTH)
    for name, row in content["parameters"].items():
        assert set(row) == {"value", "std_error", "unit", "bounds", "at_bound"}
        assert abs(row["value"] - TRUTH[name]) < 4 * row["std_error"]
    assert 0 < content["fit"]["held_out"]["rms_deg"]["all"] < 2
    assert set(content["solver"]["seconds"]) >= {"build", "compile", "functions", "linear_algebra"}
    assert len(content["starts"]) == 1 and content["starts"][0]["solved"]
    assert content["provenance"]["recordings"][0]["nodes"] == 3001
    assert report.read_text().endswith("</html>\n")


def test_identify_by_random_starts_on_two_processes(tmp_path, capsys):
    out = tmp_path / "a.json"
    code = main(
        [
            *IDENTIFY,
            "--controller",
            "pd",
            "--window",
            "0",
            "20",
            "--starts",
            "3",
            "--jobs",
            "2",
            "--seed",
            "4",
            "--json",
            str(out),
        ]
    )
    printed = capsys.readouterr()
    starts = json.loads(out.read_text())["starts"]
    assert code == (SOLVED if any(s["solved"] for s in starts) else NOT_SOLVED)
    assert len(starts) == 3 and printed.err.count("RMS") == 3
    assert len({s["parameters"]["kp_ankle"] for s in starts}) > 1


def test_identify_with_episodes_and_another_scheme(capsys):
    assert main([*IDENTIFY, "--window", "0", "10", "--episodes", "2", "--scheme", "trapezoid"]) == SOLVED
    assert "Solved" in capsys.readouterr().out


def test_a_solve_that_gives_up_is_told_and_still_written(tmp_path, capsys):
    out, report = tmp_path / "a.json", tmp_path / "a.html"
    code = main(
        [
            *IDENTIFY,
            "--window",
            "0",
            "10",
            "--controller",
            "pd",
            "--starts",
            "2",
            "--max-iterations",
            "2",
            "--held-out",
            "10",
            "20",
            "--json",
            str(out),
            "--report",
            str(report),
        ]
    )
    assert code == NOT_SOLVED
    assert "NOT SOLVED" in capsys.readouterr().out and "NOT SOLVED" in report.read_text()
    content = json.loads(out.read_text())
    assert not content["solver"]["solved"] and "held_out" not in content["fit"]
    assert all(row["std_error"] is None for row in content["parameters"].values())


@pytest.mark.elsewhere
def test_simulate_makes_the_recording_that_ships(tmp_path, capsys):
    new = tmp_path / "new.csv"
    code = main(
        [
            "simulate",
            str(new),
            "--body",
            str(DATA / "body.json"),
            "--parameters",
            str(DATA / "truth.json"),
            "--seed",
            "2020",
        ]
    )
    assert code == SOLVED
    assert_same_table(new, DATA / "recording.csv")
    assert "6001 samples, 120 s at 50 Hz" in capsys.readouterr().out


def test_simulate_on_a_recorded_platform_from_what_identify_writes(tmp_path):
    found, new = tmp_path / "found.json", tmp_path / "new.csv"
    assert main([*IDENTIFY, "--controller", "pd", "--window", "0", "20", "--json", str(found)]) == SOLVED
    code = main(
        [
            "simulate",
            str(new),
            "--body",
            str(DATA / "body.json"),
            "--controller",
            "pd",
            "--parameters",
            str(found),
            "--platform",
            str(DATA / "recording.csv"),
            "--torque-noise",
            "0",
            "--duration",
            "30",
        ]
    )
    assert code == SOLVED
    made, given = read_recording(new), read_recording(DATA / "recording.csv")
    assert len(made) == 1501
    np.testing.assert_allclose(made["platform_acceleration"], given["platform_acceleration"][:1501], atol=1e-6)


def test_demo_compares_with_the_truth(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["demo"]) == SOLVED
    printed = capsys.readouterr().out
    assert "truth" in printed and "Held-out" in printed and "symid_demo.html" in printed
    assert printed.count(" std. errors") == len(TRUTH)
    assert [p.name for p in tmp_path.iterdir()] == ["symid_demo.html"]


def test_demo_of_an_installed_symid_makes_its_data(tmp_path, monkeypatch):
    from symid.cli import demo

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo, "__file__", str(tmp_path / "site-packages" / "symid" / "cli" / "demo.py"))
    made = demo.data_folder()
    assert_same_table(made / "recording.csv", DATA / "recording.csv")


@pytest.mark.parametrize("command", command_names())
def test_every_command_explains_itself(command, capsys):
    with pytest.raises(SystemExit) as stopped:
        main([command, "--help"])
    assert stopped.value.code == 0
    assert "usage: symid " + command in capsys.readouterr().out


def test_help_lists_every_command_and_a_misspelt_one_is_bad_input(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    listed = capsys.readouterr().out
    assert all(command in listed for command in command_names())
    assert {"identify", "simulate", "demo"} <= set(command_names())
    for wrong in (["identfy"], []):
        with pytest.raises(SystemExit) as stopped:
            main(wrong)
        assert stopped.value.code == BAD_INPUT


def test_interrupting_ends_without_a_traceback(monkeypatch, capsys):
    from symid.cli import simulate

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(simulate, "build_model", interrupt)
    assert main(["simulate", "new.csv", "--body", "b", "--parameters", "p"]) == INTERRUPTED
    assert capsys.readouterr().err == "symid: interrupted\n"


@pytest.mark.elsewhere
def test_as_a_program_a_warning_is_one_line_and_the_exit_code_reaches_the_shell(tmp_path):
    lines = (DATA / "recording.csv").read_text().splitlines()[:502]
    cells = lines[300].split(",")
    lines[300] = ",".join([*cells[:-1], "-60.0"])
    (tmp_path / "odd.csv").write_text("\n".join(lines) + "\n")
    command = [
        sys.executable,
        "-m",
        "symid.cli",
        "identify",
        str(tmp_path / "odd.csv"),
        "--body",
        str(DATA / "body.json"),
        "--window",
        "0",
        "2",
    ]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == SOLVED
    (warning,) = [line for line in done.stderr.splitlines() if "row 300" in line]  # no cache and no compiler warn, too
    assert warning.startswith("symid: warning: ")
    done = subprocess.run([*command[:-2], "9", "99"], capture_output=True, text=True)
    assert done.returncode == BAD_INPUT and "Traceback" not in done.stderr


def test_a_reader_that_has_enough_is_no_error_and_the_files_are_written(tmp_path):
    out = tmp_path / "a.json"
    command = [sys.executable, "-m", "symid.cli", *IDENTIFY, "--window", "0", "4", "--json", str(out)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.close()
        err = process.stderr.read()
    assert process.returncode == SOLVED and json.loads(out.read_text())["solver"]["solved"]
    assert "Broken" not in err and "Traceback" not in err


def test_a_full_disk_names_the_file(tmp_path, monkeypatch, capsys):
    from symid import files

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.os, "replace", full)
    code = main([*IDENTIFY, "--window", "0", "4", "--json", str(tmp_path / "a.json")])
    assert code == BAD_INPUT and list(tmp_path.iterdir()) == []
    assert f"symid: error: {tmp_path / 'a.json'} cannot be written (No space left on device)" in capsys.readouterr().err


@pytest.mark.parametrize(("closed", "arguments", "code"), [("1", "completion bash", 0), ("2", "diagnose nowhere", 2)])
def test_a_stream_that_the_shell_closed_is_silent_and_no_other_speaks_for_it(closed, arguments, code):
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m symid.cli {arguments} {closed}>&-"], capture_output=True, text=True
    )
    assert (done.returncode, done.stdout, done.stderr) == (code, "", "")
