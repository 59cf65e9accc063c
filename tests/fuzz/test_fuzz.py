"""A small, always equal part of `make fuzz`: its beginnings, and some files made of them."""

import random

import pytest

from tests.fuzz.mutations import mutated
from tests.fuzz.parts import joined, parted
from tests.fuzz.seeds import LARGEST, seeds
from tests.fuzz.target import attempt

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning", "ignore:Duplicate name")
"""Numbers beyond float32 are found after they have been made."""


def test_every_beginning_is_read_or_refused_by_name() -> None:
    """And enough of them are read: a fuzzer whose files are all refused tests refusals."""
    read = [attempt(data)[0] for data in seeds()]
    assert len(read) > 200
    assert sum(read) > 30


def test_files_made_of_them_are_read_or_refused_by_name() -> None:
    """The same five hundred every time."""
    draw, beginnings = random.Random(1), seeds()
    for _ in range(500):
        attempt(mutated(draw.choice(beginnings), draw, LARGEST))


def test_an_upload_of_several_files_is_one_input() -> None:
    """There and back; a single file stays as it is."""
    for parts in ({"model": b"glTF"}, {"a.gltf": b"{}", "data.bin": b"\0\1"}):
        assert parted(joined(parts)) == parts
    assert parted(joined({"a": b"1", "b": b"2"})[:-3])["a"] == b"1"
