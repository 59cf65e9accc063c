"""The zip that Blender installs: its manifest, its files, and what they import."""

import ast
import re
import sys
import tomllib
import zipfile

import pytest

from tools.build_addon import ADDON, build_addon

BROUGHT_BY_BLENDER = {"bpy", "gpu", "gpu_extras", "numpy"}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return build_addon(tmp_path_factory.mktemp("addon"))


def test_the_manifest_stands_at_the_top_and_says_what_extensions_must_say(built):
    with zipfile.ZipFile(built) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        names = set(archive.namelist())
    assert {"__init__.py", "registration.py", "LICENSE"} <= names
    assert not any("/" in name for name in names)
    assert manifest["type"] == "add-on"
    assert manifest["blender_version_min"] == "4.2.0"
    assert re.fullmatch(r"[a-z][a-z0-9_]*", manifest["id"])
    assert len(manifest["tagline"]) <= 64
    assert not manifest["tagline"].endswith(".")
    assert set(manifest["permissions"]) == {"network", "files"}
    assert all(len(why) <= 64 and not why.endswith(".") for why in manifest["permissions"].values())


def test_it_has_the_version_of_the_project(built, checkout):
    project = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))
    assert built.name == f"caesura-blender-{project['project']['version']}.zip"


def test_the_same_sources_make_the_same_bytes(built, tmp_path):
    assert build_addon(tmp_path).read_bytes() == built.read_bytes()


@pytest.mark.parametrize("source", sorted(ADDON.glob("*.py")), ids=lambda path: path.stem)
def test_it_imports_nothing_but_itself_the_standard_library_and_what_blender_brings(source):
    for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
        modules = [node.module] if isinstance(node, ast.ImportFrom) and not node.level else []
        modules += [name.name for name in node.names] if isinstance(node, ast.Import) else []
        for module in modules:
            root = module.partition(".")[0]
            assert root in sys.stdlib_module_names | BROUGHT_BY_BLENDER, module
