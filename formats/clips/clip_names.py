"""Names that engines, file systems and their users can live with. Light: no NumPy."""

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import count
from string import Formatter

from caesura.core.errors import ParameterError

LONGEST = 60
LOOP = "-loop"
"""The ending by which Godot and others know a clip that repeats."""

PATTERN = "{motion}_{number}"
FIELDS = {
    "motion": "the name of the motion",
    "number": "how many clips of the motion there have been",
    "segment": "which segment of the take it is, from 1",
    "take": "the name of the take",
}
"""What a pattern of names may hold in braces."""


@dataclass(frozen=True)
class ClipSubject:
    """What a clip is of: its motion, the number of its segment from 1, and its take; and whether it repeats."""

    motion: str
    segment: int
    take: str
    loops: bool = False


def check_pattern(pattern: str) -> str:
    """The pattern itself; raises `ParameterError` for one that holds what there is not, or nothing."""
    known = ", ".join(f"{{{name}}}" for name in FIELDS)
    try:
        fields = [(name, spec, conversion) for _, name, spec, conversion in Formatter().parse(pattern)]
    except ValueError:
        fields = [("", "", None)]
    for name, spec, conversion in fields:
        if name is not None and (name not in FIELDS or spec or conversion):
            detail = f"names = {pattern[:50]!r} is not possible. In braces may stand {known}."
            raise ParameterError("invalid-parameter", detail, parameter="names")
    if not pattern.strip():
        raise ParameterError("invalid-parameter", f"names is empty. In braces may stand {known}.", parameter="names")
    return pattern


def name_clips(clips: Sequence[ClipSubject], taken: Iterable[str], pattern: str = PATTERN) -> list[str]:
    """A name for each clip: `A_01`, `A_02`, `walk_01-loop`, or as the pattern has it.

    Each is unique, in any case of letters, also among the names already `taken`: a pattern without a number gets one.
    """
    used = {name.casefold() for name in taken}
    most = max(Counter(engine_safe_name(clip.motion) for clip in clips).values(), default=0)
    digits = max(2, len(str(most)))
    next_number: Counter[str] = Counter()
    names = []
    for clip in clips:
        key = engine_safe_name(clip.motion).casefold()
        numbers = count(next_number[key] + 1)
        found = next(name for n in numbers if (name := _name(clip, n, pattern, digits)).casefold() not in used)
        next_number[key] = next(numbers) - 1 if "{number}" in pattern else 0
        used.add(found.casefold())
        names.append(found)
    return names


def _name(clip: ClipSubject, number: int, pattern: str, digits: int) -> str:
    """The name of a clip that is number `number` of its motion, or of those whose names are else the same."""
    values = {
        "motion": engine_safe_name(clip.motion),
        "number": f"{number:0{digits}}",
        "segment": f"{clip.segment:0{digits}}",
        "take": engine_safe_name(clip.take),
    }
    named = replace_unsafe(pattern.format(**values)) or "clip"
    again = "" if "{number}" in pattern or number == 1 else f"_{number:0{digits}}"
    return named + again + (LOOP if clip.loops else "")


def name_clips_of_motions(motions: Iterable[tuple[str, bool]], taken: Iterable[str]) -> list[str]:
    """The same of motions alone, and whether each loops."""
    return name_clips([ClipSubject(name, 0, "", loops) for name, loops in motions], taken)


def engine_safe_name(name: str) -> str:
    """Letters, digits, `_` and `-` of any script: dots, slashes, colons, brackets and spaces mean something to
    one engine or another."""
    return replace_unsafe(name)[:LONGEST] or "motion"


def replace_unsafe(name: str) -> str:
    """The same with `_` for what is not safe."""
    return re.sub(r"[^\w-]+", "_", unicodedata.normalize("NFC", name)).strip("_-")
