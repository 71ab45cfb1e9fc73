"""The pages say what is true: their examples run, their links and references lead somewhere."""

import os
import re
import subprocess
import sys
from importlib.util import find_spec

import pytest
from conftest import ROOT, example

from symid.cli.main import build_parser, command_names, main

PAGES = ROOT / "docs" / "pages"


SHORT = "index", "own_recording"
"""What a newcomer tries first runs each time; the other pages with the slow studies."""
WITH_CODE = [
    example(p, p.stem, text, slow=p.stem not in SHORT)
    for p in sorted(PAGES.rglob("*.md"))
    if "```python" in (text := p.read_text(encoding="utf-8"))
]


@pytest.mark.parametrize("page", WITH_CODE)
def test_the_examples_of_a_page_run_one_after_the_other(page, tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S)
    (tmp_path / "data").symlink_to(ROOT / "data")
    script = tmp_path / "page.py"  # a file, because worker processes read it again
    script.write_text("\n".join(blocks), encoding="utf-8")
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def commands_of(text: str) -> list[str]:
    """Commands of indented and of ``sh`` blocks, and those in a line of text that name a file; joined at a
    backslash.
    """
    text = text.replace("\\\n", " ")
    lines = re.findall(r"^    (?:\.venv/bin/)?(symid .*)$", text, re.M) + re.findall(
        r"`(?:\.venv/bin/)?(symid [^`\n]*)`", text
    )
    return [re.sub(r"\s+#.*$", "", line) for line in lines]


COMMANDS = sorted(
    {c for p in [ROOT / "README.md", *PAGES.rglob("*.md")] for c in commands_of(p.read_text(encoding="utf-8"))}
)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_that_is_shown_is_one(command, capsys):
    """Words in capitals stand for what a user puts there; where something is left out (...) the options exist."""
    words = [w.strip('"') for w in re.sub(r'"\$\(.*\)"', "tcp://HOST:1", command).split()[1:]]
    if words[0] == "COMMAND":
        return
    assert words[0] in command_names()
    if "..." in words or words[1:] == ["--help"]:
        with pytest.raises(SystemExit, match="0"):
            build_parser().parse_args([words[0], "--help"])
        told = capsys.readouterr().out
        assert all(w in told for w in words if w.startswith("--"))
    elif len(words) > 1:
        build_parser().parse_args([{"T0": "0", "T1": "1", "K": "2"}.get(w, w) for w in words])


@pytest.mark.slow
@pytest.mark.parametrize("command", [example(c, c, c) for c in COMMANDS if " data/" in c])
def test_a_command_on_files_that_ship_runs(command, tmp_path, monkeypatch, capsys):
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    assert main(command.split()[1:]) == 0
    for path in re.findall(r"--(?:report|json|held-out-csv) (\S+)", command):
        assert (tmp_path / path).stat().st_size > 0


@pytest.mark.slow
@pytest.mark.skipif(find_spec("mkdocs") is None, reason="the extra `docs` is not installed")
def test_the_pages_build_without_a_warning(tmp_path):
    command = [
        sys.executable,
        "-m",
        "mkdocs",
        "build",
        "--strict",
        "--quiet",
        "-f",
        ROOT / "docs" / "mkdocs.yml",
        "-d",
        tmp_path,
    ]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"NO_MKDOCS_2_WARNING": "1"})
    assert done.returncode == 0, done.stdout + done.stderr
    assert "<math" in (tmp_path / "theory" / "collocation.html").read_text(encoding="utf-8")
    for notebook in (ROOT / "notebooks").glob("*.ipynb"):
        page = (tmp_path / "tutorial" / f"{notebook.stem}.html").read_text(encoding="utf-8")
        assert 'src="data:image/png' in page and "$$" not in page
