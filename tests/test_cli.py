"""The command `caesura`, as it is installed: what it prints, where, and how it ends."""

import csv
import json
import shutil
import socket
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from caesura.samples.sample_figures import build_figure
from caesura.service.commands.local_service import local_service

FRAMES = 300
CUT = 150


def caesura(*arguments: str | Path, memory_bytes: int = 0) -> subprocess.CompletedProcess[str]:
    """Run the installed command, with so much address space where it is given."""
    program = Path(sys.executable).parent / "caesura"
    bounded = ["sh", "-c", f'ulimit -v {memory_bytes // 1024} && exec "$@"', "sh"] if memory_bytes else []
    return subprocess.run([*bounded, program, *arguments], check=False, capture_output=True, text=True, timeout=120)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A take of two motions with its truth, and files that cannot be read."""
    folder = tmp_path_factory.mktemp("takes")
    x, y = np.meshgrid(np.linspace(0, 2, 21), np.linspace(0, 1, 11), indexing="ij")
    rest = np.stack([x, y, 0 * x], -1).reshape(-1, 3)
    corner = (np.arange(20)[:, None] * 11 + np.arange(10)).ravel()[:, None]
    triangles = np.concatenate([corner + np.array(offsets) for offsets in ([0, 11, 1], [1, 11, 12])])
    vertices = np.repeat(rest[None], FRAMES, 0)
    swing = np.sin(np.arange(FRAMES) * 2 * np.pi / 30)[:, None]
    vertices[:CUT, :, 0] += 0.2 * swing[:CUT] * rest[:, 0] ** 2  # the far end is pulled out and pushed in
    vertices[CUT:, :, 1] += 0.3 * swing[CUT:] * rest[:, 1] * (2 - rest[:, 0])  # the near end widens and narrows
    np.savez(folder / "take.npz", vertices=vertices.astype(np.float32), triangles=triangles, frame_rate=30.0)
    truth = {
        "fps": 30,
        "frames": FRAMES,
        "segments": [{"label": "pull", "start": 0, "end": CUT}, {"label": "widen", "start": CUT, "end": FRAMES}],
    }
    (folder / "take.truth.json").write_text(json.dumps(truth))
    (folder / "page.glb").write_text("<!DOCTYPE html><title>not found</title>")
    (folder / "empty.glb").write_bytes(b"")
    return folder


@pytest.fixture(scope="module")
def document(folder: Path) -> dict[str, Any]:
    """What `caesura segment --json` prints for the take."""
    run = caesura("segment", folder / "take.npz", "--motions", "2", "--json")
    assert run.returncode == 0, run.stderr
    found: dict[str, Any] = json.loads(run.stdout)
    return found


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The URL of a service with a data folder of its own."""
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("CAESURA_DATA_DIR", str(tmp_path_factory.mktemp("data")))
        environment.delenv("REDIS_URL", raising=False)
        with local_service(0) as url:
            yield url


def closed_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


def test_help_answers_at_once() -> None:
    """Asking for help loads nothing that computes."""
    script = (
        "import sys, caesura.service.commands.cli; "
        "print({'numpy', 'numba', 'sklearn', 'scipy', 'fastapi', 'rq'} & set(sys.modules))"
    )
    run = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    assert run.stdout == "set()\n"


def test_a_glb_loads_no_library_that_it_does_not_need(tmp_path: Path) -> None:
    """By the default method: no trimesh, no scikit-learn, and of SciPy its algebra and sparse matrices alone."""
    (tmp_path / "rigid.glb").write_bytes(build_figure("rigid").glb)
    script = (
        "import sys; from caesura.service.commands.cli import main; main(sys.argv[1:], standalone_mode=False);"
        "unneeded = {'trimesh', 'sklearn', 'scipy.stats', 'scipy.spatial', 'scipy.optimize', 'scipy.ndimage'};"
        "print(sorted(unneeded & set(sys.modules)))"
    )
    arguments = ["segment", str(tmp_path / "rigid.glb"), "--motions", "6"]
    run = subprocess.run([sys.executable, "-c", script, *arguments], check=True, capture_output=True, text=True)
    assert run.stdout.splitlines()[-1] == "[]"


def test_segments_tile_the_take(document: dict[str, Any]) -> None:
    """The first segment starts at 0, each starts where the one before ends, and the last ends with the take."""
    segments = document["segments"]
    assert document["frames"] == FRAMES
    assert segments[0]["start"] == 0
    assert all(a["end"] == b["start"] for a, b in pairwise(segments))
    assert segments[-1]["end"] == FRAMES
    assert len(document["energy"]) == FRAMES


def test_options_reach_the_method(document: dict[str, Any]) -> None:
    """A parameter given as an option is the parameter of the result; the others are filled in."""
    assert document["parameters"]["motions"] == 2
    assert document["parameters"]["window_seconds"] == 1.3


def test_options_are_spelled_as_in_the_api(folder: Path) -> None:
    """`--window_seconds` and `--window-seconds` are one option."""
    run = caesura("segment", folder / "take.npz", "--window_seconds", "1", "--method", "joint-entropy", "--json")
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["parameters"]["window_seconds"] == 1
    assert json.loads(run.stdout)["method"] == "joint-entropy"


def test_the_table_is_for_people(folder: Path, document: dict[str, Any]) -> None:
    """Without --json there is one line a segment, with its frames."""
    run = caesura("segment", folder / "take.npz", "--motions", "2")
    assert run.returncode == 0, run.stderr
    for segment in document["segments"]:
        assert f"{segment['start']} … {segment['end']:>6}" in run.stdout


def test_the_score_of_a_result(folder: Path, tmp_path: Path, document: dict[str, Any]) -> None:
    """`score` compares a result with the truth; the two motions of this take are plain to see."""
    (tmp_path / "result.json").write_text(json.dumps(document))
    run = caesura("score", tmp_path / "result.json", folder / "take.truth.json", "--json")
    assert run.returncode == 0, run.stderr
    figures = json.loads(run.stdout)
    assert figures["frame_accuracy"] > 0.95
    assert set(figures) == {
        "frame_accuracy",
        "error_measure",
        "rand_index",
        "adjusted_rand_index",
        "boundary_f1_0.5_s",
        "boundary_f1_0.15_s",
    }


def test_the_truth_agrees_with_itself(folder: Path) -> None:
    """Every figure of the truth against itself is 1, but for the error, which is 0."""
    run = caesura("score", folder / "take.truth.json", folder / "take.truth.json")
    assert run.returncode == 0, run.stderr
    assert [line.split()[-1] for line in run.stdout.splitlines()] == ["1.0000", "0.0000", *["1.0000"] * 4]


def test_different_takes_are_not_compared(folder: Path, tmp_path: Path) -> None:
    """A truth of another length is a bad file."""
    (tmp_path / "other.json").write_text(
        json.dumps({"fps": 30, "frames": 9, "segments": [{"label": "a", "start": 0, "end": 9}]})
    )
    run = caesura("score", folder / "take.truth.json", tmp_path / "other.json", "--json")
    assert run.returncode == 3
    assert json.loads(run.stderr)["code"] == "different-frames"


@pytest.mark.parametrize(
    "content",
    [
        '{"fps": 30, "frames": 0, "segments": []}',
        '{"fps": 9, "frames": 5, "segments": [{"label": 1, "start": 0, "end": 9}, {"label": 2, "start": 9, "end": 5}]}',
        '{"fps": 30, "frames": 1e999, "segments": [{"label": 1, "start": 0, "end": 1e999}]}',
        '{"fps": NaN, "frames": 5, "segments": [{"label": 1, "start": 0, "end": 5}]}',
        "[" * 100_000,
        b"glTF\xf4" * 1000,
    ],
)
def test_what_is_no_labelling_is_said_in_a_sentence(tmp_path: Path, content: str | bytes) -> None:
    """Neither a traceback nor the whole file: its name, and what is wrong with it."""
    wrong = tmp_path / "wrong.json"
    wrong.write_bytes(content if isinstance(content, bytes) else content.encode())
    run = caesura("score", wrong, wrong)
    assert run.returncode == 3
    assert "[not-a-labelling]" in run.stderr
    assert len(run.stderr) < 400


@pytest.mark.parametrize("name", ["page.glb", "empty.glb"])
def test_a_bad_file_is_a_problem(folder: Path, name: str) -> None:
    """Exit code 3, nothing on stdout, and on stderr the problem and the file it is about."""
    run = caesura("segment", folder / name, "--json")
    assert (run.returncode, run.stdout) == (3, "")
    problem = json.loads(run.stderr)
    assert problem["code"] == "unsupported-media-type"
    assert problem["file"].endswith(name)


def test_a_bad_file_is_a_sentence(folder: Path) -> None:
    """Without --json a person reads one line, and no traceback."""
    run = caesura("segment", folder / "page.glb")
    assert run.returncode == 3
    assert run.stderr.startswith("caesura: ")
    assert run.stderr.count("\n") == 1


def test_a_bad_file_does_not_stop_the_others(folder: Path) -> None:
    """One line for each file: null for the bad one."""
    run = caesura("segment", folder / "page.glb", folder / "take.npz", "--motions", "2", "--json")
    assert run.returncode == 3
    first, second = (json.loads(line) for line in run.stdout.splitlines())
    assert first is None
    assert second["frames"] == FRAMES


@pytest.mark.parametrize(
    "wrong", [["--motions", "0"], ["--motions", "many"], ["--method", "guess"], ["--bins", "1"], ["--nonsense"]]
)
def test_wrong_usage(folder: Path, wrong: list[str]) -> None:
    """A parameter that is not possible ends with 2, as JSON where JSON was asked for."""
    run = caesura("segment", folder / "take.npz", *wrong, "--json")
    assert (run.returncode, run.stdout) == (2, "")
    assert json.loads(run.stderr)["detail"]


def test_a_missing_file_is_wrong_usage(folder: Path) -> None:
    """A name that leads nowhere ends with 2."""
    assert caesura("segment", folder / "nowhere.glb").returncode == 2


def test_no_server(folder: Path) -> None:
    """A server that does not answer ends with 4."""
    run = caesura("submit", folder / "take.npz", "--url", f"http://127.0.0.1:{closed_port()}", "--json")
    assert (run.returncode, run.stdout) == (4, "")
    assert json.loads(run.stderr)["code"] == "unreachable"


def test_submit_prints_what_segment_prints(service: str, folder: Path, document: dict[str, Any]) -> None:
    """The service gives the same segments as one's own machine."""
    run = caesura("submit", folder / "take.npz", "--url", service, "--motions", "2", "--json")
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    assert found["id"]
    assert found["segments"] == document["segments"]
    assert found["energy"] == document["energy"]


def test_submit_of_a_bad_file(service: str, folder: Path) -> None:
    """What the service refuses ends with 3 and the service's own problem; its address may do without a scheme."""
    run = caesura("submit", folder / "page.glb", "--url", service.removeprefix("http://"), "--json")
    assert (run.returncode, run.stdout) == (3, "")
    assert json.loads(run.stderr)["code"] == "unsupported-media-type"


def test_the_demo(service: str) -> None:
    """Both sample figures are cut as they were made, 95 frames of 100, through a running service."""
    run = caesura("demo", "--once", "--url", service)
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.count("frame accuracy") == 2


def test_clips_and_key_poses_are_written_beside_the_result(tmp_path: Path) -> None:
    """`--clips` and `--keyframes` name the files; what is chosen for clips has the names of the API."""
    from tests.glb import strip_of_two_motions

    (tmp_path / "strip.glb").write_bytes(strip_of_two_motions().glb())
    out, poses = tmp_path / "clips.glb", tmp_path / "poses.glb"
    options = ["--clips", out, "--keyframes", poses, "--keep-source", "--loop", "A"]
    run = caesura("segment", tmp_path / "strip.glb", "--motions", "2", *options)
    assert run.returncode == 0, run.stderr
    assert b'"A_01-loop"' in out.read_bytes()
    assert b'"take"' in out.read_bytes()
    assert b'"key_frames"' in poses.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["clips.glb", "poses.glb", "strip.glb"]


def test_one_file_of_clips_is_of_one_animation(folder: Path) -> None:
    """Two animations cannot go into one file: that is said before anything is computed."""
    run = caesura("segment", folder / "take.npz", folder / "empty.glb", "--clips", folder / "out.zip")
    assert run.returncode == 2
    assert "one animation at a time" in run.stderr


@pytest.mark.parametrize(
    "segments",
    [
        [{"label": "a", "start": 0, "end": 10**10}],
        [{"label": "a", "start": 0, "end": 2 * 10**9}],
        [{"label": number, "start": number, "end": number + 1} for number in range(20_000)],
    ],
    ids=["ten billion frames", "two billion frames", "twenty thousand labels"],
)
def test_a_truth_too_large_to_compare_is_refused_in_a_sentence(tmp_path: Path, segments: list[dict[str, Any]]) -> None:
    """The file is small; what it states would take gigabytes. The process may have four of them."""
    truth = tmp_path / "truth.json"
    truth.write_text(json.dumps({"fps": 30, "frames": segments[-1]["end"], "segments": segments}))
    run = caesura("score", truth, truth, memory_bytes=2**32)
    assert run.returncode == 3
    assert "more than 1000000000 frames or 1000 labels. [not-a-labelling]" in run.stderr


def test_a_long_truth_is_compared_by_its_segments(tmp_path: Path) -> None:
    """A year of frames takes no more memory than its segments."""
    parts = [{"label": label, "start": label * 10**8, "end": (label + 1) * 10**8} for label in range(10)]
    (tmp_path / "truth.json").write_text(json.dumps({"fps": 30, "frames": 10**9, "segments": parts}))
    parts[1:3] = [{"label": 2, "start": 10**8, "end": 3 * 10**8}]
    (tmp_path / "result.json").write_text(json.dumps({"fps": 30, "frames": 10**9, "segments": parts}))
    run = caesura("score", tmp_path / "result.json", tmp_path / "truth.json", "--json", memory_bytes=2**32)
    assert run.returncode == 0, run.stderr
    figures = json.loads(run.stdout)
    assert figures["frame_accuracy"] == 0.9
    assert figures["boundary_f1_0.5_s"] == pytest.approx(16 / 17)


def test_control_characters_of_names_are_shown_and_not_sent(folder: Path, tmp_path: Path) -> None:
    """A name that others chose cannot clear the terminal, colour it or start a line, in a result or in a refusal."""
    name = "\x1b[2J\nwalk\u202e"
    (tmp_path / f"{name}.npz").write_bytes((folder / "take.npz").read_bytes())
    (tmp_path / f"{name}.glb").write_text("no model")
    runs = [
        caesura("segment", tmp_path / f"{name}.npz", "--motions", "2"),
        caesura("segment", tmp_path / f"{name}.npz", tmp_path / f"{name}.glb", "--out", tmp_path / "out"),
        caesura("segment", tmp_path / f"{name}.npz", "--csv", tmp_path / name / "table.csv"),
    ]
    for run in runs:
        said = run.stdout + run.stderr
        assert r"\x1b[2J\nwalk\u202e" in said
        assert not {"\x1b", "\u202e"} & set(said)
        assert "\nwalk" not in said


def test_takes_cut_together_share_names_and_are_searched(folder: Path, tmp_path: Path) -> None:
    """A bad file is named and left out; one table holds all; clips are called after motion and file; find finds."""
    again, out = tmp_path / "again.npz", tmp_path / "cut"
    with np.load(folder / "take.npz") as take:
        turned = 2 * take["vertices"][::-1, :, [1, 2, 0]]
        np.savez(again, vertices=turned, triangles=take["triangles"], frame_rate=take["frame_rate"])
    files = (folder / "take.npz", folder / "page.glb", again)
    run = caesura("segment", *files, "--together", "--motions", "2", "--out", out, "--clips")
    assert run.returncode == 3
    assert "page.glb" in run.stderr
    assert "2 motions in 2 takes" in run.stdout
    rows = [line.split(",") for line in (out / "motions.csv").read_text().splitlines()]
    assert rows[0][:5] == ["take", "name", "motion", "start", "end"]
    assert [(row[0].rpartition("/")[2], row[1]) for row in rows[1:]] == [
        ("take", "A"), ("take", "B"), ("again", "B"), ("again", "A"),
    ]  # fmt: skip
    assert sorted(row[8] for row in rows[1:]) == ["0", "0", "1", "1"]
    document = json.loads((out / "motions.json").read_text())
    assert [motion["takes"] for motion in document["motions"]] == [2, 2]
    (clips,) = out.rglob("again.clips.zip")
    with zipfile.ZipFile(clips) as archive:
        assert {name.partition(".")[0] for name in archive.namelist()} == {"A_again_01", "B_again_01"}
    found = caesura("find", folder / "take.npz", "--in", out, "--start", "1", "--end", "2", "--most", "9", "--json")
    assert found.returncode == 0, found.stderr
    ranges = json.loads(found.stdout)
    assert ranges[0]["distance"] == pytest.approx(0, abs=0.01)
    assert {one["take"].rpartition("/")[2] for one in ranges} == {"take", "again"}
    assert caesura("segment", again, "--together").returncode == 2
    assert caesura("find", again, "--in", tmp_path).returncode == 2


@pytest.fixture(scope="module")
def cut_folder(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of one take that was cut together with its motion A named, and the other not."""
    out = tmp_path_factory.mktemp("named") / "cut"
    given = ("--motions", "2", "--out", out, "--clips", "--csv", "--loop", "walk", "--name", "A=walk")
    run = caesura("segment", folder / "take.npz", "--together", *given)
    assert run.returncode == 0, run.stderr
    return out


@pytest.fixture
def own_folder(cut_folder: Path) -> Path:
    """A copy of it for one test, as far from the file that was cut."""
    copy = Path(tempfile.mkdtemp(dir=cut_folder.parent))
    return Path(shutil.copytree(cut_folder, copy, dirs_exist_ok=True))


def entries(archive: Path) -> list[str]:
    """The names of what a zip holds."""
    with zipfile.ZipFile(archive) as opened:
        return opened.namelist()


def names_in(out: Path) -> list[set[str]]:
    """The names of motions in each file of a folder that says them, but for numbers and loops."""
    (clips,) = out.rglob("take.clips.zip")
    clipped = {name.partition(".")[0].removesuffix("-loop") for name in entries(clips)}
    tables = [next(out.rglob("take.csv")), out / "motions.csv"]
    (document,) = out.rglob("take.json")
    listed = json.loads((out / "motions.json").read_text())
    return [
        {name.removesuffix("_take_01") for name in clipped},
        *({row["name"] for row in csv.DictReader(table.read_text().splitlines())} for table in tables),
        {segment["name"] for segment in json.loads(document.read_text())["segments"]},
        {motion["name"] for motion in listed["motions"]},
        {segment["name"] for take in listed["takes"] for segment in take["segments"]},
    ]


def test_motions_are_named_as_takes_are_cut(cut_folder: Path) -> None:
    """In every file, and a motion that has a name is one that options of clips know."""
    assert names_in(cut_folder) == [{"walk", "B"}] * 6
    (clips,) = cut_folder.rglob("take.clips.zip")
    assert any(name.startswith("walk_take_01-loop") for name in entries(clips))


def test_motions_of_a_folder_are_renamed_without_a_cut(own_folder: Path) -> None:
    """All at once, so two may exchange names; clips keep their options; segments stay as they were."""
    before = json.loads((own_folder / "motions.json").read_text())
    run = caesura("rename", own_folder, "walk=B", "B=sit down")
    assert run.returncode == 0, run.stderr
    assert "sit down" in run.stdout
    assert names_in(own_folder) == [{"B", "sit_down"}, *[{"B", "sit down"}] * 5]
    (clips,) = own_folder.rglob("take.clips.zip")
    assert any(name.startswith("B_take_01-loop") for name in entries(clips))
    after = json.loads((own_folder / "motions.json").read_text())
    assert [motion["id"] for motion in after["motions"]] == [motion["id"] for motion in before["motions"]]
    ends = [[segment["end"] for segment in found["takes"][0]["segments"]] for found in (before, after)]
    assert ends[0] == ends[1]
    assert caesura("rename", own_folder, "B=", "sit down=B").returncode == 0
    assert names_in(own_folder) == [{"A", "B"}] * 6


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("Z=walk",), "There is no motion Z. The motions are"),
        (("walk",), "write it as A=walk"),
        (("walk=same", "B=SAME"), "Two motions would be called"),
    ],
)
def test_names_that_cannot_be_are_refused(own_folder: Path, given: tuple[str, ...], said: str) -> None:
    """Before anything is written."""
    before = {path: path.read_bytes() for path in own_folder.rglob("*") if path.is_file()}
    run = caesura("rename", own_folder, *given)
    assert (run.returncode, said in run.stderr) == (2, True), run.stderr
    assert {path: path.read_bytes() for path in own_folder.rglob("*") if path.is_file()} == before


def test_clips_are_renamed_only_while_their_files_are_there(cut_folder: Path, tmp_path: Path) -> None:
    """A folder that is elsewhere, without them, is left as it is, and says which is missing."""
    moved = tmp_path / "far" / "away" / "moved"
    shutil.copytree(cut_folder, moved)
    run = caesura("rename", moved, "walk=jump")
    assert run.returncode == 3
    assert "take.npz, which is not there. Nothing is renamed." in run.stderr
    assert names_in(moved) == names_in(cut_folder)
