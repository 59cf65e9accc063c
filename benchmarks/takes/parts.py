"""Parts of a take: its middle, its first and last three fifths, and the take with motions left out.

Each is a take of its own with another number of motions, which says whether the number is found or was fitted.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Float

from benchmarks.takes.recordings import Recording
from benchmarks.takes.true_motions import TrueMotions
from caesura.core.agreement import cut_frames

SHARES = {"the middle": (1 / 6, 5 / 6), "the beginning": (0.0, 0.6), "the end": (0.4, 1.0)}
LEFT_OUT = 3
"""So many choices of motions to leave out, each by its own seed."""
GLIMPSE_SECONDS = 2.0
"""What the edge of a part leaves of a motion is not scored where it lasts less."""
SHORTEST_SECONDS = 1 / 3
FADE_SECONDS = 1 / 6
"""On each side of a new cut."""


@dataclass(frozen=True)
class Part(TrueMotions):
    """What is seen, and its true motions."""

    recording: Recording

    @property
    def bounds(self) -> list[int]:
        """Where segments begin, and the end."""
        return [0, *cut_frames(self.truth).tolist(), len(self.truth)]


def parts_of(whole: Part, seed: int) -> Iterator[tuple[str, Part]]:
    """Every part in which there are two motions or more, by what it is."""
    for name, shares in SHARES.items():
        part = _stretch(whole, *(round(share * len(whole.truth)) for share in shares))
        if part.motions > 1:
            yield f"{name} alone", part
    for choice in range(LEFT_OUT):
        part = _without_motions(whole, np.random.default_rng([seed, choice]))
        if part.motions > 1:
            yield "without some of its motions", part


def _stretch(whole: Part, start: int, end: int) -> Part:
    """Frames [start, end)."""
    recording = whole.recording.moved(whole.recording.vertices[start:end])
    part = Part(whole.truth[start:end], whole.scored[start:end].copy(), recording)
    for first, last in (part.bounds[:2], part.bounds[-2:]):
        if last - first < GLIMPSE_SECONDS * recording.frame_rate:
            part.scored[first:last] = False
    return part


def _without_motions(whole: Part, random: np.random.Generator) -> Part:
    """The segments of some of the motions, two at least, in their order, each faded into the next."""
    recording, truth = whole.recording, whole.truth
    motions = np.unique(truth[whole.scored])
    kept = random.permutation(motions)[: random.integers(2, max(len(motions), 3))]
    shortest = SHORTEST_SECONDS * recording.frame_rate
    segments = [np.arange(a, b) for a, b in pairwise(whole.bounds) if truth[a] in kept and b - a > shortest]
    fade = max(round(FADE_SECONDS * recording.frame_rate), 1)
    joined = recording.moved(_joined([recording.vertices[segment] for segment in segments], fade))
    frames = np.concatenate(segments)
    return Part(truth[frames], whole.scored[frames], joined)


def _joined(pieces: list[Float[np.ndarray, "frames V 3"]], fade: int) -> Float[np.ndarray, "frames V 3"]:
    """Pieces one after the other: each goes on to where the next begins, which comes from where it ended."""
    pieces = [piece.copy() for piece in pieces]
    place = np.arange(1, 2 * fade + 1) / (2 * fade + 1)
    share = (place * place * (3 - 2 * place))[:, None, None]
    for before, after in pairwise(pieces):
        last, first = before[-1].copy(), after[0].copy()
        before[-fade:] = before[-fade:] * (1 - share[:fade]) + first * share[:fade]
        after[:fade] = last * (1 - share[fade:]) + after[:fade] * share[fade:]
    return np.concatenate(pieces)
