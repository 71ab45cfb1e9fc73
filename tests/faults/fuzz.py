"""What the fuzzed tests share: odd values, and that only a sentence of symid's own may come out, soon."""

import json
import os
import time
import warnings
from collections.abc import Callable

import numpy as np
import pandas as pd
import sympy as sm
from hypothesis import HealthCheck, settings, strategies as st

from symid.errors import SymidError

few = settings(
    max_examples=int(os.environ.get("SYMID_FUZZ", "40")),
    deadline=None,
    derandomize="SYMID_FUZZ" not in os.environ,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow, HealthCheck.data_too_large],
)
"""Some seconds in the normal run, the same draws each time; `make fuzz` asks for minutes of each kind, drawn anew."""
LIMIT_S = 5.0
"""Processor time [s] beyond which an answer is a hang."""

of_json = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.lists(st.integers(), max_size=3),
    st.tuples(st.floats(), st.floats()),
    st.dictionaries(st.text(max_size=4), st.integers(), max_size=2),
)
odd = st.one_of(
    of_json,
    st.sampled_from([10**400, "9" * 500, 1j, b"x", object(), ..., int, len, np.nan, np.array([1.0, np.nan])]),
    st.sampled_from([np.zeros((2, 0)), pd.DataFrame(), sm.nan, sm.oo, sm.I, sm.true, sm.Symbol("x"), sm.eye(2), set()]),
)


@st.composite
def spoiled(draw, content):
    """The content with one entry exchanged, renamed or left out, also inside tables."""
    content = json.loads(json.dumps(content))
    table = content
    while True:
        key = draw(st.sampled_from(sorted(table)))
        if not isinstance(table[key], dict) or not table[key] or draw(st.booleans()):
            break
        table = table[key]
    kind = draw(st.sampled_from(["exchanged", "renamed", "left out"]))
    value = table.pop(key)
    if kind != "left out":
        table[draw(st.text(max_size=12)) if kind == "renamed" else key] = value if kind == "renamed" else draw(of_json)
    return content


def told(function: Callable, *arguments, also: tuple[type[Exception], ...] = (), **options):
    """What the call gives, or None where symid refuses it in words; anything else comes out, and so does a hang."""
    began = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return function(*arguments, **options)
    except SymidError as error:
        assert 0 < len(str(error)) < 2000, f"{len(str(error))} letters: {str(error)[:200]}"
        return None
    except also:
        return None
    finally:
        assert time.process_time() - began < LIMIT_S
