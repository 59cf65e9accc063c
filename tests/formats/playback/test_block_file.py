"""Block files say where everything in them lies."""

import json

import numpy as np
import pytest

from caesura.formats.playback.block_file import FRAMES_PER_BLOCK, MAGIC, write_block_file


def header_of(data: bytes) -> dict:
    """The header, read as the page reads it."""
    assert data[:8] == MAGIC
    return json.loads(data[12 : 12 + int.from_bytes(data[8:12], "little")])


@pytest.mark.parametrize("words", range(9))
def test_every_part_lies_where_the_header_says_and_is_aligned(words: int) -> None:
    """Arrays and frames are found at their offsets, whatever the length of the header."""
    frames = FRAMES_PER_BLOCK + 5
    values = np.arange(frames * 3, dtype="<i2").reshape(frames, 3)
    arrays = {"a": np.arange(5, dtype="u1"), "b": np.arange(6, dtype="<u4").reshape(2, 3)}
    blocks = [values[:FRAMES_PER_BLOCK], values[FRAMES_PER_BLOCK:]]
    data = b"".join(write_block_file({"word": "x" * words}, arrays, frames, 6, blocks))
    header = header_of(data)
    for name, array in arrays.items():
        entry = header["arrays"][name]
        assert entry["offset"] % 8 == 0
        found = np.frombuffer(data, entry["type"], array.size, entry["offset"]).reshape(entry["shape"])
        assert np.array_equal(found, array)
    offset = header["blocks"]["offset"]
    assert offset % 8 == 0
    assert header["frames"] == frames
    assert data[offset:] == values.tobytes()


def test_a_file_is_written_block_by_block() -> None:
    """Nothing is drawn before it is asked for: memory holds one block, however long the take."""
    drawn: list[int] = []

    def blocks():
        for number in range(1000):
            drawn.append(number)
            yield np.zeros((32, 1), "u1")

    pieces = write_block_file({}, {}, 32_000, 1, blocks())
    next(pieces)
    assert drawn == []
    next(pieces)
    assert drawn == [0]
