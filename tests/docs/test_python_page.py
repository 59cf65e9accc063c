"""docs/python.md is true: its blocks run as they stand, one after the other, on takes of the project's own."""

import re
from pathlib import Path

import numpy as np
import pytest

import caesura
from caesura.core.segmentation_document import SegmentationDocument
from tests.conftest import installed
from tests.formats.point_caches import MESH, folding_sheet, pc2
from tests.glb import bending_strip
from tests.installation import take_npz


def test_every_block_runs(checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The block of a client asks a service that answers with the take; the others compute."""
    installed("pandas")
    pyplot = installed("matplotlib.pyplot")
    monkeypatch.chdir(tmp_path)
    model = bending_strip()
    (tmp_path / "take.glb").write_bytes(model.glb())
    (tmp_path / "take.pc2").write_bytes(pc2(folding_sheet()))
    (tmp_path / "take.obj").write_bytes(MESH)
    (tmp_path / "take.npz").write_bytes(take_npz())
    arrays = np.load(tmp_path / "take.npz")
    known = {
        "vertices": arrays["vertices"],
        "triangles": arrays["triangles"],
        "features": arrays["vertices"][:, ::8, 1],
    }
    document = caesura.segment(tmp_path / "take.npz", motions=2).document("id")
    asked: list[tuple[object, ...]] = []

    def segment(client: object, source: str, **parameters: object) -> SegmentationDocument:
        asked.append((source, parameters))
        return document

    monkeypatch.setattr("caesura.client.client.Client.segment", segment)
    monkeypatch.setattr("caesura.client.client.Client.download", lambda client, *of: asked.append(of))
    monkeypatch.setenv("MPLBACKEND", "agg")
    blocks = re.findall(
        r"```python\n(.*?)```", (checkout / "docs" / "python.md").read_text(encoding="utf-8"), re.DOTALL
    )
    assert len(blocks) == 5
    for block in blocks:
        exec(block, known)
    assert asked == [("take.glb", {"motions": 5}), ("id", "clips", "clips.glb")]
    pyplot.close("all")
