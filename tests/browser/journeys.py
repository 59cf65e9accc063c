"""Steps that several journeys through the page share."""

import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from playwright.sync_api import Page, expect

Seen = TypeVar("Seen")


def opened(page: Page, file: Path) -> str:
    """Choose a file on the first page and wait for its result; answers the address."""
    page.goto("/")
    page.locator("#drop input").set_input_files(file)
    expect(page.locator("#segments li").first).to_be_visible(timeout=90_000)
    expect(page.locator("#figure")).to_have_attribute("data-shown", re.compile("gltf|vertices"), timeout=30_000)
    return page.url


def seen_once(page: Page, look: Callable[[], Seen], is_right: Callable[[Seen], bool]) -> Seen:
    """What `look` sees as soon as it is right, which on a busy machine is late; after half a minute, what it sees."""
    until = time.monotonic() + 30
    while not is_right(seen := look()) and time.monotonic() < until:
        page.wait_for_timeout(100)
    return seen


def starts(page: Page) -> list[int]:
    """The first frame of every segment, as listed."""
    return [int(re.sub(r"\D", "", text)) for text in page.locator("#segments .from").all_text_contents()]


def saved(page: Page) -> None:
    """Wait until the service has kept what was done."""
    expect(page.locator("#kept-word")).to_have_text(re.compile(r"^Saved · revision \d+$"))


def cut_x(page: Page, frame: int) -> float:
    """Where a frame lies on the timeline while the whole take is shown, in pixels of the page."""
    x: float = page.evaluate(
        """(frame) => {
            const plot = document.querySelector('#curve .u-over').getBoundingClientRect();
            const frames = Number(document.querySelector('#timeline').getAttribute('aria-valuemax')) + 1;
            return plot.left + (frame / frames) * plot.width;
        }""",
        frame,
    )
    return x
