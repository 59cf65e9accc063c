"""Takes joined from a character's own clips: each repeated at its own speed and size, half a second of cross-fade.

Joined where an engine would, in the places and turns of the nodes, so that rigid parts stay rigid.
"""

import io
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from caesura.core.animation import Animation, Take
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.gltf.animation.sampling import KeyTracks
from caesura.formats.gltf.posing.node_graph import R
from caesura.formats.gltf.posing.posed_vertices import PosedVertices
from caesura.formats.read import read_animation
from caesura.formats.upload_summary import read_header

RATE = 30.0
SECONDS = (3.0, 8.0)  # of a segment
SPEED, SIZE = 0.1, 0.08  # how far repetitions differ: at most, and as a deviation
FADE = 8  # frames on each side of a cut
SHORTEST_CLIP = 0.5  # seconds

Poses = Float[np.ndarray, "frames numbers"]


@dataclass(frozen=True)
class Clip:
    """The poses of one clip, ten numbers a node and the weights of targets; `turns` is where rotations begin."""

    poses: Poses
    turns: Int[np.ndarray, "nodes"]

    def at(self, phase: Float[np.ndarray, "n"], size: Float[np.ndarray, "n"]) -> Poses:
        """Poses at phases of a repetition, 1 being the next one's 0, so much larger than the clip about its mean."""
        place = (phase % 1.0) * (len(self.poses) - 1)
        below = np.minimum(place.astype(np.int64), len(self.poses) - 2)
        share = (place - below)[:, None]
        mean = self.poses.mean(axis=0)
        shown = self.poses[below] * (1 - share) + self.poses[below + 1] * share
        return np.asarray(mean + size[:, None] * (shown - mean))


@dataclass(frozen=True)
class Passage:
    """One clip performed from frame `first` on; `share` is how much of the body it has in a cross-fade."""

    clip: Clip
    first: int
    phase: Float[np.ndarray, "n"]
    size: Float[np.ndarray, "n"]
    share: Float[np.ndarray, "n"]


@dataclass(frozen=True)
class JoinedTracks(KeyTracks):
    """The course of a joined take, in place of the keys of one clip."""

    passages: tuple[Passage, ...]

    def poses(self, seconds: Float[np.ndarray, "block"]) -> Float[np.ndarray, "block numbers"]:
        """The poses at frames of the take."""
        frames = np.rint(seconds * RATE).astype(np.int64)
        out = np.zeros((len(frames), len(self.rest_pose)))
        for passage in self.passages:
            here = np.flatnonzero((frames >= passage.first) & (frames < passage.first + len(passage.phase)))
            if len(here):
                at = frames[here] - passage.first
                shown = passage.clip.at(passage.phase[at], passage.size[at])
                out[here] += passage.share[at, None] * _turned_like(shown, out[here], passage.clip.turns)
        turns = self.passages[0].clip.turns[:, None] + np.arange(4)
        out[:, turns] /= np.linalg.norm(out[:, turns], axis=2, keepdims=True)
        return out


class Joined(NamedTuple):
    """A joined take, the motion of every frame, and how often each segment performs its own."""

    animation: Animation
    truth: Int[np.ndarray, "frames"]
    repeats: tuple[int, ...]


def joined(name: str, data: bytes, motions: int, seed: int, seconds: tuple[float, float] = SECONDS) -> Joined:
    """A take of so many of a glTF's clips, or all it has, in twice as many segments."""
    random = np.random.default_rng(seed)
    clips, of_file, drawing = clips_of(name, data)
    count = min(motions, len(clips))
    chosen = random.permutation(len(clips))[:count].tolist()
    order = list(chosen)
    while count > 1 and len(order) < 2 * count + 1:
        following = chosen[int(random.integers(count))]
        order += [following] if following != order[-1] else []
    ends = [_ends(clips[number], seconds, random) for number in order]
    bounds = np.concatenate([[0], np.cumsum([round(float(e[-1])) for e in ends])]).tolist()
    passages = tuple(
        _passage(clips[number], repetitions, (start, stop, bounds[-1]), random)
        for number, repetitions, (start, stop) in zip(order, ends, pairwise(bounds), strict=True)
    )
    frames = bounds[-1]
    vertices = replace(drawing, tracks=JoinedTracks(**vars(drawing.tracks), passages=passages), start_seconds=0.0)
    take = Take(0, name, (frames - 1) / RATE, frames, RATE)
    made = replace(of_file, vertices=vertices, frames=frames, frame_rate=RATE, take=take, start_seconds=0.0, gltf=None)
    return Joined(made, np.repeat(order, np.diff(bounds)), tuple(map(len, ends)))


def clips_of(name: str, data: bytes) -> tuple[list[Clip], Animation, PosedVertices]:
    """The clips of a file that last half a second or longer, and one of its takes for all that they share."""
    clips = []
    for take in read_header(io.BytesIO(data), name, Limits.none()).takes:
        of_file = read_animation({name: data}, Parameters(take=take.index, fps=RATE), Limits.none(), _scratch)
        drawing = of_file.vertices
        if isinstance(drawing, PosedVertices) and of_file.frames >= SHORTEST_CLIP * RATE:
            turns = R.start + 10 * np.arange(len(drawing.skeleton.parent))
            poses = drawing.tracks.poses(np.arange(of_file.frames) / RATE)
            for i in range(1, len(poses)):
                poses[i] = _turned_like(poses[i : i + 1], poses[i - 1 : i], turns)[0]
            clips.append(Clip(poses, turns))
            last = of_file, drawing
    if not clips:
        raise ValueError(f"{name} has no clip of half a second that a glTF's nodes perform")
    return clips, *last


def _ends(clip: Clip, seconds: tuple[float, float], random: np.random.Generator) -> Float[np.ndarray, "repetitions"]:
    """The frames at which repetitions end, from 0."""
    length = len(clip.poses) - 1
    repetitions = max(round(random.uniform(*seconds) * RATE / length), 1)
    return np.asarray(np.cumsum(length * random.uniform(1 - SPEED, 1 + SPEED, repetitions)))


def _passage(
    clip: Clip, ends: Float[np.ndarray, "repetitions"], at: tuple[int, int, int], random: np.random.Generator
) -> Passage:
    """`at` is where it starts and stops, and the length of the take. Inner ends reach into the cross-fades."""
    start, stop, length = at
    frames = np.arange(max(start - FADE, 0), min(stop + FADE, length))
    times = np.concatenate([[-ends[0]], [0.0], ends, [ends[-1] + ends[0]]])
    phase = np.interp(frames - start, times, np.arange(-1.0, len(ends) + 2))
    size = np.interp(phase, np.arange(len(ends)) + 0.5, random.normal(1, SIZE, len(ends)))
    rise = _smooth(frames - start) if start > 0 else np.ones(len(frames))
    fall = _smooth(frames - stop) if stop < length else np.zeros(len(frames))
    return Passage(clip, int(frames[0]), phase, size, rise - fall)


def _smooth(frames: Int[np.ndarray, "n"]) -> Float[np.ndarray, "n"]:
    """0 before a cross-fade about frame 0, 1 after it."""
    x = np.clip((frames + FADE) / (2 * FADE), 0.0, 1.0)
    return np.asarray(x * x * (3 - 2 * x))


def _turned_like(poses: Poses, others: Poses, turns: Int[np.ndarray, "nodes"]) -> Poses:
    """The same poses with the quaternions, which mean the same with either sign, on the others' side."""
    places = turns[:, None] + np.arange(4)
    other_side = np.einsum("fnq,fnq->fn", poses[:, places], others[:, places]) < 0
    turned = poses.copy()
    turned[:, places] *= np.where(other_side, -1.0, 1.0)[:, :, None]
    return turned


def _scratch(size: int) -> memoryview:
    return memoryview(bytearray(size))
