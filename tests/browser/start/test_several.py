"""Several takes in a file, and several files at once: each is seen, none is passed over in silence."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.drawn import ellipsoid
from tests.browser.journeys import opened
from tests.glb import bending_strip

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def three_takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A strip that bends in each of three takes."""
    model = bending_strip()
    (one,) = model.json["animations"]
    model.json["animations"] = [{**one, "name": name} for name in ("Survey", "Walk", "Run")]
    path = tmp_path_factory.mktemp("files") / "fox.glb"
    path.write_bytes(model.glb())
    return path


def test_every_take_of_a_file_can_be_chosen(page: Page, three_takes: Path) -> None:
    """The header says which take is shown of how many; another is a choice away, and so are all of them together."""
    opened(page, three_takes)
    expect(page.locator("#take-place")).to_have_text("take 1 of 3")
    expect(page.locator("#take option")).to_contain_text(["Survey", "Walk", "Run", "All takes, one after the other"])
    page.locator("#take").select_option("2")
    expect(page.locator("#take-place")).to_have_text("take 3 of 3", timeout=60_000)
    expect(page.locator("#subject")).to_contain_text("Run")
    page.locator("#take").select_option("all")
    expect(page.locator("#take-place")).to_have_text("all 3 takes", timeout=60_000)


def test_all_takes_are_a_batch(page: Page, three_takes: Path) -> None:
    """Each is cut by itself, has its row, and opens; the way back leads to the rows, also after a reload."""
    opened(page, three_takes)
    page.locator("#every-take").click()
    rows = page.locator("#batch-rows li")
    expect(rows).to_have_count(3)
    expect(rows.get_by_role("button", name="Open")).to_have_count(3, timeout=60_000)
    rows.nth(1).get_by_role("button").click()
    expect(page.locator("#take-place")).to_have_text("take 2 of 3")
    page.go_back()
    expect(rows).to_have_count(3)
    page.reload()
    expect(rows.get_by_role("button", name="Open")).to_have_count(3)


def test_of_several_files_the_bad_one_says_why(page: Page, three_takes: Path, tmp_path: Path) -> None:
    """The others are cut all the same."""
    files = [three_takes, tmp_path / "ball.npz", tmp_path / "notes.glb"]
    files[1].write_bytes(ellipsoid())
    files[2].write_text("not a model")
    page.goto("/")
    page.locator("#drop input").set_input_files(files)
    rows = page.locator("#batch-rows li")
    bad = page.locator("#batch-bad-rows li")
    expect(bad).to_have_count(1, timeout=60_000)
    expect(bad).to_contain_text("notes.glb")
    expect(bad.locator(".problem-line")).to_contain_text(".")
    for place in (0, 1):
        expect(rows.nth(place).locator(".row-note")).to_contain_text("motion", timeout=60_000)
    rows.nth(1).get_by_role("button", name="Open").click()
    expect(page.locator("#subject")).to_contain_text("ball.npz")
