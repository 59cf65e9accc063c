"""The examples of the documentation run as they stand there, on the project's own figures."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from caesura.samples.sample_figures import build_figure
from caesura.service.commands.local_service import local_service
from tests.installation import take_npz


def example(checkout: Path, name: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """One script, in a fresh interpreter."""
    script = checkout / "docs" / "examples" / f"{name}.py"
    return subprocess.run(
        [sys.executable, script, *arguments], check=False, capture_output=True, text=True, timeout=240
    )


@pytest.fixture(scope="module")
def take(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The robot, as a file."""
    path = tmp_path_factory.mktemp("takes") / "robot.glb"
    path.write_bytes(build_figure("rigid").glb)
    return path


def test_a_technical_artist_gets_clips_and_a_review_list(checkout: Path, take: Path, tmp_path: Path) -> None:
    """The file again with an animation a segment, and the doubtful cuts with their frames."""
    run = example(checkout, "technical_artist", take, tmp_path / "clips.glb")
    assert run.returncode == 0, run.stderr
    assert b'"A_01-loop"' in (tmp_path / "clips.glb").read_bytes()
    assert "Look at these cuts first" in run.stdout


def test_a_researcher_gets_curve_key_frames_and_a_comparison(checkout: Path, tmp_path: Path) -> None:
    """A row for every frame, and the default method ahead of k-means of single frames."""
    run = example(checkout, "researcher", tmp_path / "energy.csv")
    assert run.returncode == 0, run.stderr
    indices = {line.split()[0]: float(line.split()[1]) for line in run.stdout.splitlines() if line.startswith("  ")}
    assert indices["switching"] > 0.9 > indices["k-means"]
    frames = build_figure("smooth").truth.frames
    assert len((tmp_path / "energy.csv").read_text().splitlines()) == frames + 1


def test_a_pipeline_engineer_gets_documents_and_clips(
    checkout: Path, take: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Through a running service; a bad file is said, and does not stop the rest."""
    (tmp_path / "page.glb").write_text("<html>404</html>")
    (tmp_path / "marche & saut é.npz").write_bytes(take_npz((0, 1, 0)))
    monkeypatch.setenv("CAESURA_DATA_DIR", str(tmp_path / "data"))
    monkeypatch.delenv("REDIS_URL", raising=False)
    with local_service(0) as url:
        takes = [tmp_path / "page.glb", take, tmp_path / "marche & saut é.npz"]
        run = example(checkout, "pipeline_engineer", url, tmp_path / "out", *takes)
    assert run.returncode == 1, run.stderr
    assert "page.glb: " in run.stderr
    assert "robot.glb: 6 motions in 9 segments\n" in run.stdout
    assert json.loads((tmp_path / "out" / "robot.json").read_text())["motions"] == 6
    assert (tmp_path / "out" / "robot.clips.glb").read_bytes().startswith(b"glTF")
    assert (tmp_path / "out" / "marche & saut é.clips.zip").read_bytes().startswith(b"PK")
