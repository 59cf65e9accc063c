"""What Windows does not have is not needed to segment files: no fcntl, no resource, no fork."""

import json
import subprocess
import sys

from caesura.service.commands.output_files import OUTPUT_FORMATS
from tests.installation import take_npz

MISSING_MODULES = ("fcntl", "resource", "pwd", "grp", "termios", "pty", "syslog")
MISSING_CALLS = {
    "os": (
        "fork", "forkpty", "getppid", "sched_getaffinity", "posix_fallocate", "pread", "pwrite", "statvfs", "geteuid",
    ),
    "signal": ("SIGKILL", "SIGXCPU", "pause", "setitimer"),
}  # fmt: skip

AS_ON_WINDOWS = f"""
import importlib, pkgutil, os, signal, sys
for name in {MISSING_MODULES!r}:
    sys.modules[name] = None  # to import it is an ImportError
for module, names in {MISSING_CALLS!r}.items():
    for name in names:
        if hasattr(sys.modules[module], name):
            delattr(sys.modules[module], name)
"""


def run(program, *arguments):
    """A fresh interpreter on what is left."""
    return subprocess.run(
        [sys.executable, "-c", AS_ON_WINDOWS + program, *map(str, arguments)],
        check=False, capture_output=True, text=True, timeout=240,
    )  # fmt: skip


def test_every_module_of_core_can_be_imported():
    """And of the samples; the blocks are in force, as the attempt at one shows."""
    program = """
import caesura.core, caesura.formats, caesura.samples
for package in (caesura.core, caesura.formats, caesura.samples):
    for found in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        try:
            importlib.import_module(found.name)
        except ModuleNotFoundError as missing:  # of an extra
            if missing.name not in ("alembic3d", "pxr"):
                raise
print(hasattr(os, "fork"), end=" ")
import fcntl
"""
    ended = run(program)
    assert ended.stdout == "False "
    assert "fcntl" in ended.stderr.splitlines()[-1]


def test_files_are_segmented(tmp_path, monkeypatch):
    """`caesura segment`, by a pattern, printed and written in every form."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "take.npz").write_bytes(take_npz())
    forms = [f"--{form.replace('_', '-')}" for form in OUTPUT_FORMATS]
    command = ["segment", "*.npz", "--motions", "2", "--json", "--out", "out", *forms]
    ended = run("from caesura.service.commands.cli import main\nmain(sys.argv[1:])", *command)
    assert ended.returncode == 0, ended.stderr
    assert json.loads(ended.stdout)["motions"] == 2
    assert json.loads((tmp_path / "out" / "take.json").read_text())["motions"] == 2
    assert len(list((tmp_path / "out").iterdir())) == len(OUTPUT_FORMATS) + 1
