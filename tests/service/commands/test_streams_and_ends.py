"""The command among other programs: standard input and output, Ctrl-C, full disks, readers that go, and completion."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from caesura.service.commands.exit_codes import EXIT_CODES
from caesura.service.commands.local_service import local_service
from tests.conftest import unavailable
from tests.installation import SLOWLY, take_npz

PROGRAM = Path(sys.executable).parent / "caesura"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A short take, and several that take their time."""
    place = tmp_path_factory.mktemp("takes")
    (place / "take.npz").write_bytes(take_npz())
    (place / "copy.npz").write_bytes(take_npz())
    for name in ("long1.npz", "long2.npz", "long3.npz"):
        (place / name).write_bytes(take_npz((0, 1, 0, 1), seconds=30.0, rings=60))
    return place


def caesura(folder, *arguments, **given):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], cwd=folder, check=False, capture_output=True, timeout=120, **given
    )


def test_help_fits_one_screen_and_lists_every_exit_code(folder):
    """Forty lines of eighty letters; so does what each code means."""
    shown = caesura(folder, "--help", env={**os.environ, "COLUMNS": "80"}).stdout.decode()
    assert len(shown.splitlines()) <= 40
    assert max(map(len, shown.splitlines())) <= 80
    assert dict(re.findall(r"^ +(\d+)  (.+)$", shown, re.MULTILINE)) == {str(k): v for k, v in EXIT_CODES.items()}


@pytest.mark.parametrize("piped", [False, True], ids=["redirected", "piped"])
def test_a_dash_is_standard_input_and_output(folder, piped):
    """The document of a take from a pipe is that of its file, and a table goes on to the next program."""
    content = (folder / "take.npz").read_bytes()
    named = json.loads(caesura(folder, "segment", "take.npz", "--motions", "2", "--json").stdout)
    if piped:
        run = caesura(folder, "segment", "-", "--motions", "2", "--json", input=content)
    else:
        with (folder / "take.npz").open("rb") as file:
            run = caesura(folder, "segment", "-", "--motions", "2", "--json", stdin=file)
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout) == named
    table = caesura(folder, "segment", "-", "--motions", "2", "--csv", "-", input=content)
    assert table.stdout.startswith(b"name,motion")
    clips = caesura(folder, "segment", "-", "--motions", "2", "--clips", "-", input=content)
    assert clips.stdout.startswith(b"PK")
    into = caesura(folder, "segment", "-", "--motions", "2", "--out", "piped", "--vtt", input=content)
    assert into.returncode == 0, into.stderr
    assert sorted(path.name for path in (folder / "piped").iterdir()) == ["stdin.json", "stdin.vtt"]


def test_a_bad_take_from_a_pipe_is_a_bad_file(folder):
    """As one with a name."""
    run = caesura(folder, "segment", "-", input=b"<html>")
    assert run.returncode == 3
    assert b"[unsupported-media-type]" in run.stderr


def test_the_document_is_that_of_the_service_in_every_key(folder, tmp_path):
    """But for its id: the take by its number, the parameters, the energies, all."""
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("CAESURA_DATA_DIR", str(tmp_path))
        environment.delenv("REDIS_URL", raising=False)
        with local_service(0) as url:
            sent = json.loads(caesura(folder, "submit", "take.npz", "--url", url, "--motions", "2", "--json").stdout)
            content = (folder / "take.npz").read_bytes()
            piped = caesura(folder, "submit", "-", "--url", url, "--motions", "2", "--json", input=content)
            assert json.loads(piped.stdout)["segments"] == sent["segments"]
    here = json.loads(caesura(folder, "segment", "take.npz", "--motions", "2", "--json").stdout)
    assert here["parameters"]["take"] == 0
    assert {**here, "id": sent["id"]} == sent


def slow(folder, *arguments):
    """A batch that is at work: its first file takes seconds."""
    options = [f"--{name}={value}" for name, value in SLOWLY.items()]
    command = [
        PROGRAM,
        "segment",
        "take.npz",
        "long1.npz",
        "long2.npz",
        "long3.npz",
        "--out",
        "slow",
        *options,
        *arguments,
    ]
    # As in a terminal: whatever a shell starts in the background ignores interrupts, and so would its children.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    signal.signal(signal.SIGINT, before)
    deadline = time.monotonic() + 60
    while not (folder / "slow" / "take.json").is_file():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.02)
    return process


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_ctrl_c_ends_with_130_and_says_what_is_done(folder, jobs):
    """Nothing half-written stays, no process either, and what was done before is whole."""
    for path in (folder / "slow").glob("*"):
        path.unlink()
    process = slow(folder, "--jobs", jobs)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130, said
    assert "caesura: interrupted; 1 of 4 done" in said
    assert "Traceback" not in said
    assert json.loads((folder / "slow" / "take.json").read_text())["frames"] == 180
    assert [path.name for path in (folder / "slow").iterdir()] == ["take.json"]
    left = subprocess.run(["ps", "-eo", "args"], check=True, capture_output=True, text=True).stdout
    assert str(folder) not in left


def processes_below(parent):
    """Process ids and command lines of all that a process has started."""
    listed = subprocess.run(["ps", "-ww", "-eo", "pid=,ppid=,args="], check=True, capture_output=True, text=True).stdout
    rows = [line.split(None, 2) for line in listed.splitlines()]
    found, waiting = {}, [str(parent)]
    while waiting:
        above = waiting.pop()
        for pid, ppid, *arguments in rows:
            if ppid == above:
                found[int(pid)] = "".join(arguments)
                waiting.append(pid)
    return found


def wait_until_gone(pids):
    """Fails where one of them stays."""
    deadline = time.monotonic() + 20
    while left := [pid for pid in pids if Path(f"/proc/{pid}").exists()]:
        assert time.monotonic() < deadline, left
        time.sleep(0.05)


@pytest.fixture
def linux():
    if not Path("/proc").exists():
        unavailable("this system has no /proc")


def test_files_whose_processes_are_killed_are_named_and_the_others_stay(folder, linux):
    """Each process is killed as soon as it is seen, or told to end: 3, with what is done before."""
    for path in (folder / "slow").glob("*"):
        path.unlink()
    process = slow(folder, "--jobs", "2")
    seen = set()
    deadline = time.monotonic() + 120
    while process.poll() is None:
        assert time.monotonic() < deadline
        for pid, arguments in processes_below(process.pid).items():
            seen.add(pid)
            if "multiprocessing.spawn" in arguments:
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL if pid % 2 else signal.SIGTERM)
    printed, said = process.communicate()
    assert process.returncode == 3, said
    assert said.count("[process-lost]") == 3, said
    assert "1 of 4 done; a process was lost, and the rest done one at a time" in printed
    assert [path.name for path in (folder / "slow").iterdir()] == ["take.json"]
    wait_until_gone(seen)


def test_a_process_that_is_killed_once_costs_no_file(folder, linux):
    """The rest is done one at a time; the command says that it was."""
    process = subprocess.Popen(
        [PROGRAM, "segment", "take.npz", "copy.npz", "--motions", "2", "--jobs", "2", "--out", "again"],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    workers = []
    while not workers:
        assert process.poll() is None, process.communicate()
        workers = [
            pid for pid, arguments in processes_below(process.pid).items() if "multiprocessing.spawn" in arguments
        ]
    os.kill(workers[0], signal.SIGKILL)
    printed, said = process.communicate(timeout=120)
    assert process.returncode == 0, said
    assert "2 of 2 done; a process was lost" in printed
    assert len(list((folder / "again").iterdir())) == 2


@pytest.mark.parametrize("by", [signal.SIGTERM, signal.SIGKILL], ids=["SIGTERM", "SIGKILL"])
def test_a_command_that_is_killed_leaves_no_process(folder, linux, by):
    """Told to end: 143, and what is done. Killed, it can say nothing."""
    for path in (folder / "slow").glob("*"):
        path.unlink()
    process = slow(folder, "--jobs", "2")
    below = processes_below(process.pid)
    process.send_signal(by)
    _, said = process.communicate(timeout=60)
    if by == signal.SIGTERM:
        assert process.returncode == 143
        assert "caesura: interrupted; 1 of 4 done" in said
        assert "Traceback" not in said
    wait_until_gone(below)


def test_a_reader_that_goes_ends_the_command(folder):
    """As `| head -1` does: 141, and not a word."""
    process = subprocess.Popen(
        [PROGRAM, "segment", "take.npz", "take.npz", "./take.npz", "--json"],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    process.stdout.close()
    said = process.stderr.read()
    process.stderr.close()
    assert process.wait(60) == 141
    assert said == b""


@pytest.mark.parametrize("form", [["--json"], [], ["--clips", "-"], ["--csv", "-"]])
def test_a_full_disk_behind_standard_output_is_said(folder, form):
    """5, by a sentence."""
    if not Path("/dev/full").exists():
        unavailable("this system has no /dev/full")
    with Path("/dev/full").open("wb") as full:
        run = subprocess.run(
            [PROGRAM, "segment", "take.npz", "--motions", "2", *form],
            check=False, cwd=folder, stdout=full, stderr=subprocess.PIPE, timeout=60,
        )  # fmt: skip
    assert run.returncode == 5, run.stderr
    assert b"disk-full" in run.stderr
    assert b"Traceback" not in run.stderr


def test_a_full_disk_behind_a_file_is_said(folder):
    """5, with the name of the file that could not be written."""
    if not Path("/dev/full").exists():
        unavailable("this system has no /dev/full")
    run = caesura(folder, "segment", "take.npz", "--motions", "2", "--csv", "/dev/full")
    assert run.returncode == 5, run.stderr
    assert b"/dev/full could not be written: No space left on device. [disk-full]" in run.stderr


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("caesura se", ["segment", "serve"]),
        ("caesura segment --me", ["--method"]),
        ("caesura segment --method ac", ["aca"]),
    ],
)
def test_shells_complete_commands_options_and_methods(folder, words, offered):
    """By the script that `_CAESURA_COMPLETE=bash_source caesura` prints."""
    environment = {**os.environ, "COMP_WORDS": words, "COMP_CWORD": str(len(words.split()) - 1)}
    found = caesura(folder, env={**environment, "_CAESURA_COMPLETE": "bash_complete"}).stdout.decode().splitlines()
    assert [line.partition(",")[2] for line in found] == offered
    for shell in ("zsh", "fish"):  # for bash, click asks bash for its version
        script = caesura(folder, env={**os.environ, "_CAESURA_COMPLETE": f"{shell}_source"})
        assert b"_CAESURA_COMPLETE" in script.stdout
