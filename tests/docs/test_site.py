"""The documentation site: it builds without a warning, and has every page and every public name."""

import json
import re
from html import unescape
from pathlib import Path

import pytest

import caesura
from tests.conftest import unavailable


@pytest.fixture(scope="module")
def site(checkout: Path) -> Path:
    """The site, as `make docs` built it, strictly."""
    folder = checkout / "build" / "site"
    if not (folder / "index.html").is_file():
        unavailable("the site is not built: make docs")
    return folder


def test_every_page_is_in_the_site(checkout: Path, site: Path) -> None:
    """Those of docs/, and README, CHANGELOG and CONTRIBUTING."""
    pages = {path.relative_to(checkout / "docs").with_suffix(".html") for path in (checkout / "docs").rglob("*.md")}
    pages |= {Path("index.html"), Path("CHANGELOG.html"), Path("CONTRIBUTING.html"), Path("notebook.html")}
    assert {str(page) for page in pages if not (site / page).is_file()} == set()


def test_every_public_name_is_in_the_reference(site: Path) -> None:
    """With what it says of itself."""
    shown = unescape(re.sub(r"<[^>]+>", "", (site / "reference.html").read_text(encoding="utf-8")))
    for name in caesura.__all__:
        first = (getattr(caesura, name).__doc__ or "").strip().splitlines()[0].replace("`", "")
        assert first[:60] in shown, name


def test_the_notebook_is_shown_as_it_ran(site: Path) -> None:
    """Its poses, its curve, its table and its plot."""
    shown = (site / "notebook.html").read_text(encoding="utf-8")
    assert shown.count("data:image/png;base64") == 2
    assert "Energy curve: 9 segments of 6 motions" in shown
    assert "<table border" in shown


def test_pages_ask_nobody_else_for_anything(site: Path) -> None:
    """No font, script or picture comes from another address."""
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        asked = re.findall(
            r'<(?:script|img|link rel="(?:stylesheet|preconnect)")[^>]*(?:src|href)="?(https?:[^" >]+)', text
        )
        assert asked == [], page
    assert json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]
