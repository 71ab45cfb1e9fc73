"""The notebooks run from a clean kernel, and are committed with their outputs."""

from pathlib import Path

import nbformat
import pytest
from conftest import ROOT, SHARED, example

FOLDER = ROOT / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def code(path: Path) -> str:
    return "\n".join(cell.source for cell in code_cells(nbformat.read(path, as_version=4)))


# What a newcomer opens first runs each time; the others, minutes together, with the slow studies.
@pytest.mark.parametrize("path", [example(p, p.stem, code(p), slow=p != NOTEBOOKS[0]) for p in NOTEBOOKS])
def test_runs_from_a_clean_kernel(path, monkeypatch):
    from nbclient import NotebookClient

    if any(word in path.read_text() for word in ("shared/", "symid.fetch")) and not SHARED.is_dir():
        pytest.skip(f"no reference material at {SHARED}")
    monkeypatch.setenv("SYMID_STANDING", str(SHARED / "recordings" / "standing_subject05"))
    notebook = nbformat.read(path, as_version=4)
    for cell in code_cells(notebook):
        cell.outputs, cell.execution_count = [], None
    NotebookClient(
        notebook, timeout=900, kernel_name="python3", resources={"metadata": {"path": str(FOLDER)}}
    ).execute()
    shown = [
        output.data
        for cell in code_cells(notebook)
        for output in cell.outputs
        if output.output_type == "execute_result"
    ]
    assert any("image/png" in data for data in shown)
    assert any("text/html" in data for data in shown)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_is_committed_small_with_outputs_and_in_order(path):
    assert path.stat().st_size < 300_000
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    cells = code_cells(notebook)
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    assert not [o for cell in cells for o in cell.outputs if o.output_type == "error" or o.get("name") == "stderr"]
    assert str(Path.home()) not in path.read_text() and "/work/" not in path.read_text()
