"""Signs of life: nothing is silent for long, the innermost block speaks, and nobody speaks twice."""

import io
import time

from symid import progress
from symid.progress import alive, say


def wait_for_lines(capsys, count: int) -> list[str]:
    lines: list[str] = []
    end = time.monotonic() + 10
    while len(lines) < count and time.monotonic() < end:
        time.sleep(0.02)
        lines += capsys.readouterr().err.splitlines()
    return lines


def test_a_silent_block_says_what_it_is_at(monkeypatch, capsys):
    monkeypatch.setattr(progress, "SILENCE_S", 0.1)
    with alive(lambda: "outer"), alive(lambda: "inner"):
        lines = wait_for_lines(capsys, 2)
    assert len(lines) == 2 and all(line.startswith("inner, for ") for line in lines)


def test_who_is_heard_anyway_gets_no_line(monkeypatch, capsys):
    monkeypatch.setattr(progress, "SILENCE_S", 3.0)
    with alive(lambda: "outer"):
        for k in range(5):
            say(str(k))
            time.sleep(0.01)
    assert capsys.readouterr().err.splitlines() == list("01234")


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_on_a_terminal_steps_have_a_bar_and_lines_else(monkeypatch, capsys):
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    for k in (1, 2, 3):
        progress.step(k, 3, f"solve {k}")
    told = terminal.getvalue()
    assert "solve 1" in told and "solve 3" in told and "2/3" in told and not progress._bars
    monkeypatch.undo()
    progress.step(1, 2, "solve 1")
    assert capsys.readouterr().err == "solve 1\n"
