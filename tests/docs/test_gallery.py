"""The gallery: reference problems of the field, each with its published answer."""

import runpy

import pytest
from conftest import ROOT, example

GALLERY = ROOT / "notebooks" / "gallery"
LONG = "quickest_pendulum", "semibatch_ten", "betts_10_57"
EXAMPLES = [example(p, p.stem, "", slow=p.stem in LONG) for p in sorted(GALLERY.glob("*.py"))]


@pytest.mark.parametrize("path", EXAMPLES)
def test_published_answer_is_found(path):
    answers = runpy.run_path(str(path))["answers"]
    for name, (found, published, tolerance) in answers.items():
        assert found == pytest.approx(published, abs=tolerance), name
