"""The page as files: whole, its own, and free of inline script."""

import re
from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def static(checkout: Path) -> Path:
    """The folder that is served."""
    return checkout / "service" / "static"


def test_every_module_the_page_preloads_is_there_and_the_rest_is_imported_somewhere(static: Path) -> None:
    """No address in the page is dead, and no module lies about unused."""
    html = (static / "index.html").read_text(encoding="utf-8")
    preloaded = re.findall(r'modulepreload" href="/static/(viewer/[^"]+)"', html)
    assert preloaded
    assert all((static / path).is_file() for path in preloaded)
    sources = {path.name: path.read_text(encoding="utf-8") for path in (static / "viewer").glob("*.js")}
    imported = {name for text in sources.values() for name in re.findall(r"'\./([\w]+\.js)'", text)}
    assert imported | {"app.js"} == set(sources)


def test_all_modules_of_the_3d_view_are_asked_for_at_once(static: Path) -> None:
    """What `stage.js` imports, near and far, is preloaded with the page or listed in `parts.js`."""
    viewer = static / "viewer"
    needed, waiting = {"stage"}, ["stage"]
    while waiting:
        text = (viewer / f"{waiting.pop()}.js").read_text(encoding="utf-8")
        found = set(re.findall(r"from '\./(\w+)\.js'", text)) - needed
        needed |= found
        waiting += found
    listed = set(re.findall(r"'(\w+)'", (viewer / "parts.js").read_text(encoding="utf-8").split("THREE")[0]))
    preloaded = set(re.findall(r"viewer/(\w+)\.js", (static / "index.html").read_text(encoding="utf-8")))
    assert listed - {"modulepreload"} == needed - preloaded


def test_the_page_asks_nobody_else(static: Path) -> None:
    """Nothing of our own names another host: the page works without the Internet."""
    for path in [static / "index.html", *(static / "style").glob("*.css"), *(static / "viewer").glob("*.js")]:
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
