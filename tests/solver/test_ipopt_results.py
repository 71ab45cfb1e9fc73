"""Warm starts, what a result holds, and what is told where cyipopt is absent."""

import builtins
import dataclasses
import errno
import os
import subprocess
import sys

import numpy as np
import pytest
from nlp_problems import hs071, one_variable, tracking

from symid.errors import MachineError, SolveError
from symid.ipopt_solver import aside, solve as ipopt_solver, solve_nlp, through_cyipopt
from symid.ipopt_solver.kept import put_together, taken_apart
from symid.ipopt_solver.status import STATUS, explain


def test_warm_start_takes_fewer_iterations_than_a_cold_one():
    cold = solve_nlp(tracking())
    nearby = tracking(damping=0.41)
    warm = solve_nlp(nearby, warm_start=cold)
    assert warm.solved
    assert warm.z[-1] == pytest.approx(0.41, abs=1e-4)
    assert warm.iterations < solve_nlp(nearby).iterations
    assert solve_nlp(tracking(), warm_start=cold).iterations <= 1


def test_warm_start_with_an_active_bound_stays_there():
    nlp = one_variable(upper=[2.0])
    cold = solve_nlp(nlp)
    warm = solve_nlp(nlp, warm_start=cold)
    assert warm.z[0] == pytest.approx(2.0, abs=1e-6)
    assert warm.iterations < cold.iterations


def test_a_warm_start_of_another_size_is_refused():
    with pytest.raises(SolveError, match=r"z has shape \(1,\), expected \(4,\)"):
        solve_nlp(hs071(), warm_start=solve_nlp(one_variable()))


@pytest.mark.parametrize(
    "error, kind, words",
    [
        (ModuleNotFoundError("No module named 'cyipopt'"), SolveError, "not installed"),
        (
            ImportError("libmumps.so: failed to map segment"),
            MachineError,
            "cannot be loaded .*failed to map segment.*memory enough",
        ),
    ],
)
def test_why_cyipopt_is_not_there_is_told(monkeypatch, error, kind, words):
    def refuse(name, *_):
        if name == "cyipopt":
            raise error
        return real(name, *_)

    real = builtins.__import__
    ipopt_solver._runner.cache_clear()
    monkeypatch.setattr(through_cyipopt, "extensions", lambda: [])
    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(kind, match=words):
        solve_nlp(hs071())


def test_the_same_point_is_handed_to_the_functions_as_the_same_array():
    # A transcription may recognise a point by identity and save an evaluation.
    seen, right = [], hs071()

    def noting(name):
        def function(z, *rest):
            seen.append(z)
            return getattr(right, name)(z, *rest)

        return function

    solve_nlp(hs071(**{name: noting(name) for name in ("objective", "gradient", "constraints", "jacobian")}))
    assert len({id(z) for z in seen}) < len(seen)
    assert all((np.array_equal(a, b) or a is not b) for a in seen for b in seen)


def test_seconds_add_up():
    seconds = solve_nlp(tracking()).seconds
    parts = ("objective", "gradient", "constraints", "jacobian", "hessian")
    assert sum(seconds[p] for p in parts) == pytest.approx(seconds["functions"])
    assert seconds["functions"] + seconds["solver"] == pytest.approx(seconds["total"])


def test_results_are_frozen_and_independent():
    nlp = hs071()
    first = solve_nlp(nlp)
    kept = first.z.copy()
    solve_nlp(nlp, start=np.array([2.0, 2, 2, 2]))
    np.testing.assert_array_equal(first.z, kept)
    with pytest.raises(dataclasses.FrozenInstanceError):
        first.z = kept


def test_every_status_has_a_name_and_a_next_step():
    for name, sentence in STATUS.values():
        assert name[0].isupper() and sentence.endswith(".") and len(sentence) > 40
    assert explain(12345)[0] == "Unknown_Status_12345"


def test_absent_cyipopt_is_one_sentence_with_the_command_that_helps():
    code = (
        "import sys; sys.modules['cyipopt'] = None\n"
        "sys.path.insert(0, sys.argv[1])\n"
        "from nlp_problems import hs071\n"
        "from symid.ipopt_solver import solve_nlp\n"
        "from symid.errors import SolveError\n"
        "try: solve_nlp(hs071())\n"
        "except SolveError as e: print(e)"
    )
    folder = os.path.dirname(__file__)
    run = subprocess.run([sys.executable, "-c", code, folder], capture_output=True, text=True, check=True)
    assert "python -m symid.setup_ipopt" in run.stdout


@pytest.mark.parametrize("time", ["functions", "solver", "total"])
def test_a_kept_result_without_one_of_its_times_is_refused(time):
    content, arrays = taken_apart(solve_nlp(hs071()))
    assert put_together(content, arrays).seconds == content["seconds"]
    del content["seconds"][time]
    with pytest.raises(ValueError, match="times"):
        put_together(content, arrays)


@pytest.mark.parametrize("room", [True, False])
def test_a_large_result_waits_in_a_file_and_comes_back_bit_for_bit(monkeypatch, room):
    result = solve_nlp(hs071())

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(aside, "MANY_UNKNOWNS", 0)
    if not room:
        monkeypatch.setattr(aside.np, "savez", full)
    again = aside.set_aside(result)()
    assert (again is result) == (not room) and repr(again) == repr(result)
    for name in aside.VECTORS:
        np.testing.assert_array_equal(getattr(again, name), getattr(result, name), strict=True)
