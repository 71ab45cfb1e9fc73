"""Some of the recordings on which the diagnosis is examined; `examine.py` does hundreds."""

import pytest
from examine import judged, row

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("draw", "seed"),
    [
        pytest.param("null", 1, id="a person, filtered"),
        pytest.param("null", 3, id="a person, noise that remembers"),
        pytest.param("null", 9, id="a rig, filtered"),
        pytest.param("null", 11, id="a rig, noise that remembers"),
        pytest.param("spoilt", 12, id="one effect, filtered"),
        pytest.param("spoilt", 15, id="one effect, short"),
        pytest.param("weak", 7, id="a weak effect"),
        pytest.param("three", 2, id="three effects, one a load that looks like a wrong center of mass"),
        pytest.param("machine", 0, id="a slide with a smooth input"),
        pytest.param("machine", 6, id="a rod, filtered near half the rate"),
        pytest.param("machine", 9, id="gliders, filtered"),
        pytest.param("machine", 704, id="gliders, held out slower than friction sets in"),
        pytest.param("machine", 21, id="a rod with drag and a smooth input"),
        pytest.param("machine", 25, id="a slide with dry friction, filtered"),
        pytest.param("mechanism", 17, id="a drive seen by coarse encoders, nothing missing"),
        pytest.param("mechanism", 21, id="a rotary pendulum with dry friction"),
        pytest.param("mechanism", 22, id="a drive whose load a spring holds"),
    ],
)
def test_what_is_concealed_is_named_and_nothing_else(draw, seed):
    found = row(draw, seed)
    assert judged(found) == "right", found
