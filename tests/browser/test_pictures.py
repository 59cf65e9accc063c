"""Pictures of motions are drawn once, and kept with the result."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.journeys import opened, seen_once

pytestmark = pytest.mark.timeout(240)

DRAWN = """() => [...document.querySelectorAll('#segments canvas')].every((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.some(Boolean);
})"""


def test_pictures_are_there_before_the_figure_and_on_the_card(
    page: Page, browser: Browser, address: str, own: Path, tmp_path: Path
) -> None:
    """The second time nothing is drawn for them, not even a figure is needed; deleted, they are gone."""
    file = tmp_path / "pictured.glb"
    file.write_bytes(own.read_bytes())
    with page.expect_response(lambda answer: answer.request.method == "PUT", timeout=90_000) as kept:
        opened(page, file)
    assert kept.value.status == 204
    identifier = page.url.split("/view/")[1].split("#")[0]
    context = browser.new_context(viewport={"width": 1100, "height": 720}, base_url=address)
    again = context.new_page()
    again.route("**/viewer/model", lambda route: route.abort())
    again.goto(f"/view/{identifier}")
    expect(again.locator("#stage-note")).to_contain_text("cannot show the figure")
    assert seen_once(again, lambda: again.evaluate(DRAWN), bool)
    assert again.locator("#segments canvas").count() > 4
    again.goto("/")
    card = again.locator("#recent-cards .card", has_text="pictured.glb")
    expect(card.locator(".poster")).to_be_visible()
    assert card.locator(".poster").evaluate("(picture) => [picture.naturalWidth, picture.naturalHeight]") == [96, 72]
    pictures = f"/v1/segmentations/{identifier}/pictures"
    assert again.request.get(pictures).json()["width"] == 96
    again.on("dialog", lambda dialog: dialog.accept())
    card.locator(".more summary").click()
    card.get_by_role("button", name="Delete").click()
    expect(card).to_have_count(0)
    assert again.request.get(pictures).status == 404
    context.close()
