"""Random forces that change all the time, and forces that are held: how they move a state, and which is told."""

import numpy as np
import pytest
from driven_cart import TRUE, cart

import symid as si
from symid.errors import ModelError
from symid.estimation.between_samples import with_likeliest_holds
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.predicting.forces import Forces, held
from symid.estimation.predicting.kalman import KalmanFilter
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_between
from symid.simulation import Linearised, synthetic_recording

SENSOR, STEP_s = 2e-5, 0.0125
DOUBLE = Linearised(
    A=np.array([[0.0, 1.0], [0.0, 0.0]]),
    G=np.array([[0.0], [1.0]]),
    C=np.array([[1.0, 0.0]]),
    A_late=np.zeros((2, 0)),
    C_late=np.zeros((1, 0)),
    lag=np.zeros(0),
    late_state=np.zeros(0, dtype=int),
)


def covariance(step: float, white: bool) -> np.ndarray:
    """What a force of size 1 on a mass adds to the covariance of position and speed within a sample."""
    found = KalmanFilter.of(DOUBLE, Forces(step, white), np.ones(1), np.ones(1))
    return found.Q * np.outer(found.size, found.size)


@pytest.mark.parametrize("step", [0.001, 0.01, 0.03, 0.5])
def test_a_white_force_moves_position_and_speed_as_in_closed_form(step):
    """Q = S [[h^3 / 3, h^2 / 2], [h^2 / 2, h]], the integral of S v v' over a sample, v = (t, 1)."""
    holds, size = held(step)
    power = size**2 * step / holds
    exact = power * np.array([[step**3 / 3, step**2 / 2], [step**2 / 2, step]])
    assert covariance(step, white=True) == pytest.approx(exact, rel=0.01)


@pytest.mark.parametrize("step", [0.001, 0.01])
def test_a_held_force_moves_position_and_speed_together(step):
    move = np.array([step**2 / 2, step])
    assert covariance(step, white=False) == pytest.approx(np.outer(move, move))


@pytest.mark.parametrize("step", [0.001, 0.012, 0.04, 0.3])
def test_both_have_the_same_power_at_low_frequencies(step):
    (held_, size), (white, larger) = held(step), held(step, white=True)
    assert larger**2 / white == pytest.approx(size**2 / held_)
    assert white >= held_


@pytest.mark.parametrize(("hold", "told"), [(0.1 * STEP_s, "white"), (STEP_s, "either")])
def test_the_likelier_one_is_told(hold, told):
    recording = synthetic_recording(
        cart(),
        TRUE,
        duration=40,
        rate=1 / STEP_s,
        seed=1,
        hold=hold,
        process_noise={"gust": 20.0},
        sensor_noise={"position": SENSOR},
    )
    pieces = segments_between(cart(), recording.time, dict(recording.channels), (0.0, 40.0), None)
    data = Data(pieces, np.array([SENSOR]), True)
    fit = with_likeliest_holds(fit_model(cart(), data), data)
    assert fit.model.noises["gust"].hold == told
    if told == "white":
        assert fit.process[0] == pytest.approx(20 * np.sqrt(hold / STEP_s), rel=0.25)


def test_what_noise_does_between_samples_must_be_known():
    m = cart()
    m.other = si.Noise(unit="N", hold="zero")
    with pytest.raises(ModelError, match="the noise 'other' has hold='zero'; known: 'either', 'held', 'white'"):
        m.check()
