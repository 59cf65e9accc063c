"""Tasks of a person at the page, with clicks and seconds: `python -m benchmarks.page_tasks`.

Each is done in Chromium from a fresh tab, as a person who knows the page does it. A press of the pointer, a key, a
choice in a menu and a dropped file count as one step each. The seconds are those that the page takes; what a person
needs to look and to decide comes on top. Every task checks that it is done.
Written between the markers of docs/page.md; `--print` writes nothing.
"""

import argparse
import io
import re
import shutil
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, FilePayload, Page, expect, sync_playwright

from benchmarks.load.joint_cut import performances
from benchmarks.reports.report import DOCS, write_section
from benchmarks.session import SOFTWARE_WEBGL
from benchmarks.timing.processes import service
from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from caesura.samples.sample_figures import build_figure

PATIENCE_MS = 400_000
FILES = 10
FORTY, FRAMES = 40, 600


@dataclass
class Person:
    """Somebody at the page; `steps` counts what they press."""

    page: Page
    folder: Path
    steps: int = 0
    begun: float = 0.0

    def begin(self) -> None:
        """From now on the seconds count."""
        self.begun = time.perf_counter()

    def click(self, selector: str, number: int = 0) -> None:
        """Press the pointer on something."""
        self.steps += 1
        self.page.locator(selector).nth(number).click()

    def choose(self, selector: str, value: str) -> None:
        """Choose from a menu."""
        self.steps += 1
        self.page.locator(selector).select_option(value)

    def press(self, keys: str) -> None:
        """Press a key."""
        self.steps += 1
        self.page.keyboard.press(keys)

    def drop(self, files: Sequence[FilePayload] | Sequence[Path]) -> None:
        """Give files to the first page."""
        self.steps += 1
        self.page.locator("#drop input").set_input_files(files)

    def open(self, glb: bytes) -> None:
        """Give a file and wait for its result."""
        self.drop([FilePayload(name="take.glb", mimeType="", buffer=glb)])
        expect(self.page.locator("#segments li").first).to_be_visible()
        expect(self.page.locator("#figure")).to_have_attribute("data-shown", re.compile("."))

    def download(self, selector: str) -> list[str]:
        """Press a button that saves a GLB; answers the names of its clips."""
        with self.page.expect_download() as saving:
            self.click(selector)
        path = self.folder / saving.value.suggested_filename
        saving.value.save_as(path)
        return [take.name or "" for take in read_header(io.BytesIO(path.read_bytes()), path.name, Limits()).takes]


def clips_for_unity(person: Person, glb: bytes) -> None:
    """Open a take, choose Unity, save its clips."""
    person.open(glb)
    person.click("#export-open")
    person.choose("[name=engine]", "unity")
    expect(person.page.locator("#export-names li").first).to_be_visible()
    assert len(person.download("#export-save")) > 1


def three_doubtful_cuts(person: Person, glb: bytes) -> None:
    """Go to the three least certain cuts and move each by a frame."""
    person.open(glb)
    for _ in range(3):
        person.press("n")
        before = person.page.locator("#cut-frame").input_value()
        person.press("ArrowRight")
        expect(person.page.locator("#cut-frame")).not_to_have_value(before)
    expect(person.page.locator("#kept-word")).to_contain_text("Saved")


def two_motions_in_one(person: Person, glb: bytes) -> None:
    """Ask for a motion too few, see its segments side by side, and make the one that differs a motion of its own."""
    person.open(glb)
    person.click("#fewer")
    expect(person.page.locator("#controls-note")).to_contain_text("now has")
    counts = person.page.locator("#segments .motion .times").all_inner_texts()
    largest = max(range(len(counts)), key=lambda place: int(re.sub(r"\D", "", counts[place])))
    person.click("#segments .motion", largest)
    person.choose("#compare", "beside")
    expect(person.page.locator("#pair p").nth(1)).to_be_visible()
    person.click("#segments .chosen .segment", 1)
    person.choose("#motion-of", "new")
    expect(person.page.locator("#kept-word")).to_contain_text("Saved")


def loop_a_walk(person: Person, glb: bytes) -> None:
    """Look at the loop of the walk, mark it, and save it."""
    person.open(glb)
    person.click("#segments .segment")
    person.click("#play-loop")
    person.click("#flag-loop")
    assert person.download("#one-clip")[0].endswith("-loop")


def night_of_forty(person: Person, glb: bytes) -> None:
    """Drop forty files, two of them none, have the same motions found in the others, and name one in all."""
    good = performances(FORTY - 2, FRAMES)
    bad = {"notes.glb": b"not a model", "broken.glb": glb[:3000]}
    named = {f"take_{number:02d}.glb": content for number, content in enumerate(good)} | bad
    paths = [person.folder / name for name in named]
    for path, content in zip(paths, named.values(), strict=True):
        path.write_bytes(content)
    person.begin()
    person.drop(paths)
    expect(person.page.locator("#batch-bad-rows li")).to_have_count(len(bad))
    person.click("#batch-together button")
    expect(person.page.locator("#takes-table tbody canvas")).to_have_count(len(good))
    person.click(".motion-card .called input:not([type=color])")
    person.page.locator(".motion-card .called input:not([type=color])").first.fill("walk")
    person.press("Enter")
    expect(person.page.locator("#takes-table thead .head-name").first).to_have_text("walk")


def batch_of_ten(person: Person, glb: bytes) -> None:
    """Drop ten files at once and wait until every one is cut."""
    copies = [glb.replace(b'"take"', f'"tk{number:02d}"'.encode(), 1) for number in range(FILES)]
    person.drop([FilePayload(name=f"{n}.glb", mimeType="", buffer=copy) for n, copy in enumerate(copies)])
    expect(person.page.locator("#batch-rows button:enabled")).to_have_count(FILES)


TASKS: tuple[tuple[str, Callable[[Person, bytes], None]], ...] = (
    ("Cut a take into clips for Unity", clips_for_unity),
    ("Correct three doubtful cuts", three_doubtful_cuts),
    ("Find why two motions are one, and part them", two_motions_in_one),
    ("Loop a walk", loop_a_walk),
    ("Cut ten files at once", batch_of_ten),
    ("Find the same motions in forty files, two of them bad, and name one", night_of_forty),
)


def main() -> None:
    """Do all tasks, print them, and write them."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--print", action="store_true", help="print only")
    arguments.add_argument("--only", default="", help="tasks whose name holds this, printed only")
    chosen = arguments.parse_args()
    tasks = [task for task in TASKS if chosen.only in task[0]]
    glb = build_figure("smooth").glb
    with service() as running, sync_playwright() as playwright, TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=SOFTWARE_WEBGL)
        rows = [_row(browser, running.url, task, glb, Path(folder)) for task in tasks]
        browser.close()
    text = "\n".join(["| task | steps | seconds |", "|---|---:|---:|", *rows])
    print(text)
    if not chosen.print and not chosen.only:
        write_section(DOCS / "page.md", "tasks", text)


def _row(
    browser: Browser, url: str, task: tuple[str, Callable[[Person, bytes], None]], glb: bytes, folder: Path
) -> str:
    name, do = task
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    page.set_default_timeout(PATIENCE_MS)
    expect.set_options(timeout=PATIENCE_MS)
    page.goto(url)
    person = Person(page, folder)
    person.begin()
    do(person, glb)
    took = time.perf_counter() - person.begun
    page.close()
    return f"| {name} | {person.steps} | {took:.1f} |"


if __name__ == "__main__":
    main()
