"""The recipes of CONTRIBUTING.md lead where they say: each is followed with a toy, in a copy of the sources."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

TOYS = {
    "core/registry/methods.py": (
        '        Method(\n            "haca"',
        '        Method("toy-method", "toy:toy", "A toy."),\n',
    ),
    "core/registry/descriptors.py": (
        '        DescriptorEntry("geodesic"',
        '        DescriptorEntry("toy-descriptor", "toy:Toy", "how much of a toy it is"),\n',
    ),
    "formats/exports/export_table.py": (
        '    Export("result.npz"',
        '    _text("result.toy", "Toy", "a toy", "text/x-toy", "toy:toy", option="toy", option_help="Write a toy."),\n',
    ),
    "formats/input_formats.py": (
        '        InputFormat(\n            "npz"',
        '        InputFormat("toy", "toy file", lambda head: head[:3] == b"TOY", "toy:header", reader="toy:read"),\n',
    ),
    "core/segmentation_document.py": ("    scores: tuple[Score, ...] = ()", "    toy_field: int = 0\n"),
    "core/parameters.py": ("    seed: int = _light", '    toy_control: int = _light(3, "a toy", ge=1)\n'),
}
"""The line that a recipe adds to a file, and what it stands before."""

WRITTEN = {
    "core/methods/toy.py": "def toy(analysis, parameters):\n    return 'cut'\n",
    "core/descriptors/toy.py": "class Toy:\n    from_input = classmethod(lambda cls, subject: cls())\n",
    "formats/toy.py": "def header(*given):\n    return 'head'\n\n\ndef read(*given):\n    return 'animation'\n",
    "formats/exports/toy.py": "def toy(document):\n    return f'toy of {document}'\n",
}

PROGRAM = """
import io
import json
from click.testing import CliRunner
from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.core.registry.methods import METHODS
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.exports.export_table import exports_of
from caesura.formats.upload_summary import read_header
from caesura.formats.read import read_animation
from caesura.service.app import create_app
from caesura.service.commands.cli import main
from caesura.service.results.result_formats import export_documents
from caesura.service.api_description.method_schemas import describe_methods
from caesura.service.settings import ServiceSettings

print(json.dumps({
    "help": CliRunner().invoke(main, ["segment", "--help"], env={"COLUMNS": "400"}).output,
    "openapi": create_app(ServiceSettings()).openapi(),
    "methods": [method.model_dump() for method in describe_methods()],
    "exports": [export.model_dump() for export in export_documents()],
    "made": [
        METHODS["toy-method"].load()(None, None),
        type(DESCRIPTORS["toy-descriptor"].load()(None)).__name__,
        exports_of("result")["toy"].text("x"),
        read_header(io.BytesIO(b"TOY 1"), "a.toy", Limits()),
        read_animation({"a.toy": b"TOY 1"}, Parameters(), Limits(), None),
    ],
}))
"""


@pytest.fixture(scope="module")
def offered(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the command, OpenAPI and the page's data offer after all recipes were followed."""
    copy = tmp_path_factory.mktemp("recipes")
    shutil.copytree(checkout / "caesura", copy / "caesura", ignore=shutil.ignore_patterns("vendor", "__pycache__"))
    for file, (before, line) in TOYS.items():
        path = copy / "caesura" / file
        text = path.read_text(encoding="utf-8")
        assert text.count(before) == 1, file
        path.write_text(text.replace(before, line + before), encoding="utf-8")
    for file, text in WRITTEN.items():
        (copy / "caesura" / file).write_text(text, encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM], check=False, cwd=copy, capture_output=True, text=True, timeout=60,
        env={"PYTHONPATH": str(copy), "HOME": str(copy), "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    found: dict[str, Any] = json.loads(run.stdout)
    return found


def query(offered: dict[str, Any], name: str) -> dict[str, Any]:
    """A parameter of POST /v1/segmentations, by OpenAPI."""
    (found,) = (p for p in offered["openapi"]["paths"]["/v1/segmentations"]["post"]["parameters"] if p["name"] == name)
    return dict(found)


def test_a_method_is_a_file_and_a_line(offered: dict[str, Any]) -> None:
    """It can be chosen, and runs."""
    assert re.search(r"--method \S*toy-method", offered["help"])
    assert "toy-method" in query(offered, "method")["schema"]["enum"]
    assert ("toy-method", "A toy.") in {(method["name"], method["description"]) for method in offered["methods"]}
    assert offered["made"][0] == "cut"


def test_a_descriptor_is_a_file_and_a_line(offered: dict[str, Any]) -> None:
    """It can be chosen, is described, and is made."""
    assert re.search(r"--descriptor \S*toy-descriptor", offered["help"])
    assert "how much of a toy it is" in query(offered, "descriptor")["description"]
    assert "toy-descriptor" in offered["methods"][0]["parameters"]["properties"]["descriptor"]["enum"]
    assert offered["made"][1] == "Toy"


def test_an_input_format_is_a_file_and_a_line(offered: dict[str, Any]) -> None:
    """Its files are known by their first bytes, and read; the command and OpenAPI say so."""
    assert "toy file (.toy)" in " ".join(offered["help"].split())
    assert "toy file (.toy)" in offered["openapi"]["paths"]["/v1/animations"]["post"]["requestBody"]["description"]
    assert offered["made"][3:] == ["head", "animation"]


def test_an_export_is_a_file_and_a_line(offered: dict[str, Any]) -> None:
    """It has an address, a line in the page's menu and an option, and is written."""
    result = offered["openapi"]["paths"]["/v1/segmentations/{identifier}/result.toy"]["get"]
    assert "text/x-toy" in result["responses"]["200"]["content"]
    assert {"path": "result.toy", "title": "Toy", "description": "a toy", "queued": False} in offered["exports"]
    assert re.search(r"--toy \S+ +Write a toy\.", offered["help"])
    assert offered["made"][2] == "toy of x"


def test_a_field_of_the_result_is_a_line(offered: dict[str, Any]) -> None:
    """Programs find it in the schema of the result."""
    assert "toy_field" in offered["openapi"]["components"]["schemas"]["SegmentationDocument"]["properties"]


def test_a_control_has_its_parameter(offered: dict[str, Any]) -> None:
    """The page reads its range from GET /v1/methods; the command and the API take it."""
    assert "--toy-control INTEGER" in offered["help"]
    assert query(offered, "toy_control")["schema"]["minimum"] == 1
    assert offered["methods"][0]["parameters"]["properties"]["toy_control"]["default"] == 3


def test_the_recipes_name_files_that_are_there(checkout: Path) -> None:
    """All but those that a recipe tells to write."""
    page = (checkout / "CONTRIBUTING.md").read_text(encoding="utf-8")
    named = {path for path in re.findall(r"`([a-z]\S*/\S+)`", page) if "NAME" not in path}
    assert {path for path in named if not (checkout / path).exists()} == set()
    assert set(TOYS) <= named


def test_every_folder_has_a_sentence(checkout: Path) -> None:
    """In docs/architecture.md; and no folder that is not there."""
    page = (checkout / "docs/architecture.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"^\| `([a-z_0-9/]+)` \| .+\. \|$", page, re.MULTILINE))
    packages = ("core", "formats", "worker", "service", "samples")
    folders = {
        file.parent.relative_to(checkout) for name in packages for file in (checkout / name).rglob("__init__.py")
    }
    own = {file.parent for file in (checkout / "caesura").glob("*/__init__.py") if not file.parent.is_symlink()}
    folders |= {folder.relative_to(checkout) for folder in own}
    assert listed == {str(folder) for folder in folders if len(folder.parts) > 1} | {"service/static"}
