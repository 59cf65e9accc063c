"""A real service and a real browser: nothing of the page is tested any other way."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserType, Page, expect, sync_playwright

SOFTWARE_WEBGL = [
    "--use-angle=swiftshader",
    "--disable-gpu-compositing",  # else the whole page is put together by software WebGL: a third more of the time
    "--enable-unsafe-swiftshader",
    "--disable-lcd-text",
    "--force-color-profile=srgb",
    "--hide-scrollbars",
    "--force-device-scale-factor=1",
]
PATIENCE_MS = 30_000
expect.set_options(timeout=PATIENCE_MS)  # a busy machine shows what is expected later, not otherwise


@pytest.fixture(scope="session")
def address(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Where a service of our own answers, with its workers and its Redis."""
    vendor = checkout / "service" / "static" / "vendor" / "stamp.txt"
    if not vendor.is_file():
        message = "the page's libraries are not fetched: python tools/fetch_assets.py"
        if os.environ.get("CI") == "true":
            pytest.fail(message)
        pytest.skip(message)
    folder = tmp_path_factory.mktemp("served")
    environment = {name: value for name, value in os.environ.items() if name != "REDIS_URL"}
    environment |= {"CAESURA_DATA_DIR": str(folder)}
    with (folder / "log").open("w") as log:
        service = subprocess.Popen(
            [Path(sys.executable).parent / "caesura", "serve", "--port", "0"],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=log,
            text=True,
        )
    assert service.stdout is not None
    try:
        announced = service.stdout.readline()
        assert "http://" in announced, (folder / "log").read_text()
        yield announced.split()[-1]
    finally:
        service.terminate()
        service.wait(30)
        service.stdout.close()


@pytest.fixture(scope="module")
def chromium_type(node: Path) -> Iterator[BrowserType]:
    """What launches Chromium. Its event loop in this thread must end before another module needs its own."""
    os.environ["PLAYWRIGHT_NODEJS_PATH"] = str(node)
    with sync_playwright() as playwright:
        yield playwright.chromium


@pytest.fixture(scope="module")
def browser(chromium_type: BrowserType, chromium: Path) -> Iterator[Browser]:
    """Debian's Chromium, drawing WebGL in software."""
    launched = chromium_type.launch(executable_path=chromium, headless=True, args=SOFTWARE_WEBGL)
    yield launched
    launched.close()


def tab(browser: Browser, address: str) -> Iterator[Page]:
    """A tab of its own. An error that the page itself makes fails the test."""
    context = browser.new_context(viewport={"width": 1100, "height": 720}, base_url=address)
    # In the order of time, in which tests count segments; tests of the list by motion choose it.
    context.add_init_script("localStorage['caesura.list-by'] ??= JSON.stringify('time')")
    page = context.new_page()
    page.set_default_timeout(PATIENCE_MS)
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert not errors


page = pytest.fixture(tab)
kept_page = pytest.fixture(tab, scope="module", name="kept_page")


@pytest.fixture(scope="session")
def smooth(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Our own skinned figure, as a file."""
    path = tmp_path_factory.mktemp("files") / "smooth.glb"
    # In a process of its own: here every array's shape is checked, which the making of a figure need not wait for.
    code = (
        "import sys; from caesura.samples.sample_figures import build_figure;"
        " sys.stdout.buffer.write(build_figure('smooth').glb)"
    )
    path.write_bytes(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout)
    return path


@pytest.fixture(scope="module")
def own(smooth: Path, tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Path:
    """The same build_figure with its take called otherwise, so another animation: its edits no other module sees."""
    path = tmp_path_factory.mktemp("files") / "own.glb"
    called = request.module.__name__.rpartition("_")[2][:4].encode()
    path.write_bytes(smooth.read_bytes().replace(b'"take"', b'"%s"' % called, 1))
    return path


@pytest.fixture
def answer(node: Path, checkout: Path) -> Callable[[str], Any]:
    """Run a script that may import the page's modules; answers the JSON it prints."""
    viewer = checkout / "service" / "static" / "viewer"

    def run(script: str) -> Any:
        done = subprocess.run(
            [node, "--input-type=module", "--disable-warning=MODULE_TYPELESS_PACKAGE_JSON"],
            input=script.replace("VIEWER", viewer.as_uri()),
            text=True,
            capture_output=True,
            check=True,
        )
        return json.loads(done.stdout)

    return run
