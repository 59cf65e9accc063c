"""The figure as WebGL draws it: its outline, its light, its colours; and the page where there is no WebGL."""

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import BrowserType, Page, expect

from tests.browser.conftest import SOFTWARE_WEBGL, tab
from tests.browser.drawn import body, ellipsoid, extent, jointed_bar, picture
from tests.browser.journeys import opened, saved

pytestmark = pytest.mark.timeout(240)

FRAME = 20
ANTIALIASED = "document.querySelector('#figure').getContext('webgl2').getContextAttributes().antialias"


def to_frame(page: Page, frame: int) -> None:
    """Show a frame."""
    page.locator("#frame").fill(str(frame))
    page.locator("#frame").press("Enter")


def test_an_ellipsoid_is_an_ellipse_that_stands_up_and_turns(page: Page, tmp_path: Path) -> None:
    """It fills pi/4 of the box around it. From its end it is half as wide, upright it is high."""
    file = tmp_path / "ellipsoid.npz"
    file.write_bytes(ellipsoid())
    opened(page, file)
    lying = body(picture(page))
    width, height = extent(lying)
    assert lying.sum() == pytest.approx(np.pi / 4 * width * height, rel=0.15)  # it lies a little aslant
    view = page.locator("#figure").bounding_box()
    assert view is not None
    x, y = view["x"] + view["width"] / 2, view["y"] + view["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + view["height"] * 40 / 360, y, steps=3)  # the view's height is a whole turn
    page.mouse.up()
    assert extent(body(picture(page)))[0] < 0.6 * width
    page.locator("#upright").click()
    standing = body(picture(page))
    width, height = extent(standing)
    assert standing.sum() == pytest.approx(np.pi / 4 * width * height, rel=0.06)
    assert height > 2.5 * width


def test_a_cut_is_drawn_twice(page: Page, smooth: Path) -> None:
    """Each side of the stage has a whole body, which touches no edge; without a cut one stands in the middle."""
    opened(page, smooth)
    page.keyboard.press("n")
    expect(page.locator("#pair")).to_be_visible()
    both = body(picture(page))
    left, right = both[:, :120], both[:, 120:]
    for half in (left, right):
        assert half.sum() > 200
        assert not half[:, [0, -1]].any()
    page.keyboard.press("Escape")
    expect(page.locator("#pair")).to_be_hidden()
    one = body(picture(page))
    assert one[:, 118:122].any()


def test_a_body_is_coloured_by_its_motion_or_plain(page: Page, smooth: Path) -> None:
    """A motion's colour is not that of clay, and the body stays where it is. Software draws without anti-aliasing."""
    opened(page, smooth)
    assert not page.evaluate(ANTIALIASED)
    to_frame(page, FRAME)
    pictures = []
    for look in ("Motion", "Plain"):
        page.locator("#looks").get_by_text(look, exact=True).click()
        pictures.append(picture(page))
    motion, plain = pictures
    assert (body(motion) == body(plain)).all()
    assert np.abs(motion[body(motion)].mean(0) - plain[body(plain)].mean(0)).max() > 20


def test_a_body_that_its_joints_mirror_is_lit_from_outside(page: Page, tmp_path: Path) -> None:
    """It is as bright as its twin that no joint mirrors, though its triangles turn the other way."""
    brightness = []
    for mirrored in (False, True):
        file = tmp_path / f"bar-{mirrored}.glb"
        file.write_bytes(jointed_bar(mirrored=mirrored))
        opened(page, file)
        page.locator("#looks").get_by_text("Plain", exact=True).click()
        drawn = picture(page)
        assert body(drawn).sum() > 100
        brightness.append(drawn[body(drawn)][:, :3].mean())
    assert brightness[0] == pytest.approx(brightness[1], abs=6)


def test_without_webgl_the_page_says_so_and_all_else_works(
    chromium_type: BrowserType, chromium: Path, address: str, own: Path
) -> None:
    """The curve is there, it plays, an edit is kept and the clips can be downloaded."""
    browser = chromium_type.launch(executable_path=chromium, args=[*SOFTWARE_WEBGL, "--disable-3d-apis"])
    for page in tab(browser, address):
        page.goto("/")
        page.locator("#drop input").set_input_files(own)
        expect(page.locator("#curve canvas")).to_be_visible(timeout=90_000)
        expect(page.locator("#stage-note")).to_contain_text(
            "this browser does not offer WebGL 2. Everything else", timeout=30_000
        )
        page.locator("#frame").fill("100")
        page.locator("#frame").press("Enter")
        page.keyboard.press("Space")
        expect(page.locator("#frame")).not_to_have_value("100")
        page.keyboard.press("Space")
        page.keyboard.press("n")
        page.keyboard.press("Escape")
        page.locator("#flag-loop").click()
        saved(page)
        with page.expect_download(timeout=60_000):
            page.locator("#clips").click()
    browser.close()
