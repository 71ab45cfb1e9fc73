"""The install: a folder named symid beside a script, a clone for instance, does not hide the package."""

import subprocess
import sys

SCRIPT = "import symid\nassert callable(symid.read_recording)\nprint(symid.__file__)\n"


def test_a_clone_beside_a_script_does_not_hide_the_package(tmp_path):
    (tmp_path / "symid" / "symid").mkdir(parents=True)
    (tmp_path / "symid" / "pyproject.toml").write_text("")
    (tmp_path / "script.py").write_text(SCRIPT)
    for command in (["script.py"], ["-c", SCRIPT], ["-m", "script"]):
        done = subprocess.run([sys.executable, *command], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert done.stdout.strip().endswith("__init__.py")
