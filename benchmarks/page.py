"""How fast the page is, in Chromium that draws WebGL by software: `python -m benchmarks.page`.

Starts a service of its own, posts a body of 30,000 triangles as a skinned glTF and as vertices, and the long session
(`--frames`: a shorter one), opens each in the page and writes what it measured between the markers of
docs/performance.md; `--print` writes nothing. It ends with status 1 where a bound is missed.
"""

import argparse
import io
import shutil
import sys
import time
from collections.abc import Callable
from statistics import median

import numpy as np
from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks.reports.report import write_section
from benchmarks.session import DOCS, SOFTWARE_WEBGL
from benchmarks.timing.page_work import frame_costs, stage_of, step_costs
from benchmarks.timing.processes import service
from caesura.api import open_animation
from caesura.client.client import Client
from caesura.samples.figure_glb import smooth_glb
from caesura.samples.long_session import long_session, plan_session
from caesura.samples.performed_take import perform_take
from caesura.samples.smooth_body import build_body

FRAMES = 1000
CELL = 0.01352  # metres: about 30,000 triangles
SEED = 30
DRAWN = 200
"""So many frames one after the other are drawn and measured, after all of them were seen once."""
STEPS = 40

Row = tuple[str, float, str, float]
"""What was measured, the figure, its unit and its bound."""


def main() -> int:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--frames", type=int, default=72_000)
    arguments.add_argument("--print", action="store_true", help="print only")
    chosen = arguments.parse_args()
    rows = _measured(chosen.frames)
    lines = [
        f"| {what} | {found:.3g} {unit} | ≤ {bound:g} {unit} | {'' if found <= bound else 'missed'} |"
        for what, found, unit, bound in rows
    ]
    text = "\n".join(["| measure | found | bound | |", "|---|---:|---:|---|", *lines])
    print(text)
    if not chosen.print:
        write_section(DOCS, "page", text)
    return int(any(found > bound for _, found, _, bound in rows))


def _measured(frames: int) -> list[Row]:
    random = np.random.default_rng(SEED)
    glb = smooth_glb(build_body(CELL), perform_take(plan_session(FRAMES, random), random))
    session = long_session(frames)
    chromium = shutil.which("chromium")
    if chromium is None:
        raise SystemExit("There is no Chromium here.")
    with service() as running, Client(running.url) as client, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=SOFTWARE_WEBGL)

        def posted(data: bytes, name: str) -> str:
            return f"{running.url}/view/{client.segment(data, name=name).id}"

        rows = _drawing(browser, posted(glb, "skinned.glb"), "skinned")
        rows += _drawing(browser, posted(as_vertices(glb), "vertices.npz"), "as vertices")
        rows += _session(browser, posted(session.glb, "session.glb"), frames)
        browser.close()
    return rows


def as_vertices(glb: bytes) -> bytes:
    """The same take as an NPZ of its vertices."""
    animation = open_animation(glb)
    stored = io.BytesIO()
    vertices = animation.vertices(0, animation.frames)
    np.savez(stored, vertices=vertices, triangles=animation.triangles, frame_rate=animation.frame_rate)
    return stored.getvalue()


def _drawing(browser: Browser, address: str, how: str) -> list[Row]:
    """First paint of a finished result, then what a frame costs, and the two poses of a cut."""
    shown, _ = _opened(browser, address)
    page = _page(browser, address)
    stage_of(page, 640, 480)
    one = frame_costs(page, range(DRAWN))
    what = f"30,000 triangles, 1,000 frames, {how}"
    page.close()
    return [
        (f"{what}: opened, curve and list shown", shown, "s", 1.0),
        (f"{what}: a frame, 640 × 480, median of {DRAWN}", median(one), "ms", 60.0),
    ]


def _session(browser: Browser, address: str, frames: int) -> list[Row]:
    """The long session: how soon it is there, and what a step in it costs."""
    shown, figure = _opened(browser, address)
    page = _page(browser, address)
    name = f"{frames:,} frames"
    far = [str(step * 7919 % frames) for step in range(1, STEPS + 1)]
    steps: list[tuple[str, Callable[[int], None]]] = [
        ("a scrub to a far frame", lambda step: page.evaluate(SCRUB, far[step])),
        ("a zoom by the wheel", lambda step: page.evaluate(WHEEL, -120 if step % 20 < 10 else 120)),
        ("the next cut of the review", lambda _: page.keyboard.press("n")),
        ("a cut moved by a frame", lambda _: page.keyboard.press("ArrowRight")),
    ]
    rows: list[Row] = [
        (f"{name}: opened, curve and list shown", shown, "s", 3.0),
        (f"{name}: opened, figure on stage", figure, "s", 3.0),
    ]
    for what, act in steps:
        costs = step_costs(page, act, STEPS)
        rows.append((f"{name}: {what}, median of {STEPS}", median(costs), "ms", 50.0))
    page.close()
    return rows


SCRUB = """(frame) => {
    const field = document.querySelector('#frame');
    field.value = frame;
    field.dispatchEvent(new Event('change', { bubbles: true }));
}"""
WHEEL = """(deltaY) => {
    const box = document.querySelector('#tracks');
    const { left, top, width, height } = box.getBoundingClientRect();
    const place = { clientX: left + width / 3, clientY: top + height / 2 };
    box.dispatchEvent(new WheelEvent('wheel', { deltaY, bubbles: true, cancelable: true, ...place }));
}"""


def _page(browser: Browser, address: str) -> Page:
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.goto(address)
    page.locator("#figure[data-shown]").wait_for(timeout=120_000)
    return page


def _opened(browser: Browser, address: str) -> tuple[float, float]:
    """Seconds until the result is shown and until the figure is, in a fresh context: the median of three."""
    found = []
    for _ in range(3):
        context = browser.new_context(viewport={"width": 1280, "height": 800})
        page = context.new_page()
        since = time.perf_counter()
        page.goto(address, wait_until="commit")
        page.locator("#segments li").first.wait_for(timeout=120_000)
        shown = time.perf_counter() - since
        page.locator("#figure[data-shown]").wait_for(timeout=120_000)
        found.append((shown, time.perf_counter() - since))
        context.close()
    return median(shown for shown, _ in found), median(figure for _, figure in found)


if __name__ == "__main__":
    sys.exit(main())
