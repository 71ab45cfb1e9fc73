"""What a user is told before anything runs: examples that parse, completion, the state of the installation."""

import shlex
import subprocess
from importlib import import_module

import pytest

import symid
from symid.cli.main import build_parser, command_names, main
from symid.progress import NORMAL, set_level


@pytest.mark.parametrize("name", command_names())
def test_every_command_shows_examples_that_parse(name, capsys):
    module = import_module(f"symid.cli.{name}")
    assert module.EXAMPLES
    for example in module.EXAMPLES:
        words = shlex.split(example.removeprefix('eval "$(').removesuffix(')"'))
        assert words[:2] == ["symid", name]
        build_parser().parse_args(words[1:])
    with pytest.raises(SystemExit):
        main([name, "--help"])
    assert module.EXAMPLES[0] in capsys.readouterr().out


def test_the_help_of_all_shows_examples_that_parse(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    examples = [line[2:] for line in capsys.readouterr().out.splitlines() if line.startswith("  symid ")]
    assert len(examples) > 2 and examples[-1] == "symid identify --help"
    for example in examples[:-1]:
        build_parser().parse_args(shlex.split(example)[1:])


def test_completion_is_a_script_that_bash_reads(capsys):
    assert main(["completion", "bash"]) == 0
    script = capsys.readouterr().out
    assert "identify" in script and "--held-out" in script
    assert subprocess.run(["bash", "-n"], input=script, text=True).returncode == 0


@pytest.mark.compiled
def test_the_doctor_finds_a_working_installation(capsys):
    assert main(["doctor"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ["ok"] * len(lines) and "self-test" in lines[-1]


def test_the_doctor_names_what_does_not_work(capsys, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("SYMID_CACHE_DIR", str(tmp_path / "file"))
    assert main(["doctor"]) == 1
    assert any(line.startswith("BAD  cache") for line in capsys.readouterr().out.splitlines())


def test_the_package_tells_its_version():
    from importlib.metadata import version

    assert symid.__version__ == version("symid")


def test_a_file_whose_folder_is_missing_is_refused_before_the_work(tmp_path, capsys):
    missing = str(tmp_path / "nowhere" / "report.html")
    body, recording = "data/standing_synthetic/body.json", "data/standing_synthetic/recording.csv"
    for words in (
        ["identify", recording, "--body", body, "--report", missing],
        ["diagnose", recording, "--body", body, "--controller", "pd", "--window", "0", "9", "--report", missing],
        ["simulate", missing, "--body", body, "--parameters", "none.json"],
        ["demo", "--report", missing],
        ["bench", "--json", missing],
    ):
        assert main(words) == 2
        assert "nowhere does not exist" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_quiet_says_nothing_but_errors_and_verbose_says_where_they_come_from(tmp_path, capsys):
    assert main(["conceal", str(tmp_path), "--system", "rig", "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    assert main(["conceal", str(tmp_path), "--system", "rig"]) == 0
    assert "case 1 of 1 is made" in capsys.readouterr().err
    assert main(["conceal", str(tmp_path), "--system", "nothing", "--verbose"]) == 2
    told = capsys.readouterr().err
    assert "Traceback" in told and told.splitlines()[-1].startswith("symid: error: ")
    set_level(NORMAL)
