"""Ctrl-C while a package is imported: it comes out afterwards, and what was imported is whole."""

import signal
import subprocess
import sys
import threading

import pytest

from symid.interrupt import held_back
from symid.units import si


def test_ctrl_c_waits_for_the_end_of_the_block():
    reached = []
    with pytest.raises(KeyboardInterrupt):
        with held_back():
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
            reached.append("the end")
        reached.append("nothing behind it")
    assert reached == ["the end"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_error_of_the_block_comes_out_and_other_threads_are_left_alone():
    with pytest.raises(ImportError), held_back():
        raise ImportError
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    done = []

    def elsewhere():
        with held_back():
            done.append(1)

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert done


def test_a_package_that_fails_is_not_taken_for_a_wrong_unit(monkeypatch):
    def broken():
        raise ImportError("no memory")

    monkeypatch.setattr(si, "_registry", broken)
    with pytest.raises(ImportError, match="no memory"):
        si.parsed.__wrapped__("rad/s^2")


PRESSED = """
import sys
class Pressed:
    def find_spec(name, path=None, target=None):
        if name == sys.argv[1]:
            raise KeyboardInterrupt
sys.meta_path.insert(0, Pressed)
from symid.cli import main
sys.exit(main(["doctor"]))
"""


@pytest.mark.parametrize("where", ["symid.threads", "symid.cli.simulate"])
def test_ctrl_c_while_the_command_line_is_imported(where):
    done = subprocess.run([sys.executable, "-c", PRESSED, where], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (130, "symid: interrupted\n")
