"""The review: cuts that are least certain, frames at which one may be missing; key-frames are listed."""

import json
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.journeys import opened, starts
from tests.browser.test_export_panel import downloaded, take_names

pytestmark = pytest.mark.timeout(240)


def with_candidate(page: Page, file: Path) -> int:
    """Open a file whose result says that a cut is missing; answers where."""
    places: list[int] = []

    def answer(route: Route) -> None:
        reply = route.fetch()
        document = json.loads(reply.text())
        first = document["segments"][0]
        places.append((first["start"] + first["end"]) // 2)
        document["candidates"] = [{"frame": places[0], "seconds": places[0] / 30, "likelihood": 0.97}]
        route.fulfill(response=reply, json=document)

    page.route("**/result", answer)
    opened(page, file)
    return places[0]


def test_the_review_offers_missing_cuts_and_makes_them(page: Page, own: Path) -> None:
    """The likeliest comes first; it can be dismissed and made, and is gone where there is a cut."""
    missing = with_candidate(page, own)
    before = starts(page)
    expect(page.locator("#doubts")).to_have_text("1")
    page.keyboard.press("n")
    expect(page.locator("#frame")).to_have_value(str(missing))
    row = page.locator("#cuts [aria-current]")
    expect(row).to_contain_text("cut missing in A?")
    expect(row).to_contain_text("97 %")
    page.keyboard.press("c")
    expect(page.locator("#doubts")).to_be_hidden()
    page.locator("#cuts button", has_text="missing").click()
    page.keyboard.press("c")
    expect(page.locator("#doubts")).to_have_text("1")
    page.locator("#cuts button", has_text="missing").click()
    page.locator("#cut-here").click()
    expect(page.locator("#cuts button", has_text="missing")).to_have_count(0)
    page.locator("#tab-segments").click()
    assert starts(page) == sorted([*before, missing])


def test_key_frames_are_listed_with_their_poses_and_saved(page: Page, own: Path, tmp_path: Path) -> None:
    """A press goes to one; the file has one animation that steps through them."""
    opened(page, own)
    page.locator("#tab-poses").click()
    rows = page.locator("#poses .pose")
    expect(rows.nth(2).locator("canvas")).to_be_visible()
    frame = int(rows.nth(2).locator(".from").inner_text())
    rows.nth(2).click()
    expect(page.locator("#frame")).to_have_value(str(frame))
    expect(rows.nth(2)).to_have_attribute("aria-current", "true")
    page.keyboard.press("k")
    expect(rows.nth(3)).to_have_attribute("aria-current", "true")
    saved = downloaded(page, "#save-poses", tmp_path)
    assert take_names(saved.read_bytes()) == ["key_frames"]


def test_the_method_and_its_settings_are_under_advanced(page: Page, own: Path) -> None:
    """Each with what it is for; what is set otherwise is asked for, and what cannot be is refused in words."""
    opened(page, own)
    expect(page.locator("#method")).to_be_hidden()
    page.locator("#advanced-open").click()
    expect(page.locator("#method-purpose")).to_contain_text("K motions")
    window = page.get_by_label("keyframe window, seconds")
    expect(window).to_have_value("2")
    expect(page.locator("#setting-keyframe_window_seconds-purpose")).to_contain_text("key-frame is the largest")
    page.locator("#tab-poses").click()
    few = page.locator("#poses .pose").count()
    window.fill("0.5")
    page.locator("#apply-settings").click()
    expect(page.locator("#controls-note")).to_contain_text("The take now has")
    page.locator("#tab-poses").click()
    expect.soft(window).to_have_value("0.5")
    assert page.locator("#poses .pose").count() > few
    window.fill("many")
    page.locator("#apply-settings").click()
    expect(page.locator("#controls-note")).to_contain_text("keyframe_window_seconds")


def test_what_the_papers_method_saw_is_shown_where_it_was_asked_for(page: Page, own: Path) -> None:
    """The curve of Eq. 5 between neighbouring motions, whose lowest points are cuts, and the mean strains of Eq. 4."""
    opened(page, own)
    page.locator("#advanced-open").click()
    expect(page.locator("#details")).to_be_hidden()
    page.locator("#method").select_option("joint-entropy")
    expect(page.locator("#controls-note")).to_contain_text("The take now has")
    page.locator("#setting-details").check()
    page.locator("#apply-settings").click()
    expect(page.locator("#variances")).to_be_visible()
    identifier = page.url.split("/view/")[1].split("#")[0]
    found = page.request.get(f"/v1/segmentations/{identifier}/result.json").json()
    expect(page.locator("#variances .line")).to_have_count(len(found["variances"]))
    page.locator("#variances rect").last.click()
    expect(page.locator("#frame")).to_have_value(str(found["variances"][-1]["boundary"]))
    shown = [float(text) for text in page.locator("#clusters .long").all_text_contents()]
    assert shown == [round(cluster["mean_strain"], 3) for cluster in found["clusters"]]
    assert len(shown) > 1
