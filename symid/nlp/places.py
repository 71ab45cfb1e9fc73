"""Row or column numbers of a matrix's entries that are made anew wherever they are looked at."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np


class Places(np.lib.mixins.NDArrayOperatorsMixin):
    """To NumPy an int array, shape (size,), that takes no memory while nobody looks at it.

    The places of a recording of an hour are a few hundred megabytes, and follow from those of one interval.

    Parameters
    ----------
    size : of the array.
    make : () -> (size,) integers, the same at every call.
    """

    def __init__(self, size: int, make: Callable[[], np.ndarray]):
        self.size, self._make, self.dtype = size, make, np.dtype(np.intc)

    def __len__(self) -> int:
        return self.size

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        return np.asarray(self._make(), dtype=np.intc if dtype is None else dtype)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **given: Any) -> Any:
        return getattr(ufunc, method)(*(np.asarray(x) if isinstance(x, Places) else x for x in inputs), **given)

    def __getitem__(self, index: Any) -> Any:
        return np.asarray(self)[index]
