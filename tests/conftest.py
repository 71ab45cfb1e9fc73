"""What several tests share: small models, and the folder of reference material beside the checkout."""

import os
import signal
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import sympy as sm

import symid.model as si
from symid.recording import Recording
from symid.simulation import Simulator as AnySimulator

TESTS = Path(__file__).resolve().parent
ROOT = TESTS.parent
SHARED = ROOT.parent / "shared"
COMPILED = ("codegen", "discrepancy", "estimation")
"""Folders whose tests compare C with NumPy, or fit by thousands of simulations: in Python these take hours."""
if SHARED.is_dir():  # for the notebooks, too, which run in processes of their own
    os.environ.setdefault("SYMID_STANDING", str(SHARED / "recordings" / "standing_subject05"))


@pytest.fixture(params=["c", "numpy"])
def Simulator(request):
    """A simulator with each of its two loops."""
    return partial(AnySimulator, backend=request.param)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The reference material; tests that need it skip where it is absent."""
    if not SHARED.is_dir():
        pytest.skip(f"no reference material at {SHARED}")
    return SHARED


def pendulum() -> si.Model:
    """A driven, damped pendulum with one unknown: the smallest model with all kinds of parts."""
    m = si.Model("driven pendulum")
    m.angle = si.State(unit="rad", bounds=(-3, 3))
    m.rate = si.State(unit="rad/s", bounds=(-20, 20))
    m.drive = si.Input(unit="1/s^2")
    m.stiffness = si.Constant(4.0, unit="1/s^2")
    m.damping = si.Parameter(unit="1/s", bounds=(0, 5))
    m.push = si.Noise(unit="1/s^2")
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(m.rate.dot + m.stiffness * sm.sin(m.angle) + m.damping * m.rate - m.drive - m.push)
    m.measured = si.Output(m.angle)
    return m


@pytest.fixture
def pendulum_model() -> si.Model:
    return pendulum()


def pendulum_recording(
    damping: float = 0.4,
    duration: float = 6.0,
    step: float = 0.02,
    noise: float = 0.0,
    seed: int = 0,
    strength: float = 1.0,
) -> Recording:
    """The pendulum's motion under a smooth drive, from SciPy's integrator, which symid does not use."""
    from scipy.integrate import solve_ivp

    time = np.arange(0, duration + step / 2, step)

    def drive(t):
        return strength * (1.5 * np.sin(2.1 * t) + np.cos(0.7 * t))

    def f(t, x):
        return [x[1], -4 * np.sin(x[0]) - damping * x[1] + drive(t)]

    x = solve_ivp(f, (0, time[-1]), [0.3, 0.0], t_eval=time, rtol=1e-12, atol=1e-13, method="DOP853").y
    angle = x[0] + noise * np.random.default_rng(seed).standard_normal(len(time))
    return Recording(
        "pendulum",
        time,
        {"angle": angle, "rate": x[1], "drive": drive(time)},
        {"angle": "rad", "rate": "rad/s", "drive": "rad/s^2"},
    )


@pytest.fixture(scope="module")
def empty_cache(tmp_path_factory):
    """A cache of kernels of the module's own, empty at first."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SYMID_CACHE_DIR", str(folder))
        yield folder


@pytest.fixture(scope="module")
def pool():
    """Two workers of studies."""
    from symid.identification import LocalPool

    with LocalPool(2) as made:
        yield made


@pytest.fixture(scope="module")
def undisturbed(pool):
    """The numbers of a study that nothing happened to."""
    from study_problems import numbers, study

    return numbers(study().run(pool, on_finished=None))


@pytest.fixture
def solved(monkeypatch) -> list[str]:
    """Grows by the key of every solve of a study that is done in this process."""
    from symid.identification.studies import dispatch

    done = []

    def note(solve, on_iteration=None):
        done.append(solve.key)
        return original(solve, on_iteration)

    original = dispatch.solve_here
    monkeypatch.setattr(dispatch, "solve_here", note)
    return done


def example(thing, name: str, text: str, slow: bool = False):
    """A parameter of a test that runs `text`, which takes more than ten minutes in Python where it is a diagnosis."""
    marks = [pytest.mark.slow] if slow else []
    return pytest.param(thing, id=name, marks=[*marks, pytest.mark.compiled] if "diagnose" in text else marks)


def pytest_configure() -> None:
    """Interrupts are tested, here and in programs that are started; a shell's background has them ignored."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items) -> None:
    """Without a C compiler what asks for C by name is left out, and what would take hours without it."""
    compiled = [item for item in items if item.path.parent.name in COMPILED or _asks_for_c(item)]
    if compiled and not _has_compiler():
        for item in compiled:
            item.add_marker(pytest.mark.skip(reason="no C compiler"))


def _asks_for_c(item) -> bool:
    parameters = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return item.get_closest_marker("compiled") is not None or any(isinstance(v, str) and v == "c" for v in parameters)


def _has_compiler() -> bool:
    from symid.codegen.build import compiled
    from symid.errors import CodegenError

    try:
        compiled("int one(void) { return 1; }")
    except CodegenError:
        return False
    return True


def pytest_terminal_summary(terminalreporter) -> None:
    """Faults on purpose, counted by what was done."""
    counted: dict[str, list[int]] = {}
    for column, outcome in enumerate(("passed", "failed")):
        for report in terminalreporter.getreports(outcome):
            if report.when == "call" and "fault" in report.keywords:
                counted.setdefault(report.nodeid.split("::")[1].split("[")[0], [0, 0])[column] += 1
    if counted:
        terminalreporter.section("faults on purpose")
        for name, (good, bad) in counted.items():
            terminalreporter.line(f"{good + bad:5d} {name.removeprefix('test_').replace('_', ' ')}: {bad} not survived")
        total, lost = (sum(column) for column in zip(*counted.values(), strict=True))
        terminalreporter.line(f"{total + lost:5d} faults, {lost} not survived")
