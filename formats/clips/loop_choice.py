"""Which segments are cut to their best loops. Light: no NumPy."""

from caesura.core.segmentation_document import Loop, SegmentationDocument


def chosen_loops(document: SegmentationDocument) -> dict[int, Loop]:
    """By the numbers of segments, from 1: of each motion the loop that matches best, and those a person has marked."""
    kept = [
        (number, segment, segment.best_loop)
        for number, segment in enumerate(document.segments, 1)
        if segment.best_loop is not None and not segment.discard
    ]
    best: dict[int, tuple[float, int]] = {}
    for number, segment, loop in kept:
        best[segment.motion] = min(best.get(segment.motion, (loop.seam, number)), (loop.seam, number))
    chosen = {number for _, number in best.values()}
    return {number: loop for number, segment, loop in kept if number in chosen or segment.loop}
