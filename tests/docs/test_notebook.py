"""The notebook of the documentation runs from its first cell to its last, and shows what it says."""

from pathlib import Path
from typing import Any

import pytest

from tests.conftest import installed


@pytest.fixture(scope="module")
def cells(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    """The outputs of the cells of code, in a folder of their own."""
    nbclient, nbformat = installed("nbclient"), installed("nbformat")
    book = nbformat.read(checkout / "docs" / "examples" / "notebook.ipynb", as_version=4)
    folder = tmp_path_factory.mktemp("notebook")
    nbclient.NotebookClient(book, timeout=200, resources={"metadata": {"path": str(folder)}}).execute()
    return [cell for cell in book.cells if cell.cell_type == "code"]


def shown(cell: dict[str, Any]) -> str:
    """All that a cell shows, as text."""
    parts = [output.get("text", "") + str(output.get("data", {})) for output in cell["outputs"]]
    return "".join(parts)


def test_the_notebook_is_kept_without_its_outputs(checkout: Path) -> None:
    """They are made anew wherever it runs."""
    nbformat = installed("nbformat")
    book = nbformat.read(checkout / "docs" / "examples" / "notebook.ipynb", as_version=4)
    nbformat.validate(book)
    assert not any(cell.get("outputs") for cell in book.cells)


def test_every_cell_runs_and_shows_what_it_should(cells: list[dict[str, Any]]) -> None:
    """Poses, the curve over the segments, a table, a plot; the truth is met, and the new take is recognised."""
    take, found, points, table, plot, score, predicted, features = cells
    assert "data:image/png;base64" in shown(take)
    assert "<svg" in shown(found)
    assert "6 motions in 9 segments" in shown(points)
    assert "<table" in shown(table)
    assert any("image/png" in output.get("data", {}) for output in plot["outputs"])
    assert float(score["outputs"][0]["data"]["text/plain"]) > 0.9
    assert int(shown(predicted).split("%")[0]) > 90
    assert "pair_distances0" in shown(features)
    outputs = [output for cell in cells for output in cell["outputs"]]
    assert not any(output.get("name") == "stderr" for output in outputs)
