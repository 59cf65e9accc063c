"""Leaving what is on screen: for another number of motions, another take, or while something is on its way."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, saved

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure."""
    opened(kept_page, own)
    return kept_page


def test_a_click_leaves_space_to_playing(result: Page) -> None:
    """Who has clicked a row or a button means by Space to play; who came by the Tab key means the button."""
    result.locator("#segments button").nth(1).click()
    result.keyboard.press("Space")
    expect(result.locator("#play")).to_have_attribute("aria-label", "Pause")
    result.keyboard.press("Space")
    expect(result.locator("#play")).to_have_attribute("aria-label", "Play")
    result.locator("#flag-loop").focus()
    result.keyboard.press("Tab")
    result.keyboard.press("Space")
    expect(result.locator("#flag-discard")).to_have_attribute("aria-pressed", "true")
    result.keyboard.press("Control+z")
    expect(result.locator("#play")).to_have_attribute("aria-label", "Play")


def test_a_service_that_is_away_is_waited_for(page: Page, own: Path) -> None:
    """A restart in the middle is survived while a person waits, and said where they download."""
    address = opened(page, own)
    page.route("**/v1/**", lambda route: route.abort())
    page.locator("#downloads summary").click()
    page.locator("[data-form=csv]").click()
    expect(page.locator("#downloads-note")).to_contain_text("does not answer")
    page.unroute("**/v1/**")
    with page.expect_download() as saving:
        page.locator("#downloads summary").click()
        page.locator("[data-form=csv]").click()
    assert saving.value.suggested_filename == f"{own.stem}.csv"
    page.goto("/")
    page.route("**/v1/**", lambda route: route.abort())
    page.evaluate(
        "(path) => { history.pushState(null, '', path); dispatchEvent(new PopStateEvent('popstate')) }", address
    )
    expect(page.locator("#waiting-note")).to_contain_text("The page tries again")
    page.unroute("**/v1/**")
    expect(page.locator("#curve canvas")).to_be_visible()


def test_another_cut_says_where_the_edits_are(result: Page) -> None:
    """Edits belong to the cut they were made in; going back shows them again."""
    result.locator("#flag-loop").click()
    saved(result)
    result.locator("#motions").fill("2")
    result.locator("#motions").press("Enter")
    expect(result.locator("#controls-note")).to_contain_text("now has 2 motions")
    expect(result.locator("#controls-note")).to_contain_text("Your edits belong to the result before")
    result.go_back()
    expect(result.locator("#flag-loop")).to_have_attribute("aria-pressed", "true")


def test_a_cut_that_is_refused_leaves_the_form_as_the_result_is(result: Page) -> None:
    """What is shown was not made with what could not be had."""
    result.route("**/v1/segmentations", lambda route: route.abort())
    result.locator("#advanced-open").click()
    result.locator("#method").select_option("spectral")
    expect(result.locator("#controls-note")).to_contain_text("does not answer")
    expect(result.locator("#method")).to_have_value("switching")
    result.unroute("**/v1/segmentations")


def test_edits_that_cannot_be_kept_are_not_left_by_mistake(result: Page) -> None:
    """Who does not want to leave stays, with the edits and the address they are of."""
    result.route("**/revisions", lambda route: route.abort() if route.request.method == "POST" else route.continue_())
    result.locator("#flag-discard").click()
    expect(result.locator("#kept-word")).to_contain_text("Not saved")
    address = result.url.split("#")[0]
    result.once("dialog", lambda dialog: dialog.dismiss())
    result.evaluate("history.pushState(null, '', '/'); dispatchEvent(new PopStateEvent('popstate'))")
    result.wait_for_url(f"{address}**")
    expect(result.locator("#flag-discard")).to_have_attribute("aria-pressed", "true")
    result.unroute("**/revisions")
    if result.locator("#kept").get_attribute("data-kind") == "failed":  # else the page has tried again by itself
        result.evaluate("document.querySelector('#kept-ways button')?.click()")
    saved(result)


def test_no_longer_waiting_for_a_finished_result_does_not_delete_it(page: Page, own: Path) -> None:
    """To cancel is for what runs; what is done and slow to arrive is left alone."""
    identifier = opened(page, own).partition("/view/")[2].partition("#")[0]
    page.route(re.compile(r"/result(\?|$)"), lambda route: None)  # an answer that does not come
    page.goto(f"/view/{identifier}")
    expect(page.locator("#waiting-name")).to_have_text(own.name)
    page.locator("#waiting-cancel").click()
    expect(page.locator("#drop")).to_be_visible()
    assert page.request.get(f"/v1/segmentations/{identifier}").json()["status"] == "done"


def test_a_figure_that_is_still_prepared_is_not_asked_for_by_who_has_left(page: Page, own: Path) -> None:
    """What is said on the stage is then said of another take."""
    identifier = opened(page, own).partition("/view/")[2].partition("#")[0]
    problem = {"code": "not-finished", "detail": "It is prepared.", "status": 409}
    page.route("**/viewer", lambda route: route.fulfill(status=409, json=problem))
    page.goto(f"/view/{identifier}")
    expect(page.locator("#stage-note")).to_have_text("The service still prepares the figure.")
    page.evaluate("history.pushState(null, '', '/'); dispatchEvent(new PopStateEvent('popstate'))")
    expect(page.locator("#drop")).to_be_visible()
    page.wait_for_timeout(2000)  # it would be asked for again after 1.5 s
    expect(page.locator("#stage-note")).to_have_text("The service still prepares the figure.")
