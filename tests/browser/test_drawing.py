"""The figure as WebGL draws it: its outline, its light, its colours; and the page where there is no WebGL."""

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import BrowserType, Page, expect

from tests.browser.conftest import SOFTWARE_WEBGL, tab
from tests.browser.drawn import body, ellipsoid, extent, jointed_bar, picture
from tests.browser.journeys import opened, saved, seen_once
from tests.formats.playback.test_materials import painted

pytestmark = pytest.mark.timeout(240)

FRAME = 20
A_CARD = "export const probeRenderer = async () => 'a card'; export const isSoftware = () => false;"
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
    for look in ("Motion", "Model"):
        page.locator("#looks").get_by_text(look, exact=True).click()
        pictures.append(picture(page))
    motion, plain = pictures
    assert (body(motion) == body(plain)).all()
    assert np.abs(motion[body(motion)].mean(0) - plain[body(plain)].mean(0)).max() > 20


def test_the_view_is_from_the_front_the_side_and_above(page: Page, tmp_path: Path) -> None:
    """An ellipsoid that is three times as long along z is a circle from the front, and long otherwise."""
    file = tmp_path / "ellipsoid.npz"
    file.write_bytes(ellipsoid())
    opened(page, file)
    view = page.locator("#figure").bounding_box()
    assert view is not None
    slant = view["width"] / 240 / (view["height"] / 150)  # the picture is 240 by 150, whatever the view is
    slim = []
    for side in ("Front", "Side", "Top"):
        page.locator(".sides").get_by_role("button", name=side).click()
        width, height = extent(body(picture(page)))
        slim.append(width * slant / height)
    assert slim == [pytest.approx(1, abs=0.12), pytest.approx(3, abs=0.8), pytest.approx(1 / 3, abs=0.1)]


@pytest.mark.parametrize("software", [True, False])
def test_a_model_has_the_images_of_its_author(page: Page, tmp_path: Path, *, software: bool) -> None:
    """A red image makes a red body, by a graphics card's materials too; a motion's colour goes over it."""
    if not software:
        page.route("**/renderer_probe.js", lambda route: route.fulfill(content_type="text/javascript", body=A_CARD))
    model = painted()
    model.json["meshes"][0]["primitives"][0]["attributes"].pop("COLOR_0")
    file = tmp_path / f"strip-{software}.glb"
    file.write_bytes(model.glb())
    opened(page, file)
    red = seen_once(page, lambda: picture(page), lambda drawn: bool((body(drawn) & is_red(drawn)).any()))
    where = body(red)
    assert where.sum() > 100
    own = red[where][:, :3].mean(0)
    assert own[0] > 2.5 * own[1:].max()
    page.get_by_text("Motion", exact=True).click()
    coloured = picture(page)[where][:, :3].mean(0)
    assert coloured[2] > own[2] + 40  # the first motion is blue


def is_red(drawn: np.ndarray) -> np.ndarray:
    """Where a picture is red."""
    return np.asarray(drawn[..., 0] > 2.5 * drawn[..., 1:3].max(-1))


def test_ghosts_show_the_poses_of_the_key_frames(page: Page, smooth: Path) -> None:
    """Seen through, beside the body, and gone when they are no longer wanted."""
    opened(page, smooth)
    to_frame(page, 150)  # of a walk
    page.locator("#follow").uncheck(force=True)
    alone = picture(page)
    page.keyboard.press("g")
    ghosts = picture(page)
    assert (ghosts[..., 3] > 60).sum() > 1.03 * (alone[..., 3] > 60).sum()
    page.keyboard.press("g")
    assert (picture(page) == alone).mean() > 0.99


def test_the_camera_stays_above_the_floor(page: Page, smooth: Path) -> None:
    """However far a person turns it down, the lines of the floor lie below the middle of the body."""
    opened(page, smooth)
    view = page.locator("#figure").bounding_box()
    assert view is not None
    x, y = view["x"] + view["width"] / 2, view["y"] + view["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 500, steps=5)
    page.mouse.up()
    page.mouse.wheel(0, 800)
    drawn = picture(page)
    line_rows = np.flatnonzero(((drawn[..., 3] > 8) & ~body(drawn)).sum(1) > 20)
    assert len(line_rows) > 0
    assert line_rows.min() > np.flatnonzero(body(drawn).any(1)).mean()


def test_a_body_that_its_joints_mirror_is_lit_from_outside(page: Page, tmp_path: Path) -> None:
    """It is as bright as its twin that no joint mirrors, though its triangles turn the other way."""
    brightness = []
    for mirrored in (False, True):
        file = tmp_path / f"bar-{mirrored}.glb"
        file.write_bytes(jointed_bar(mirrored=mirrored))
        opened(page, file)
        page.locator("#looks").get_by_text("Model", exact=True).click()
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
