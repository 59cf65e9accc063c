"""Ways to a result and from one to the next: addresses, recent animations, other numbers and methods, refusals."""

import io
import re
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from tests.browser.drawn import ellipsoid
from tests.browser.journeys import opened

pytestmark = pytest.mark.timeout(240)


def test_another_number_of_motions_is_shown_in_place(page: Page, smooth: Path) -> None:
    """Asking for two motions cuts again and shows two, without another look at the figure."""
    address = opened(page, smooth)
    for unusable in ("many", "1001", "0", "2.5"):
        page.locator("#motions").fill(unusable)
        page.locator("#motions").press("Enter")
        expect(page.locator("#controls-note")).to_have_text("Type a whole number of motions up to 1000, or auto.")
    page.locator("#motions").fill("2")
    page.locator("#motions").press("Enter")
    expect(page.locator("#summary")).to_contain_text("2 motions", timeout=30_000)
    page.wait_for_url(lambda url: url.split("#")[0] != address.split("#")[0])


def test_a_method_that_must_be_told_the_number_gets_the_one_on_screen(page: Page, smooth: Path) -> None:
    """Whoever only chooses a method is not asked for what the page knows; back again it may be found anew."""
    opened(page, smooth)
    motions = page.locator("#motions").get_attribute("placeholder")
    with page.expect_request("**/v1/segmentations") as asked:
        page.locator("#advanced-open").click()
        page.locator("#method").select_option("spectral")
    assert asked.value.post_data_json["motions"] == int(motions or "")
    expect(page.locator("#controls-note")).to_contain_text("now has", timeout=60_000)
    expect(page.locator("#auto")).to_be_disabled()
    page.locator("#method").select_option("switching")
    expect(page.locator("#auto")).to_be_enabled()


def test_a_number_that_the_take_does_not_have_is_not_shown_as_if_it_had(page: Page, smooth: Path) -> None:
    """Of 40 motions that were asked for ten are found: the field, the list and a sentence say ten."""
    opened(page, smooth)
    page.locator("#motions").fill("40")
    page.locator("#motions").press("Enter")
    expect(page.locator("#warnings")).to_contain_text("40 motions were asked for, but only", timeout=60_000)
    expect(page.locator("#motions")).not_to_have_value("40")
    expect(page.locator("#summary")).to_contain_text(f"{page.locator('#motions').input_value()} motions")


def test_a_take_without_a_curve_says_why_in_its_place(page: Page, tmp_path: Path) -> None:
    """No empty chart, no invented axis; the timeline stands under the sentence and plays."""
    file = tmp_path / "short.npz"
    with np.load(io.BytesIO(ellipsoid())) as whole:
        np.savez(file, **{**whole, "vertices": whole["vertices"][:30]})
    page.goto("/")
    page.locator("#drop input").set_input_files(file)
    expect(page.locator("#no-curve")).to_contain_text("energy curve needs", timeout=60_000)
    box = page.locator("#curve").bounding_box()
    assert box is not None
    assert box["height"] < 2
    expect(page.locator(".axis")).to_be_hidden()
    page.locator("#timeline").click(position={"x": 300, "y": 10})
    expect(page.locator("#frame")).not_to_have_value("0")
    expect(page.locator("#segments .long")).to_have_text("0.97 s")  # from the first pose to the last, as the clip lasts


def test_a_bad_file_leaves_the_result_where_it_is(page: Page, smooth: Path, tmp_path: Path) -> None:
    """It is refused over the result, which is still there, and plays."""
    address = opened(page, smooth).split("#")[0]
    file = tmp_path / "page.glb"
    file.write_text("<!doctype html><title>Not found</title>")
    page.locator("#another input").set_input_files(file)
    expect(page.locator("#refusal-detail")).to_contain_text(".")
    page.locator("#refusal").get_by_role("button", name="Close").click()
    expect(page.locator("#segments li").first).to_be_visible()
    assert page.url.split("#")[0] == address
    page.locator("#play").click()
    expect(page.locator("#frame")).not_to_have_value("0")


def test_the_same_bytes_under_another_name_are_called_so(page: Page, own: Path, tmp_path: Path) -> None:
    """A person who renames a file sees the new name, in the header and in the list."""
    opened(page, own)
    other = tmp_path / "renamed.glb"
    other.write_bytes(own.read_bytes())
    opened(page, other)
    expect(page.locator("#subject")).to_contain_text("renamed.glb")
    page.goto("/")
    expect(page.locator("#recent .animation strong", has_text="renamed.glb")).to_have_count(1)


def test_a_result_opens_by_its_address_at_a_moment(page: Page, smooth: Path) -> None:
    """/view/{id}#frame=… shows that frame."""
    address = opened(page, smooth).split("#")[0]
    page.goto("/")
    page.goto(f"{address}#frame=321")
    expect(page.locator("#frame")).to_have_value("321")
    expect(page.locator("#timeline")).to_have_attribute("aria-valuenow", "321")


def test_recent_animations_are_listed_and_open(page: Page, smooth: Path) -> None:
    """The first page remembers."""
    opened(page, smooth)
    page.goto("/")
    entry = page.locator("#recent .animation", has_text="smooth.glb").first
    expect(entry).to_contain_text(re.compile("just now|ago"))
    entry.click()
    expect(page.locator("#curve canvas")).to_be_visible()


def test_an_animation_whose_segmentation_was_cancelled_is_segmented_again(page: Page, smooth: Path) -> None:
    """What was given up, or failed with a worker, is no dead end."""
    opened(page, smooth)
    gone = {"segmentations": [{"id": "a" * 26, "status": "cancelled"}]}
    page.route("**/v1/segmentations?animation=*", lambda route: route.fulfill(json=gone))
    page.goto("/")
    page.locator("#recent .animation", has_text="smooth.glb").first.click()
    expect(page.locator("#curve canvas")).to_be_visible()


def test_a_hostile_file_is_refused_in_a_sentence(page: Page, tmp_path: Path) -> None:
    """What is wrong is said to a person, and there is a way on."""
    file = tmp_path / "page.glb"
    file.write_text("<!doctype html><title>Not found</title>")
    page.goto("/")
    page.locator("#drop input").set_input_files(file)
    expect(page.locator("#refused-detail")).to_be_visible()
    sentence = page.locator("#refused-detail").inner_text()
    assert len(sentence) > 20
    assert sentence.rstrip().endswith(".")
    assert "Traceback" not in sentence
    expect(page.get_by_role("link", name="Open another file")).to_be_visible()


def test_an_address_of_nothing_says_so(page: Page) -> None:
    """A link that has expired is not a blank page."""
    page.goto("/view/aaaaaaaaaaaaaaaaaaaaaaaaaa")
    expect(page.locator("#refused-detail")).to_be_visible()


def test_the_file_comes_back_in_clips(page: Page, smooth: Path, tmp_path: Path) -> None:
    """One click waits until the clips are written and saves a GLB with one named animation for each segment."""
    opened(page, smooth)
    segments = page.locator("#segments li").count()
    with page.expect_download(timeout=60_000) as saving:
        page.locator("#clips").click()
    file = tmp_path / "clips.glb"
    saving.value.save_as(file)
    names = [take.name for take in read_header(io.BytesIO(file.read_bytes()), file.name, Limits()).takes]
    assert len(names) == len(set(names)) == segments
    assert "A_01" in names


def test_what_may_pass_is_tried_again(page: Page, smooth: Path) -> None:
    """A network that was away costs a click, not the search for the file; what is wrong for good offers none."""
    page.goto("/")
    page.route("**/v1/animations?*", lambda route: route.abort())
    page.locator("#drop input").set_input_files(smooth)
    expect(page.locator("#refused-detail")).to_contain_text("does not answer")
    page.unroute("**/v1/animations?*")
    page.get_by_role("button", name="Try again").click()
    expect(page.locator("#curve canvas")).to_be_visible(timeout=90_000)
    page.goto("/view/aaaaaaaaaaaaaaaaaaaaaaaaaa")
    expect(page.locator("#refused-detail")).to_be_visible()
    expect(page.get_by_role("button", name="Try again")).to_be_hidden()
