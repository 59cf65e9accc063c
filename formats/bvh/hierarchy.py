"""The head of a BVH: joints, what of them moves, how many frames there are, how far apart. Light: no NumPy."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from caesura.core.errors import BrokenContainer
from caesura.core.limits import Limits
from caesura.formats.takes.frame_rate import snap_frame_rate

MOTION = b"MOTION"
ROUNDED = 1e-3
"""Share by which a frame's time may miss that of a known rate."""

LONGEST = 4 * 2**20
"""Bytes of a head: fifty thousand joints have fewer."""

LONGEST_NAME = 200
"""Letters of a joint's name: an end takes its parent's, so that a long one would be kept as often as there are ends."""

CHANNELS = {f"{axis}{kind}" for axis in "XYZ" for kind in ("position", "rotation")}


@dataclass
class BvhJoint:
    """One joint; `parent` is -1 at the root. `channels` are as in glTF's order of the file, such as `Zrotation`."""

    name: str
    parent: int
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    channels: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class BvhHeader:
    """Joints, each after its parent; `frames` at every `frame_seconds`, whose numbers begin at byte `start`."""

    joints: list[BvhJoint]
    frames: int
    frame_seconds: float
    start: int

    @property
    def rate(self) -> float:
        """Frames per second; of a time that was rounded to 0.0083333 seconds, the 120 that it stands for."""
        rate = 1 / self.frame_seconds
        known = snap_frame_rate(rate)
        return known if known is not None and abs(known / rate - 1) < ROUNDED else rate

    @property
    def columns(self) -> int:
        """Numbers in a frame."""
        return sum(len(joint.channels) for joint in self.joints)


def read_bvh_header(data: bytes, limits: Limits) -> BvhHeader:
    """The head at the beginning of `data`; raises `BrokenContainer("malformed-bvh")` or `LimitExceeded`."""
    end = data.find(MOTION, 0, LONGEST)
    if end < 0:
        raise malformed_bvh("has no MOTION after its hierarchy")
    joints = _joints(iter(data[:end].decode("utf-8-sig", "replace").split()), limits)
    at = end
    lines = []
    for _ in range(3):
        stop = data.find(b"\n", at, at + 200)
        if stop < 0:
            raise malformed_bvh("ends before its frames")
        lines.append(data[at:stop].decode("ascii", "replace").split())
        at = stop + 1
    count, step = lines[1], lines[2]
    if count[:1] != ["Frames:"] or step[:2] != ["Frame", "Time:"]:
        raise malformed_bvh("does not say how many frames it has and how far apart")
    seconds = _number(step[2] if len(step) > 2 else "")
    frames = _number(count[1] if len(count) > 1 else "")
    if not 0 < seconds <= 1e6 or not 0 <= frames < 2**53 or frames != int(frames):
        raise malformed_bvh(f"has {frames:g} frames of {seconds:g} seconds")
    return BvhHeader(joints, int(frames), seconds, at)


def malformed_bvh(what: str) -> BrokenContainer:
    """The refusal of a BVH."""
    return BrokenContainer("malformed-bvh", f"The BVH {what}. Export it again.")


def _joints(words: Iterator[str], limits: Limits) -> list[BvhJoint]:
    joints: list[BvhJoint] = []
    above: list[int] = []
    for word in words:
        if word in {"ROOT", "JOINT", "End"}:
            limits.check("max_nodes", len(joints) + 1)
            name = _name_before_brace(words)
            parent = above[-1] if above else -1
            if word == "End":  # which has no name of its own
                name = _end_site_name(joints[parent].name if above else "")
            above.append(len(joints))
            joints.append(BvhJoint(name, parent))
        elif word == "OFFSET" and above:
            joints[above[-1]].offset = (_number(next(words, "")), _number(next(words, "")), _number(next(words, "")))
        elif word == "CHANNELS" and above:
            joints[above[-1]].channels = _channels(words)
        elif word == "}" and above:
            above.pop()
        elif word != "HIERARCHY":
            raise malformed_bvh(f"has {word[:40]!r} in its hierarchy")
    if above or not joints:
        raise malformed_bvh("has no joints, or a joint without an end")
    return joints


def _end_site_name(parent: str) -> str:
    """The name of an end, which has none of its own; an end below an end is called the same."""
    return parent if parent.endswith(" end") else f"{parent} end"


def _name_before_brace(words: Iterator[str]) -> str:
    """The name before a brace, which in some files has spaces."""
    name: list[str] = []
    letters = 0
    for word in words:
        if word == "{":
            return " ".join(name)
        name.append(word)
        letters += len(word)
        if letters > LONGEST_NAME:
            raise malformed_bvh(f"has a joint whose name goes on beyond {LONGEST_NAME} letters: {name[0][:40]!r} …")
    raise malformed_bvh("breaks off in its hierarchy")


def _channels(words: Iterator[str]) -> list[str]:
    """The channels of a joint. Blender writes 0 of them for the root that it puts above several roots."""
    count = next(words, "")
    if not (count.isascii() and count.isdecimal() and len(count) == 1):
        raise malformed_bvh(f"has {count[:40]!r} where a number of channels belongs")
    found = [next(words, "") for _ in range(int(count))]
    if not set(found) <= CHANNELS or len(set(found)) < len(found):
        raise malformed_bvh(f"has channels {' '.join(found)[:80]}")
    return found


def _number(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        raise malformed_bvh(f"has {word[:40]!r} where a number belongs") from None
    if not math.isfinite(value) or abs(value) > 3e38:
        raise malformed_bvh("has a number that is not finite")
    return value
