"""Correcting a result: cuts, names and marks, all kept by the service as revisions."""

import io
import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from tests.browser.journeys import cut_x, opened, saved, starts

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def result(kept_page: Page, smooth: Path) -> Page:
    """The result of our own figure; every test leaves it as computed, with nothing open."""
    opened(kept_page, smooth)
    return kept_page


@pytest.fixture(autouse=True)
def computed(result: Page) -> None:
    """Every test begins with the computed result on screen."""
    result.locator("#tab-history").click()
    result.locator("#revisions button", has_text="Computed result").click()
    expect(result.locator("#kept-word")).to_have_text("As computed")
    result.locator("#tab-segments").click()


def test_a_cut_is_dragged_and_still_there_after_a_reload(result: Page) -> None:
    """The handle of a cut goes where the pointer does; what was kept is what opens next time."""
    before = starts(result)
    box = result.locator("#timeline").bounding_box()
    assert box is not None
    x, y = cut_x(result, before[2]), box["y"] + box["height"] / 2
    result.mouse.move(x, y)
    result.mouse.down()
    result.mouse.move(x + 30, y, steps=4)
    expect(result.locator("#pair")).to_be_visible()
    result.mouse.up()
    moved = starts(result)
    assert moved[2] > before[2] + 10
    assert moved[:2] + moved[3:] == before[:2] + before[3:]
    saved(result)
    result.reload()
    expect(result.locator("#segments li").first).to_be_visible()
    assert starts(result) == moved


def test_a_press_beside_a_cut_moves_it_only_once_it_is_dragged(result: Page) -> None:
    """A hand that shakes by a pixel changes nothing; a drag keeps its distance, leaves no sliver; Escape ends it."""
    before = starts(result)
    box = result.locator("#timeline").bounding_box()
    assert box is not None
    x, y = cut_x(result, before[2]), box["y"] + box["height"] / 2
    frames_per_pixel = 100 / (cut_x(result, 100) - cut_x(result, 0))
    result.mouse.move(x + 4, y)
    result.mouse.down()
    result.mouse.move(x + 5, y)
    result.mouse.up()
    expect(result.locator("#cut-frame")).to_have_value(str(before[2]))
    assert starts(result) == before
    expect(result.locator("#kept-word")).to_have_text("As computed")
    result.mouse.move(x + 4, y)
    result.mouse.down()
    result.mouse.move(x + 4 + 23, y, steps=4)
    assert starts(result)[2] == pytest.approx(before[2] + 20 * frames_per_pixel, abs=1)
    result.keyboard.press("Escape")
    assert starts(result) == before
    result.mouse.move(x + 60, y)
    result.mouse.up()
    assert starts(result) == before
    result.mouse.move(x, y)
    result.mouse.down()
    result.mouse.move(x + 700, y, steps=4)
    result.mouse.up()
    assert starts(result)[2] == before[3] - 3
    saved(result)


def test_a_cut_is_nudged_and_undone_by_keys_alone(result: Page) -> None:
    """Select, three frames on, undo as one step, redo; both poses are named with their frames."""
    before = starts(result)
    result.locator("#timeline").focus()
    result.keyboard.press("Home")
    result.keyboard.press("]")
    for _ in range(3):
        result.keyboard.press("ArrowRight")
    expect(result.locator("#cut-frame")).to_have_value(str(before[1] + 3))
    expect(result.locator("#pair p").nth(1)).to_contain_text(f"{before[1] + 3}")
    result.keyboard.press("Control+z")
    assert starts(result) == before
    result.keyboard.press("Control+Shift+z")
    assert starts(result)[1] == before[1] + 3
    result.keyboard.press("Escape")
    expect(result.locator("#pair")).to_be_hidden()
    saved(result)


def test_repetitions_stay_marked_while_a_cut_moves(result: Page) -> None:
    """Those that begin before the cut are there at once, and after the service has saved it."""
    row = result.locator("#timeline").bounding_box()
    before = starts(result)
    assert row is not None

    def repetition() -> str:
        result.mouse.move(cut_x(result, before[2] + 20), row["y"] + 10)
        return result.locator("#hover").inner_text()

    assert re.search(r", 1 of \d", repetition())
    result.locator("#timeline").focus()
    for key in ("Home", "]", "]", "ArrowRight", "ArrowRight"):
        result.keyboard.press(key)
    assert re.search(r", 1 of \d", repetition())
    saved(result)
    assert re.search(r", 1 of \d", repetition())


def test_segments_are_split_and_merged(result: Page) -> None:
    """A split is one more segment of the same motion; merging over its cut is as before."""
    before = starts(result)
    middle = (before[1] + before[2]) // 2
    result.locator("#frame").fill(str(middle))
    result.locator("#frame").press("Enter")
    result.keyboard.press("s")
    assert starts(result) == sorted([*before, middle])
    result.keyboard.press("m")
    assert starts(result) == before


def test_an_edit_that_cannot_be_kept_says_so_and_is_tried_again(result: Page) -> None:
    """While the service does not answer nothing is called saved, and nothing is lost; once it answers, it is saved."""
    result.route("**/revisions", lambda route: route.abort() if route.request.method == "POST" else route.continue_())
    result.locator("#flag-loop").click()
    expect(result.locator("#kept-word")).to_contain_text("Not saved. The service does not answer")
    expect(result.locator("#kept-word")).to_contain_text("The page tries again")
    result.unroute("**/revisions")
    saved(result)
    expect(result.locator("#flag-loop")).to_have_attribute("aria-pressed", "true")


def test_somebody_elses_edit_is_offered_and_not_written_over(result: Page) -> None:
    """Of two who edit at once the second is told, and may load the other's or insist."""
    identifier = re.search(r"/view/(\w+)", result.url)
    assert identifier
    address = f"/v1/segmentations/{identifier[1]}"
    theirs = result.request.get(f"{address}/result").json()["segments"]
    kept = {"start", "end", "motion", "name"}
    body = [{key: value for key, value in one.items() if key in kept} for one in theirs]
    for one in body:
        one["name"] = one["name"].replace("A", "theirs")
    answer = result.request.post(f"{address}/revisions", data={"segments": body}, headers={"If-Match": "*"})
    assert answer.status == 201
    result.locator("#flag-discard").click()
    expect(result.locator("#kept-word")).to_contain_text("somebody else")
    result.get_by_role("button", name="Load theirs").click()
    expect(result.locator("#segments .name").first).to_have_text("theirs")
    expect(result.locator("#kept-word")).to_contain_text("Saved")


def test_a_motion_is_renamed_and_its_clips_carry_the_name(result: Page, tmp_path: Path) -> None:
    """What an engine gets are the names that a person gave, loops marked and what was discarded left out."""
    segments = len(starts(result))
    result.locator("#frame").fill("0")
    result.locator("#frame").press("Enter")
    result.keyboard.press("r")
    result.keyboard.type("walk")
    result.keyboard.press("Enter")
    expect(result.locator("#segments .name").first).to_have_text("walk")
    result.keyboard.press("o")
    result.locator("#segments button").nth(1).click()
    result.locator("#flag-discard").click()
    with result.expect_download(timeout=60_000) as saving:
        result.locator("#clips").click()
    file = tmp_path / "clips.glb"
    saving.value.save_as(file)
    names = [take.name or "" for take in read_header(io.BytesIO(file.read_bytes()), file.name, Limits()).takes]
    assert len(names) == segments - 1
    assert "walk_01-loop" in names
    assert "walk_02" in names
    assert "B_01" in names


def test_every_form_is_of_the_revision_that_is_shown(result: Page) -> None:
    """Links name the revision; the computed result's name none."""
    links = result.locator("#downloads a")
    assert not any("revision" in (link.get_attribute("href") or "") for link in links.all())
    result.locator("#flag-loop").click()
    saved(result)
    hrefs = [link.get_attribute("href") or "" for link in links.all()]
    assert len(hrefs) >= 9
    assert all(re.search(r"\?revision=\d+$", href) for href in hrefs)
    result.locator("#downloads summary").click()
    with result.expect_download() as saving:
        result.locator("[data-form=json]").click()
    assert saving.value.suggested_filename == "smooth.json"
    expect(result.locator("[data-form=json]")).to_be_hidden()
