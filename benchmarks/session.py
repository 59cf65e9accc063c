"""The normal case, end to end: a 40-minute session from upload to result, and the page that shows it.

`python -m benchmarks.session` starts a service of its own, makes the long session, posts it, watches every process,
scores the result against the session's truth, opens the page in Chromium where there is one, and writes what it
measured between the markers of docs/performance.md. `--frames` takes a shorter session, `--print` writes nothing.
"""

import argparse
import io
import shutil
import time
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from benchmarks.reports.report import write_section
from benchmarks.timing.processes import Watch, service
from caesura.client.client import Client
from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from caesura.samples.long_session import long_session
from caesura.service.commands.frame_labels import Labelling, compute_agreement

DOCS = Path(__file__).resolve().parent.parent / "docs" / "performance.md"
SCRUBS = 60
SOFTWARE_WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def main() -> None:
    """Measure, print, and write."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--frames", type=int, default=72_000)
    arguments.add_argument("--print", action="store_true", help="print only")
    chosen = arguments.parse_args()
    text = "\n".join(_measured(chosen.frames))
    print(text)
    if not chosen.print:
        write_section(DOCS, "session", text)


def _measured(frames: int) -> list[str]:
    started = time.perf_counter()
    sample = long_session(frames)
    made = time.perf_counter() - started
    with service() as (url, pid, _), Client(url) as client:
        watch = Watch(pid)
        since = time.perf_counter()
        found = client.segment(sample.glb, name="session.glb")
        seconds = time.perf_counter() - since
        since = time.perf_counter()
        client.segment(sample.glb, name="session.glb", motions=found.motions)
        again = time.perf_counter() - since
        peaks = watch.stop()
        shown = _page(f"{url}/view/{found.id}", frames)
    truth = Labelling.of(sample.truth.document())
    agreed = compute_agreement(Labelling.of(found.model_dump()), truth)
    triangles = read_header(io.BytesIO(sample.glb), "session.glb", Limits()).triangles or 0
    return [
        "| a session of our own, as one GLB | measured |",
        "|---|---|",
        f"| frames, triangles, bytes | {frames:,}, {triangles:,}, {len(sample.glb):,} |",
        f"| true segments, motions | {len(truth.segments)}, {len({label for _, _, label in truth.segments})} |",
        f"| made in | {made:.1f} s |",
        f"| posted to result, K unasked | {seconds / 60:.1f} min |",
        f"| the same bytes with K given, posted to result | {again:.1f} s |",
        f"| found segments, motions | {len(found.segments)}, {found.motions} |",
        *(f"| {name.replace('_', ' ')} | {value:.3f} |" for name, value in agreed.items()),
        *(f"| largest resident size: {role} | {peak / 2**20:,.0f} MB |" for role, peak in sorted(peaks.items())),
        *shown,
    ]


def _page(address: str, frames: int) -> list[str]:
    """How long the page takes to open, and to show another frame; nothing where there is no Chromium."""
    chromium = shutil.which("chromium")
    if chromium is None:
        return ["| the page | not measured: no Chromium here |"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=SOFTWARE_WEBGL)
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        faults: list[str] = []
        page.on("pageerror", lambda fault: faults.append(str(fault)))
        since = time.perf_counter()
        page.goto(address)
        page.locator("#segments li").first.wait_for(timeout=120_000)
        result = time.perf_counter() - since
        page.locator("#figure[data-shown]").wait_for(timeout=120_000)
        figure = time.perf_counter() - since
        steps = sorted(_scrubs(page, frames))
        browser.close()
    if faults:
        raise RuntimeError(f"the page failed: {faults[0]}")
    return [
        f"| page: curve, timeline and list shown after | {result:.1f} s |",
        f"| page: figure on stage after | {figure:.1f} s |",
        f"| page: a scrub to a far frame, until drawn: median of {SCRUBS} | {steps[SCRUBS // 2]:.0f} ms |",
        f"| page: the slowest of them | {steps[-1]:.0f} ms |",
    ]


def _scrubs(page: Page, frames: int) -> list[float]:
    """Milliseconds from setting a frame to the next picture, for frames all over the take."""
    script = """async (frame) => {
        const field = document.querySelector('#frame');
        const since = performance.now();
        field.value = frame;
        field.dispatchEvent(new Event('change', {bubbles: true}));
        await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        return performance.now() - since;
    }"""
    return [page.evaluate(script, str(step * 7919 % frames)) for step in range(1, SCRUBS + 1)]


if __name__ == "__main__":
    main()
