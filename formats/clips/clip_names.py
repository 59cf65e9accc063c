"""Names that engines, file systems and their users can live with. Light: no NumPy."""

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable

LONGEST = 60
LOOP = "-loop"
"""The ending by which Godot and others know a clip that repeats."""


def number_repeated_names(motions: Iterable[tuple[str, bool]], taken: Iterable[str]) -> list[str]:
    """A name for each clip, of its motion's name and whether it loops: `A_01`, `A_02`, `walk_01-loop`.

    Each is unique, in any case of letters, also among the names already `taken`.
    """
    used = {name.casefold() for name in taken}
    wanted = [(safe_name(name), loops) for name, loops in motions]
    digits = max(2, len(str(max(Counter(name for name, _ in wanted).values(), default=0))))
    count: Counter[str] = Counter()
    names = []
    for name, loops in wanted:
        while True:
            count[name.casefold()] += 1
            found = f"{name}_{count[name.casefold()]:0{digits}}" + (LOOP if loops else "")
            if found.casefold() not in used:
                break
        used.add(found.casefold())
        names.append(found)
    return names


def safe_name(name: str) -> str:
    """Letters, digits, `_` and `-` of any script: dots, slashes, colons, brackets and spaces mean something to
    one engine or another."""
    plain = re.sub(r"[^\w-]+", "_", unicodedata.normalize("NFC", name)).strip("_-")
    return plain[:LONGEST] or "motion"
