"""The map over blocks: order, bounds, progress, and how it ends early."""

import threading
import time

import pytest

from caesura.core.frames.blocks import BLOCKS_BYTES, frames_per_block, map_blocks, split_into_blocks, threads_at_once


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_results_come_in_order(threads):
    """However long each takes."""
    assert list(map_blocks(lambda i: time.sleep(0.002 * (i % 3)) or i, range(30), threads)) == list(range(30))


def test_only_so_many_are_begun_and_not_taken():
    """At most one more than there are threads, so that memory is bounded."""
    begun = []
    results = map_blocks(begun.append, range(100), 2)
    next(results)
    time.sleep(0.05)
    assert len(begun) <= 4


def test_a_failure_is_the_callers():
    """What the function raises is raised at its place in the order."""
    results = map_blocks(lambda i: 1 // (3 - i), range(9), 2)
    assert [next(results) for _ in range(3)] == [0, 0, 1]
    with pytest.raises(ZeroDivisionError):
        next(results)


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_that_raises_ends_the_work(threads):
    """No further block is begun, and the caller sees what was raised."""
    begun = []

    def cancelled(stage, fraction):
        if fraction >= 0.1:
            raise KeyboardInterrupt(stage)

    with pytest.raises(KeyboardInterrupt, match="strain"):
        list(map_blocks(begun.append, range(100), threads, progress=cancelled, stage="strain", total=100))
    assert len(begun) <= 14


def test_progress_is_heard_while_a_block_is_waited_for():
    """In the calling thread, every 0.2 s, with the share that is done."""
    heard = []
    list(map_blocks(time.sleep, [0.5], 2, progress=lambda *told: heard.append((*told, threading.current_thread()))))
    assert len(heard) >= 3
    assert {thread for *_, thread in heard} == {threading.current_thread()}


def test_maps_may_be_chained():
    """The items of one may be the results of another, drawn as they are needed."""
    doubled = map_blocks(lambda i: 2 * i, range(20), 2)
    assert list(map_blocks(lambda i: i + 1, doubled, 2)) == [2 * i + 1 for i in range(20)]


def test_blocks_tile_the_frames_and_shrink_for_large_meshes():
    """The last is shorter; 512 frames at most, 8 at least."""
    assert split_into_blocks(10, 4) == [(0, 4), (4, 8), (8, 10)]
    sizes = [frames_per_block(vertices) for vertices in (0, 100, 2_000, 10_000, 500_000, 10**7)]
    assert sizes == [512, 512, 128, 64, 32, 8]


@pytest.mark.parametrize("vertices", [1_000, 260_000, 500_000])
def test_the_blocks_of_all_threads_fit_into_memory_together(vertices):
    """A large mesh has fewer threads and not shorter blocks, which are the same for any number; one there is always."""
    each = 12 * vertices * frames_per_block(vertices)
    assert threads_at_once(64, vertices) * each <= BLOCKS_BYTES
    assert threads_at_once(2, vertices, 2 * vertices) == 2
    assert threads_at_once(2, 10**9) == 1
