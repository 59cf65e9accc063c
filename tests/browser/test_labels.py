"""Labels of other people as a second track, and links to look at or to edit."""

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, saved, seen_once, starts

pytestmark = pytest.mark.timeout(240)

DRAWN = """() => {
    const canvas = document.getElementById('labels');
    const { data } = canvas.getContext('2d').getImageData(60, 4, canvas.width - 100, 1);
    return new Set(new Uint32Array(data.buffer)).size;
}"""


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure, with the list of the review."""
    opened(kept_page, own)
    kept_page.locator("#tab-review").click()
    return kept_page


@pytest.mark.parametrize("form", ["csv", "eaf", "json"])
def test_labels_that_the_service_wrote_agree_wholly(result: Page, tmp_path: Path, form: str) -> None:
    """As CSV, EAF and JSON: every frame and every cut, shown as a track; closed, the track goes."""
    identifier = result.url.split("/view/")[1].split("#")[0]
    path = tmp_path / f"labels.{form}"
    path.write_bytes(result.request.get(f"/v1/segmentations/{identifier}/result.{form}").body())
    result.locator("#labels-open").set_input_files(path)
    cuts = len(starts(result)) - 1
    expect(result.locator("#labels-note")).to_contain_text(
        f"labels.{form}: 100 % of its frames agree. {cuts} of its {cuts} cuts"
    )
    expect(result.locator("#labels")).to_be_visible()
    assert seen_once(result, lambda: result.evaluate(DRAWN), lambda colours: colours >= 4) >= 4
    result.locator("#labels-close").click()
    expect(result.locator("#labels")).to_be_hidden()


def test_labels_that_differ_say_how_far(result: Page, tmp_path: Path) -> None:
    """One cut moved by a second and a motion called otherwise; other names are no difference."""
    names = result.locator("#segments .name").all_text_contents()
    bounds = [*starts(result), 1543]
    bounds[1] += 30
    rows = [{"start": bounds[i], "end": bounds[i + 1], "label": f"my {name}"} for i, name in enumerate(names)]
    path = tmp_path / "mine.json"
    path.write_text(json.dumps({"frame_rate": 30, "segments": rows}))
    result.locator("#labels-open").set_input_files(path)
    cuts = len(rows) - 1
    expect(result.locator("#labels-note")).to_contain_text(f"98 % of its frames agree. {cuts - 1} of its {cuts} cuts")


@pytest.mark.parametrize(
    ("text", "why"),
    [("nonsense", "needs a header"), ("{}", "no list of segments"), ("<eaf/>", "no annotations"), ("[]", "no labels")],
)
def test_files_without_labels_are_refused_in_a_sentence(result: Page, tmp_path: Path, text: str, why: str) -> None:
    """What is on screen stays."""
    path = tmp_path / "bad.txt"
    path.write_text(text)
    result.locator("#labels-open").set_input_files(path)
    expect(result.locator("#labels-note")).to_contain_text(why)


def test_a_link_to_look_at_shows_that_revision_and_changes_nothing(page: Page, own: Path) -> None:
    """Edits that come later are not in it; the way to edit leads to them."""
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    opened(page, own)
    page.locator("#motion-name").fill("stroll")
    page.locator("#motion-name").press("Enter")
    saved(page)
    links = {}
    for kind in ("look", "edit"):
        page.locator("#share summary").click()
        page.locator(f"[data-link={kind}]").click()
        expect(page.locator("#share summary")).to_have_text("Copied")
        links[kind] = page.evaluate("navigator.clipboard.readText()")
    assert re.search(r"/view/\w+\?revision=\d+&look=1#frame=0$", links["look"])
    assert "look" not in links["edit"]
    page.locator("#motion-name").fill("march")
    page.locator("#motion-name").press("Enter")
    saved(page)
    page.goto(links["look"])
    expect(page.locator("#look-note")).to_be_visible()
    names = page.locator("#segments .segment .name")
    expect(names.first).to_have_text("stroll")
    before = names.all_text_contents()
    for hidden in ("#controls", "#motion-name", "#flag-discard", "#split"):
        expect(page.locator(hidden)).to_be_hidden()
    for key in ("x", "o", "]", "ArrowRight", "m", "Delete"):
        page.keyboard.press(key)
    assert names.all_text_contents() == before
    page.reload()
    expect(page.locator("#look-note")).to_be_visible()
    page.locator("#look-edit").click()
    expect(names.first).to_have_text("march")
    expect(page.locator("#flag-discard")).to_be_visible()
