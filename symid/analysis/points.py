"""Numbers of a model in the order in which the many-state programs take them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from symid import checked
from symid.checked import nearest
from symid.codegen import Kernel, Program, compile_program
from symid.errors import ModelError
from symid.model import Model
from symid.units import FloatArray

_KERNELS: dict[tuple[str, str], Kernel] = {}


def grid(low: Sequence[float], high: Sequence[float], per_state: int = 11) -> FloatArray:
    """(per_state^n, n) all combinations of evenly spaced values of n states; the last runs fastest."""
    axes = [np.linspace(a, b, per_state) for a, b in zip(low, high, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def check_values(model: Model, values: Mapping[str, float]) -> None:
    """ModelError if a parameter has no value."""
    checked.kind(values, Mapping, f"values of the parameters of '{model.name}'", ModelError)
    for name in model.parameters:
        if name not in values:
            raise ModelError(f"model '{model.name}': parameter '{name}' has no value; {nearest(name, values)}")


def uniform_values(model: Model, values: Mapping[str, float]) -> FloatArray:
    """Inputs and noises (zero), parameters, constants and time (zero)."""
    silent = [0.0] * (len(model.inputs) + len(model.noises))
    known = [c.value for c in model.constants.values()]
    return np.array([*silent, *(values[name] for name in model.parameters), *known, 0.0])


def kernel_of(model: Model, program: Callable[[Model], Program]) -> Kernel:
    """The compiled `program(model)`; the same object for equal equations."""
    key = program.__name__, model.fingerprint
    if key not in _KERNELS:
        _KERNELS[key] = compile_program(program(model))
    return _KERNELS[key]
