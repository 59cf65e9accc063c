"""The timeline: an overview, zooming to a segment, pictures, and tools that stand at what is selected."""

from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import cut_x, opened, seen_once, starts

pytestmark = pytest.mark.timeout(240)

TRACK = """() => {
    const canvas = document.getElementById('timeline');
    const { data } = canvas.getContext('2d').getImageData(0, 30, canvas.width, canvas.height - 40);
    return new Set(new Uint32Array(data.buffer)).size;
}"""


@pytest.fixture(scope="module")
def result(kept_page: Page, smooth: Path) -> Page:
    """The result of our own figure, wide enough for everything."""
    kept_page.set_viewport_size({"width": 1400, "height": 800})
    opened(kept_page, smooth)
    return kept_page


def frames_shown(page: Page) -> list[int]:
    """The first frame that is shown and the last, as the pointer tells there."""
    row = page.locator("#timeline").bounding_box()
    assert row is not None
    seen = []
    for x in (row["x"] + 50, row["x"] + row["width"] - 22):
        page.mouse.move(x, row["y"] + 30)
        seen.append(
            int(page.locator("#hover-text").inner_text().split("frame ")[1].split(" ·")[0].replace("\u202f", ""))
        )
    return seen


def first_shown(page: Page, is_right: Callable[[int], bool]) -> int:
    """The first frame that is shown, once it is right."""
    return seen_once(page, lambda: frames_shown(page)[0], is_right)


def test_a_double_click_shows_a_segment_alone_and_again_the_whole_take(result: Page) -> None:
    """So do a key and a button; the overview stays whole, and its window is dragged along."""
    before = starts(result)
    row = result.locator("#timeline").bounding_box()
    assert row is not None
    result.mouse.dblclick(cut_x(result, before[2] + 40), row["y"] + 40)
    first, last = seen_once(result, lambda: frames_shown(result), lambda seen: seen[0] > before[2] - 25)
    assert before[2] - 25 < first <= before[2]
    assert before[3] <= last < before[3] + 25
    overview = result.locator("#overview").bounding_box()
    assert overview is not None
    result.mouse.move(overview["x"] + overview["width"] * 0.8, overview["y"] + 8)
    result.mouse.down()
    result.mouse.up()
    assert first_shown(result, lambda first: first > before[4]) > before[4]
    result.keyboard.press("z")
    assert first_shown(result, lambda first: first < before[4]) < before[4]
    result.locator("#zoom-fit").click()
    assert first_shown(result, lambda first: first < 12) < 12


def test_segments_have_pictures(result: Page) -> None:
    """In the timeline, and in what the pointer shows; many more colours than those of the boxes."""
    assert seen_once(result, lambda: result.evaluate(TRACK), lambda colours: colours > 200) > 200
    row = result.locator("#timeline").bounding_box()
    assert row is not None
    picture = result.locator("#hover-picture canvas")
    places = cycle([cut_x(result, 60), cut_x(result, 64)])

    def pointed() -> bool:
        result.mouse.move(next(places), row["y"] + 10)
        result.wait_for_timeout(500)  # it is drawn where the pointer rests
        return picture.is_visible()

    assert seen_once(result, pointed, bool)


def test_the_tools_stand_under_what_is_selected_and_are_of_one_kind(result: Page) -> None:
    """A segment has those of segments, a cut those of cuts; nothing is greyed out that does not belong there."""
    middles = []
    for index in (1, 4):
        result.locator("#segments .segment").nth(index).click()
        expect(result.locator("#merge")).to_be_hidden()
        box = result.locator("#selection-tools").bounding_box()
        assert box is not None
        middles.append(box["x"] + box["width"] / 2)
    assert middles[1] > middles[0] + 40
    result.keyboard.press("]")
    expect(result.locator("#merge")).to_be_visible()
    expect(result.locator("#motion-name")).to_be_hidden()
    box = result.locator("#selection-tools").bounding_box()
    assert box is not None
    assert box["x"] < cut_x(result, int(result.locator("#cut-frame").input_value())) < box["x"] + box["width"]
    assert result.locator("#selection-tools button:disabled").count() == 0
    result.keyboard.press("Escape")


def test_the_curve_fills_its_height(result: Page) -> None:
    """Its axis is fitted to its values: the lowest and the highest are near the edges."""
    canvas = result.locator("#curve canvas")
    drawn = np.array(
        canvas.evaluate(
            """(canvas) => {
                const over = document.querySelector('#curve .u-over').getBoundingClientRect();
                const { width, height } = over;
                const context = canvas.getContext('2d');
                const left = over.left - canvas.getBoundingClientRect().left;
                const { data } = context.getImageData(left + 40, 0, width - 80, canvas.height - 24);
                const rows = [];
                for (let i = 0; i < data.length; i += 4) {
                    const dark = data[i] + data[i + 1] + data[i + 2] < 150 && data[i + 3] > 200;
                    if (dark) rows.push(Math.floor(i / 4 / Math.floor(width - 80)));
                }
                return [Math.min(...rows), Math.max(...rows), height];
            }"""
        )
    )
    low, high, height = drawn
    assert high - low > 0.55 * height


def key_frames(page: Page) -> list[int]:
    """The key-frames of the result on screen."""
    identifier = page.url.split("/view/")[1].split("#")[0]
    document = page.request.get(f"/v1/segmentations/{identifier}/result", headers={"Accept": "application/json"}).json()
    return [key["frame"] for key in document["key_frames"]]


def test_key_frames_are_hovered_and_jumped_to(result: Page) -> None:
    """A key-frame says what it is and shows its pose; a press goes to it, and keys go from one to the next."""
    keys = key_frames(result)
    result.locator("#zoom-fit").click()
    row = result.locator("#timeline").bounding_box()
    assert row is not None
    result.mouse.move(cut_x(result, keys[0]) + 2, row["y"] + 30)
    expect(result.locator("#hover-text")).to_contain_text("key-frame of A")
    expect(result.locator("#hover-picture canvas")).to_be_visible()
    result.mouse.down()
    result.mouse.up()
    expect(result.locator("#frame")).to_have_value(str(keys[0]))
    result.keyboard.press("k")
    result.keyboard.press("k")
    expect(result.locator("#frame")).to_have_value(str(keys[2]))
    result.keyboard.press("j")
    expect(result.locator("#frame")).to_have_value(str(keys[1]))


def test_a_cut_dragged_with_ctrl_snaps_to_a_key_frame(result: Page) -> None:
    """A few pixels beside the key-frame are enough; without Ctrl the cut stays where it is let go."""
    keys = key_frames(result)
    cuts = starts(result)[1:]
    cut, key = min(((cut, key) for cut in cuts for key in keys if cut + 30 < key), key=lambda pair: pair[1] - pair[0])
    row = result.locator("#timeline").bounding_box()
    assert row is not None
    y = row["y"] + 40
    for modified, expected in ((False, False), (True, True)):
        if modified:
            result.keyboard.down("Control")
        result.mouse.move(cut_x(result, cut), y)
        result.mouse.down()
        result.mouse.move(cut_x(result, key) + 7, y, steps=6)
        result.mouse.up()
        result.keyboard.up("Control")
        assert (int(result.locator("#cut-frame").input_value()) == key) == expected
        result.keyboard.press("Control+z")
        result.keyboard.press("Escape")
