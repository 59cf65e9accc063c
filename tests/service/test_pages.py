"""Every answer tells browsers what they may do with it; the page runs only scripts of its own."""

import base64
import hashlib
import re

import pytest

from caesura.service.http.security_headers import page_policy
from tests.conftest import unavailable


@pytest.mark.parametrize("path", ["/healthz", "/v1/limits", "/nothing", "/openapi.json"])
def test_every_answer_is_guarded(idle, path):
    """Whatever the status: no sniffing, no framing, no script."""
    headers = idle.http.get(path).headers
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Content-Security-Policy"].startswith("default-src 'none'")


@pytest.mark.parametrize("path", ["/", "/view/any"])
def test_the_page_may_run_its_own_scripts_and_its_import_map(idle, path):
    """The policy allows this server's files and the inline import map by its digest, and nothing inline beside it."""
    answer = idle.http.get(path)
    policy = answer.headers["Content-Security-Policy"]
    assert answer.status_code == 200
    inline = re.findall(r"<script type=\"importmap\">(.*?)</script>", answer.text, re.DOTALL)
    assert len(inline) == 1
    assert f"'sha256-{base64.b64encode(hashlib.sha256(inline[0].encode()).digest()).decode()}'" in policy
    assert "unsafe" not in policy


def test_only_inline_scripts_are_digested():
    """A script with an address of its own is covered by 'self'."""
    assert page_policy('<script src="/a.js"></script>').count("sha256") == 0
    assert page_policy("<script>x</script><script type=module>y</script>").count("sha256") == 2


def test_the_pages_files_are_served_and_kept(idle):
    """With a tag, so that a browser asks before it loads them again."""
    answer = idle.http.get("/static/icon.svg")
    assert answer.headers["Cache-Control"] == "no-cache"
    assert answer.status_code == 200
    again = idle.http.get("/static/icon.svg", headers={"If-None-Match": answer.headers["ETag"]})
    assert again.status_code == 304


def test_there_is_no_way_out_of_the_static_folder(idle):
    """Neither by dots nor by encoded dots."""
    for path in ("/static/../settings.py", "/static/%2e%2e/settings.py", "/static//etc/passwd"):
        assert idle.http.get(path).status_code == 404


@pytest.mark.parametrize("path", ["/redoc", "/docs/oauth2-redirect"])
def test_no_page_loads_scripts_of_another_site(idle, path):
    """The framework's pages about the API do: they are not there. /openapi.json is, and a page of our own."""
    assert idle.http.get(path).json()["code"] == "not-found"
    assert idle.http.get("/openapi.json").status_code == 200


def test_the_page_of_the_api_has_all_its_files_here(idle):
    """Its scripts and styles are ours; nothing of it comes from another site."""
    answer = idle.http.get("/docs")
    if answer.status_code == 404 and "not installed" in answer.json()["detail"]:
        unavailable("the page's libraries are not fetched: make setup")
    assert answer.status_code == 200
    assert "unsafe" not in answer.headers["Content-Security-Policy"]
    assert "://" not in answer.text
    for path in re.findall(r'(?:src|href)="([^"]+)"', answer.text):
        assert idle.http.get(path).status_code == 200, path
