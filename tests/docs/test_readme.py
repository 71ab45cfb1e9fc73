"""What the README says is true."""

import re
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT
from scipy.integrate import solve_ivp

from symid.cli.main import command_names

README = (ROOT / "README.md").read_text(encoding="utf-8")


def write_walks(folder):
    """Recordings of a reader's own, as the README calls them."""
    import ezc3d

    hip = [10.0, 11.0, 12.5, 13.0, 12.0]
    rows = "".join(f"{0.01 * i:.2f},{x},{100 + x}\n" for i, x in enumerate(hip))
    (folder / "walk.csv").write_text(f"Time [s],hip angle [deg],force / N\n{rows}")
    pd.DataFrame({"t": 0.01 * np.arange(5), "Flexion": [*hip[:2], None, *hip[3:]]}).to_excel(folder / "walk.xlsx")
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [100.0]
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    file["parameters"]["POINT"]["LABELS"]["value"] = ["ANK", "LHIP", "RHIP", "C7"]
    file["data"]["points"] = np.ones((4, 4, 5)) * np.array([100.0, 900.0, 900.0, 1400.0])[None, :, None]
    file.write(str(folder / "walk.c3d"))
    time = np.arange(0, 12, 0.05)
    run = solve_ivp(
        lambda t, x: [x[1], -9.81 / 1.5 * np.sin(x[0]) - 0.1 * x[1] - 0.1 * np.tanh(50 * x[1])],
        (0, 12),
        [1.0, 0.0],
        t_eval=time,
        rtol=1e-9,
    )
    angle = np.degrees(run.y[0]) + 0.05 * np.random.default_rng(0).standard_normal(time.size)
    pd.DataFrame({"time_s": time, "angle_deg": angle}).to_csv(folder / "swing.csv", index=False)


def test_the_examples_run_as_they_stand(tmp_path):
    examples = re.findall(r"```python\n(.*?)```", README, re.S)
    assert all(len([line for line in example.splitlines() if line.strip()]) <= 12 for example in examples)
    example = "\n".join(examples)
    write_walks(tmp_path)
    (tmp_path / "data").symlink_to(ROOT / "data")  # the folder that it names, so that its files land elsewhere
    done = subprocess.run([sys.executable, "-c", example], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("Solved") == 2 and "kp_aa" in done.stdout and "dry friction" in done.stdout
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")
    assert "</html>" in (tmp_path / "report.html").read_text()


def test_the_commands_it_names_exist():
    named = set(re.findall(r"`symid (\w+)", README))
    assert named and named <= set(command_names())


@pytest.mark.parametrize("target", re.findall(r"^    make (\w+)", README, re.M))
def test_the_make_targets_it_names_exist(target):
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(), re.M)


@pytest.mark.parametrize("path", re.findall(r"\]\(([\w./]+)\)", README))
def test_its_links_lead_somewhere(path):
    assert (ROOT / path).exists()


def test_the_legend_is_the_one_of_the_code():
    import symid.units

    page = (ROOT / "docs/pages/theory/legend.md").read_text(encoding="utf-8")
    legend = re.findall(r"^([A-Za-z]'?)\s{4,}", symid.units.__doc__, re.M)
    for letter in legend:
        assert re.search(rf"\| (\w, )?{letter}(, \S+)? \|", page), letter


def test_it_is_read_in_five_minutes():
    """At 200 words a minute, code and tables counted."""
    assert len(README.split()) <= 1000


def test_all_commands_are_named():
    listed = re.search(r"There are (.*?):", README, re.S)
    assert listed and set(re.findall(r"`(\w+)`", listed[1])) == set(command_names())
