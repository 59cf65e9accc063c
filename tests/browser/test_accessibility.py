"""The page for everybody: axe-core finds no serious fault in any state, by day and by night, and keys do everything."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, starts
from tests.conftest import unavailable

pytestmark = pytest.mark.timeout(240)

SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
GRAVE = ("serious", "critical")
FOCUSED = (
    "(({ id, className, localName }) => localName === 'body' ? localName : id || className)(document.activeElement)"
)


@pytest.fixture(scope="module")
def axe(checkout: Path) -> str:
    """The checker's source; it is served nowhere, the test brings it into the page."""
    path = checkout / "node_modules" / "axe-core" / "axe.min.js"
    if not path.is_file():
        unavailable("axe-core is not fetched: python tools/fetch_assets.py")
    return path.read_text(encoding="utf-8")


def faults(page: Page, axe: str) -> list[str]:
    """What is seriously or critically wrong, by day and by night."""
    found: list[str] = []
    if not page.evaluate("'axe' in window"):
        page.evaluate(axe)
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        answer: dict[str, Any] = page.evaluate("axe.run(document, { resultTypes: ['violations'] })")
        found += [
            f"{scheme}: {one['id']}: {node['target']}: {node['failureSummary']}"
            for one in answer["violations"]
            if one["impact"] in GRAVE
            for node in one["nodes"]
        ]
    page.emulate_media(color_scheme="light")
    return found


@pytest.fixture(scope="module")
def result(kept_page: Page, smooth: Path) -> Page:
    """The result of our own figure."""
    opened(kept_page, smooth)
    return kept_page


def test_nothing_serious_in_any_state_of_a_result(result: Page, axe: str, tmp_path: Path) -> None:
    """Every list, panel, menu and mode, one after the other."""
    labels = tmp_path / "labels.csv"
    labels.write_text("start,end,name\n0,300,walk\n300,700,wave\n")
    page = result.locator
    states: dict[str, Callable[[], Any]] = {
        "as opened": lambda: None,
        "by motion": lambda: page("[name=list-by][value=motion]").check(force=True),
        "several chosen": lambda: page("#segments .motion").nth(1).click(),
        "a discarded segment": lambda: page("#flag-discard").click(),
        "in time": lambda: (result.keyboard.press("Escape"), page("[name=list-by][value=time]").check(force=True)),
        "repeats side by side": lambda: page("#compare").select_option("beside"),
        "overlaid": lambda: page("#compare").select_option("over"),
        "a loop": lambda: (page("#compare").select_option(""), page("#play-loop").click(), page("#play").click()),
        "a cut and the review": lambda: (result.keyboard.press("n"), expect(page("#panel-review")).to_be_visible()),
        "labels": lambda: (page("#labels-open").set_input_files(labels), expect(page("#labels")).to_be_visible()),
        "key-frames": lambda: (page("#tab-poses").click(), expect(page("#poses canvas").first).to_be_visible()),
        "history and the menu": lambda: (page("#tab-history").click(), page("#downloads summary").click()),
        "settings": lambda: (result.keyboard.press("Escape"), page("#advanced-open").click()),
        "links": lambda: (page("#advanced-open").click(), page("#share summary").click()),
        "the export panel": lambda: (page("#export-open").click(), page("[name=loop]").select_option("auto")),
        "keys": lambda: (page("#export-close").click(), result.keyboard.press("Escape"), result.keyboard.press("?")),
    }
    found = {}
    for state, bring in states.items():
        bring()
        result.wait_for_timeout(150)
        found |= {state: serious} if (serious := faults(result, axe)) else {}
    assert found == {}
    result.keyboard.press("Escape")
    page("#tab-segments").click()
    result.keyboard.press("Control+z")


def test_nothing_serious_on_a_phone(result: Page, axe: str) -> None:
    """At 390 pixels nothing sticks out, and nothing is lost to who cannot see it."""
    result.set_viewport_size({"width": 390, "height": 844})
    assert result.evaluate("document.documentElement.scrollWidth") <= 390
    assert faults(result, axe) == []
    result.set_viewport_size({"width": 1100, "height": 720})


def test_nothing_serious_before_and_where_it_fails(page: Page, axe: str, tmp_path: Path) -> None:
    """The first page, the wait, and the refusal."""
    page.goto("/")
    expect(page.locator("#drop")).to_be_visible()
    assert faults(page, axe) == []
    file = tmp_path / "broken.glb"
    file.write_bytes(b"glTF" + bytes(8))
    page.route("**/v1/animations?*", lambda route: None)  # an answer that does not come
    page.locator("#drop input").set_input_files(file)
    expect(page.locator("#waiting")).to_be_visible()
    assert faults(page, axe) == []
    page.unroute("**/v1/animations?*")
    page.goto("/")
    page.locator("#drop input").set_input_files(file)
    expect(page.locator("#refused-detail")).to_be_visible()
    assert faults(page, axe) == []


def test_a_person_without_a_mouse_gets_everywhere(result: Page) -> None:
    """Tab reaches every group once, arrows move within; lists are one stop each, and what has the focus is seen."""
    result.keyboard.press("Escape")  # no cut is selected
    result.locator("#ask-help").focus()
    seen: list[str] = []
    while "body" not in seen:
        seen.append(result.evaluate(FOCUSED))
        outlined = result.evaluate("""() => {
            const seen = (element) => getComputedStyle(element).outlineStyle !== 'none';
            const at = document.activeElement;
            return at === document.body || seen(at) || seen(at.nextElementSibling || at) || seen(at.parentElement);
        }""")
        assert outlined, seen[-1]
        result.keyboard.press("Tab")
    wanted = {
        "motions",
        "advanced-open",
        "tab-segments",
        "segment",
        "clips",
        "play",
        "frame",
        "timeline",
        "motion-name",
    }
    assert wanted <= set(seen)
    assert seen.count("segment") == 1
    result.locator("#segments button").first.focus()
    result.keyboard.press("ArrowDown")
    result.keyboard.press("Enter")
    expect(result.locator("#frame")).to_have_value(str(starts(result)[1]))


def test_review_goes_through_the_cuts_by_keys_and_remembers_what_was_checked(result: Page) -> None:
    """N selects the least certain, P plays around it, C checks it and goes on; a reload forgets nothing."""
    result.keyboard.press("Escape")
    result.keyboard.press("n")
    least = result.locator("#cuts button").first
    expect(least).to_have_attribute("aria-current", "true")
    frame = least.locator(".from").text_content()
    result.keyboard.press("p")
    expect(result.locator("#play")).to_have_attribute("aria-label", "Pause")
    expect(result.locator("#play")).to_have_attribute("aria-label", "Play")
    expect(least).to_have_attribute("aria-current", "true")
    result.keyboard.press("c")
    expect(result.locator("#cuts button", has_text=frame)).to_contain_text("checked")
    expect(result.locator("#cuts button").first).to_have_attribute("aria-current", "true")
    expect(result.locator("#cuts button").first).not_to_contain_text(frame or "")
    result.reload()
    result.locator("#tab-review").click()
    expect(result.locator("#cuts button", has_text=frame)).to_contain_text("checked")


def test_frames_count_from_one_where_a_person_says_so(result: Page) -> None:
    """Starts are one more, ends are named, what is typed is meant so; links and the choice itself stay."""
    result.locator("#tab-segments").click()
    first = starts(result)[1]
    result.locator("#count-one").check(force=True)
    row = result.locator("#segments button").nth(1)
    expect(row.locator(".from")).to_have_text(f"{first + 1}–{starts_after(result)}")
    result.locator("#frame").fill("11")
    result.locator("#frame").press("Enter")
    result.wait_for_url("**#frame=10")
    result.reload()
    expect(result.locator("#frame")).to_have_value("11")
    result.locator("#count-one").uncheck(force=True)
    expect(result.locator("#frame")).to_have_value("10")


def starts_after(page: Page) -> str:
    """The last frame, counted from 1, of the second segment: the third's first frame less one."""
    third = page.locator("#segments button").nth(2).locator(".from").text_content() or ""
    return str(int(third.split("–")[0]) - 1)


def test_the_scores_choose_a_number_of_motions(result: Page) -> None:
    """Every number that was scored is in the chart; a click on one cuts the take so, and marks it."""
    result.locator("#scores rect").nth(2).click()
    expect(result.locator("#summary")).to_contain_text("3 motions")
    expect(result.locator("#scores text.chosen")).to_have_text("3")
    result.locator("#auto").click()
    expect(result.locator("#auto")).to_have_attribute("aria-pressed", "true")
