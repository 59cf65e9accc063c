"""What a writer of clips is given."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.core.segmentation_document import SegmentationDocument
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import Clip
from caesura.formats.clips.in_kind.animation_file import AnimationFile
from caesura.formats.clips.in_kind.stored_frames import StoredFrames


@dataclass(frozen=True)
class ClipRequest:
    """The file, the clips to make of it, the result that they are of, and what reading the file may take."""

    model: AnimationFile
    clips: Sequence[Clip]
    document: SegmentationDocument
    options: ClipOptions
    scratch: Callable[[int], memoryview]
    limits: Limits

    @property
    def parameters(self) -> Parameters:
        """Those that the file was read with."""
        return Parameters.model_validate(self.document.parameters)

    def stored_frames(self, count: int, rate: float | None) -> StoredFrames:
        """The `count` frames of the file, at its own `rate` or, where it has none, at that of the result."""
        drawn = self.document.frame_rate
        return StoredFrames(count, rate or drawn, self.document.source.start_seconds, drawn)
