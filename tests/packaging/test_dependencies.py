"""What is imported is declared: in the base what arrays and files need, in the extra `service` the rest."""

import ast
import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator
from importlib.metadata import packages_distributions
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.installation import take_npz

OWN = {"blender", "benchmarks", "caesura", "tests", "tools"}
PROVIDERS = {"pxr": ["usd-core"], **packages_distributions()}
"""`pxr` also where the large readers are not installed: it is not called as what brings it."""


def project(checkout: Path) -> dict[str, Any]:
    """What pyproject.toml says."""
    return tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))


def names_of(requirements: Iterable[str]) -> set[str]:
    """The distributions of some requirements; an extra of our own is none."""
    return {canonicalize_name(Requirement(text).name) for text in requirements} - {"caesura"}


def declared(checkout: Path, *parts: str) -> set[str]:
    """The distributions that some extras and groups declare, with those of the base."""
    found = project(checkout)
    lists = {**found["project"]["optional-dependencies"], **found["dependency-groups"]}
    return names_of(found["project"]["dependencies"]).union(*(names_of(lists[part]) for part in parts))


def imported(files: Iterable[Path]) -> Iterator[tuple[Path, str]]:
    """Every top-level module of another project that a file imports, wherever in the file."""
    for path in files:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            modules = [node.module] if isinstance(node, ast.ImportFrom) and node.module else []
            modules += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            tops = {module.partition(".")[0] for module in modules}
            yield from ((path, top) for top in tops - OWN - sys.stdlib_module_names)


@pytest.mark.parametrize(
    ("folders", "parts"),
    [
        (["core", "formats", "samples"], ["alembic", "usd", "plot"]),
        (["service", "worker"], ["service"]),
        (
            ["benchmarks", "tests", "tools", "docs/examples"],
            ["service", "alembic", "usd", "plot", "assets", "build", "docs", "fuzz", "notebook", "test"],
        ),
    ],
)
def test_every_import_is_declared(checkout: Path, folders: list[str], parts: list[str]) -> None:
    """By the distribution that provides it, and not through another one that happens to need it."""
    here = declared(checkout, *parts)
    files = [path for folder in folders for path in sorted((checkout / folder).rglob("*.py"))]
    found = {(str(path.relative_to(checkout)), top) for path, top in imported(files)}
    assert found
    undeclared = {
        (path, top) for path, top in found if not {canonicalize_name(name) for name in PROVIDERS.get(top, [top])} & here
    }
    assert not undeclared


def without_the_extra(checkout: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `caesura` as where the extra `service` is not installed."""
    missing = declared(checkout, "service") - declared(checkout) - {"pydantic-core"}  # which pydantic brings
    modules = {top for top, names in PROVIDERS.items() if missing & {canonicalize_name(name) for name in names}}
    program = (
        f"import sys\nfor name in {sorted(modules)!r}:\n    sys.modules[name] = None\n"
        "from caesura.service.commands.cli import main\nmain(sys.argv[1:])"
    )
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], check=False, capture_output=True, text=True, timeout=120
    )


def test_the_base_segments_files(checkout: Path, tmp_path: Path) -> None:
    """Without the extra a file is segmented, written in every form and scored."""
    (tmp_path / "take.npz").write_bytes(take_npz())
    result = str(tmp_path / "out" / "take.json")
    forms = ["--csv", "--clips", "--vtt", "--eaf", "--plot", "--plot-png"]
    segment = ["segment", str(tmp_path / "take.npz"), "--motions", "2", "--out", str(tmp_path / "out"), *forms]
    for command in (segment, ["score", result, result]):
        run = without_the_extra(checkout, *command)
        assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(
    "command", [["serve"], ["worker", "--check"], ["keys", "list"], ["submit", "pyproject.toml"], ["demo"]]
)
def test_a_command_without_its_extra_names_it(checkout: Path, command: list[str]) -> None:
    """In a sentence, and with `--json`, where there is one, as a problem."""
    as_json = command[0] == "submit"
    run = without_the_extra(checkout, *command, *(["--json"] if as_json else []))
    assert run.returncode == 4, run.stderr
    detail = json.loads(run.stderr)["detail"] if as_json else run.stderr.splitlines()[-1]
    assert re.search(r"\w+ is not installed, which this command needs\. Install caesura\[service\]\.", detail)


def test_the_image_has_every_extra_of_the_service(checkout: Path) -> None:
    """The runtime's lock names the base and all extras but those for notebooks, and no registry."""
    text = (checkout / "locks/runtime.lock").read_text(encoding="utf-8")
    locked = {canonicalize_name(name) for name in re.findall(r"^([\w.-]+)==", text, re.MULTILINE)}
    extras = project(checkout)["project"]["optional-dependencies"].keys() - {"plot"}
    assert declared(checkout, *extras) <= locked
    assert "://" not in text


def test_what_is_subclassed_has_an_upper_bound(checkout: Path) -> None:
    """Their internals are ours to know, so the next version is looked at before it is allowed."""
    service = {r.name: r for r in map(Requirement, project(checkout)["project"]["optional-dependencies"]["service"])}
    for name in ("rq", "uvicorn"):
        assert any(bound.operator == "<" for bound in service[name].specifier), name
