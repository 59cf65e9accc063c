"""The export panel: what is chosen is what comes, under the names that were shown."""

import io
import zipfile
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from tests.browser.journeys import opened

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure."""
    opened(kept_page, own)
    return kept_page


def downloaded(page: Page, button: str, folder: Path) -> Path:
    """What a button saves, in a folder."""
    with page.expect_download(timeout=60_000) as saving:
        page.locator(button).click()
    path = folder / saving.value.suggested_filename
    saving.value.save_as(path)
    return path


def take_names(data: bytes) -> list[str]:
    """The names of the animations of a GLB."""
    return [take.name or "" for take in read_header(io.BytesIO(data), "clips.glb", Limits()).takes]


def test_a_clip_is_one_click_away(result: Page, own: Path, tmp_path: Path) -> None:
    """The segment of the moment alone, under the name of the take."""
    result.locator("#segments button").nth(1).click()
    saved = downloaded(result, "#one-clip", tmp_path)
    assert saved.name == f"{own.stem}-clips.glb"
    assert take_names(saved.read_bytes()) == ["B_01"]


def test_clips_come_as_the_panel_shows_them(result: Page, tmp_path: Path) -> None:
    """Advice for the program, names by a pattern, only the segments that are wanted, a file for each."""
    result.locator("#export-open").click()
    names = result.locator("#export-names .name")
    expect(names.first).to_have_text("A_01")
    form = result.locator("#export-form")
    form.locator("[name=engine]").select_option("unity")
    expect(result.locator("#export-advice")).to_contain_text("glTFast")
    form.get_by_label("Names", exact=True).fill("hero/{motion}_{number}")
    expect(names.first).to_have_text("hero_A_01")
    form.locator("[name=which]").select_option("chosen")
    form.locator("[name=numbers]").fill("1, 3-4")
    expect(names).to_have_text(["hero_A_01", "hero_C_01", "hero_A_02"])
    form.locator("[name=files]").select_option("separate")
    saved = downloaded(result, "#export-save", tmp_path)
    with zipfile.ZipFile(saved) as archive:
        assert archive.namelist() == ["hero_A_01.glb", "hero_C_01.glb", "hero_A_02.glb"]


def test_what_is_not_possible_is_said_beside_the_names(result: Page) -> None:
    """Nothing is offered to download then; what was chosen is there again when the panel is opened anew."""
    form = result.locator("#export-form")
    form.get_by_label("Names", exact=True).fill("{nonsense}")
    expect(result.locator("#export-count")).to_contain_text("{motion}")
    expect(result.locator("#export-save")).to_be_disabled()
    form.get_by_label("Names", exact=True).fill("{motion}")
    expect(result.locator("#export-save")).to_be_enabled()
    result.locator("#export-close").click()
    result.reload()
    expect(result.locator("#segments li").first).to_be_visible()
    result.locator("#export-open").click()
    expect(form.get_by_label("Names", exact=True)).to_have_value("{motion}")
    expect(form.locator("[name=engine]")).to_have_value("unity")
    result.locator("#export-close").click()
