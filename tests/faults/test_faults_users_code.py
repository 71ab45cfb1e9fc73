"""Faults of a user's own code: exceptions and NaN from models and call-backs, solves that never end, Ctrl-C.

An exception of the user comes out as it is and leaves everything usable; NaN is a sentence that names where; what
never ends is stopped by the time limit or by Ctrl-C, at the start, in the functions and in the linear algebra.
"""

import _thread
import random
import threading
import time

import numpy as np
import pytest
import sympy as sm
from conftest import pendulum, pendulum_recording
from study_problems import numbers, problem, study

import symid as si
from symid.errors import SymidError
from symid.identification import LocalPool

pytestmark = [pytest.mark.slow, pytest.mark.fault]


class Own(Exception):
    """What a user's code raises."""


def raises(*_):
    raise Own("mine")


@pytest.fixture(scope="module")
def undisturbed():
    return numbers(study(starts=2).run_here(on_finished=None))


@pytest.mark.parametrize("moment", range(1, 5))
@pytest.mark.parametrize("where", ["here", "pool"])
def test_a_call_back_that_raises_ends_the_study_and_keeps_what_was_finished(undisturbed, tmp_path, where, moment):
    def on_finished(finished):
        if finished.done == moment:
            raise Own("mine")

    with pytest.raises(Own):
        one = study(tmp_path, 2)
        one.run_here(on_finished) if where == "here" else one.run(LocalPool(2), on_finished=on_finished)
    kept = {f: f.stat().st_mtime_ns for f in tmp_path.glob("*.npz")}
    assert len(kept) >= moment
    assert numbers(study(tmp_path, 2).run_here(on_finished=None)) == undisturbed
    assert all(f.stat().st_mtime_ns == when for f, when in kept.items())


@pytest.mark.parametrize("iteration", range(5))
def test_an_iteration_that_raises_or_stops(iteration):
    def on_iteration(seen):
        if seen.number == iteration:
            raise Own("mine")

    with pytest.raises(Own):
        problem().solve(start="random", on_iteration=on_iteration)
    stopped = problem().solve(start="random", on_iteration=lambda seen: seen.number < iteration)
    assert not stopped.solved and stopped.message


ODD = {
    "logarithm of what turns negative": lambda m: sm.log(m.angle - m.angle.initial * 0 - sm.Rational(1, 3)),
    "root of what turns negative": lambda m: sm.sqrt(m.angle),
    "division by what is zero": lambda m: 1 / (m.damping * 0 + sm.Symbol("damping", real=True) - m.damping.symbol),
    "overflow": lambda m: sm.exp(1e6 * m.damping),
    "a pole": lambda m: 1 / m.angle,
}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("odd", ODD)
@pytest.mark.parametrize("backend", ["c", "numpy"])
def test_a_model_that_gives_nan_is_a_sentence_or_a_result(odd, backend):
    model = pendulum()
    try:
        model.redefine("measured", model.angle + 1e-9 * ODD[odd](model))
        found = si.Identification(model, pendulum_recording(duration=2, noise=0.01), backend=backend).solve()
        assert found.message and all(np.isfinite(v) for v in found.values.values())
    except SymidError as told:
        assert 0 < len(str(told)) < 2000 and "Traceback" not in str(told)


@pytest.mark.parametrize("limit_s", [1e-9, 1e-3, 0.01, 0.05])
@pytest.mark.parametrize("start", ["default", "random", "search", "stable", "relaxed"])
def test_a_solve_that_would_take_longer_ends_in_time(start, limit_s):
    began = time.monotonic()
    try:
        found = problem().solve(start=start, time_limit_s=limit_s)
        assert found.message
    except SymidError as told:
        assert "time" in str(told)
    assert time.monotonic() - began < 60


def test_a_solve_that_never_ends():
    def slow(_):
        time.sleep(0.5)

    began = time.monotonic()
    found = problem().solve(start="random", on_iteration=slow, time_limit_s=2.0, options={"tol": 1e-30})
    assert time.monotonic() - began < 30 and found.message


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("where", ["identify", "simulate", "diagnose"])
def test_ctrl_c_in_any_phase_comes_out_and_leaves_everything_usable(where, seed):
    """At any moment of building, starting, solving, simulating and refitting."""
    delay = random.Random(f"{where}{seed}").uniform(0.01, {"identify": 1.0, "simulate": 0.3, "diagnose": 4.0}[where])
    timer = threading.Timer(delay, _thread.interrupt_main)
    timer.start()
    try:
        while True:
            ACTS[where]()
    except KeyboardInterrupt:
        pass
    finally:
        timer.cancel()
    assert problem().solve().solved


def _diagnose():
    model = si.mechanics.rig_model({"m1_kg": 1.0, "a1_m": 0.5, "I1_kg_m2": 0.97625}, ["link1_angle"])
    swing = pendulum_recording(damping=0.05, duration=12.0, noise=1e-3, strength=0.0)
    swing = swing.select("angle").rename({"angle": "link1_angle"})
    few = [s for s in si.suspects(model) if s.term.name == "viscous_friction"]
    si.diagnose(model, swing, fit_window=(0, 8), held_out=(8, 12), suspects=few, threads=1 + int(time.time()) % 2)


def _simulate():
    from symid.simulation import simulator

    time_s = np.linspace(0, 20, 2001)
    drive = {"drive": np.sin(time_s)}
    simulator(pendulum()).simulate(np.array([0.1]), np.array([0.3, 0.0]), time_s, drive, substeps=20)


ACTS = {
    "identify": lambda: problem().solve(start="random", seed=int(time.time())),
    "simulate": _simulate,
    "diagnose": _diagnose,
}


@pytest.mark.parametrize("place", ["progress", "law", "suspects"])
def test_what_a_diagnosis_is_given_raises(place):
    model = si.mechanics.rig_model({"m1_kg": 1.0, "a1_m": 0.5, "I1_kg_m2": 0.97625}, ["link1_angle"])
    swing = pendulum_recording(damping=0.05, duration=12.0, noise=1e-3, strength=0.0)
    swing = swing.select("angle").rename({"angle": "link1_angle"})
    law = si.Law("mine", "joint", (si.LawParameter("size", "N*m"),), raises)
    few = [s for s in si.suspects(model) if s.term.name == "viscous_friction"]
    more = {
        "progress": {"suspects": few, "progress": raises},
        "law": {"suspects": [*few, si.Suspect(law.at("joint1"))]},
        "suspects": {"suspects": (raises() for _ in range(1))},
    }
    with pytest.raises((Own, SymidError)) as told:
        si.diagnose(model, swing, fit_window=(0, 8), held_out=(8, 12), threads=2, **more[place])
    assert "mine" in str(told.value)
    _diagnose()
