"""The first screen: what one gets is seen at once, and tried at a click."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import seen_once

pytestmark = pytest.mark.timeout(240)

HEAD = "parseFloat(document.getElementById('demo-head').style.left)"


def test_what_one_gets_moves_in_a_loop_and_stops_for_who_wants_no_motion(page: Page) -> None:
    """Within five seconds a figure moves, the playhead runs over the colours and the clip of the moment is marked."""
    page.goto("/")
    expect(page.locator("#demo-figure")).to_have_attribute("data-shown", "gltf", timeout=10_000)
    expect(page.locator("#demo-clips li")).to_have_text([re.compile(r"^\w+_0\d")] * 6)
    expect(page.locator("#demo-clips .now")).to_have_count(1)
    first = page.evaluate(HEAD)
    assert seen_once(page, lambda: page.evaluate(HEAD), lambda now: now > first) > first
    figure = page.locator("#demo-figure")
    before = figure.screenshot()
    assert seen_once(page, figure.screenshot, lambda now: now != before) != before
    page.get_by_role("button", name="Pause", exact=True).click()
    page.wait_for_timeout(200)
    rest = page.evaluate(HEAD)
    page.wait_for_timeout(300)
    assert page.evaluate(HEAD) == rest
    page.emulate_media(reduced_motion="reduce")
    page.reload()
    expect(page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    expect(page.locator("#demo-figure")).to_have_attribute("data-shown", "gltf", timeout=10_000)
    assert page.evaluate(HEAD) == pytest.approx(0, abs=1)


def test_a_sample_is_cut_at_a_click(page: Page) -> None:
    """Whoever has no file at hand sees a result all the same."""
    page.goto("/")
    expect(page.locator("#sample-cards li")).to_have_count(3)
    page.locator("#sample-cards button", has_text="A robot").click()
    expect(page.locator("#segments li").nth(2)).to_be_visible(timeout=90_000)
    expect(page.locator("#subject")).to_contain_text("robot.glb")
