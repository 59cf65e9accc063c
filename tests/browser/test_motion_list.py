"""The list by motion: several segments are chosen and edited at once, and many stay easy to go through."""

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, saved, seen_once

pytestmark = pytest.mark.timeout(240)

MANY = 240


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure, listed by motion."""
    opened(kept_page, own)
    kept_page.get_by_text("motion", exact=True).click()
    return kept_page


def names(page: Page) -> list[str]:
    """The names of all segments in the list."""
    return page.locator("#segments .segment .name").all_text_contents()


def test_motions_open_to_their_segments(result: Page) -> None:
    """Each says how often it comes and how long it is altogether, and has a picture; its arrow folds it."""
    heads = result.locator("#segments .motion")
    expect(heads).to_have_count(int((result.locator("#summary").inner_text()).split()[0]))
    expect(heads.first).to_contain_text(re.compile(r"A\s*×\u202f\d.*\d s"))
    assert names(result) == sorted(names(result))
    drawn = "(canvas) => new Uint32Array(canvas.getContext('2d').getImageData(0, 0, 96, 72).data.buffer).some(Boolean)"
    expect(result.locator("#figure")).to_have_attribute("data-shown", "gltf")
    assert seen_once(result, lambda: heads.first.locator("canvas").evaluate(drawn), bool)
    before = result.locator("#segments .segment:visible").count()
    result.locator("#segments .fold").first.click()
    assert result.locator("#segments .segment:visible").count() < before
    result.locator("#segments .fold").first.click()


def test_all_segments_of_a_motion_are_edited_at_once(result: Page) -> None:
    """Its row chooses them; name and loop go to every one, and one undo takes each back."""
    before = names(result)
    result.locator("#segments .motion").nth(1).click()
    expect(result.locator("#chosen-count")).to_have_text(re.compile(r"^\d segments$"))
    result.locator("#motion-name").fill("wave")
    result.locator("#motion-name").press("Enter")
    assert names(result) == ["wave" if name == "B" else name for name in before]
    result.locator("#segments .motion").nth(1).click()
    result.locator("#flag-loop").click()
    expect(result.locator("#segments .segment .marks", has_text="↻")).to_have_count(before.count("B"))
    saved(result)
    result.keyboard.press("Control+z")
    result.keyboard.press("Control+z")
    assert names(result) == before
    expect(result.locator("#segments .segment .marks", has_text="↻")).to_have_count(0)


def test_any_segments_are_chosen_by_hand_and_by_keys(result: Page) -> None:
    """With their boxes, with Ctrl and with Shift; a plain click goes to one and chooses no more."""
    rows = result.locator("#segments .segment")
    rows.first.click()
    expect(result.locator("#chosen-count")).to_have_text("")
    rows.nth(1).click(modifiers=["ControlOrMeta"])
    rows.nth(3).hover()
    result.locator("#segments .pick").nth(3).check()
    expect(result.locator("#chosen-count")).to_have_text("2 segments")
    result.locator("#flag-discard").click()
    expect(result.locator("#segments .discarded")).to_have_count(2)
    result.keyboard.press("Control+z")
    rows.first.click()
    rows.first.focus()
    result.keyboard.press("Shift+ArrowDown")
    expect(result.locator("#segments .chosen")).not_to_have_count(0)
    result.keyboard.press("Escape")
    expect(result.locator("#segments .chosen")).to_have_count(0)


def test_hundreds_of_segments_stay_workable(page: Page, own: Path) -> None:
    """Their motions are folded at first; opening one, choosing it and renaming it are quick."""
    opened(page, own)
    identifier = re.search(r"/view/(\w+)", page.url)
    assert identifier
    address = f"/v1/segmentations/{identifier[1]}"
    frames = page.request.get(address).json()["frames"]
    bounds = [frames * i // MANY for i in range(MANY + 1)]
    segments = [{"start": bounds[i], "end": bounds[i + 1], "motion": i % 8} for i in range(MANY)]
    kept = page.request.post(
        f"{address}/revisions",
        data=json.dumps({"segments": segments}),
        headers={"If-Match": "*", "Content-Type": "application/json"},
    )
    assert kept.status == 201
    page.evaluate("localStorage['caesura.list-by'] = JSON.stringify('motion')")
    page.goto(f"/view/{identifier[1]}")
    expect(page.locator("#segments .motion")).to_have_count(8)
    expect(page.locator("#segments .segment:visible")).to_have_count(0)
    page.locator("#segments .motion").nth(2).click()
    expect(page.locator("#chosen-count")).to_have_text("30 segments")
    took = page.evaluate(
        """() => {
            const name = document.getElementById('motion-name');
            name.value = 'third';
            const begun = performance.now();
            name.dispatchEvent(new Event('change'));
            return performance.now() - begun;
        }"""
    )
    assert took < 300
    expect(page.locator("#segments .motion").nth(2)).to_contain_text("third")
