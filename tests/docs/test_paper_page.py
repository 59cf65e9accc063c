"""docs/paper.md leads from each item of the paper to the code: every place it names is there."""

import re
from pathlib import Path

import pytest

from caesura.core.parameters import Parameters

PLACE = re.compile(r"`((?:core|formats|samples|service|benchmarks|tests)/[\w/]+\.py)(?::(\w+))?`")
ITEMS = (
    *(f"Eq. {n}," for n in range(1, 7)), *(f"Fig. {n}" for n in (1, 2, 3, 4, 5, 7, 8)), "Figs. 6", "Algorithm 1",
    "Table 1", *(f"[{n}]" for n in (3, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16, 20, 21, 23, 24, 25, 26)),
)  # fmt: skip


@pytest.fixture(scope="module")
def page(checkout: Path) -> str:
    """The text of the page."""
    return (checkout / "docs" / "paper.md").read_text(encoding="utf-8")


def test_every_place_that_the_page_names_is_in_the_code(checkout: Path, page: str) -> None:
    """The file, and what it is said to define."""
    places = PLACE.findall(page)
    assert len(places) > 40
    for path, name in places:
        assert (checkout / path).is_file(), path
        if name:
            defined = re.compile(rf"^(def|class) {name}\b", re.MULTILINE)
            assert defined.search((checkout / path).read_text(encoding="utf-8")), f"{path} defines no {name}"


def test_every_choice_that_the_page_names_can_be_made(page: str) -> None:
    """Parameters by their names, methods by theirs."""
    for name, value in re.findall(r"`(\w+)=([\w-]*)`", page):
        assert name in Parameters.model_fields, name
        if value:
            assert Parameters.parse({"motions": "2", name: value})


@pytest.mark.parametrize("item", ITEMS)
def test_every_item_of_the_paper_is_on_the_page(page: str, item: str) -> None:
    """Its equations, its algorithm, its table, its figures, and the works whose methods it names."""
    assert item in page
