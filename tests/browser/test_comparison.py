"""Comparing repeats: all segments of a motion at once, in one rhythm."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.drawn import FRAMES, bar_that_turns, body, picture
from tests.browser.journeys import opened, seen_once

pytestmark = pytest.mark.timeout(240)

RHYTHM = """
    import('VIEWER/timeline/comparison.js').then(({ inRhythm, repeatsOf, comparedPoses }) => {
        const part = (start, ...lengths) => {
            let at = start;
            const repeats = lengths.map((length) => ({ start: at, end: (at += length) }));
            return { start, end: at, repeats, motion: 0, name: 'A' };
        };
        const [even, slow, once] = [part(0, 10, 10, 10), part(100, 20, 20), part(200, 60)];
        const document = { segments: [even, { ...part(30, 20), motion: 1 }, slow, once], frames: 300, frame_rate: 30 };
        const shown = comparedPoses(document, 0, 15, 'beside', 1000);
        console.log(JSON.stringify({
            halves: [...[5, 15, 25].map((frame) => inRhythm(frame, even, slow)), inRhythm(15, even, once)],
            inside: inRhythm(29.999, even, slow) < 120 && inRhythm(19.999, even, slow) < 140,
            many: repeatsOf(document, 0).length, few: repeatsOf(document, 1).length,
            shown: shown.map(({ position, current }) => [position, current]),
            narrow: comparedPoses(document, 0, 15, 'beside', 200).length,
        }));
    });
"""


def test_repeats_are_shown_at_the_same_share_of_the_same_cycle(answer: Callable[[str], Any]) -> None:
    """One that has no cycles, at the same share of the whole; what does not fit is left out evenly."""
    found = answer(RHYTHM)
    assert found["halves"] == [110, 130, 110, 230]
    assert found["inside"]
    assert (found["many"], found["few"]) == (3, 1)
    assert found["shown"] == [[15, True], [130, False], [230, False]]
    assert found["narrow"] == 2


@pytest.fixture(scope="module")
def result(kept_page: Page, smooth: Path) -> Page:
    """The result of our own figure."""
    kept_page.set_viewport_size({"width": 1400, "height": 800})
    opened(kept_page, smooth)
    return kept_page


def columns(page: Page) -> int:
    """How many bodies stand beside each other in the picture."""
    across = body(picture(page, 480, 200)).any(0).astype(int)
    return int((np.diff(across, prepend=0) == 1).sum())


def test_the_segments_of_a_motion_stand_side_by_side(result: Page) -> None:
    """Each with its number and length, the current one marked; a motion that comes once shows its repetitions."""
    result.locator("#segments .segment").first.click()
    times = result.locator("#segments .segment .name", has_text=re.compile("^A$")).count()
    assert columns(result) == 1
    result.locator("#compare").select_option("beside")
    expect(result.locator("#pair p")).to_have_count(times)
    expect(result.locator("#pair .current")).to_contain_text(f"1 of {times}")
    assert seen_once(result, lambda: columns(result), lambda count: count == times) == times
    result.keyboard.press("Space")
    result.wait_for_timeout(1500)
    expect(result.locator("#pair p")).to_have_count(times)
    result.keyboard.press("Space")


def test_the_other_repeats_are_laid_over_where_the_current_one_stands(result: Page) -> None:
    """However far the figure has walked meanwhile: one body, with others seen through it."""
    result.locator("#compare").select_option("over")
    expect(result.locator("#pair")).to_be_hidden()
    assert columns(result) == 1
    laid_over = picture(result)
    result.locator("#compare").select_option("")
    alone = picture(result)
    assert (np.abs(laid_over - alone).max(axis=2) > 20).sum() > 50
    expect(result.locator("#loop")).not_to_be_checked()


def test_bodies_that_are_compared_face_the_same_way(page: Page) -> None:
    """A bar bends twice, the second time turned by a right angle and elsewhere: side by side it is the same picture."""
    page.set_viewport_size({"width": 1400, "height": 800})
    uploaded = page.request.post("/v1/animations?name=turns.npz", data=bar_that_turns()).json()
    asked = page.request.post("/v1/segmentations", data={"animation": uploaded["id"], "motions": 1}).json()
    address = f"/v1/segmentations/{asked['id']}"
    page.request.get(address, headers={"Prefer": "wait=60"})
    halves = [{"start": at, "end": at + FRAMES // 2, "motion": 0, "name": "bend"} for at in (0, FRAMES // 2)]
    saved = page.request.post(f"{address}/revisions", data={"segments": halves}, headers={"If-Match": '"0"'})
    assert saved.ok, saved.text()
    page.goto(f"/view/{asked['id']}#frame={FRAMES // 4}")
    expect(page.locator("#figure")).to_have_attribute("data-shown", "vertices")
    page.locator("#compare").select_option("beside")
    expect(page.locator("#pair p")).to_have_count(2)
    seen = body(picture(page, 480, 300))
    left, right = seen[:, :240], seen[:, 240:]
    assert left.sum() > 500
    assert (left != right).sum() < 0.05 * left.sum()
