"""`caesura compare`: every method on labelled takes, whatever the labels are written in."""

import json
import shutil

import numpy as np
import pytest
from click.testing import CliRunner

from caesura.core.registry.methods import METHODS
from caesura.service.commands.cli import main
from tests.animations import performing_bar


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two takes: one labelled by a table in seconds, one by JSON in frames; and one that nobody has labelled."""
    folder = tmp_path_factory.mktemp("takes")
    for name, order in (("one", (0, 1, 0)), ("two", (1, 2))):
        source = performing_bar(order, seconds=2.0, rings=8).animation
        vertices = source.vertices(0, source.frames)
        np.savez(folder / f"{name}.npz", vertices=vertices, triangles=source.triangles, frame_rate=30.0)
    (folder / "one.csv").write_text("label,start_seconds,end_seconds\nbend,0,2\nsway,2,4\nbend,4,6\n")
    segments = [{"label": "sway", "start": 0, "end": 60}, {"label": "pull", "start": 60, "end": 120}]
    (folder / "two.truth.json").write_text(json.dumps({"fps": 30, "frames": 120, "segments": segments}))
    brief = performing_bar((1, 2), seconds=0.8, rings=6).animation
    np.savez(folder / "brief.npz", vertices=brief.vertices(0, 48), triangles=brief.triangles, frame_rate=30.0)
    shutil.copy(folder / "one.npz", folder / "unlabelled.npz")
    return folder


def compare(*arguments):
    return CliRunner().invoke(main, ["compare", *map(str, arguments)])


def test_every_method_is_compared_on_a_labelled_take(folder, tmp_path, monkeypatch):
    """As JSON: figures told K of all, and untold of those that choose it; time and memory.

    But for `haca`, whose many small steps the checks of a test slow down a hundredfold.
    """
    known = {name: method for name, method in METHODS.items() if name != "haca"}
    monkeypatch.setattr("caesura.service.commands.compare.METHODS", known)
    shutil.copy(folder / "brief.npz", tmp_path / "brief.npz")
    (tmp_path / "brief.csv").write_text("label,start,end\nsway,0,24\npull,24,48\n")
    ended = compare(tmp_path, "--methods", "all", "--json", "--threads", "1")
    assert ended.exit_code == 0
    rows = json.loads(ended.stdout)
    assert [row["method"] for row in rows] == list(known)
    for row in rows:
        assert 0 <= row["told"]["error"] <= 1
        assert (row["untold"] is None) == METHODS[row["method"]].needs_motions
        assert row["seconds"] > 0
        assert row["megabytes"] > 0


def test_the_table_has_a_line_for_each_method(folder):
    """The means, and with --each every take; methods are listed in the order in which they were named."""
    ended = compare(folder, "--methods", "aca,switching", "--each", "--descriptors", "strain")
    assert ended.exit_code == 0
    lines = [line.split() for line in ended.stdout.splitlines() if line.startswith(("aca", "switching"))]
    assert [line[:2] for line in lines] == [["aca", "1"], ["switching", "1"]] * 2 + [["aca", "2"], ["switching", "2"]]


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["--methods", "magic"], 2, "There is no method 'magic'"),
        (["--descriptors", "magic"], 2, "descriptors"),
        (["--method", "aca"], 2, "No such option"),
    ],
)
def test_what_is_not_known_is_refused(folder, arguments, code, said):
    """By name; `--method` and `--motions` are for the command to choose."""
    ended = compare(folder / "two.npz", *arguments)
    assert ended.exit_code == code
    assert said in ended.stderr


def test_labels_that_are_not_of_the_take_are_refused_and_the_others_compared(folder, tmp_path):
    """The exit code is that of the bad one; a take without labels is refused at once."""
    for name in ("one.npz", "one.csv", "two.npz"):
        shutil.copy(folder / name, tmp_path / name)
    (tmp_path / "two.csv").write_text("label,start,end\na,0,40\nb,40,90000\n")
    ended = compare(tmp_path, "--methods", "luo2014")
    assert ended.exit_code == 3
    assert "two.npz" in ended.stderr
    assert ended.stdout.splitlines()[-1].split()[:2] == ["luo2014", "1"]
    assert compare(folder / "unlabelled.npz").exit_code == 3


def test_labels_at_another_rate_lie_on_the_same_moments(folder, tmp_path):
    """Ten labels a second for a take of thirty."""
    shutil.copy(folder / "two.npz", tmp_path / "two.npz")
    segments = [{"label": "sway", "start": 0, "end": 20}, {"label": "pull", "start": 20, "end": 40}]
    (tmp_path / "two.json").write_text(json.dumps({"fps": 10, "frames": 40, "segments": segments}))
    row = json.loads(compare(tmp_path, "--methods", "switching", "--json").stdout)[0]
    other = json.loads(compare(folder / "two.npz", "--methods", "switching", "--json").stdout)[0]
    assert row["told"] == other["told"]
    assert row["told"]["accuracy"] > 0.9
    assert row["told"]["error"] < 0.15
