"""Conceal physics in a recording: simulate the truth, and measure what the model without it misses."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from symid.conceal.fit import FreeFit, fit_free, simulate_free
from symid.conceal.setup import SWAY, Setup
from symid.errors import SymidError
from symid.estimation.signals.segment import Segment
from symid.estimation.signals.windows import segments_between
from symid.mechanics import CANONICAL
from symid.model import Model, Term
from symid.recording import Recording
from symid.simulation import synthetic_recording

NEEDED = 0.3
"""Of two effects, each must leave this share of the noise unexplained when it alone is left out."""
_BEYOND = 1.0
"""Seconds simulated beyond the recording, so that an early input is known to its end."""


class Unsuitable(SymidError):
    """These values do not make a case: the loop is unstable, the motion out of range, or the effect invisible.

    Examples
    --------
    >>> draw_case("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 1e-9})], (3, 0))    # doctest: +SKIP
    """


@dataclass(frozen=True, eq=False)
class Concealed:
    """A recording in which physics is concealed, and the answer.

    Attributes
    ----------
    setup : what the user is told. terms : what is concealed, with its parameters [SI].
    recording : with noise. clean : (N, m) the same outputs without noise.
    kind : ``"none"``, ``"single"``, ``"two"`` or ``"unlisted"``.
    visibility : rms of what the model cannot absorb, over the rms of all noise; 0 where nothing is concealed.
    sway : rms that the process noise causes. reference : rms errors of model and truth.
    equivalent, near : other answers that the recording hardly tells from the truth, per effect.
    torque_noise : standard deviation of each process noise.

    Examples
    --------
    >>> hidden = draw_case("rig", [("sensor_offset", "sensor:link1", {"offset_rad": 0.004})], (3, 0))
    >>> hidden.kind, [str(term) for term in hidden.terms]
    ('single', ['sensor_offset@sensor:link1'])
    """

    setup: Setup
    terms: Mapping[Term, Mapping[str, float]]
    recording: Recording
    clean: np.ndarray
    kind: str
    visibility: float
    sway: float
    torque_noise: Mapping[str, float]
    reference: Mapping[str, Mapping[str, float]]
    equivalent: tuple[tuple[Term, ...], ...] = ()
    near: tuple[tuple[Term, ...], ...] = ()

    @property
    def quiet(self) -> Recording:
        """The recording without noise."""
        channels = [y.channel for y in self.setup.model.outputs.values()]
        return replace(
            self.recording, channels=dict(self.recording.channels) | dict(zip(channels, self.clean.T, strict=True))
        )


def conceal(
    setup: Setup,
    terms: Mapping[Term, Mapping[str, float]],
    *,
    seed: int,
    visibility: float = 1.0,
    listed: Collection[str] = CANONICAL,
) -> Concealed:
    """Simulate `setup` with `terms`, record it with noise, and measure how visible they are.

    Parameters
    ----------
    setup : who moves, and how it is recorded.
    terms : laws at places, of the library or a user's own, each with all of its parameters [SI] by key.
    seed : of the input and of all noise; the same seed gives the same bytes.
    visibility : aimed at by the size of the sway, where the setup leaves that open.
    listed : names that an answer may give; a single effect with another name is of kind ``"unlisted"``.

    Raises
    ------
    Unsuitable : the motion diverges or leaves its range, or the sway would be none that people have.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> setup = setup_from_facts(rig_facts(rng, conservative=False), rng)
    >>> friction = si.mechanics.LIBRARY["coulomb_friction"].at("joint2")
    >>> case = conceal(setup, {friction: {"torque_Nm": 1e-3}}, seed=1)
    >>> case.kind, bool(case.visibility > 1)                # more than the noise: a diagnosis should find it
    ('single', True)
    """
    truth = setup.model
    for term in terms:
        truth = truth.with_term(term)
    values = dict(setup.parameters) | {t.parameter_name(k): v for t, given in terms.items() for k, v in given.items()}
    record = _Recorder(setup, truth, values, seed)
    quiet = record({}, 0.0)
    clean = outputs_of(truth, quiet)
    _refuse_excursion(setup, truth, clean)
    missed = _missed(setup, setup.model, setup.parameters, quiet) if terms else 0.0
    noise, sway = _process_noise(setup, record, clean, missed, visibility)
    recording = record(noise, setup.sensor_noise)
    _refuse_excursion(setup, truth, outputs_of(truth, recording))
    kind = (
        "none"
        if not terms
        else "two"
        if len(terms) > 1
        else "single"
        if next(iter(terms)).name in listed
        else "unlisted"
    )
    all_noise = _rms(outputs_of(truth, recording) - clean)
    return Concealed(
        setup,
        dict(terms),
        recording,
        clean,
        kind,
        missed / all_noise if missed else 0.0,
        sway,
        noise,
        _reference(setup, recording, quiet, clean),
    )


class _Recorder:
    """The true system on one and the same input, with more or less noise."""

    def __init__(self, setup: Setup, truth: Model, values: Mapping[str, float], seed: int):
        self.setup, self.truth, self.values, self.seed = setup, truth, values, seed

    def __call__(self, process_noise: Mapping[str, float], sensor_noise: float) -> Recording:
        s, channels = self.setup, [y.channel for y in self.truth.outputs.values()]
        try:
            long = synthetic_recording(
                self.truth,
                self.values,
                duration=s.fit + s.held_out + _BEYOND,
                rate=s.rate,
                seed=self.seed,
                warm_up=s.warm_up,
                process_noise=process_noise,
                sensor_noise=dict.fromkeys(channels, sensor_noise),
                initial_state=s.initial_state,
                resolution=s.resolution if sensor_noise else 0.0,
            )
        except SymidError as error:
            raise Unsuitable(str(error)) from None
        return long.window(0.0, s.fit + s.held_out)


def outputs_of(model: Model, recording: Recording) -> np.ndarray:
    return np.column_stack([recording[y.channel] for y in model.outputs.values()])


def _rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(x**2)))


def _refuse_excursion(setup: Setup, model: Model, outputs: np.ndarray) -> None:
    for y, values in zip(model.outputs.values(), outputs.T, strict=True):
        limit = setup.limits.get(y.at.removeprefix("sensor:"), np.inf)
        if not np.abs(values).max() <= limit:
            raise Unsuitable(
                f"{y.channel} reaches {np.abs(values).max():.3g} {y.unit}, beyond {limit:g}: "
                "the loop is unstable, or an effect is too large"
            )


# ---- what the model without the effects makes of it ---------------------------------------------
def segments_of(setup: Setup, model: Model, recording: Recording, window) -> tuple[Segment, ...]:
    return segments_between(model, recording.time, dict(recording.channels), window, setup.segment)


def first_states(model: Model, segments: Sequence[Segment]) -> np.ndarray:
    """(E, n) initial states to begin from: what outputs show, and their slopes for rates."""
    shown = {str(y.expr): i for i, y in enumerate(model.outputs.values())}
    rates, out = model.rates(), np.zeros((len(segments), len(model.states)))
    for e, row in zip(segments, out, strict=True):
        slope = np.gradient(e.recorded[:3], e.time[:3], axis=0)[0]
        for j, name in enumerate(model.states):
            if name in shown:
                row[j] = e.recorded[0, shown[name]]
            elif rates.get(name) in shown:
                row[j] = slope[shown[rates[name]]]
    return out


def _missed(setup: Setup, model: Model, values: Mapping[str, float], quiet: Recording) -> float:
    """Rms of what `model`, fitted to the noise-free recording, cannot absorb."""
    segments = segments_of(setup, model, quiet, setup.windows[0])
    try:
        return fit_free(model, segments, values, first_states(model, segments)).rms(segments, setup.settling)
    except SymidError as error:
        raise Unsuitable(str(error)) from None


def needed(case: Concealed) -> bool:
    """Whether each of several effects still shows when the others are in the model."""
    if len(case.terms) < 2:
        return True
    quiet, noise = case.quiet, _rms(outputs_of(case.setup.model, case.recording) - case.clean)
    for left_out in case.terms:
        model, values = case.setup.model, dict(case.setup.parameters)
        for term in case.terms.keys() - {left_out}:
            model = model.with_term(term)
            values |= {term.parameter_name(k): v for k, v in case.terms[term].items()}
        if _missed(case.setup, model, values, quiet) < NEEDED * noise:
            return False
    return True


def _process_noise(setup: Setup, record: _Recorder, clean: np.ndarray, missed: float, visibility: float):
    """Size of each process noise, and the rms that it causes."""
    if not setup.torque_noise:
        return {}, 0.0
    target = setup.sway
    if target is None:
        target = np.sqrt(max((missed / visibility) ** 2 - setup.sensor_noise**2, 0.0))
        if not SWAY[0] <= target <= SWAY[1]:
            raise Unsuitable(
                f"a visibility of {visibility:.2g} would need a sway of {np.degrees(target):.2g} deg rms; people have "
                f"{np.degrees(SWAY[0]):.2g} to {np.degrees(SWAY[1]):.2g}"
            )
    if target == 0:
        return {}, 0.0
    size = 1.0
    for _ in range(2):  # a second time because the loop need not be linear
        noise = {k: size * v for k, v in setup.torque_noise.items()}
        size *= target / _rms(outputs_of(record.truth, record(noise, 0.0)) - clean)
    return {k: float(size * v) for k, v in setup.torque_noise.items()}, float(target)


def _reference(setup: Setup, recording: Recording, quiet: Recording, clean: np.ndarray) -> dict[str, dict[str, float]]:
    """Errors on both windows of the fitted model and of the truth, as ``rms_rad`` of the fit measure."""
    model = setup.model
    train, later = (segments_of(setup, model, recording, w) for w in setup.windows)
    start = first_states(model, segments_of(setup, model, quiet, setup.windows[0]))
    after = first_states(model, segments_of(setup, model, quiet, setup.windows[1]))
    fit = fit_free(model, train, setup.parameters, start)
    anew = fit_free(model, later, fit.values, after, free=()).rms(later)
    held_out = min(anew, _continued(setup, fit, recording)) if setup.segment is None else anew
    noise = outputs_of(model, recording) - clean
    rows = recording.time <= setup.fit + 1e-9
    settled = rows & (recording.time >= setup.settling)
    return {
        "baseline": {"train_rms_rad": fit.rms(train, setup.settling), "heldout_rms_rad": held_out},
        "true_parameters": {
            "train_rms_rad": _rms(noise[settled]),
            "heldout_rms_rad": _rms(noise[recording.time >= setup.fit - 1e-9]),
        },
    }


def _continued(setup: Setup, fit: FreeFit, recording: Recording) -> float:
    """Error on the held-out window of the fit run carried on."""
    whole = segments_of(setup, setup.model, recording, (0.0, setup.fit + setup.held_out))
    return simulate_free(setup.model, whole, fit.values, fit.initial).rms(whole, setup.fit)
