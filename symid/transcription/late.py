"""Which delayed signals a model has, and where their samples, unknowns and lags stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from symid.codegen.equations.interval import late_signals
from symid.errors import TranscriptionError
from symid.model import Model, free_symbols
from symid.transcription.data import Measured, spline
from symid.transcription.delays import LateSignal
from symid.transcription.layout import Layout
from symid.transcription.schemes import Scheme


def refuse_late(model: Model, measured: Sequence[Measured]) -> None:
    """TranscriptionError for delayed signals that a collocation does not handle."""
    late = set(model.delays)
    for m in measured if late else ():
        if not m.even:
            raise TranscriptionError(
                f"model '{model.name}' has delayed signals, which need even steps, and the samples of "
                f"{m.name} are uneven: use symid.recording.resample, or nodes at equal distances"
            )
    for d in model.delays.values():
        held = model.inputs.get(str(d.of)) or model.controls.get(str(d.of))
        if held is not None and held.hold == "zero":
            raise TranscriptionError(
                f"model '{model.name}' delays the {type(held).__name__.lower()} '{d.of}', which is held between "
                "samples or nodes: direct "
                "collocation reads late signals through smooth weights; give hold='linear', or shift "
                "the recorded channel by a known lag"
            )
        longest = _lag(model, str(d.lag))["bounds"][1]
        for m in measured:
            if m.targets is not None and longest > m.time[-1] - m.time[0]:
                raise TranscriptionError(
                    f"model '{model.name}' delays '{d.of}' by up to {longest:g} s, and {m.name} has only "
                    f"{m.time[-1] - m.time[0]:g} s: give a lag, or bounds of it, in seconds"
                )
    for name, y in zip(model.outputs, model.observed(), strict=True):
        if free_symbols(y) & late:
            raise TranscriptionError(
                f"output '{name}' of model '{model.name}' shows a delayed signal, which direct "
                "collocation does not handle; shift the recorded channel instead"
            )


def gather_late(
    model: Model, scheme: Scheme, layout: Layout, measured: Sequence[Measured], recording_of: Sequence[int], row: int
) -> Iterator[LateSignal]:
    """One LateSignal for each episode, point and delayed signal; their constraints start at `row`."""
    numbers = np.arange(layout.size)
    for e, r in enumerate(recording_of):
        m, late_columns = measured[r], layout.late_view(numbers, e)
        for p, c in enumerate(scheme.stencil.abscissae):
            for k, y in enumerate(late_signals(model)):
                of, lag = str(model.delays[y].of), _lag(model, str(model.delays[y].lag))
                at_nodes = layout.node_names.index(of) if of in layout.node_names else None
                samples, before = _on_whole_mesh(m, m.signal(of, model), layout.refine)
                column = layout.parameter_columns(e)[lag["parameter"]] if lag["parameter"] is not None else None
                yield LateSignal(
                    samples=samples / layout.late_scale[k],
                    before=before,
                    abscissa=float(c),
                    lag=lag["value"],
                    lag_bounds=lag["bounds"],
                    step=m.step / layout.refine,
                    row=row + np.arange(layout.intervals[e]),
                    late_column=late_columns[:, p, k],
                    node_columns=None if at_nodes is None else layout.node_view(numbers, e)[:, at_nodes],
                    lag_column=column,
                    lag_scale=1.0 if column is None else layout.parameter_scale[column - layout.offsets[-1]],
                    jumps=of in model.controls,
                )
                row += layout.intervals[e]


def _on_whole_mesh(m: Measured, samples: np.ndarray, refine: int) -> tuple[np.ndarray, int]:
    """The samples of a whole recording at the nodes of its mesh, and how many of these lie before the window."""
    if refine == 1:
        return samples, m.first
    place = np.arange(len(samples))
    return spline(place, samples)(np.arange(refine * (len(samples) - 1) + 1) / refine), refine * m.first


def _lag(model: Model, text: str) -> dict:
    """A lag's value or parameter, and its range [s]."""
    if text in model.parameters:
        lo, hi = model.parameters[text].bounds
        if not 0 <= lo <= hi < np.inf:
            raise TranscriptionError(
                f"the lag '{text}' of model '{model.name}' needs bounds of at least 0 s and below "
                f"infinity, not {lo:g} to {hi:g} s: they fix which nodes are looked at"
            )
        return {"value": None, "parameter": list(model.parameters).index(text), "bounds": (lo, hi)}
    try:
        value = model.constants[text].value if text in model.constants else float(text)
    except ValueError:
        raise TranscriptionError(
            f"the lag '{text}' of model '{model.name}' must be a number, a Constant or a "
            "Parameter, not an expression of several"
        ) from None
    return {"value": value, "parameter": None, "bounds": (value, value)}
