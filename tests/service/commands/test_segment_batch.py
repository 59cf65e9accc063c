"""`caesura segment *.glb --out DIR`: a night's batch, of which one bad file must not cost the rest."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from caesura.samples.sample_figures import build_figure
from caesura.service.commands.cli import main
from caesura.service.commands.file_arguments import output_paths
from tests.conftest import unavailable
from tests.installation import take_npz


def caesura(folder, *arguments):
    """Run the installed command in a folder, on a console of few letters; no shell has a look at its patterns."""
    program = Path(sys.executable).parent / "caesura"
    return subprocess.run(
        [program, *map(str, arguments)],
        cwd=folder, env={**os.environ, "PYTHONIOENCODING": "latin-1"}, check=False, capture_output=True, text=True,
        timeout=240,
    )  # fmt: skip


@pytest.fixture(scope="module")
def takes(tmp_path_factory):
    """Two good takes in two folders, and a file that is none between them."""
    folder = tmp_path_factory.mktemp("batch")
    for name, order in (("monday/walk.npz", (0, 1, 0)), ("tuesday/walk.npz", (1, 0, 1))):
        (folder / name).parent.mkdir()
        (folder / name).write_bytes(take_npz(order))
    (folder / "monday" / "z→.npz").write_text("<html>404</html>")
    (folder / "one.bin").write_bytes(b"")
    return folder


@pytest.fixture(scope="module")
def run(takes):
    """All of them by one pattern, with documents, tables, plots and clips."""
    forms = ["--csv", "--clips", "--vtt", "--eaf", "--plot", "--plot-png"]
    return caesura(takes, "segment", "**/*.npz", "--motions", "2", "--out", "out", *forms)


def test_every_good_file_has_its_results(takes, run):
    """Named after the file, in folders as the files lie; the bad one has none, and nothing half-written is left."""
    written = sorted(str(path.relative_to(takes / "out")) for path in (takes / "out").rglob("*") if path.is_file())
    suffixes = (".clips.zip", ".csv", ".eaf", ".json", ".png", ".svg", ".vtt")
    assert written == [f"{day}/walk{suffix}" for day in ("monday", "tuesday") for suffix in suffixes]
    document = json.loads((takes / "out/monday/walk.json").read_text())
    rows = list(csv.DictReader((takes / "out/monday/walk.csv").read_text().splitlines()))
    assert [int(row["end"]) for row in rows] == [segment["end"] for segment in document["segments"]]
    assert document["parameters"]["motions"] == 2


def test_the_table_at_the_end_says_how_each_went(run):
    """A line for each file, in letters that the console has; a sentence about the bad one; the status is 3."""
    lines = run.stdout.splitlines()
    assert [line.split()[0] for line in lines[1:4]] == [
        str(Path("monday/walk.npz")), str(Path("monday/z\\u2192.npz")), str(Path("tuesday/walk.npz")),
    ]  # fmt: skip
    assert "failed: unsupported-media-type" in lines[2]
    assert lines[-1] == "2 of 3 done"
    assert run.stderr.startswith("caesura: ")
    assert run.stderr.count("\n") == 1
    assert run.returncode == 3


def test_a_folder_that_cannot_be_written_is_said(takes):
    """Where the results cannot go, the file failed, by a sentence and without a traceback."""
    (takes / "taken").write_text("a file")
    run = caesura(takes, "segment", "monday/walk.npz", "--out", "taken/below")
    assert run.returncode == 5
    assert "taken/below could not be written" in run.stderr
    assert "[not-written]" in run.stderr
    assert "Traceback" not in run.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["*.glb"], "There is no file '*.glb'"),
        (["."], "is a folder"),
        (["monday/walk.npz", "--csv"], "--csv needs the name of a file"),
        (["monday/*.npz", "--csv", "one.csv"], "--csv names one file"),
        (["monday/walk.npz", "--out", "out", "--clips", "c.zip"], "With --out, --clips takes no name"),
        (["--out", "out", "--clips", "monday/walk.npz", "monday/z→.npz"], "With --out, --clips takes no name"),
        (["monday/walk.npz", "--csv", "nowhere/one.csv"], "There is no folder 'nowhere' for --csv"),
        (["monday/walk.npz", "--csv", "tuesday"], "'tuesday' is a folder"),
        (["monday/walk.npz", "--csv", "one", "--vtt", "./one"], "'one' is named twice"),
        (["monday/walk.npz", "--discard", "A", "--csv", "one.csv"], "--discard says how clips are made"),
        (["monday/walk.npz", "--csv", "monday/walk.npz"], "'monday/walk.npz' is one of the files to read"),
        (["-", "monday/walk.npz"], "- is standard input, which is one animation"),
        (["monday/walk.npz", "--csv", "-", "--vtt", "-"], "Only one output can go to standard output"),
        (["monday/walk.npz", "--csv", "-", "--json"], "would both go to standard output"),
        (["monday/walk.npz", "one.bin", "--clips", "one.bin"], "'one.bin' is one of the files to read"),
        (["--clips", "monday/walk.npz", "tuesday/walk.npz"], "'monday/walk.npz' is an animation, and --clips would"),
    ],
)
def test_wrong_usage_is_said_before_anything_is_computed(takes, monkeypatch, arguments, said):
    """Exit code 2 and what to do; an input that an option swallowed is noticed."""
    monkeypatch.chdir(takes)
    run = CliRunner().invoke(main, ["segment", *arguments])
    assert run.exit_code == 2
    assert said in run.output


def test_wrong_usage_that_several_options_make_is_json_too(takes, monkeypatch):
    """With `--json` a program reads what is wrong, wherever it is noticed."""
    monkeypatch.chdir(takes)
    run = CliRunner().invoke(main, ["segment", "monday/walk.npz", "--loop", "A", "--json"])
    assert run.exit_code == 2
    assert json.loads(run.stderr)["code"] == "usage"


def test_a_form_that_a_result_has_not_does_not_cost_the_others(takes):
    """No window fits into one second: there are no key-frames, but all else is written."""
    forms = ["--keyframes", "--csv", "--plot"]
    run = caesura(takes, "segment", "monday/walk.npz", "--out", "some", "--end", "1", *forms)
    assert run.returncode == 3
    assert "[no-key-frames]" in run.stderr
    assert sorted(path.name for path in (takes / "some").iterdir()) == ["walk.csv", "walk.json", "walk.svg"]


def test_clips_replace_clips_but_no_other_model(takes):
    """An option that swallowed the first of two files would have written the second's clips over it."""
    for name in ("one.glb", "two.glb"):
        (takes / name).write_bytes(build_figure("rigid").glb)
    source = (takes / "one.glb").read_bytes()
    swallowed = caesura(takes, "segment", "--clips", "one.glb", "two.glb", "--motions", "2")
    assert swallowed.returncode == 2
    assert "'one.glb' is an animation" in swallowed.stderr
    assert (takes / "one.glb").read_bytes() == source
    for name in ("clips.glb", "clips.glb"):
        run = caesura(takes, "segment", "two.glb", "--clips", name, "--motions", "2")
        assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["own.json", "--clips", "own.json"],
        ["own.json", "--csv", "./own.json"],
        ["own.json", "--clips", "link.glb"],
        ["own.json", "--clips", "hard.glb"],
        ["own.json", "--out", "."],
        ["own.json", "walk.npz", "--out", ".", "--csv"],
    ],
    ids=["the name", "another spelling", "a link", "a hard link", "a folder", "several into a folder"],
)
def test_an_input_is_never_written_over(tmp_path, arguments):
    """In no form and by no name, unless --force says so: then it is whole, and new."""
    (tmp_path / "own.json").write_bytes(build_figure("rigid").glb)
    (tmp_path / "walk.npz").write_bytes(take_npz())
    (tmp_path / "link.glb").symlink_to("own.json")
    (tmp_path / "hard.glb").hardlink_to(tmp_path / "own.json")
    before = (tmp_path / "own.json").read_bytes()
    run = caesura(tmp_path, "segment", *arguments, "--motions", "2")
    assert run.returncode == 2
    assert "one of the files to read" in run.stderr
    assert (tmp_path / "own.json").read_bytes() == before


def test_force_writes_over_an_input(tmp_path):
    """The clips are made of the file that they replace."""
    (tmp_path / "two.glb").write_bytes(build_figure("rigid").glb)
    run = caesura(tmp_path, "segment", "two.glb", "--clips", "two.glb", "--motions", "2", "--force")
    assert run.returncode == 0, run.stderr
    assert b"A_01" in (tmp_path / "two.glb").read_bytes()


def test_several_files_at_once_are_cut_as_one_by_one(takes, run):
    """In the same order, with the same documents and tables, the same sentence and the same status."""
    forms = ["--csv", "--clips", "--vtt", "--eaf", "--plot", "--plot-png"]
    once = caesura(
        takes, "segment", "**/walk.npz", "monday/z→.npz", "--motions", "2", "--out", "jobs", "--jobs", "2", *forms
    )
    assert once.returncode == 3, once.stderr
    assert [line.split()[0] for line in once.stdout.splitlines()[1:4]] == [
        "monday/walk.npz", "tuesday/walk.npz", "monday/z\\u2192.npz",
    ]  # fmt: skip
    assert once.stdout.splitlines()[-1] == "2 of 3 done"
    for path in (takes / "out").rglob("*.*"):
        assert (takes / "jobs" / path.relative_to(takes / "out")).read_bytes() == path.read_bytes()


def test_pipes_and_links_stay_what_they_are(takes):
    """What is written to a pipe goes through it, and what is written to a link goes to the file that it names."""
    os.mkfifo(takes / "pipe")
    (takes / "link").symlink_to("linked.vtt")
    with subprocess.Popen(["cat", takes / "pipe"], stdout=subprocess.PIPE) as reader:
        run = caesura(takes, "segment", "monday/walk.npz", "--csv", "pipe", "--vtt", "link")
        assert run.returncode == 0, run.stderr
        assert reader.communicate(timeout=30)[0].startswith(b"name,motion")
    assert (takes / "pipe").is_fifo()
    assert (takes / "link").is_symlink()
    assert (takes / "linked.vtt").read_text().startswith("WEBVTT")


def test_results_of_two_files_never_share_a_name(tmp_path):
    """Files of one name but for the suffix, even in another case, keep their suffixes."""
    files = [Path("/t/a.glb"), Path("/t/A.npz"), Path("/t/b.glb"), Path("/t/below/b.glb")]
    out = tmp_path / "out"
    assert output_paths(files, out) == [out / "a.glb", out / "A.npz", out / "b", out / "below" / "b"]


def test_a_full_folder_for_temporary_files_is_said(takes):
    """Where what must be inflated has no room, the file failed, by a sentence: no bus error ends the command."""
    arrays = dict(np.load(takes / "monday/walk.npz"))
    np.savez_compressed(takes / "deflated.npz", **arrays)
    small = 'mkdir full && mount -t tmpfs -o size=64k none full && TMPDIR=$PWD/full exec "$@"'
    program = Path(sys.executable).parent / "caesura"
    alone = ["unshare", "--user", "--map-root-user", "--mount"]
    if subprocess.run([*alone, "true"], check=False, capture_output=True).returncode:
        unavailable("this machine gives no user its own mounts")
    run = subprocess.run(
        [*alone, "sh", "-c", small, "sh", program, "segment", "deflated.npz", "--motions", "2"],
        cwd=takes, check=False, capture_output=True, text=True, timeout=240,
    )  # fmt: skip
    assert run.returncode == 5, run.stderr
    assert f"{takes / 'full'} has no room for" in run.stderr
    assert "[disk-full]" in run.stderr
