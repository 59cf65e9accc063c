"""Edits are found again: from the first page, from another number of motions, from the history."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, saved

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure, of which a motion is called otherwise."""
    opened(kept_page, own)
    kept_page.locator("#motion-name").fill("stroll")
    kept_page.locator("#motion-name").press("Enter")
    saved(kept_page)
    return kept_page


def test_back_at_the_number_of_motions_the_edits_are_offered(result: Page) -> None:
    """One more and one fewer is another result of as many motions; it says that the first is edited, and opens it."""
    edited = result.url.split("#")[0]
    for step in ("#more", "#fewer"):
        result.locator(step).click()
        expect(result.locator("#controls-note")).to_contain_text("now has")
    expect(result.locator("#controls-note")).to_contain_text("You have edited this take with")
    expect(result.locator("#segments .name").first).to_have_text("A")
    result.locator("#tab-history").click()
    expect(result.locator("#edited-list li")).to_have_count(1)
    result.locator("#tab-segments").click()
    result.get_by_role("button", name="Show the edits").click()
    expect(result.locator("#segments .name").first).to_have_text("stroll")
    assert result.url.split("#")[0] == edited


def test_recent_animations_open_as_they_were_edited(result: Page, own: Path) -> None:
    """Though a newer result of the same animation is not edited. The card says so, and is found by its name."""
    result.goto("/")
    result.locator("#recent-search").fill("NO SUCH THING")
    expect(result.locator("#recent-none")).to_have_text("No animation is called “NO SUCH THING”.")
    result.locator("#recent-search").fill(own.name.upper())
    result.locator("#recent").scroll_into_view_if_needed()
    card = result.locator("#recent .card", has=result.locator("[aria-label*=stroll]"))
    expect(card).to_have_count(1)
    expect(card.locator(".edited")).to_be_visible()
    card.locator(".animation").click()
    expect(result.locator("#segments .name").first).to_have_text("stroll")


def test_a_card_is_renamed_and_deleted(page: Page, tmp_path: Path, smooth: Path) -> None:
    """The new name stays after a reload; what is deleted is gone, and was asked about before."""
    file = tmp_path / "passing.glb"
    file.write_bytes(smooth.read_bytes().replace(b'"take"', b'"gone"', 1))
    page.goto("/")
    posted = page.request.post("/v1/animations?name=passing.glb", data=file.read_bytes())
    assert posted.status == 201
    page.reload()
    card = page.locator("#recent .card", has_text="passing.glb")
    card.locator("summary").click()
    card.get_by_role("button", name="Rename").click()
    page.get_by_label("Name", exact=True).fill("kept.glb")
    page.get_by_role("button", name="Rename", exact=True).click()
    renamed = page.locator("#recent .card", has_text="kept.glb")
    expect(renamed).to_have_count(1)
    page.reload()
    renamed.locator("summary").click()
    page.once("dialog", lambda dialog: dialog.accept())
    renamed.get_by_role("button", name="Delete").click()
    expect(renamed).to_have_count(0)
    assert page.request.get(f"/v1/animations/{posted.json()['id']}").status == 404
