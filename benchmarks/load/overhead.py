"""What HTTP, queue and store add to the work itself: a demo take posted until it is done, less the bare pipeline."""

import time
from itertools import chain

from benchmarks.load.calls import Calls
from benchmarks.load.measure import Measure, percentile
from benchmarks.load.takes import different
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.formats.playback.playback_files import make_playback
from caesura.formats.read import read_animation
from caesura.samples.figures import figure
from caesura.worker.process.thread_count import available_threads
from caesura.worker.process.warm_up import warm_up

TURNS = 15
MOTIONS = 4


def overhead(url: str, turns: int = TURNS) -> list[Measure]:
    """In turns: the pipeline in this process, and the same take through the service; medians of the differences."""
    warm_up()
    takes = different(figure("smooth").glb)
    posted, bare = [], []
    with Calls(url) as calls:
        calls.post_file(next(takes), motions=MOTIONS)
        pipeline(next(takes))
        for _ in range(turns):
            bare.append(milliseconds(lambda: pipeline(next(takes))))
            posted.append(milliseconds(lambda: calls.post_file(next(takes), motions=MOTIONS)))
    added = [whole - alone for whole, alone in zip(posted, bare, strict=True)]
    return [
        Measure("demo take, posted to done", percentile(posted, 0.5), "ms"),
        Measure("demo take, the pipeline alone", percentile(bare, 0.5), "ms"),
        Measure("what the service adds, median", percentile(added, 0.5), "ms", most=60),
    ]


def pipeline(glb: bytes) -> str:
    """What a job does, without queue and store: read, analyse, make what the page plays, cut, write the document."""
    threads = available_threads()
    parameters = Parameters(motions=MOTIONS)
    animation = read_animation({"": memoryview(glb)}, parameters, Limits(), lambda size: memoryview(bytearray(size)))
    analysis = analyse(animation, parameters, threads=threads)
    shown = make_playback(animation, analysis, threads=threads)
    for _ in chain(shown.model, shown.strain or ()):  # made as it is read
        pass
    return cut(analysis, parameters).to_json()


def milliseconds(do: object) -> float:
    """How long a call takes."""
    assert callable(do)
    since = time.perf_counter()
    do()
    return (time.perf_counter() - since) * 1000
