"""Mistakes of units, signs and columns that a model's own equations give away."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import combinations

import numpy as np

from symid.errors import SymidError
from symid.model import Model, as_shown, shown_states
from symid.plausibility.body import is_a_person
from symid.plausibility.equations import Change
from symid.plausibility.evidence import EXPLAINED, Witness
from symid.plausibility.motion import Motion, foretold, motion_of, thirds_of
from symid.recording import Recording
from symid.units import STANDARD_GRAVITY

MOSTLY = 0.2
"""Equations that leave no more than this explain most of the motion, and are questioned only where undoing a mistake
leaves far less."""
BETTER, SIGN_BETTER = 1.5, 3.0
"""A mistake is named where undoing it leaves so many times less unexplained (where the equations explain most of the
motion: the second, for signs and swapped columns) ...

On 16 recordings of standing, angles and platform alone, none that is right is blamed, and 159 of 160 planted mistakes
are named; the other is given another name, where a dead zone hides the motion. None of 660 right recordings of 34 other
systems is blamed, nor of 1440 of nine systems with white, proportional, remembering and heavy noise.
"""
CONSTANT_BETTER, FAR_BETTER = 3.0, 5.0
"""As BETTER, for constants of the body: there are many, and a law that is missing can look like one. A body with
the proportions of a person has no power of ten wrong, and is not questioned. The second where the equations explain
most of the motion, there for units, too."""
CLEAR = 0.5
"""... and no more than this: where nothing explains the motion, nothing is blamed."""
AS_GOOD = 1.1
"""Changes that leave this many times as much as the best are told beside it: the motion cannot tell them apart."""
FEW = 1000
"""Samples on which a change must leave no more unexplained than nothing changed does, to be looked at on all: most
changes leave many times more. Samples are `PER_BAND` to a period of the fastest motion, so these hold tens of periods;
of the article's recording the ratios on them differ by a tenth from those on all."""
SELDOM, TINY, USUAL = 0.5, 1e-4, 1e-3
"""Seconds between samples from on which milliseconds may have been taken for seconds, and the shares of their upper
bounds below which all parameters are then, and above which all would be. Stiffness grows by a million, damping by a
thousand: one of them alone may have wide bounds (a torsion pendulum of half a minute)."""
SLOW_MOTION = (
    "every parameter that explains the motion is below a ten thousandth of its upper bound, and none would be if the "
    "time column holds milliseconds but is labelled as seconds: check that first"
)
ANGLES = (
    (180 / np.pi, "holds radians but is labelled as degrees"),
    (np.pi / 180, "holds degrees but is labelled as radians"),
)
LENGTHS = (
    (1e3, "holds metres but is labelled as millimetres"),
    (1e-3, "holds millimetres but is labelled as metres"),
    (1e2, "holds metres but is labelled as centimetres"),
    (1e-2, "holds centimetres but is labelled as metres"),
)
GRAVITIES = (
    (STANDARD_GRAVITY, "holds multiples of g but is labelled as m/s²"),
    (1 / STANDARD_GRAVITY, "holds m/s² but is labelled as g"),
)
FORCES = (
    (1e3, "is a thousand times too small (N mm or mN labelled wrongly)"),
    (1e-3, "is a thousand times too large (N mm or mN labelled as N m or N)"),
)
SPEEDS = (
    (30 / np.pi, "holds rad/s but is labelled as revolutions per minute"),
    (np.pi / 30, "holds revolutions per minute but is labelled as rad/s"),
)
CURRENTS = (
    (1e3, "is a thousand times too small (mA or mV labelled wrongly)"),
    (1e-3, "is a thousand times too large (mA or mV labelled as A or V)"),
)
POWER = ((1e3, "holds kilowatts but is labelled as watts"), (1e-3, "holds watts but is labelled as kilowatts"))
PRESSURES = (
    (1e3, "holds kilopascals but is labelled as pascals"),
    (1e-3, "holds pascals but is labelled as kilopascals"),
    (1e5, "holds bars but is labelled as pascals"),
    (1e-5, "holds pascals but is labelled as bars"),
)
CONFUSED = {
    "rad": ANGLES,
    "rad/s": (*ANGLES, *SPEEDS),
    "rad/s^2": ANGLES,
    "m": LENGTHS,
    "m/s": LENGTHS,
    "m/s^2": (*LENGTHS[:2], *GRAVITIES),
    "N": FORCES,
    "N*m": FORCES,
    "A": CURRENTS,
    "V": CURRENTS,
    "W": POWER,
    "Pa": PRESSURES,
}
POWERS = {
    "mass": (0.1, 10.0, 1e-3, 1e3),
    "inertia": (0.1, 10.0, 1e-3, 1e3, 1e-4, 1e4, 1e-6, 1e6),
    "length": (1e-3, 1e3, 1e-2, 1e2),
    "center_of_mass": (1e-3, 1e3, 1e-2, 1e2),
}
OF_UNIT = {"kg": "mass", "m": "length", "kg*m^2": "inertia", "kg m^2": "inertia"}
"""What a constant of this unit is, where its model does not say."""
_KINDS = {
    "mass": "masses",
    "inertia": "inertias",
    "length": "lengths",
    "center_of_mass": "distances of the centres of mass",
}


def model_remarks(model: Model, recording: Recording, window: tuple[float, float] | None = None) -> list[str]:
    """A sentence on the mistake that the equations give away; none where they, or nothing, explain the motion.

    Models with states that no channel shows (memories of controllers), networks, and recordings without a stretch of
    samples cannot be asked, and give no remark.
    """
    try:
        model = as_shown(model)
        motion = motion_of(model, recording, window)
        if motion is None:
            return []
        witness = Witness(model, motion)
        if witness.is_blind:
            return []
        given = witness.unexplained()
        if given <= MOSTLY and _slowed(witness):
            return [f"{recording.name}: {SLOW_MOTION}"]
        if given <= EXPLAINED:
            return []
        told = foretold(motion)
        looks = [(m, law_open) for m, law_open in ((told, False), (motion, False), (told, True)) if m is not None]
        for one, law_open in looks:
            remark = _judged(model, one, law_open, witness)
            if remark is not None:
                return [f"{recording.name}: {remark}"] if remark else []
    except (SymidError, np.linalg.LinAlgError, ValueError):
        pass  # a model or a motion about which equations of single moments say nothing
    return []


def _slowed(witness: Witness) -> bool:
    """Whether the unknowns have made up for a time in milliseconds: nothing that is known tells how fast all is."""
    if witness.motion.step < SELDOM:
        return False
    as_given, as_read = (witness.of_bounds(Change(time=factor)) for factor in (1.0, 1e-3))
    return bool(as_read.size > 1 and (as_given < TINY).all() and (as_read > USUAL).all() and (as_read <= 1.0).all())


def _judged(model: Model, motion: Motion, law_open: bool, whole: Witness) -> str | None:
    """The sentence, "" where all is well, None where this motion does not show it.

    whole : asked about the whole motion.
    """
    witness = Witness(model, motion, law_open)
    given = witness.unexplained()
    if given <= EXPLAINED:
        return ""
    most = given <= MOSTLY and bool(model.parameters)  # without unknowns nothing can make up for a mistake
    as_given, changes, promising = (
        witness.generalised(),
        list(channel_changes(model)),
        _first_look(witness, law_open, whole),
    )
    shares = {c.said: witness.generalised(c) for c in changes if (c.is_of_sign or not most) and promising(c)}
    remark = _sentence(as_given, shares, SIGN_BETTER if most else BETTER)
    if remark is None and most:
        shares |= {c.said: witness.generalised(c) for c in changes if not c.is_of_sign and promising(c)}
        remark = _sentence(as_given, shares, FAR_BETTER)
    best = min(shares.values(), default=np.inf)
    if not law_open and not is_a_person(model):
        bodies = {c.said: witness.generalised(c) for c in body_changes(model) if promising(c)}
        if remark is None or min(bodies.values(), default=np.inf) * CONSTANT_BETTER < best:
            remark = _sentence(as_given, shares | bodies, FAR_BETTER if most else CONSTANT_BETTER) or remark
    return remark or ("" if given < CLEAR else None)


def _first_look(witness: Witness, law_open: bool, whole: Witness) -> Callable[[Change], bool]:
    """Whether `FEW` samples leave no more unexplained with a change than without (all do where the motion has hardly
    more), nor the whole motion: the part that inputs foretell linearly is no motion of a strongly nonlinear model."""
    part, judges = thirds_of(witness.motion, FEW), []
    if part is not witness.motion:
        judges.append((Witness(witness.model, part, law_open), 1.0))
    if not law_open and witness.motion is not whole.motion:
        judges.append((whole, AS_GOOD))
    limits = [(judge, most * judge.generalised()) for judge, most in judges]
    return lambda change: all(judge.generalised(change) <= most for judge, most in limits)


def _sentence(given: float, shares: dict[str, float], better: float) -> str | None:
    best = min(shares.values(), default=np.inf)
    if not (best <= CLEAR and given >= better * best):
        return None
    causes = [said for said, share in sorted(shares.items(), key=lambda pair: pair[1]) if share <= AS_GOOD * best]
    return (
        f"the model's equations explain the recorded accelerations far better if {', or '.join(causes[:3])} "
        f"(unexplained {_percent(best)} instead of {_percent(given)} of their generalised variance): check that first"
    )


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else "more than all"


def channel_changes(model: Model) -> Iterator[Change]:
    """What may have been confused in the recording: signs, units, columns, the unit of time."""
    outputs = {y.channel: y.unit or "1" for y in model.outputs.values() if y.channel in shown_states(model).values()}
    inputs = {u.channel: u.unit for u in model.inputs.values()}
    for channel, unit in (outputs | inputs).items():
        yield from _of_channels((channel,), unit)
    for unit in dict.fromkeys(outputs.values()):
        group = tuple(c for c, u in outputs.items() if u == unit)
        if len(group) > 1:
            yield from _of_channels(group, unit)
    lengths = tuple(c for c, u in (outputs | inputs).items() if u in ("m", "m/s", "m/s^2"))
    if len(lengths) > 1 and lengths != tuple(c for c, u in outputs.items() if u == "m"):
        yield from (
            Change(f"{_names(lengths)} {_plural(said, lengths)}", dict.fromkeys(lengths, f)) for f, said in LENGTHS[:2]
        )
    for factor, said in (
        (1e-3, "milliseconds but is labelled as seconds"),
        (1e3, "seconds but is labelled as milliseconds"),
    ):
        yield Change(f"the time column holds {said}", time=factor)
    for a, b in (*combinations(outputs, 2), *combinations(inputs, 2)):
        yield Change(f"the columns of {a} and {b} are swapped", swapped=(a, b))


def _of_channels(channels: tuple[str, ...], unit: str) -> Iterator[Change]:
    yield Change(f"{_names(channels)} {_plural('has', channels)} the opposite sign", dict.fromkeys(channels, -1.0))
    for factor, said in CONFUSED.get(unit, ()):
        yield Change(f"{_names(channels)} {_plural(said, channels)}", dict.fromkeys(channels, factor))


def body_changes(model: Model) -> Iterator[Change]:
    """Powers of ten of masses, inertias and lengths, each alone, all of a kind, and of masses with their inertias."""
    roles = {c.name: c.role or OF_UNIT.get(c.unit, "") for c in model.constants.values()}
    parts = [c for c in model.constants.values() if roles[c.name] in POWERS]
    for c in parts:
        for factor in POWERS[roles[c.name]]:
            yield Change(f"{c.name} is {_times(1 / factor)}", {c.name: factor})
    for role, kind in _KINDS.items():
        group = [c.name for c in parts if roles[c.name] == role]
        for factor in POWERS[role] if len(group) > 1 else ():
            yield Change(f"all {kind} are {_times(1 / factor)}", dict.fromkeys(group, factor))
    masses, inertias = ([c for c in parts if roles[c.name] == role] for role in ("mass", "inertia"))
    bodies = {f"{a.name} and {b.name}": (a, b) for a in masses for b in inertias if a.at == b.at}
    bodies |= {"all masses and inertias": (*masses, *inertias)} if bodies and len(parts) > 2 else {}
    for said, group in bodies.items():
        for factor in POWERS["mass"]:
            yield Change(f"{said} are {_times(1 / factor)}", {c.name: factor for c in group})


def _times(factor: float) -> str:
    return f"{factor:g} times too large" if factor > 1 else f"{1 / factor:g} times too small"


def _names(channels: Iterable[str]) -> str:
    *first, last = channels
    return f"{', '.join(first)} and {last}" if first else last


def _plural(said: str, channels: tuple[str, ...]) -> str:
    if len(channels) == 1:
        return said
    words = {"has": "have", "holds": "hold", "is": "are"}
    return " ".join(words.get(word, word) for word in said.split(" "))
