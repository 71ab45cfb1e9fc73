"""Recorded inputs that have noise of their own: it moves a mechanism like random forces, and is no missing law."""

from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
import sympy as sm
from scipy.signal import butter, filtfilt, lfilter

import symid as si
from symid.discrepancy.task import Task
from symid.errors import DiagnosisError, ModelError
from symid.estimation.fitting import noise_sizes as sizes
from symid.model.variants import CORRELATION_TIME
from symid.simulation import Simulator

VALUES = {"length": 0.3, "damping": 0.15}
SUSPECTS = ("coulomb_friction", "joint_drag", "cubic_stiffness", "constant_torque", "input_gain")


def pendulum(law=lambda m: 0) -> si.Model:
    """On a cart whose acceleration was measured."""
    m = si.Model("pendulum on a cart")
    m.angle, m.rate = si.State(unit="rad"), si.State(unit="rad/s")
    m.cart = si.Input(unit="m/s^2", channel="cart_acceleration")
    m.length, m.damping = si.Parameter(unit="m", bounds=(0.05, 2)), si.Parameter(unit="1/s", bounds=(0, 5))
    m.g = si.Constant(9.81, unit="m/s^2")
    m.kinematics = si.Equation(m.angle.dot - m.rate)
    m.balance = si.Equation(
        m.length * (m.rate.dot + m.damping * m.rate) + m.g * sm.sin(m.angle) + m.cart * sm.cos(m.angle) + law(m)
    )
    m.pivot = si.Port(position=m.angle, rate=m.rate, into={"balance": -1.0}, role="joint", at="pivot")
    m.seen = si.Output(m.angle)
    return m


def recorded(true: si.Model, seed: int, input_noise: float, **more: float) -> si.Recording:
    rng, fine = np.random.default_rng((41, seed)), np.arange(0, 45, 0.001)
    cart = filtfilt(*butter(2, 0.004), rng.standard_normal(len(fine)))
    cart /= cart.std()
    angle = Simulator(true).simulate(VALUES | more, {"angle": 0.3, "rate": 0}, fine, {"cart": cart}).states["angle"]
    time, size = fine[::10], len(fine[::10])
    return si.Recording(
        "cart",
        time,
        {
            "angle": angle[::10] + 0.001 * rng.standard_normal(size),
            "cart_acceleration": cart[::10] + input_noise * rng.standard_normal(size),
        },
        {"angle": "rad", "cart_acceleration": "m/s^2"},
    )


def diagnosed(recording: si.Recording) -> si.Diagnosis:
    model = pendulum()
    few = [s for s in si.suspects(model) if s.term.name in SUSPECTS]
    return si.diagnose(model, recording, fit_window=(0, 30), held_out=(30, 44.9), suspects=few, threads=1)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1])
def test_noise_of_an_input_is_no_missing_physics(seed):
    found = diagnosed(recorded(pendulum(), seed, 0.1))
    assert found.verdict == "adequate" and not found.effects
    assert "noise in the recorded cart_acceleration (0." in str(found)
    assert found.baseline.process[0] == pytest.approx(0.1, rel=0.15)


@pytest.mark.slow
def test_a_law_beside_noise_of_an_input_is_found():
    term = si.mechanics.LIBRARY["coulomb_friction"].at("pivot")
    found = diagnosed(recorded(pendulum().with_term(term), 2, 0.1, **{term.parameter_name("torque_Nm"): 0.12}))
    (effect,) = found.effects
    assert effect.name == "coulomb_friction" and effect.parameters["torque_Nm"][0] == pytest.approx(0.12, rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("size", [0.1, 1.0])
def test_a_law_that_has_no_name_is_not_taken_for_noise_of_an_input(size):
    found = diagnosed(
        recorded(pendulum(lambda m: 0.4 * size * sm.sin(3 * m.angle) * sm.exp(-((m.rate / 2) ** 2))), 3, 0)
    )
    assert found.verdict == "unexplained" and "noise in the recorded" not in str(found)


def test_what_was_found_is_kept_where_noise_cannot_be_tried(monkeypatch):
    """As where a part of the model has the name of the noise already."""
    from symid.discrepancy import judged as module

    def refuse(self):
        raise ModelError("there is a part 'cart_noise' already")

    monkeypatch.setattr(module, "explained", lambda task, *others: mock.MagicMock(task=task))
    monkeypatch.setattr(module, "tested", lambda *arguments: mock.MagicMock(nameless=True))
    monkeypatch.setattr(module, "evidence_of", lambda *arguments: mock.MagicMock(by_chance=False))
    monkeypatch.setattr(module, "judge", lambda *arguments: ("unexplained", (), ()))
    monkeypatch.setattr(Task, "with_input_noise", property(refuse))
    task = Task(pendulum(), recorded(pendulum(), 0, 0), (0.0, 30.0), None)
    assert module.judged(task, None, None, None, lambda text: None).verdict == "unexplained"


@pytest.mark.parametrize(("left", "said"), [(False, ["law", "nothing"]), (True, ["law"])])
def test_what_chance_may_have_made_is_put_to_the_tests_as_nothing(left, said, monkeypatch):
    """left : whether something systematic is left without it, so that something acts whatever it is called."""
    from symid.discrepancy import judged as module

    search, judged = mock.MagicMock(nothing="nothing"), []
    search.explained = lambda found: not left
    search.settled = lambda found: "law"

    def evidence_of(found, *others):
        judged.append(found.found)
        return mock.MagicMock(by_chance=found.found == "law")

    explained = mock.MagicMock(search=search)
    monkeypatch.setattr(module, "explained", lambda *arguments: explained)
    monkeypatch.setattr(module, "tested", lambda found, search: mock.MagicMock(found=found, nameless=False))
    monkeypatch.setattr(module, "with_held_out", lambda found, search, task: found)
    monkeypatch.setattr(module, "_holds_in_pieces_alone", lambda found, task: False)
    monkeypatch.setattr(module, "evidence_of", evidence_of)
    monkeypatch.setattr(module, "judge", lambda *arguments: ("adequate", (), ()))
    monkeypatch.setattr(module._Found, "asks_for_noise", False)
    module.judged(None, None, None, None, lambda text: None)
    assert judged == said


@pytest.mark.parametrize(("given", "improved", "refuted"), [(1.0, 1.0, True), (1e9, 1.0, False), (1.0, 1e9, False)])
def test_the_whole_refutes_nothing_where_either_model_runs_away(given, improved, refuted, monkeypatch):
    """A balancing robot looked steady where the slope that it stood on was left out."""
    from symid.discrepancy import judged as module

    def unable(fit, data):
        raise DiagnosisError("it diverges")

    base, fit = (SimpleNamespace(initial=np.zeros((2, 1)), growth=g, model=None) for g in (given, improved))
    piece = SimpleNamespace(time=np.array([0.0]))
    search = SimpleNamespace(base=base, data=SimpleNamespace(segments=[piece]))
    by = SimpleNamespace(search=search, task=SimpleNamespace(segment_length=1.0))
    tested = SimpleNamespace(found=SimpleNamespace(suspects=("force",), fit=fit))
    monkeypatch.setattr(module, "of_window", lambda *arguments: SimpleNamespace(segments=[piece]))
    monkeypatch.setattr(module, "replace", lambda fit, **changed: fit)
    monkeypatch.setattr(module, "largest_growth", lambda fit, whole: fit.growth)
    monkeypatch.setattr(module.Fitter, "of", unable)
    task = SimpleNamespace(segment_length=None, recording=None, fit_window=None)
    assert module._holds_in_pieces_alone(SimpleNamespace(by=by, tested=tested), task) is refuted


@pytest.mark.parametrize(("size", "believed"), [(0.9, True), (1.1, False)])
def test_what_hides_an_input_altogether_is_no_noise_of_it(size, believed, monkeypatch):
    """The sun that warms a house through its windows was told as noise of 1400 K in the temperature outside."""
    from symid.discrepancy import judged as module

    pieces = [mock.Mock(inputs={"cart": np.array(u)}) for u in ([1.0, -1.0], [1.0, -1.0, -1.0, 1.0])]
    noisy = mock.MagicMock(**{"by.search.data.segments": pieces, "by.task.model": pendulum()})
    monkeypatch.setattr(module, "input_noise", lambda *_: {"cart_acceleration": size})
    assert module._may_be_noise(noisy) is believed
    for piece in pieces:
        piece.inputs["cart"] = 0 * piece.inputs["cart"]
    assert module._may_be_noise(noisy)  # noise of an input that stood still is all that is known of it


@pytest.mark.parametrize(("correlated_s", "step"), [(None, 0.01), (0.5, 0.01), (0.08, 0.02)])
def test_its_size_is_that_of_a_sample(correlated_s, step, monkeypatch):
    """Of noise that a first-order process makes of what is held over 0.01 s, simulated."""
    monkeypatch.setattr(sizes, "noise_sizes", lambda *_: (np.array([3.0]), None))
    values = VALUES if correlated_s is None else VALUES | {CORRELATION_TIME: correlated_s}
    told = sizes.input_noise(mock.Mock(model=pendulum(), values=values), mock.Mock(segments=[mock.Mock(step=step)]))
    w = 3.0 * np.random.default_rng(0).standard_normal(400_000)
    if correlated_s is not None:
        keep = np.exp(-0.01 / correlated_s)
        w = lfilter([0, 1 - keep], [1, -keep], w)
    assert told == {"cart_acceleration": pytest.approx(w.std(), rel=0.07)}


def test_the_noise_acts_as_the_input_does():
    m = pendulum().with_input_noise()
    time, rng = np.arange(0, 2, 0.01), np.random.default_rng(0)
    cart, noise = np.sin(time), rng.standard_normal(len(time))
    apart = Simulator(m).simulate(
        VALUES, {"angle": 0.3, "rate": 0}, time, {"cart": cart}, noise={"cart_noise": 0 * noise}
    )
    none = Simulator(pendulum()).simulate(VALUES, {"angle": 0.3, "rate": 0}, time, {"cart": cart})
    assert np.array_equal(apart.states["angle"], none.states["angle"])
    held = pendulum().with_holds(cart="zero")
    moved = Simulator(held).simulate(VALUES, {"angle": 0.3, "rate": 0}, time, {"cart": noise})
    as_noise = Simulator(held.with_input_noise()).simulate(
        VALUES, {"angle": 0.3, "rate": 0}, time, {"cart": 0 * time}, noise={"cart_noise": noise}
    )
    assert as_noise.states["angle"] == pytest.approx(moved.states["angle"], abs=1e-9)
