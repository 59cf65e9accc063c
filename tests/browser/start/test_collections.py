"""Many takes in the same motions: dropped at once, named once, corrected, searched, seen side by side."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.animations import performing_bar
from tests.browser.conftest import tab
from tests.browser.test_accessibility import axe, faults

__all__ = ["axe"]

pytestmark = pytest.mark.timeout(300)

LONG = 120_000
GOOD, BAD = 6, 2
ORDERS = ((0, 1, 0, 1), (1, 0, 1, 0))


def performance(path: Path, order: Sequence[int], shift: float) -> Path:
    """A bar that performs motions, three seconds each, somewhere else each time."""
    animation = performing_bar(order, seconds=3.0, rings=8).animation
    vertices = np.array(animation.vertices(0, animation.frames)) + np.float32([shift, 0, 0])
    np.savez(path, vertices=vertices, triangles=animation.triangles, frame_rate=np.float64(30))
    return path


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Takes of one bar, and two files that are none."""
    folder = tmp_path_factory.mktemp("night")
    good = [performance(folder / f"take_{i + 1:02}.npz", ORDERS[i % 2], 40 + i) for i in range(GOOD)]
    notes, cut_off = folder / "notes.glb", folder / "broken.npz"
    notes.write_text("not a model")
    cut_off.write_bytes(good[0].read_bytes()[:3000])
    return [*good[:3], notes, *good[3:], cut_off]


@pytest.fixture(scope="module")
def batch(kept_page: Page, files: list[Path]) -> Page:
    """All of them dropped at once, and ready."""
    kept_page.goto("/")
    kept_page.locator("#drop input").set_input_files(files)
    expect(kept_page.locator("#batch-together")).to_be_visible(timeout=LONG)
    return kept_page


@pytest.fixture(scope="module")
def collection(batch: Page) -> Page:
    """The collection of the good ones, all labelled."""
    batch.locator("#batch-together button").click()
    batch.wait_for_url("**/collection/*")
    expect(batch.locator("#takes-table tbody canvas")).to_have_count(GOOD, timeout=LONG)
    return batch


def test_of_files_dropped_at_once_the_bad_ones_are_named_apart(batch: Page, axe: str) -> None:
    """Each has its row and its progress; what could not be used says why, and the others are ready."""
    bad = batch.locator("#batch-bad-rows li")
    expect(bad).to_have_count(BAD)
    assert {name.split(".")[0] for name in bad.locator("strong").all_text_contents()} == {"notes", "broken"}
    for place in range(BAD):
        expect(bad.nth(place).locator(".problem-line")).to_contain_text(".")
    expect(batch.locator("#batch-rows li")).to_have_count(GOOD)
    expect(batch.locator("#batch-summary")).to_have_text(f"{GOOD} of {GOOD + BAD} ready, {BAD} could not be used")
    assert faults(batch, axe) == []


def test_the_good_ones_have_the_same_motions(collection: Page, axe: str) -> None:
    """A card for each motion with its picture, a row for each take; by day and by night nothing is seriously wrong."""
    cards = collection.locator(".motion-card")
    expect(cards).to_have_count(2)
    expect(cards.locator("canvas[data-drawn]")).to_have_count(2, timeout=LONG)
    expect(collection.locator("#takes-table tbody td button")).to_have_count(2 * GOOD)
    assert faults(collection, axe) == []
    collection.set_viewport_size({"width": 390, "height": 844})
    assert collection.evaluate("document.documentElement.scrollWidth") <= 390
    assert faults(collection, axe) == []
    collection.set_viewport_size({"width": 1100, "height": 720})


def test_a_name_given_once_is_seen_in_all(collection: Page, browser: Browser, address: str) -> None:
    """In the table, in every take, for who comes later; a name that another motion has is refused."""
    names = collection.locator(".motion-card .called input:not([type=color])")
    names.nth(0).fill("bend")
    names.nth(0).press("Enter")
    expect(collection.locator("#takes-table thead .head-name").first).to_have_text("bend")
    collection.locator("#takes-table tbody th button").nth(4).click()
    expect(collection.locator("#take-segments .name", has_text="bend").first).to_be_visible()
    collection.locator("#take-close").click()
    names.nth(1).fill("Bend")
    names.nth(1).press("Enter")
    expect(collection.locator(".motion-card .problem-line").nth(1)).to_contain_text("name of another motion")
    for other in tab(browser, address):
        other.goto("/")
        other.locator("#collection-cards .animation").first.click()
        other.wait_for_url("**/collection/*")
        expect(other.locator(".motion-card .called input:not([type=color])").first).to_have_value("bend")


def test_a_cell_opens_the_take_at_that_segment_by_keys(collection: Page) -> None:
    """Tab stops at the table once, arrows go from cell to cell, and the way back leads to the collection."""
    collection.locator("#takes-table tbody button").first.focus()
    for key in ("ArrowDown", "ArrowRight", "ArrowRight"):
        collection.keyboard.press(key)
    assert collection.locator("#takes-table button[tabindex='0']").count() == 1
    label = collection.evaluate("document.activeElement.textContent")
    assert "take_02" in label
    collection.keyboard.press("Enter")
    collection.wait_for_url("**/view/**")
    expect(collection.locator("#subject")).to_contain_text("take_02", timeout=LONG)
    collection.go_back()
    expect(collection.locator("#takes-table tbody canvas")).to_have_count(GOOD)


def test_similar_ranges_are_found_and_opened(collection: Page, axe: str) -> None:
    """The nearest first, each with its distance."""
    collection.locator(".motion-card").first.get_by_role("button", name="Find similar").click()
    rows = collection.locator("#similar-rows button")
    expect(rows.first).to_be_visible(timeout=LONG)
    distances = [float(text.split()[-1]) for text in collection.locator("#similar-rows .sure").all_text_contents()]
    assert distances == sorted(distances)
    assert len(distances) > GOOD // 2
    assert faults(collection, axe) == []
    rows.first.click()
    collection.wait_for_url("**/view/**")
    collection.go_back()
    expect(collection.locator("#takes-table tbody canvas")).to_have_count(GOOD)


FIGURES = """([share, width, height]) => new Promise((resolve) => {
    const slider = document.getElementById('together-share');
    slider.value = share;
    slider.dispatchEvent(new Event('input'));  // draws; pixels are there to be read in that frame
    requestAnimationFrame(() => {
        const copy = Object.assign(document.createElement('canvas'), { width, height });
        const context = copy.getContext('2d');
        context.drawImage(document.getElementById('together-figures'), 0, 0, width, height);
        resolve(Array.from(context.getImageData(0, 0, width, height).data));
    });
})"""


def bodies_at(page: Page, share: float) -> list[np.ndarray]:
    """Where the bodies of twelve figures in two rows are, so far into their motion; the floor is never opaque."""
    opaque = np.array(page.evaluate(FIGURES, [share, 360, 120])).reshape(2, 60, 6, 60, 4)[..., 3] == 255
    return list(opaque.transpose(0, 2, 1, 3).reshape(12, 60, 60))


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """What two shapes share, of what either covers."""
    return float((one & other).sum() / (one | other).sum())


def test_all_of_a_motion_play_side_by_side(collection: Page, axe: str) -> None:
    """As figures on one stage, in one rhythm: bars that do the same look the same, wherever each performed it."""
    together = collection.locator(".motion-card").first.get_by_role("button", name="Side by side")
    together.click()
    expect(collection.locator("#together-figures[data-shown='12']")).to_be_visible(timeout=LONG)
    early, late = bodies_at(collection, 0.1), bodies_at(collection, 0.6)
    for first, *others in (early, late):
        assert min(overlap(first, other) for other in others[: GOOD - 1]) > 0.8
    assert overlap(early[0], late[0]) < 0.6
    assert faults(collection, axe) == []
    collection.locator("#together-close").click()
    collection.set_viewport_size({"width": 390, "height": 844})
    together.click()
    for seen in ("1 to 6", "7 to 12"):
        expect(collection.locator("#together-note")).to_have_text(
            f"{seen} of 12 segments, each as far into the motion as the first.", timeout=LONG
        )
        expect(collection.locator("#together-tiles li")).to_have_count(6)
        collection.locator("#together-later:enabled").or_(collection.locator("#together-close")).first.click()
    collection.set_viewport_size({"width": 1100, "height": 720})


def test_a_correction_is_proposed_for_others_and_refused(collection: Page, axe: str) -> None:
    """Nothing else changes: not before a person has decided, and not when they refuse."""
    cells = collection.locator("#takes-table tbody td")
    before = {number: cells.nth(number).text_content() for number in range(2, 2 * GOOD)}
    collection.locator("#takes-table tbody th button").first.click()
    collection.locator("#take-segments button").nth(1).click()
    assert faults(collection, axe) == []
    collection.locator("#segment-motion").select_option(label="another motion …")
    collection.locator("#new-name").fill("turn")
    collection.locator("#new-name").press("Enter")
    expect(collection.locator("#take-segments .name", has_text="turn")).to_have_count(1)
    collection.locator("#take-close").click()
    expect(collection.locator(".proposal")).to_have_count(1, timeout=LONG)
    expect(collection.locator(".proposal")).to_contain_text("would change")
    assert faults(collection, axe) == []
    collection.get_by_role("button", name="Refuse").click()
    expect(collection.locator(".proposal")).to_have_count(0)
    cells = collection.locator("#takes-table tbody td:not(:nth-child(4))")
    assert {number: cells.nth(number).text_content() for number in before} == before


def test_a_take_is_added_and_removed_and_all_is_saved(collection: Page, tmp_path: Path) -> None:
    """A file given to the collection becomes a row; the CSV has a line for each segment, by the common names."""
    late = performance(tmp_path / "late.npz", ORDERS[0], 77.0)
    collection.locator("#collection-add input").set_input_files(late)
    row = collection.locator("#takes-table tbody tr", has_text="late")
    expect(row.locator("canvas")).to_have_count(1, timeout=LONG)
    collection.locator("#collection-save summary").click()
    with collection.expect_download() as saved:
        collection.locator("#collection-save [data-saved=json]").click()
    document = json.loads(saved.value.path().read_text())
    assert len(document["takes"]) == GOOD + 1
    assert {"bend", "turn"} <= {one["name"] for take in document["takes"] for one in take["segments"]}
    collection.once("dialog", lambda dialog: dialog.accept())
    row.locator("th button").click()
    collection.locator("#take-remove").click()
    expect(row).to_have_count(0)
