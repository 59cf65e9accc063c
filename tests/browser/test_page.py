"""What a person does with the page, done in a browser."""

import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, seen_once

pytestmark = pytest.mark.timeout(240)


@pytest.fixture(scope="module")
def result(kept_page: Page, smooth: Path) -> Page:
    """The result of our own figure, open; for tests that leave the address alone."""
    opened(kept_page, smooth)
    return kept_page


PIXELS = """([selector, width, height]) => new Promise((resolve) => {
    document.getElementById('reframe').click();  // draws the figure; its pixels can be read in the frame that drew it
    requestAnimationFrame(() => {
        const copy = document.createElement('canvas');
        Object.assign(copy, { width, height });
        const context = copy.getContext('2d');
        context.drawImage(document.querySelector(selector), 0, 0, width, height);
        resolve(Array.from(context.getImageData(0, 0, width, height).data));
    });
})"""


def pixels(page: Page, canvas: str) -> np.ndarray:
    """A canvas as it is on screen, (100, 160, 4): red, green, blue, alpha."""
    return np.array(page.evaluate(PIXELS, [canvas, 160, 100])).reshape(100, 160, 4)


def figure_pixels(page: Page) -> np.ndarray:
    """The 3D view."""
    return pixels(page, "#figure")


def drawn_share(page: Page, canvas: str) -> float:
    """The share of a canvas that is not its most frequent colour."""
    packed = pixels(page, canvas).reshape(-1, 4) @ np.array([2**24, 2**16, 2**8, 1])
    return float(1 - np.unique(packed, return_counts=True)[1].max() / len(packed))


def test_a_file_goes_in_and_its_motions_come_out(result: Page) -> None:
    """Upload, stages, then curve, timeline, list and figure, all with something in them."""
    assert "/view/" in result.url
    expect(result.locator("#subject")).to_contain_text("smooth.glb")
    expect(result.locator("#segments li").first).to_be_visible()
    assert result.locator("#segments li").count() > 1
    expect(result.locator("#summary")).to_contain_text("motions")
    for canvas, least in (("#timeline", 0.2), ("#curve canvas", 0.05)):
        assert seen_once(result, partial(drawn_share, result, canvas), least.__lt__) > least


def test_the_figure_is_drawn_and_strain_colours_it(result: Page) -> None:
    """There are opaque pixels in the 3D view, and warm ones as soon as the body bends."""
    result.locator("#frame").fill("60")
    result.locator("#frame").press("Enter")
    result.get_by_text("Model", exact=True).click()
    plain = figure_pixels(result)
    body = plain[..., 3] > 250
    assert 0.02 < body.mean() < 0.6

    def changed() -> int:
        now = figure_pixels(result)
        return int(((np.abs(now[..., :3] - plain[..., :3]).max(axis=2) > 12) & body).sum())

    result.get_by_text("Strain", exact=True).click()
    assert seen_once(result, changed, lambda count: count > 5) > 5
    result.get_by_text("Model", exact=True).click()
    assert seen_once(result, changed, lambda count: count <= 5) <= 5


def test_playing_moves_the_frame_the_playhead_and_the_body(result: Page) -> None:
    """The space bar starts and stops it."""
    result.locator("#frame").fill("0")
    result.locator("#frame").press("Enter")
    still = figure_pixels(result)
    result.keyboard.press("Space")
    expect(result.locator("#frame")).to_have_value(re.compile(r"^(1[6-9]|[2-9]\d|\d{3,})$"))
    result.keyboard.press("Space")
    frame = int(result.locator("#frame").input_value())
    result.wait_for_timeout(300)
    assert int(result.locator("#frame").input_value()) == frame
    assert np.abs(figure_pixels(result) - still).max() > 30
    assert f"frame={frame}" in result.url


def test_a_segment_is_one_click_away(result: Page) -> None:
    """Clicking a row goes to the segment's first frame."""
    row = result.locator("#segments button").nth(1)
    row.click()
    start = re.sub(r"\D", "", row.locator(".from").inner_text())
    expect(result.locator("#frame")).to_have_value(start)
    expect(row).to_have_attribute("aria-current", "true")


def test_a_vertex_sequence_plays_from_its_blocks(page: Page, tmp_path: Path) -> None:
    """An NPZ of vertices is drawn, and its last block is reached by Range."""
    n, frames = 24, 150
    x, z = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    time = np.arange(frames)[:, None, None] / 30
    wave = 0.3 * np.sin(3 * x + 4 * time) * np.where(time < 2.5, 1, 0.2)
    vertices = np.stack([np.broadcast_to(x, wave.shape), wave, np.broadcast_to(z, wave.shape)], axis=-1)
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel()
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    file = tmp_path / "cloth.npz"
    np.savez(file, vertices=vertices.reshape(frames, -1, 3).astype(np.float32), triangles=triangles, frame_rate=30.0)
    opened(page, file)
    assert page.locator("#figure").get_attribute("data-shown") == "vertices"
    first = figure_pixels(page)
    assert (first[..., 3] > 250).mean() > 0.02
    page.keyboard.press("End")
    expect(page.locator("#frame")).to_have_value(str(frames - 1))
    last = seen_once(page, lambda: figure_pixels(page), lambda now: np.abs(now - first).max() > 30)
    assert np.abs(last - first).max() > 30
