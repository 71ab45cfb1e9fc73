"""Exact derivatives of every shipped model, by every scheme and backend, against central differences."""

import numpy as np
import pytest

import symid as si
from symid.nlp import check_derivatives
from symid.transcription import SCHEMES, Episodes, measure, scheme_by_name, transcribe

BODY = si.mechanics.DoubleLinkPendulum(0.85, 0.47, 0.33, 23.0, 48.0, 1.7, 3.3, 9.81)
RIG = si.mechanics.BenchDoublePendulum(0.09, 0.14, 0.11, 0.12, 0.17, 0.0004, 0.0013, 9.81)
MODELS = {
    "PD": lambda: BODY.with_feedback(si.mechanics.PD()),
    "FPD": lambda: BODY.with_feedback(si.mechanics.FullStatePD()),
    "FPD with unknown delay": lambda: BODY.with_feedback(si.mechanics.FullStatePD(delay=(0.0, 0.1))),
    "PD with muscles": lambda: BODY.with_feedback(si.mechanics.PD(muscle=(0.02, 0.2))),
    "NN": lambda: BODY.with_feedback(si.mechanics.NeuralNetwork()),
    "bench": lambda: RIG.plant(friction=("joint1", "joint2")),
    "chain of three": lambda: si.mechanics.Chain.uniform(3).with_feedback(si.mechanics.PD()),
}


def smooth_recording(model: si.Model) -> si.Recording:
    """Smooth made-up channels for everything that the model asks for, 0.6 s at 50 Hz."""
    time = np.arange(31) * 0.02
    channels = {
        c.channel: (c.unit, 0.2 * np.sin((3 + k) * time + k))
        for k, c in enumerate((*model.inputs.values(), *model.outputs.values()))
    }
    return si.Recording(
        "made up", time, {n: v for n, (_, v) in channels.items()}, {n: u for n, (u, _) in channels.items()}
    )


@pytest.mark.parametrize("backend", ["c", pytest.param("numpy", marks=pytest.mark.slow)])
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", MODELS)
def test_derivatives_agree_with_central_differences(name, scheme, backend):
    model = MODELS[name]()
    noise = Episodes(2, amplitude=0.2) if model.noises else Episodes()
    t = transcribe(
        model,
        [measure(model, smooth_recording(model), (0.3, 0.6))],
        scheme_by_name(scheme),
        noise,
        np.ones((1, len(model.outputs))),
        (),
        backend,
    )
    draw = np.random.default_rng(4)
    # Large weights of a network make kinks that no finite difference resolves.
    within = np.array(
        [
            draw.uniform(*np.clip(p.bounds, *((-0.5, 0.5) if p.role == "weight" else (-300, 300))))
            for p in model.parameters.values()
        ]
    )
    start = t.start(within)
    z = start + draw.normal(0, 0.02, len(start))
    z[t.layout.offsets[-1] :] = start[t.layout.offsets[-1] :]
    assert check_derivatives(t.nonlinear_program(start), z).worst_error < 1e-6
