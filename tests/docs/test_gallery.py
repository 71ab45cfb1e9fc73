"""The gallery: reference problems of the field, each with its published answer."""

import runpy

import pytest
from conftest import ROOT

GALLERY = ROOT / "notebooks" / "gallery"


@pytest.mark.parametrize("path", sorted(GALLERY.glob("*.py")), ids=lambda p: p.stem)
def test_published_answer_is_found(path):
    answers = runpy.run_path(str(path))["answers"]
    for name, (found, published, tolerance) in answers.items():
        assert found == pytest.approx(published, abs=tolerance), name
