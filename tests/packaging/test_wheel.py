"""The wheel is enough: in an empty environment, with the locked runtime dependencies alone, the demo runs."""

import os
import re
import shutil
import subprocess
import sys
import venv
import zipfile
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

LOCKED = re.compile(r"^([a-z0-9][^ ;]*==[^ ;]+)( ; .+?)? \\$", re.MULTILINE)


def build(checkout: Path, folder: Path, kind: str) -> Path:
    """A wheel or an sdist, as `make dist` builds it."""
    command = [sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(folder)]
    subprocess.run(command, cwd=checkout, check=True, capture_output=True)
    return next(folder.iterdir())


@pytest.fixture(scope="module")
def wheel(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of these sources."""
    return build(checkout, tmp_path_factory.mktemp("wheel"), "wheel")


def locked(checkout: Path) -> list[Distribution]:
    """The distributions of the runtime's lock that belong on this machine, as they are installed here by digest."""
    found = []
    for name, marker in LOCKED.findall((checkout / "locks/runtime.lock").read_text(encoding="utf-8")):
        requirement = Requirement(name + marker)
        if requirement.marker is None or requirement.marker.evaluate():
            here = distribution(requirement.name)
            assert requirement.specifier.contains(here.version)
            found.append(here)
    return found


def lend(found: Distribution, site: Path) -> None:
    """The files of an installed distribution in another environment: the same files, at no cost of disk or network."""
    for file in found.files or ():
        target = site / str(file)
        if ".." in file.parts or "__pycache__" in file.parts:
            continue  # programs in bin/, and what is compiled anew
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            os.link(str(found.locate_file(file)), target)
        except OSError:  # another file system
            target.write_bytes(Path(str(found.locate_file(file))).read_bytes())


def test_the_wheel_has_the_page_and_no_more(wheel: Path) -> None:
    """The page and its libraries are inside; tests, benchmarks and tools are not."""
    names = zipfile.ZipFile(wheel).namelist()
    page = "caesura/service/static"
    needed = {
        f"{page}/index.html",
        f"{page}/vendor/stamp.txt",
        f"{page}/vendor/samples/samples.json",
        "caesura/py.typed",
    }
    assert needed <= set(names)
    assert [name for name in names if name.startswith("caesura/service/static/vendor/three/")]
    tops = {name.split("/")[0] for name in names}
    assert tops == {"caesura", f"caesura-{wheel.name.split('-')[1]}.dist-info"}


def test_the_image_builds_the_same_wheel(checkout: Path, wheel: Path, tmp_path: Path) -> None:
    """Of what .dockerignore lets in; and all that the Dockerfile copies from the checkout is let in."""
    source = tmp_path / "source"
    let_in = re.findall(r"^!(.+)$", (checkout / ".dockerignore").read_text(encoding="utf-8"), re.MULTILINE)
    for name in let_in:
        if (checkout / name).is_dir():
            shutil.copytree(checkout / name, source / name, symlinks=True)
        else:
            shutil.copy(checkout / name, source / name)
    dockerfile = (checkout / "Dockerfile").read_text(encoding="utf-8")
    assert all((source / name).exists() for name in re.findall(r"^COPY ([^- ]\S*) ", dockerfile, re.MULTILINE))
    built = build(source, tmp_path / "built", "wheel")
    assert sorted(zipfile.ZipFile(built).namelist()) == sorted(zipfile.ZipFile(wheel).namelist())


@pytest.mark.release
@pytest.mark.timeout(600)  # it compiles every kernel anew: 25 s of work, on a machine that may be busy
def test_the_wheel_runs_the_demo_in_an_empty_environment(checkout: Path, wheel: Path, tmp_path: Path) -> None:
    """Beside folders of the same names, without the checkout or anybody's home: both figures are cut as made."""
    home = tmp_path / "home"
    home.mkdir()
    venv.create(tmp_path / "empty", symlinks=True)
    python = tmp_path / "empty" / "bin" / "python"
    site = next((tmp_path / "empty" / "lib").glob("*/site-packages"))
    for found in locked(checkout):
        lend(found, site)
    pip = [sys.executable, "-m", "pip", "--python", str(python), "--isolated", "--disable-pip-version-check"]
    subprocess.run([*pip, "install", "--quiet", "--no-deps", "--no-index", str(wheel)], check=True)
    for taken in ("core", "formats", "service", "worker"):  # another project's own, which nothing here may import
        (site / taken).mkdir()
        (site / taken / "__init__.py").write_text("raise RuntimeError('the folder of another project')\n")
    environment = {"HOME": str(home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    program = tmp_path / "empty" / "bin" / "caesura"
    run = subprocess.run(
        [program, "demo", "--once", "--port", "0"],
        env=environment, cwd=home, check=False, capture_output=True, text=True, timeout=560,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.count("frame accuracy") == 2
