"""The page on a phone, on a tablet and in forced colours: nothing sticks out, and what is chosen is seen."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.journeys import opened, seen_once

pytestmark = pytest.mark.timeout(240)

LONG = "walk forward with a heavy limp and turn"
STICKING_OUT = """() => [...document.querySelectorAll('header *, #stage *, #deck *, #side *')]
    .filter((one) => one.getClientRects().length && !one.closest('.unseen, #hover, svg'))
    .filter((one) => {
        const { left, right } = one.getBoundingClientRect();
        const around = one.closest('header, #stage, #deck, #side').getBoundingClientRect();
        return left < around.left - 1 || right > around.right + 1;
    }).map((one) => `${one.localName} ${one.id || one.className || one.parentElement.id}`)"""


SMALL_TARGETS = """() => [...document.querySelectorAll('button, select, a.button, label.chip, #looks span, summary')]
    .filter((one) => one.getClientRects().length && one.getBoundingClientRect().height < 39.5)
    .map((one) => `${one.id || one.className || one.textContent} ${one.getBoundingClientRect().height}`)"""


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure, with a motion of a long name."""
    opened(kept_page, own)
    kept_page.locator("#motion-name").fill(LONG)
    kept_page.locator("#motion-name").press("Enter")
    return kept_page


@pytest.mark.parametrize("width", [360, 400, 820, 1280])
def test_nothing_sticks_out_of_its_part_of_the_page(result: Page, width: int) -> None:
    """With names as long as they get, while a moment is shown and while a cut is."""
    result.set_viewport_size({"width": width, "height": 800})
    for key in ("Escape", "]"):
        result.keyboard.press(key)
        result.wait_for_timeout(200)
        assert seen_once(result, lambda: result.evaluate(STICKING_OUT), lambda found: not found) == []
        assert result.evaluate("document.documentElement.scrollWidth") <= width
    expect(result.locator("#merge")).to_be_in_viewport()


@pytest.mark.parametrize("width", [1120, 1200, 1280])
def test_the_motion_of_the_moment_is_not_under_the_zoom(result: Page, width: int) -> None:
    """Beside the player's buttons where there is room, else on a row of its own."""
    result.set_viewport_size({"width": width, "height": 800})
    motion, zoom = (result.locator(one).bounding_box() for one in ("#now-motion", ".zoom"))
    assert motion is not None
    assert zoom is not None
    assert motion["x"] + motion["width"] <= zoom["x"] or motion["y"] >= zoom["y"] + zoom["height"]


@pytest.mark.parametrize("width", [1000, 1280, 1440])
def test_nothing_of_the_deck_and_the_list_lies_on_another_thing(result: Page, width: int) -> None:
    """The tools of any segment leave undo and redo free, the tabs end before the edge, the axis is named beside it."""
    result.set_viewport_size({"width": width, "height": 800})
    result.keyboard.press("Escape")

    def box(selector: str) -> dict[str, float]:
        found = result.locator(selector).bounding_box()
        assert found is not None, selector
        return {**found, "right": found["x"] + found["width"], "bottom": found["y"] + found["height"]}

    for key in ("Home", "End", ",", ","):
        result.keyboard.press(key)
        tools, kept = box("#selection-tools"), box("#kept-tools")
        assert tools["right"] <= kept["x"] or tools["bottom"] <= kept["y"], key
    assert box("#tab-history")["right"] <= box("#side")["right"] - 8
    assert box(".axis")["right"] <= box("#curve .u-over")["x"]


def test_a_cut_is_chosen_moved_and_merged_with_a_thumb(result: Page) -> None:
    """On a phone the tools of the cut take the place of the segment's, and go with it."""
    result.set_viewport_size({"width": 360, "height": 740})
    result.keyboard.press("Escape")
    expect(result.locator("#merge")).to_be_hidden()
    result.locator("#cut-after").click()
    expect(result.locator("#motion-name")).to_be_hidden()
    frame = int(result.locator("#cut-frame").input_value())
    result.locator("#nudge-on").click()
    expect(result.locator("#cut-frame")).to_have_value(str(frame + 1))
    segments = result.locator("#segments li").count()
    result.locator("#merge").click()
    expect(result.locator("#segments li")).to_have_count(segments - 1)
    expect(result.locator("#motion-name")).to_be_visible()
    result.locator("#undo").click()
    expect(result.locator("#segments li")).to_have_count(segments)


def test_a_finger_finds_everything_on_a_phone(result: Page, browser: Browser, address: str) -> None:
    """Upright the facts are whole and every target is 40 pixels high; on its side the timeline is in view."""
    context = browser.new_context(
        base_url=address, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    page = context.new_page()
    page.goto(result.url)
    expect(page.locator("#segments li").first).to_be_visible(timeout=30_000)
    assert page.evaluate("(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(subject)")
    assert page.evaluate(SMALL_TARGETS) == []
    page.set_viewport_size({"width": 844, "height": 390})
    expect(page.locator("#timeline")).to_be_in_viewport(ratio=1)
    assert page.evaluate("document.documentElement.scrollWidth") <= 844
    context.close()


def test_a_phone_shows_one_face_at_a_time(page: Page) -> None:
    """The first page and a refusal have nothing of the player below them."""
    page.set_viewport_size({"width": 360, "height": 740})
    for address, shown in (("/", "#drop"), ("/view/aaaaaaaaaaaaaaaaaaaaaaaaaa", "#refused-detail")):
        page.goto(address)
        expect(page.locator(shown)).to_be_visible()
        expect(page.locator("#deck")).to_be_hidden()


def test_what_is_chosen_is_seen_in_forced_colours(result: Page) -> None:
    """Where the system sets all colours, the row that plays, the tab and the playhead still stand out."""
    result.set_viewport_size({"width": 1100, "height": 720})
    result.keyboard.press("Escape")
    result.emulate_media(forced_colors="active")
    background = "(selector) => getComputedStyle(document.querySelector(selector)).backgroundColor"
    for chosen, other in (
        ("#segments [aria-current]", "#segments button:not([aria-current])"),
        ("#tab-segments", "#tab-review"),
        ("#looks :checked + span", "#looks :not(:checked) + span"),
        ("#playhead", "#deck"),
        ("#segments .swatch", "#side"),
    ):
        assert result.evaluate(background, chosen) != result.evaluate(background, other), chosen
    result.emulate_media(forced_colors="none")
