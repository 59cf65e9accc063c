"""In the reader's process: parts of a stage, each as a layer of its own in text.

The stage is flattened. What is not sampled in time stays as it is, skeletons with their animation too; of what is, a
part has the samples within it, and at both of its ends the value that the stage has there.
"""

from collections.abc import Iterator, Sequence
from typing import Any

from pxr import Sdf, Usd

from caesura.core.limits import Limits
from caesura.formats.native.reader_answer import TextsAnswer
from caesura.formats.native.usd.frame_times import find_clock
from caesura.formats.native.usd.layer import library_errors, open_layer
from caesura.formats.native.usd.meshes_and_skeletons import read_bodies
from caesura.formats.notices import Notices
from caesura.formats.takes.stored_range import stored_range


def cut_stage(
    path: str, limits: Limits, notices: Notices, *, ranges: Sequence[tuple[float, float, float]], from_zero: bool
) -> TextsAnswer:
    """A layer for each range of seconds (start, end, handle), its frames those of `stored_range`.

    Each begins at time code 0, or where it is in the take.
    """
    with library_errors():
        layer, _ = open_layer(path, limits, notices)
        stage = Usd.Stage.Open(layer, None)
        clock = find_clock(stage, list(read_bodies(stage, limits).samples()), limits, notices)
        flat = stage.Flatten(False)
        whole = _SampledStage(flat)
    spans = []
    for start, end, handle in ranges:
        first, last = stored_range(clock.frames, clock.rate, start, end, handle)
        spans.append((clock.code(first), clock.code(last - 1)))
    return TextsAnswer(len(spans), _layers(whole, spans, from_zero))


def _layers(whole: "_SampledStage", spans: Sequence[tuple[float, float]], from_zero: bool) -> Iterator[bytes]:
    for begin, end in spans:
        with library_errors():
            yield whole.part(begin, end, begin if from_zero else 0.0).encode()


class _SampledStage:
    """A flattened layer: what of it is sampled in time, and the rest."""

    def __init__(self, flat: Any) -> None:
        self._flat = flat
        self._stage = Usd.Stage.Open(flat, None)
        self._still = Sdf.Layer.CreateAnonymous("part.usda")
        self._still.TransferContent(flat)
        self._sampled: list[tuple[Any, list[float]]] = []
        flat.Traverse(Sdf.Path.absoluteRootPath, self._note)
        for path, _ in self._sampled:
            self._still.GetAttributeAtPath(path).ClearInfo("timeSamples")

    def part(self, begin: float, end: float, origin: float) -> str:
        """The layer of time codes [begin, end], which are counted from `origin`."""
        layer = Sdf.Layer.CreateAnonymous("part.usda")
        layer.TransferContent(self._still)
        for path, codes in self._sampled:
            within = [code for code in codes if begin < code < end]
            for code in dict.fromkeys([begin, *within, end] if len(codes) > 1 else [begin]):
                value = self._value(path, code)
                if value is not None:
                    layer.SetTimeSample(path, code - origin, value)
        layer.startTimeCode, layer.endTimeCode = begin - origin, end - origin
        return str(layer.ExportToString())

    def _note(self, path: Any) -> None:
        if path.IsPropertyPath() and (codes := self._flat.ListTimeSamplesForPath(path)):
            self._sampled.append((path, codes))

    def _value(self, path: Any, code: float) -> Any:
        """What is stored at a time code, or between two what the stage makes of them."""
        stored = self._flat.QueryTimeSample(path, code)
        return self._stage.GetAttributeAtPath(path).Get(code) if stored is None else stored
