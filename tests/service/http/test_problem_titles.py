"""Titles of problems are English: a phrase that says what is wrong, with names of formats as people write them."""

import re

import pytest

from caesura.core.errors import ERROR_KINDS
from caesura.service.problems.status_table import STATUS_OF_CODE, TITLE_OF_CODE
from tests.docs.test_docs import RAISED

LOWER = re.compile(r"\b(alembic|amc|api|asf|bvh|c3d|fbx|glb|gltf|json|mdd|npz|obj|pc2|ply|usd|vtt|eaf|url|uri)\b")


@pytest.fixture(scope="module")
def codes(checkout):
    folders = (checkout / folder for folder in ("core", "formats", "service", "worker"))
    sources = (path for folder in folders for path in folder.rglob("*.py") if "commands" not in path.parts)
    raised = {code for path in sources for code in RAISED.findall(path.read_text(encoding="utf-8"))}
    return (raised | set(STATUS_OF_CODE)) - {*ERROR_KINDS, "request", "worker"}


def test_every_title_is_a_phrase(codes):
    """Of two words and more, the first with a capital, and every name of a format as people write it."""
    for code in codes | TITLE_OF_CODE.keys():
        title = TITLE_OF_CODE.get(code) or code.replace("-", " ").capitalize()
        assert re.fullmatch(r"[A-Z][\w-]*( [\w,-]+)+", title), (code, title)
        assert not LOWER.search(title), (code, title)
