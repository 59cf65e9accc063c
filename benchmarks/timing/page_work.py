"""What a frame and a step cost in the page: work, without the waiting for the screen's next refresh.

A frame (`frame_costs`) is timed in the page itself: the event that asks for it, and then from the first to the last
callback of the screen frame that draws it, with `gl.finish()` and the reading of a pixel: Chromium takes the former for
a flush, and only the latter waits until the drawing is over and not only ordered.
A step (`step_costs`) is what the browser counts as work of the page's thread (TaskDuration of the DevTools protocol:
script, layout, style and paint) until everything that the step set off is done, again with the pixel read.
"""

from collections.abc import Callable, Iterable
from typing import Any

from playwright.sync_api import CDPSession, Page

DRAWN = """
    const drawn = (gl) => { gl.finish(); gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); };"""
FRAME = (
    f"""async (frames) => {{{DRAWN}"""
    """
    const gl = document.querySelector('#figure').getContext('webgl2');
    const field = document.querySelector('#frame');
    const costs = [];
    for (const frame of frames) {
        for (let refresh = 0; refresh < 3; refresh++) await new Promise(requestAnimationFrame);
        drawn(gl);  // so that the last frame's way to the screen is not counted here
        await new Promise(requestAnimationFrame);
        let begun;
        requestAnimationFrame(() => { begun = performance.now(); });
        const asked = performance.now();
        field.value = frame;
        field.dispatchEvent(new Event('change', { bubbles: true }));
        const answered = performance.now();
        costs.push(answered - asked + await new Promise((done) => requestAnimationFrame(() => {
            drawn(gl);
            done(performance.now() - begun);
        })));
    }
    return costs;
}"""
)
SETTLE = (
    f"""async () => {{{DRAWN}"""
    """
    const gl = document.querySelector('#figure').getContext('webgl2');
    const rest = () => new Promise((done) => setTimeout(done, 60));
    await rest();  // what was asked for over HTTP comes back
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    drawn(gl);
}"""
)


def stage_of(page: Page, width: int, height: int) -> None:
    """Make the window as large as leaves the figure exactly so many pixels."""
    for _ in range(10):  # the curve's height goes with the window's
        box = page.locator("#figure").bounding_box()
        size = page.viewport_size
        assert box is not None
        assert size is not None
        across, down = width - round(box["width"]), height - round(box["height"])
        if not across and not down:
            return
        page.set_viewport_size({"width": size["width"] + across, "height": size["height"] + down})
        page.wait_for_timeout(300)
    raise RuntimeError("the stage does not take the size asked for")


def frame_costs(page: Page, frames: Iterable[int]) -> list[float]:
    """Milliseconds of each frame, all of them seen once before, so that nothing is waited for."""
    listed = list(frames)
    page.evaluate(FRAME, listed)
    page.wait_for_timeout(300)
    costs: list[float] = page.evaluate(FRAME, listed)
    return costs


def step_costs(page: Page, act: Callable[[int], Any], steps: int) -> list[float]:
    """Milliseconds of each of so many steps; `act(step)` does one. Three are taken before, unmeasured."""
    tools = page.context.new_cdp_session(page)
    tools.send("Performance.enable")
    costs = []
    for step in range(-3, steps):
        page.evaluate(SETTLE)
        before = _work(tools)
        act(max(0, step))
        page.evaluate(SETTLE)
        if step >= 0:
            costs.append(1000 * (_work(tools) - before))
    tools.detach()
    return costs


def _work(tools: CDPSession) -> float:
    metrics = tools.send("Performance.getMetrics")["metrics"]
    return next(float(metric["value"]) for metric in metrics if metric["name"] == "TaskDuration")
