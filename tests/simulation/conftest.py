from functools import partial

import pytest

from symid.simulation import Simulator as AnySimulator


@pytest.fixture(params=["c", "numpy"])
def Simulator(request):
    return partial(AnySimulator, backend=request.param)
