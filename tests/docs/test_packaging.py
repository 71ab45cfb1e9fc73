"""What other tools read about this package is what pyproject.toml says."""

import re
import tomllib

import pytest
from conftest import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
RECIPE = (ROOT / "packaging" / "conda" / "recipe.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "text", [RECIPE, (ROOT / "CITATION.cff").read_text(encoding="utf-8")], ids=["recipe", "citation"]
)
def test_the_version_is_that_of_the_package(text):
    (version,) = re.findall(r'^ *version: "?(\d[\w.]*)"?$', text, re.M)
    assert version == PROJECT["version"]


def test_the_recipe_asks_for_what_the_package_asks_for():
    run = re.search(r"run: \[(.*?)\]", RECIPE, re.S).group(1)
    asked = {part.strip().replace(" ", "").replace("matplotlib-base", "matplotlib") for part in run.split(",")}
    assert asked == {
        *PROJECT["dependencies"],
        *PROJECT["optional-dependencies"]["solver"],
        "python>=3.11",
        "c-compiler",
    }


def test_the_worker_of_the_image_has_a_home_for_its_cache_and_no_environment_of_the_checkout():
    image = (ROOT / "packaging" / "Dockerfile").read_text(encoding="utf-8")
    assert "useradd --create-home worker" in image and "python -m symid.setup_ipopt" in image
    assert ".venv" in (ROOT / ".dockerignore").read_text(encoding="utf-8").split()
