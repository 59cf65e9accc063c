"""What the pages say is so: their commands exist, their links lead somewhere, every call is listed."""

import re
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from click.testing import CliRunner

from caesura.core.errors import ERROR_KINDS
from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.core.registry.methods import METHODS
from caesura.service.api_description.format_documents import format_documents
from caesura.service.app import create_app
from caesura.service.commands.cli import main
from caesura.service.commands.exit_codes import EXIT_CODES
from caesura.service.problems.status_table import STATUS_OF_CODE
from caesura.service.settings import ServiceSettings

ROOT = Path(__file__).parents[2]
PAGES = sorted(path.relative_to(ROOT) for path in ROOT.glob("docs/**/*.md"))
PAGES += [Path("README.md"), Path("CHANGELOG.md"), Path("CONTRIBUTING.md")]
RAISED = re.compile(
    r"\b(?:InputError|UnsupportedMedia|BrokenContainer|InvalidModel|LimitExceeded|ParameterError|RequestProblem|worker_problem)"
    r'\(\s*"([a-z0-9-]+)"'
)
LARGE_READERS = {"alembic3d", "usd-core"}
LOCKS = [*sorted(path.relative_to(ROOT) for path in ROOT.glob("locks/*.lock")), Path("package-lock.json")]


def blocks(page: str) -> str:
    """The code of a page, and nothing else."""
    return "\n".join(re.findall(r"```\w*\n(.*?)```", page, re.DOTALL))


def anchors(page: str) -> set[str]:
    """The places of a page that a link can name: its headings, as they are shown on the web."""
    headings = re.findall(r"^#+ (.+)$", page, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_links_lead_somewhere(checkout: Path, page: Path) -> None:
    """A link to a file or a heading of the project finds it."""
    text = (checkout / page).read_text(encoding="utf-8")
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if "://" in link:
            continue
        path, _, anchor = unquote(link).partition("#")
        target = (checkout / page).parent / path if path else checkout / page
        assert target.exists(), f"{page} links to {link}"
        if anchor:
            assert anchor in anchors(target.read_text(encoding="utf-8")), f"{page} links to {link}"


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_measured_sections_hold_figures(checkout: Path, page: Path) -> None:
    """What a program wrote into its section is a table, not nothing and not how it failed."""
    text = (checkout / page).read_text(encoding="utf-8")
    assert "Traceback (most recent call last)" not in text
    for name, found in re.findall(r"^<!-- (\w+) -->\n(.*?)^<!-- /\1 -->", text, re.DOTALL | re.MULTILINE):
        assert re.search(r"\d", found), f"{page}: nothing was measured in {name}"


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_commands_exist(checkout: Path, page: Path) -> None:
    """Every `make X` and `caesura X` that a page shows can be run."""
    makefile = (checkout / "Makefile").read_text(encoding="utf-8")
    code = blocks((checkout / page).read_text(encoding="utf-8"))
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    assert set(re.findall(r"\bmake ([a-z]+)", code)) <= targets
    assert set(re.findall(r"(?<!from )\bcaesura ([a-z]+)", code)) <= set(main.commands)


@pytest.mark.parametrize("lock", LOCKS, ids=str)
def test_locks_name_no_registry(checkout: Path, lock: Path) -> None:
    """What is locked are names, versions and digests: whoever installs chooses where from."""
    assert "://" not in (checkout / lock).read_text(encoding="utf-8")


def test_the_image_installs_what_was_tested(checkout: Path) -> None:
    """Of every package that both locks have the same version and digests; the image has the large readers besides."""
    runtime, tested = (
        dict(
            re.findall(r"^(\S+==\S+)(.*(?:\n +--hash.*)+)", (checkout / name).read_text(encoding="utf-8"), re.MULTILINE)
        )
        for name in ("locks/runtime.lock", "locks/development.lock")
    )
    shared = runtime.keys() & tested.keys()
    assert {name: runtime[name] for name in shared} == {name: tested[name] for name in shared}
    assert {name.partition("==")[0] for name in runtime.keys() - shared} <= LARGE_READERS


def test_every_call_is_documented(checkout: Path) -> None:
    """docs/api.md lists each call of the OpenAPI document, and no other."""
    calls = {
        f"{method.upper()} {path}"
        for path, methods in create_app(ServiceSettings()).openapi()["paths"].items()
        for method in methods
    }
    listed = re.findall(r"^\| `([A-Z]+ /[^`]+)`", (checkout / "docs/api.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert set(listed) == calls


def test_every_problem_is_documented(checkout: Path) -> None:
    """docs/api.md says what each code means that the service can answer with."""
    page = (checkout / "docs/api.md").read_text(encoding="utf-8").partition("## Problems")[2]
    raised = {
        code
        for folder in ("core", "formats", "service", "worker")
        for path in (checkout / folder).rglob("*.py")
        if not {"commands", "key_ring.py"} & set(path.parts)  # a command alone makes and revokes keys
        for code in RAISED.findall(path.read_text(encoding="utf-8"))
    }
    codes = {code for code in STATUS_OF_CODE if code not in {*ERROR_KINDS, "request", "worker"}}
    assert {code for code in raised | codes if f"`{code}`" not in page} == set()


def test_make_help_lists_every_target(checkout: Path) -> None:
    """What can be made is said by `make help`, and nothing else is."""
    makefile = (checkout / "Makefile").read_text(encoding="utf-8")
    (phony,) = re.findall(r"^\.PHONY: (.+)$", makefile, re.MULTILINE)
    assert set(re.findall(r'@echo "make ([a-z-]+) ', makefile)) | {"help"} == set(phony.split())
    assert set(phony.split()) == set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))


def test_the_readme_tells_what_python_offers(checkout: Path) -> None:
    """Its Python block runs as it stands, on arrays of the shapes that it names."""
    (block,) = re.findall(r"```python\n(.*?)```", (checkout / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    swing = np.sin(np.arange(120) / 5)[:, None]
    vertices = np.random.default_rng(0).normal(size=(1, 20, 3)) + np.stack([0 * swing, swing, 0 * swing], 2) * 0.1
    triangles = np.arange(18).reshape(6, 3)
    exec(block, {"vertices": vertices * (1 + swing[..., None] / 9), "triangles": triangles, "features": vertices[:, 0]})


def test_every_exit_code_is_documented(checkout: Path) -> None:
    """docs/command.md has the table that `caesura --help` prints."""
    page = (checkout / "docs/command.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| (\d+) \| (.+) \|$", page, re.MULTILINE)
    assert listed == [(str(code), meaning) for code, meaning in EXIT_CODES.items()]


def test_every_format_is_documented(checkout: Path) -> None:
    """docs/formats.md and `caesura formats` have the table that the API answers with."""
    page = (checkout / "docs/formats.md").read_text(encoding="utf-8")
    listed = CliRunner().invoke(main, ["formats"]).output
    rows = []
    for known in format_documents():
        files = ", ".join(f"`{suffix}`" for suffix in known.suffixes)
        beside = f" with its `{known.companion}`" if known.companion else ""
        rows.append(f"| {known.title} | {files}{beside} | {known.description} |")
        assert f"{known.title}: {known.description}\n" in listed
    assert re.findall(r"^\| .* \| `.* \|$", page, re.MULTILINE) == rows


def test_every_method_and_descriptor_is_documented(checkout: Path) -> None:
    """docs/method.md says what each of the tables' entries does."""
    page = (checkout / "docs/method.md").read_text(encoding="utf-8")
    assert not {name for name in (*METHODS, *DESCRIPTORS) if f"`{name}`" not in page}
