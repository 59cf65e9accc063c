"""The figure as the page paints it where there is no graphics card, and as it has a card draw it."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import tab
from tests.browser.drawn import body, ellipsoid, extent, mirrored_bar, picture
from tests.browser.journeys import opened

pytestmark = pytest.mark.timeout(240)

A_CARD = """window.Worker = class {
    constructor() { setTimeout(() => this.onmessage({ data: 'A graphics card' })); }
    terminate() {}
};"""
"""The page asks a worker who draws here; this one says that a card does."""
ANTIALIASED = "document.querySelector('#figure').getContext('webgl2').getContextAttributes().antialias"
FRAME = 20


@pytest.fixture(scope="module")
def with_a_card(browser: Browser, address: str) -> Iterator[Page]:
    """A tab on a machine that has a graphics card, as far as the page can tell."""
    for page in tab(browser, address):
        page.add_init_script(A_CARD)
        yield page


@pytest.fixture
def files(smooth: Path, tmp_path: Path) -> dict[str, Path]:
    """A figure of each kind, by its name."""
    (tmp_path / "ellipsoid.npz").write_bytes(ellipsoid())
    (tmp_path / "mirrored.glb").write_bytes(mirrored_bar())
    return {"smooth.glb": smooth} | {path.name: path for path in tmp_path.iterdir()}


def to_frame(page: Page, frame: int) -> None:
    """Show a frame."""
    page.locator("#frame").fill(str(frame))
    page.locator("#frame").press("Enter")


def test_a_painted_ellipsoid_is_an_ellipse_that_stands_up_and_turns(page: Page, files: dict[str, Path]) -> None:
    """It fills pi/4 of the box around it. From its end it is half as wide, upright it is high."""
    opened(page, files["ellipsoid.npz"])
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


def test_a_cut_is_painted_twice(page: Page, smooth: Path) -> None:
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


@pytest.mark.parametrize("name", ["smooth.glb", "ellipsoid.npz", "mirrored.glb"])
def test_painting_and_a_card_agree(page: Page, with_a_card: Page, files: dict[str, Path], name: str) -> None:
    """The same outline, and within it nearly the same colours, of strain, of the motion and plain."""
    address = opened(page, files[name]).split("#")[0]
    with_a_card.goto(address)
    expect(with_a_card.locator("#figure")).to_have_attribute("data-shown", "vertices" if "npz" in name else "gltf")
    assert not page.evaluate(ANTIALIASED)
    assert with_a_card.evaluate(ANTIALIASED)
    shown = []
    for one in (page, with_a_card):
        to_frame(one, FRAME)
    for look in ("Strain", "Motion", "Plain"):
        pictures = []
        for one in (page, with_a_card):
            one.locator("#looks").get_by_text(look, exact=True).click()
            pictures.append(picture(one))
        painted, drawn = (body(each) for each in pictures)
        both = painted & drawn
        assert both.sum() > 100
        assert both.sum() > 0.85 * (painted | drawn).sum()
        difference = np.abs(pictures[0] - pictures[1])[both][:, :3]
        assert difference.mean() < 6
        shown.append(pictures[0][both][:, :3].mean(0))
    assert np.abs(shown[1] - shown[2]).max() > 20  # a motion's colour is not that of clay
