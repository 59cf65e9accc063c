"""The page as files: whole, its own, and free of inline script."""

import re
from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def static(checkout: Path) -> Path:
    """The folder that is served."""
    return checkout / "service" / "static"


def test_every_module_is_imported_and_every_import_is_there(static: Path) -> None:
    """No module lies about unused, and none is asked for in vain."""
    html = "".join((static / name).read_text(encoding="utf-8") for name in ("index.html", "docs.html"))
    named = {static / path for path in re.findall(r'<script type="module" src="/static/([^"]+)"', html)}
    modules = set((static / "viewer").rglob("*.js"))
    for path in modules:
        names = re.findall(r"(?:from |import\(|URL\()'(\.[^']+)'", path.read_text(encoding="utf-8"))
        named |= {(path.parent / name).resolve() for name in names}
    assert named == modules


def test_the_page_asks_nobody_else(static: Path) -> None:
    """Nothing of our own names another host: the page works without the Internet."""
    for path in [static / "index.html", *(static / "style").glob("*.css"), *(static / "viewer").rglob("*.js")]:
        assert not re.search(r"https?://|//cdn", path.read_text(encoding="utf-8")), path.name


def test_the_import_map_is_the_only_inline_script(static: Path) -> None:
    """A content security policy without unsafe-inline holds."""
    html = (static / "index.html").read_text(encoding="utf-8")
    inline = re.findall(r"<script(?![^>]*\bsrc=)([^>]*)>", html)
    assert inline == [' type="importmap"']
    assert not re.search(r"\sstyle=|\son\w+=", html)


def test_locks_name_no_host(checkout: Path) -> None:
    """Whoever installs chooses from where."""
    for name in ("package.json", "package-lock.json", ".npmrc"):
        assert "://" not in (checkout / name).read_text(encoding="utf-8"), name
