"""The committed sources are what the equations give, and the check says so when they are not."""

import os
import subprocess
import sys

import pytest

from symid import regenerate as subject
from symid.codegen.shipped import FOLDER
from symid.regenerate import main, regenerate


@pytest.fixture
def few(monkeypatch, tmp_path):
    """The cheapest shipped model alone, in a folder of its own."""
    monkeypatch.setattr(subject, "SHIPPED", {"bench": subject.SHIPPED["bench"]})
    return tmp_path


def test_the_committed_sources_are_current():
    assert regenerate(check=True) == []


def test_every_shipped_name_has_its_source_and_its_fingerprint_first():
    names = {f"{m}_{s}" for m, (_, schemes) in subject.SHIPPED.items() for s in (*schemes, "objective")}
    assert {p.stem for p in FOLDER.glob("*.c")} == names
    first = [p.read_text().split("\n", 1)[0] for p in FOLDER.glob("*.c")]
    assert all(line.startswith("// ") and len(line) == 35 for line in first) and len(set(first)) == len(first)


def test_missing_changed_and_surplus_sources_are_named_then_mended(few):
    names = {f"bench_{s}" for s in ("midpoint", "backward_euler", "trapezoid", "hermite_simpson", "objective")}
    assert set(regenerate(folder=few)) == names
    assert regenerate(check=True, folder=few) == []
    (few / "bench_midpoint.c").write_text((few / "bench_midpoint.c").read_text().replace("0.5", "0.25"))
    (few / "former_model.c").write_text("// nobody\n")
    (few / "bench_objective.c").unlink()
    stale = ["bench_midpoint", "bench_objective", "former_model"]
    assert regenerate(check=True, folder=few) == stale
    assert (few / "former_model.c").exists()
    assert regenerate(folder=few) == stale
    assert regenerate(check=True, folder=few) == []
    assert {p.stem for p in few.iterdir()} == names


def test_check_exits_1_and_names_the_model(monkeypatch, capsys):
    monkeypatch.setattr(subject, "regenerate", lambda check: ["standing_pd_midpoint"])
    assert main(["--check"]) == 1
    assert "standing_pd_midpoint: the source in" in capsys.readouterr().out
    assert main([]) == 0
    assert "standing_pd_midpoint: rewritten" in capsys.readouterr().out


def test_all_current_is_said_and_exits_0(monkeypatch, capsys):
    monkeypatch.setattr(subject, "regenerate", lambda check: [])
    assert main(["--check"]) == 0
    assert capsys.readouterr().out == "all generated sources are current\n"


def test_a_folder_that_cannot_be_written_is_said(monkeypatch, capsys):
    def refuse(check):
        raise PermissionError(13, "Permission denied", "/usr/lib/symid/generated")

    monkeypatch.setattr(subject, "regenerate", refuse)
    assert main([]) == 2
    assert "cannot write /usr/lib/symid/generated (Permission denied)" in capsys.readouterr().err


@pytest.mark.parametrize("seed", ["1", pytest.param("2", marks=pytest.mark.slow)])
def test_the_text_does_not_depend_on_the_hash_seed(seed):
    code = "from symid.regenerate import main; raise SystemExit(main(['--check']))"
    done = subprocess.run([sys.executable, "-c", code], env=os.environ | {"PYTHONHASHSEED": seed}, capture_output=True)
    assert done.returncode == 0
