"""Programs that tests of faults stop, starve and mislead: `python fault_programs.py KIND FOLDER`, each some seconds.

What they do is what the command line does, on small problems: the folder gets their inputs, outputs and store.
"""

import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from symid.cli import main

STANDING = Path(__file__).parents[1] / "data" / "standing_synthetic"
RIG = '{"m1_kg": 1.0, "a1_m": 0.5, "I1_kg_m2": 0.97625, "g_m_s2": 9.81}'
OUTPUTS = {
    "diagnose": ("found.json", "report.html", "prediction.csv"),
    "reproduce": ("comparison.csv", "figure_2.png", "starts.png"),
}


def prepare(folder: Path) -> None:
    """Inputs of both."""
    from conftest import pendulum_recording  # not at the top: a program that is short of memory begins with `main`

    from symid.recording import read_recording

    swing = pendulum_recording(damping=0.05, duration=12.0, noise=1e-3, strength=0.0)
    swing.select("angle").rename({"angle": "link1_angle"}).to_csv(folder / "swing.csv")
    (folder / "rig.json").write_text(RIG)
    read_recording(STANDING / "recording.csv").window(0, 8).to_csv(folder / "recording_50hz.csv")
    (folder / "body.json").write_text((STANDING / "body.json").read_text())


def made_small(name: str, change: Callable[[], None]) -> None:
    """Let the command do `change` before anything else: inside `main`, as what a user interrupts or starves is."""
    command = import_module(f"symid.cli.{name}")
    run = command.run
    command.run = lambda arguments: change() or run(arguments)


def diagnose(folder: Path) -> int:
    """A free swing with damping, of a rig that is said to have none; one suspect."""

    def one_suspect() -> None:
        from symid.discrepancy import suspects

        few = lambda model, sizes: [s for s in suspects(model, sizes) if s.term.name == "viscous_friction"]  # noqa: E731
        import_module("symid.discrepancy.explained").suspects_of = few

    made_small("diagnose", one_suspect)
    outputs = [str(folder / name) for name in OUTPUTS["diagnose"]]
    options = zip(("--json", "--report", "--held-out-csv"), outputs, strict=True)
    source = [str(folder / "swing.csv"), "--rig", str(folder / "rig.json")]
    windows = ["--window", "0", "8", "--held-out", "8", "12", "--threads", "1"]
    return main(["diagnose", *source, *windows, *(word for option in options for word in option)])


def reproduce(folder: Path) -> int:
    """Two starts of the article's first case, on a made-up person and a few seconds."""

    def few_seconds() -> None:
        import_module("symid.fetch").standing = Path  # the folder as it is given, though it is not the article's
        run = import_module("symid.reproduce.run")
        run.WINDOW, run.RANGE, run.HELD_OUT = dict.fromkeys(run.WINDOW, (0.0, 5.0)), (0.0, 8.0), (5.0, 8.0)

    made_small("reproduce", few_seconds)
    places = [f"--{name}={folder / name}" for name in ("store", "output")]
    return main(["reproduce", "--only", "PD-1", "--starts", "2", f"--recordings={folder}", *places])


if __name__ == "__main__":
    sys.exit({"diagnose": diagnose, "reproduce": reproduce}[sys.argv[1]](Path(sys.argv[2])))
