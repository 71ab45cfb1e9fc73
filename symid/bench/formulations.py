"""Ways to keep a noisy recording from being explained by an unstable controller, on recordings whose gains are known.

Wang & van den Bogert (2020) follow one recording with several episodes of simulated process noise.
Here stand, on the same recordings, what else could be done: nothing, more data, a constraint on the
eigenvalues, process noise that is estimated, and prediction errors of a Kalman filter.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from symid.analysis.eigenvalues import growth, slopes_at
from symid.errors import SymidError
from symid.estimation.fitting.cold_start import fit_model
from symid.estimation.signals.data import Data
from symid.estimation.signals.windows import segments_of
from symid.identification import Identification
from symid.identification.starts.search import noisy_rows
from symid.ipopt_solver import solve_nlp
from symid.mechanics import FullStatePD
from symid.model import Model
from symid.nlp import soften, with_hurwitz
from symid.simulation import simulator
from symid.synthetic import BODY, GAINS, SENSOR_NOISE, standing_recording
from symid.threads import one_blas_thread
from symid.transcription import Episodes

TRUE = GAINS | {"kp_aa": 330.0, "kd_aa": 95.0}
"""A slow mode close to the margin, as that of the article's person (-0.05 1/s)."""
TORQUE_NOISE = 6.0
"""Of the made-up person [N m], each joint, anew every 10 ms."""
FIT, MORE, HELD_OUT = 20.0, 3, 40.0
"""Seconds of the fit, how many times that is "more data", and seconds held out after these."""
MARGIN = 0.05
"""Of the eigenvalue constraint [1/s]."""
OWN, STIFFER = ("kp_aa", "kd_aa", "kp_hh", "kd_hh"), 40
"""Gains of each joint on itself, raised by a tenth up to so many times until the loop is stable."""
PATIENCE_S = 60.0
"""Of a solve: where multipliers explode, each factorization takes half a minute and leads nowhere."""
FALLEN_DEG = 90.0
"""What a free run that falls counts as."""


def person() -> Model:
    """The model of the made-up person and of the fits; wide bounds, so that noise cuts nothing off."""
    wide = dict.fromkeys(("ankle_velocity", "hip_velocity"), (-20, 20))
    return BODY.with_feedback(FullStatePD()).with_bounds(**wide)


def head_to_head(
    seeds: Iterable[int],
    names: Sequence[str] | None = None,
    *,
    torque_noise: float = TORQUE_NOISE,
    on_row: Callable[[dict], None] = lambda row: None,
) -> pd.DataFrame:
    """One row per recording and formulation.

    Parameters
    ----------
    seeds : of the recordings and of the episodes' noise. names : of `FORMULATIONS`, all by default.
    torque_noise : of the made-up person [N m].

    Returns
    -------
    DataFrame
        seed, formulation, solved, growth_1_s (largest real part of the eigenvalues at upright), stable,
        gain_error (norm of the error of the eight gains, relative to that of the gains),
        held_out_deg (RMS of a free run from the recorded state), seconds (processor).
    """
    rows = []
    for seed in seeds:
        model = person()
        recording = standing_recording(
            model, TRUE, duration=MORE * FIT + HELD_OUT, seed=seed, torque_noise=torque_noise
        )
        for name in names or FORMULATIONS:
            row = {"seed": seed, "formulation": name} | _tried(FORMULATIONS[name], model, recording, seed, torque_noise)
            on_row(row)
            rows.append(row)
    return pd.DataFrame(rows)


def summary(rows: pd.DataFrame) -> pd.DataFrame:
    """Per formulation: stable and solved share [%], medians of gain error [%], held-out RMS [deg] and seconds."""
    groups = rows.groupby("formulation", sort=False)
    return pd.DataFrame(
        {
            "stable_percent": 100 * groups["stable"].mean(),
            "solved_percent": 100 * groups["solved"].mean(),
            "gain_error_percent": 100 * groups["gain_error"].median(),
            "held_out_deg": groups["held_out_deg"].median(),
            "seconds": groups["seconds"].median(),
        }
    )


@one_blas_thread
def _tried(formulation, model: Model, recording, seed: int, torque_noise: float) -> dict:
    began = time.process_time()
    try:
        problem = Identification(model, recording, (0.0, FIT), episodes=Episodes(seed=seed))
        values, solved = formulation(problem, torque_noise)
    except SymidError:
        return {
            "solved": False,
            "growth_1_s": np.nan,
            "stable": False,
            "gain_error": np.nan,
            "held_out_deg": FALLEN_DEG,
            "seconds": time.process_time() - began,
        }
    seconds = time.process_time() - began
    gains = [k for k in TRUE if k.startswith("k")]
    error = np.array([values[k] - TRUE[k] for k in gains])
    rate = float(growth(model, np.zeros((1, 4)), values)[0])
    return {
        "solved": solved,
        "growth_1_s": rate,
        "stable": rate < 0,
        "gain_error": float(np.linalg.norm(error) / np.linalg.norm([TRUE[k] for k in gains])),
        "held_out_deg": held_out_deg(model, values, recording),
        "seconds": seconds,
    }


def held_out_deg(model: Model, values: dict[str, float], recording) -> float:
    """RMS [deg] of a free run over the last `HELD_OUT` seconds, from the recorded state, both angles."""
    last = recording.time >= MORE * FIT
    initial = [recording[name][last][0] for name in model.states]
    channels = [y.channel for y in model.outputs.values()]
    run = simulator(model).simulate(
        values,
        initial,
        recording.time[last],
        {u.channel: recording[u.channel][last] for u in model.inputs.values()},
        limit=100.0,
    )
    error = run.y - np.stack([recording[c][last] for c in channels], axis=1)
    rms = np.degrees(np.sqrt(np.mean(error**2)))
    return float(rms) if rms < FALLEN_DEG else FALLEN_DEG


def _solved(problem: Identification) -> tuple[dict[str, float], bool]:
    result = problem.solve_from(problem.start(), max_iterations=300, time_limit_s=PATIENCE_S)
    return _values(problem, result), result.solved


def _values(problem: Identification, result) -> dict[str, float]:
    layout = problem.transcription.layout
    return dict(zip(layout.parameter_names, layout.parameters(result.z[: layout.size]).tolist(), strict=True))


def _alone(problem: Identification, torque_noise: float):
    return _solved(problem)


def _episodes(problem: Identification, torque_noise: float):
    return _solved(replace(problem, episodes=Episodes(3, torque=0.25, seed=problem.episodes.seed)))


def _loud_episodes(problem: Identification, torque_noise: float):
    # The person's noise is drawn every 10 ms, an episode's every 20 ms; its deviation is 1/sqrt(3) of its half width.
    loud = float(np.sqrt(3 / 2)) * torque_noise
    return _solved(replace(problem, episodes=Episodes(3, torque=loud, seed=problem.episodes.seed)))


def _more_data(problem: Identification, torque_noise: float):
    return _solved(replace(problem, window=(0.0, MORE * FIT)))


def _eigenvalue_constraint(problem: Identification, torque_noise: float):
    layout, model = problem.transcription.layout, problem.model
    gains = [k for k in layout.parameter_names if k.startswith("k")]
    zero = dict.fromkeys(layout.parameter_names, 0.0)

    def matrix(values):
        found = slopes_at(model, np.zeros((1, 4)), values)
        return -np.linalg.solve(found.mass[0], found.state[0])

    place = [layout.parameter_names.index(k) for k in gains]
    slopes = np.stack(
        [
            (matrix(zero | {k: 1.0}) - matrix(zero)) * layout.parameter_scale[i]
            for k, i in zip(gains, place, strict=True)
        ]
    )
    columns, base, z = layout.offsets[-1] + np.array(place), matrix(zero), problem.start()
    own = columns[[gains.index(k) for k in OWN]]
    for _ in range(STIFFER):  # the equations of stability are best begun where they hold
        if np.linalg.eigvals(base + np.tensordot(z[columns], slopes, 1)).real.max() < -2 * MARGIN:
            break
        z[own] = np.minimum(1.1 * z[own], 0.9)
    nlp = with_hurwitz(problem.nonlinear_program(z), columns, base, slopes, MARGIN)
    result = solve_nlp(nlp, max_iterations=300, time_limit_s=PATIENCE_S)
    return _values(problem, result), result.solved


def _estimated_noise(problem: Identification, torque_noise: float):
    """Maximum a posteriori of motion and noise: slack in the noisy equations at the price of the true noise levels."""
    t = problem.transcription
    rows, nlp = noisy_rows(t), problem.nonlinear_program(problem.start())
    step = t.program.data[0].step
    per_torque = _constraint_per_noise(problem)
    price = step * SENSOR_NOISE**2 / (torque_noise**2 / 2) / per_torque**2
    result = solve_nlp(soften(nlp, rows, price / nlp.objective_scale), max_iterations=300)
    return _values(problem, result), result.solved


def _constraint_per_noise(problem: Identification) -> float:
    """How much a noisy equation changes by 1 N m of noise, as the program scales it."""
    t = problem.transcription
    local, parameters, data, constants = t.program.interval_arguments(problem.start("random"), 0)
    louder = np.ascontiguousarray(data.copy())
    louder[:, -len(problem.model.noises) :] += 1.0
    change = t.program.interval.residual(local, parameters, louder, constants) - t.program.interval.residual(
        local, parameters, data, constants
    )
    return float(np.abs(change[0]).max())


def _prediction_error(problem: Identification, torque_noise: float):
    model, recording = problem.model, problem.recordings[0]
    noise = np.full(len(model.outputs), SENSOR_NOISE)
    fit = fit_model(model, Data(segments_of(model, recording, (0.0, FIT), None), noise, True))
    return {k: fit.values[k] for k in model.parameters}, True


FORMULATIONS: dict[str, Callable[[Identification, float], tuple[dict[str, float], bool]]] = {
    "one episode": _alone,
    "three noisy episodes": _episodes,
    "three episodes as noisy as the person": _loud_episodes,
    "three times the data": _more_data,
    "eigenvalue constraint": _eigenvalue_constraint,
    "estimated process noise": _estimated_noise,
    "prediction error": _prediction_error,
}
"""Name -> what it finds in a problem of one episode, given the true noise: values [SI] and whether it ended well."""
