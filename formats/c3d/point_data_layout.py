"""Where what lies in a C3D, by its head and its parameters. Light: no NumPy.

The head (512 bytes) says how many points and analog numbers a frame has, which frames there are, and in which block of
512 bytes the places begin. The parameters, in groups, say the same again and more: names, units, axes. Where a take is
too long for the head's 16 bits, they count its frames.
"""

import math
from dataclasses import dataclass, replace
from itertools import chain

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits
from caesura.formats.c3d.number_encodings import Numbers, Processor
from caesura.formats.c3d.parameter_section import ParameterSection, read_parameters

BLOCK = 512
HEAD_BYTES = 2 * 255 * BLOCK + BLOCK
"""What a head and the longest parameters take at most."""

METRES = {"mm": 0.001, "cm": 0.01, "dm": 0.1, "m": 1.0, "in": 0.0254, "ft": 0.3048}
NO_PLACES = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "MODELED_MARKERS_ANGLES")
"""Parameters that list points which are no places."""


@dataclass(frozen=True)
class C3dLayout:
    """Frames of `points` from byte `start` on, `stride` bytes apart; a point is four numbers, three and a residual.

    Numbers are integers, to be multiplied by `scale`, or reals. `metres` is a metre's share of the unit, `axes` are the
    letters of what points to the right and up on a screen.
    """

    processor: Processor
    frames: int
    points: int
    analog: int
    integers: bool
    scale: float
    start: int
    rate: float
    labels: tuple[str, ...]
    unplaced: frozenset[str]
    metres: float
    axes: tuple[str, str]

    @property
    def number_bytes(self) -> int:
        """Bytes of a number."""
        return 2 if self.integers else 4

    @property
    def stride(self) -> int:
        """Bytes of a frame, with its analog numbers."""
        return (4 * self.points + self.analog) * self.number_bytes


def read_c3d_layout(head: bytes, size: int, limits: Limits) -> C3dLayout:
    """The layout of a C3D of `size` bytes that begins with `head`; raises `malformed-c3d` or `LimitExceeded`."""
    place = (head[0] - 1) * BLOCK
    try:
        processor = Processor(head[place + 3])
    except (IndexError, ValueError):
        raise malformed_c3d("has no parameters that say which processor wrote it") from None
    numbers = Numbers(head, processor)
    parameters = read_parameters(numbers, place)
    scale = parameters.real("POINT", "SCALE") or numbers.real(12)
    rate = parameters.real("POINT", "RATE") or numbers.real(20)
    layout = C3dLayout(
        processor=processor,
        frames=0,
        points=numbers.word(2),
        analog=numbers.word(4),
        integers=scale > 0,
        scale=abs(scale),
        start=((numbers.word(16) or parameters.integer("POINT", "DATA_START")) - 1) * BLOCK,
        rate=rate,
        labels=tuple(parameters.texts("POINT", "LABELS")),
        unplaced=frozenset(chain.from_iterable(parameters.texts("POINT", name) for name in NO_PLACES)),
        metres=METRES.get("".join(parameters.texts("POINT", "UNITS")).lower(), METRES["mm"]),
        axes=("".join(parameters.texts("POINT", "X_SCREEN")), "".join(parameters.texts("POINT", "Y_SCREEN"))),
    )
    counts = _frame_counts(numbers, parameters)
    # Programs that cut a take do not always tell all of the parameters.
    there = (size - layout.start) // layout.stride if layout.stride else 0
    frames = max((count for count in counts if count <= there), default=min(counts))
    layout = replace(layout, frames=frames)
    _check(layout, size, limits)
    return layout


def _frame_counts(numbers: Numbers, parameters: ParameterSection) -> list[int]:
    """What the head says of the number of frames, in 16 bits, and what the parameters say, in more."""
    counts = [numbers.word(8) - numbers.word(6) + 1]
    ends = [parameters.integers("TRIAL", f"ACTUAL_{end}_FIELD") for end in ("START", "END")]
    if all(len(end) >= 2 for end in ends):
        first, last = (end[0] + (end[1] << 16) for end in ends)
        counts.append(last - first + 1)
    counted = parameters.real("POINT", "LONG_FRAMES")
    return [*counts, int(counted)] if math.isfinite(counted) else counts


def _check(layout: C3dLayout, size: int, limits: Limits) -> None:
    if not (math.isfinite(layout.scale) and 0 < layout.scale < 1e30):
        raise malformed_c3d(f"has the scale {layout.scale:g}")
    if not 1e-3 <= layout.rate <= 1e6:
        raise malformed_c3d(f"has {layout.rate:g} frames a second")
    if not layout.points:
        raise malformed_c3d("has no points")
    limits.check("max_nodes", layout.points)
    limits.check("max_frames", layout.frames, "Cut the take")
    needed = layout.start + layout.frames * layout.stride
    if layout.frames < 1 or layout.start < BLOCK or size < needed:
        raise malformed_c3d(
            f"has {size:,} bytes; its {layout.frames:,} frames of {layout.points} points need {needed:,}"
        )


def malformed_c3d(what: str) -> BrokenContainer:
    """The refusal of a C3D."""
    return BrokenContainer("malformed-c3d", f"The C3D {what}. Export it again.")
