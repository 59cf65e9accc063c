"""Blocks of frames, and a map over them on threads of our own.

Everything long is a function of a block of frames. The kernels release the interpreter's lock, so plain threads
run them side by side; results come back in block order, so any reduction over them is the same for any number of
threads.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import islice
from typing import TypeVar

from caesura.core.kernels.descriptors import WIDTH
from caesura.core.progress import Progress, ignore_progress

BLOCK_BYTES = 192 * 2**20
BLOCKS_BYTES = 4 * BLOCK_BYTES
"""Memory for the blocks of all threads together."""
SMALL_BLOCK_BYTES = 4 * 2**20
MOST_FRAMES = 512
HEARTBEAT_SECONDS = 0.2

Item = TypeVar("Item")
Result = TypeVar("Result")

Block = tuple[int, int]
"""Frames [start, stop)."""


def frames_per_block(vertex_count: int) -> int:
    """8 to 512 frames: as many as `SMALL_BLOCK_BYTES` hold of float32 vertices or `WIDTH`; fewer beyond `BLOCK_BYTES`.

    Of small meshes many, for what is done once a block would be a good part of the work.
    """
    frame = max(12 * vertex_count, 1)
    few = max(BLOCK_BYTES // frame // 8 * 8, 8)
    many = max(SMALL_BLOCK_BYTES // frame // WIDTH * WIDTH, WIDTH)
    return int(min(few, many, MOST_FRAMES))


def threads_at_once(threads: int, vertex_count: int, columns: int = 0) -> int:
    """As many of the threads as may hold a block each within `BLOCKS_BYTES`; where meshes are large, fewer.

    A block is its float32 vertices and, of every column, a code of two bytes and a bin of one, twice, for it waits for
    the block that comes a window later.
    It is the threads that are fewer and not the frames of a block, on which bits of a result might depend.
    """
    block = frames_per_block(vertex_count) * (12 * vertex_count + 4 * columns)
    return max(min(threads, BLOCKS_BYTES // max(block, 1)), 1)


def split_into_blocks(frames: int, size: int) -> list[Block]:
    """[0, frames) in blocks of `size` frames, the last one shorter."""
    return [(start, min(start + size, frames)) for start in range(0, frames, size)]


def map_blocks(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    threads: int,
    *,
    progress: Progress = ignore_progress,
    stage: str = "",
    total: int = 0,
) -> Iterator[Result]:
    """`function` of every item, in order, at most `threads` + 1 of them begun and not yet taken.

    `items` may itself be lazy: it is drawn from the calling thread. `progress` hears the share of `total` done
    before every wait and every 0.2 s of it. One thread means the calling one.
    """
    source = iter(items)
    if threads <= 1:
        for done, item in enumerate(source):
            progress(stage, done / (total or 1))
            yield function(item)
        return
    with ThreadPoolExecutor(threads, thread_name_prefix="caesura") as pool:
        ahead: deque[Future[Result]] = deque()
        done = 0
        try:
            while True:
                ahead.extend(pool.submit(function, item) for item in islice(source, threads + 1 - len(ahead)))
                if not ahead:
                    return
                yield _wait_for(ahead.popleft(), lambda: progress(stage, done / (total or 1)))  # noqa: B023  called at once
                done += 1
        finally:
            for waiting in ahead:
                waiting.cancel()


def _wait_for(future: "Future[Result]", heartbeat: Callable[[], None]) -> Result:
    heartbeat()
    while True:
        try:
            return future.result(HEARTBEAT_SECONDS)
        except TimeoutError:
            if future.done():  # the function itself timed out: that is its answer
                raise
            heartbeat()
