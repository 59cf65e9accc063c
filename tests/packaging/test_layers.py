"""Data flows one way: the contracts on imports in pyproject.toml hold, and would notice if they did not."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest


def contracts(folder: Path) -> subprocess.CompletedProcess[str]:
    program = Path(sys.executable).parent / "lint-imports"
    return subprocess.run(
        [program, "--no-cache", "--no-logo"], check=False, cwd=folder, capture_output=True, text=True, timeout=120
    )


@pytest.fixture
def copy(checkout: Path, tmp_path: Path) -> Path:
    """The sources again, to break them."""
    ignored = shutil.ignore_patterns("static", "__pycache__")
    shutil.copytree(checkout / "caesura", tmp_path / "caesura", ignore=ignored)
    shutil.copy(checkout / "pyproject.toml", tmp_path)
    return tmp_path


def test_the_contracts_hold(checkout: Path) -> None:
    """Nothing in the sources points upwards, and core knows neither HTTP nor Redis."""
    run = contracts(checkout)
    assert run.returncode == 0, run.stdout


@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("core", "import redis"),
        ("core", "import caesura.formats.read"),
        ("formats", "import caesura.worker.tasks"),
        ("worker", "import caesura.service.app"),
    ],
)
def test_an_arrow_that_points_up_is_noticed(copy: Path, module: str, line: str) -> None:
    """A forbidden import breaks the contracts."""
    (copy / "caesura" / module / "wrong.py").write_text(f'"""Wrong."""\n\n{line}\n')
    run = contracts(copy)
    assert run.returncode == 1, run.stdout
    assert f"{module}.wrong" in run.stdout


def test_the_picture_of_the_rooms_is_drawn_from_the_imports(checkout: Path) -> None:
    """No two rooms import each other in a circle, none imports upwards, and docs/pictures/architecture.svg shows it."""
    program = [sys.executable, "tools/architecture.py", "--check"]
    run = subprocess.run(program, check=False, cwd=checkout, capture_output=True, text=True, timeout=60)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(
    ("file", "line", "said"),
    [
        ("core/mesh/mesh.py", "import caesura.core.block_pass.projection", "circle"),
        ("core/mesh/mesh.py", "import caesura.formats.read", "core/mesh -> formats/read"),
        ("core/plot/svg.py", "import caesura.core.agreement", "is old"),
    ],
)
def test_a_circle_of_rooms_is_noticed(copy: Path, checkout: Path, file: str, line: str, said: str) -> None:
    """As are an import that points upwards, and a picture that is not drawn anew."""
    for folder in ("core", "formats", "worker", "service", "samples"):
        (copy / "caesura" / folder).rename(copy / folder)
    for folder in ("tools", "docs"):
        shutil.copytree(checkout / folder, copy / folder)
    with (copy / file).open("a") as module:
        module.write(f"\n{line}\n")
    program = [sys.executable, "tools/architecture.py", "--check"]
    run = subprocess.run(program, check=False, cwd=copy, capture_output=True, text=True, timeout=60)
    assert run.returncode == 1
    assert said in run.stderr
