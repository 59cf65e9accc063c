"""The pictures of the page in docs/: `python -m benchmarks.pictures` takes them anew, of a service of its own."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import Browser, FilePayload, Page, expect, sync_playwright

from benchmarks.session import SOFTWARE_WEBGL
from benchmarks.timing.processes import service
from caesura.client.client import Client
from caesura.samples.long_session import long_session
from caesura.samples.sample_figures import build_figure

DOCS = Path(__file__).resolve().parent.parent / "docs"
FLAGS = [*SOFTWARE_WEBGL, "--disable-lcd-text", "--force-color-profile=srgb", "--hide-scrollbars"]
SESSION = 5400  # frames
WIDE, PHONE = (1280, 800), (390, 844)
PATIENCE_MS = 90_000


def main() -> None:
    """Take all pictures."""
    with service() as running, Client(running.url) as client, sync_playwright() as playwright:
        short = client.segment(build_figure("smooth").glb, name="performance.glb").id
        long = client.segment(long_session(SESSION).glb, name="session.glb").id
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        picture = _Pictures(browser, running.url)
        picture("start", "/", _begun)
        picture("result", f"/view/{short}#frame=300", _drawn)
        picture("editing", f"/view/{short}", _edited, dark=True)
        picture("compare", f"/view/{short}#frame=630", _compared)
        picture("loops", f"/view/{short}#frame=300", _looped, dark=True)
        picture("review", f"/view/{long}", _reviewed)
        picture("error", "/", _refused)
        picture("phone", f"/view/{short}#frame=990", _drawn, size=PHONE, dark=True)
        browser.close()


class _Pictures:
    """Opens a page of its own for each picture, brings it to its state, and keeps what is seen."""

    def __init__(self, browser: Browser, url: str) -> None:
        self._browser = browser
        self._url = url

    def __call__(
        self, name: str, path: str, act: Callable[[Page], None], *, size: tuple[int, int] = WIDE, dark: bool = False
    ) -> None:
        page = self._browser.new_page(
            viewport={"width": size[0], "height": size[1]},
            color_scheme="dark" if dark else "light",
            has_touch=size == PHONE,
            is_mobile=size == PHONE,
        )
        page.set_default_timeout(PATIENCE_MS)
        page.goto(self._url + path)
        act(page)
        page.wait_for_timeout(600)  # until the last frame is drawn
        page.screenshot(path=DOCS / "pictures" / f"page-{name}.png")
        page.close()
        print(f"docs/page-{name}.png")


def _shown(page: Page) -> None:
    expect(page.locator("#figure")).to_have_attribute("data-shown", re.compile("."), timeout=PATIENCE_MS)


def _drawn(page: Page) -> None:
    """With the pictures of the motions, which come when nobody waits for anything."""
    _shown(page)
    page.wait_for_timeout(4000)


def _begun(page: Page) -> None:
    """The first screen, its figure in the middle of a motion."""
    page.wait_for_timeout(5000)


def _compared(page: Page) -> None:
    _drawn(page)
    page.locator("#compare").select_option("beside")


def _looped(page: Page) -> None:
    """The export panel with the best loops."""
    _shown(page)
    page.locator("#export-open").click()
    page.locator("[name=loop]").select_option("auto")
    expect(page.locator("#export-names .match").first).to_be_visible()


def _edited(page: Page) -> None:
    """A motion named, one that loops, one discarded, and a cut that is being moved."""
    _shown(page)
    rows = page.locator("#segments .segment")
    page.locator("[name=list-by][value=time]").check(force=True)
    for index, name in enumerate(["walk", "wave", "squat"]):
        rows.nth(index).click()
        page.locator("#motion-name").fill(name)
        page.locator("#motion-name").press("Enter")
    rows.nth(0).click()
    page.locator("#flag-loop").click()
    rows.nth(4).click()
    page.locator("#flag-discard").click()
    page.locator("[name=list-by][value=motion]").check(force=True)
    rows.nth(1).click()
    page.keyboard.press("Escape")
    page.keyboard.press("]")
    for _ in range(8):
        page.locator("#nudge-on").click()
    expect(page.locator("#kept-word")).to_contain_text("Saved")


def _reviewed(page: Page) -> None:
    """The least certain cut, near by."""
    _drawn(page)
    page.keyboard.press("n")
    expect(page.locator("#pair")).to_be_visible()


def _refused(page: Page) -> None:
    """A web page that was saved under the name of a model."""
    saved = b"<!doctype html><title>Not found</title>"
    page.locator("#drop input").set_input_files(FilePayload(name="character.glb", mimeType="", buffer=saved))
    expect(page.locator("#refused-detail")).to_be_visible()


if __name__ == "__main__":
    main()
