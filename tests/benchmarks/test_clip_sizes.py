"""The table of how large clips are, of files made here."""

import sys

from benchmarks.formats.clip_sizes import main
from tests.formats.clips.test_clip_sizes import swaying


def test_hardly_more_is_new_than_gltf_asks_for(tmp_path, monkeypatch, capsys):
    """As GLB and as glTF, cut on keys and between them: times, what clips say of themselves, and a key at each cut."""
    (tmp_path / "a.glb").write_bytes(swaying(601).glb())
    (tmp_path / "b.gltf").write_bytes(swaying(601).gltf())
    (tmp_path / "c.gltf").write_text('{"asset": {"version": "2.0"}, "buffers": []}')
    monkeypatch.setattr(sys, "argv", ["clip_sizes", str(tmp_path)])
    main()
    _, *rows, refused = capsys.readouterr().out.splitlines()
    for row in rows:
        name, size, on_keys, between, asked = row.split()
        assert int(size) == (tmp_path / name).stat().st_size
        assert float(on_keys) < float(between) <= float(asked) + 1500 / int(size)
    assert [row.split()[0] for row in rows] == ["a.glb", "b.gltf"]
    assert refused.split() == ["c.gltf", "44", "no-animation"]
