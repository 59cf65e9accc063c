"""Names that a person gives to the motions of takes that were cut together: `A=walk`."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import click

from caesura.core.errors import ParameterError
from caesura.core.revision import LONGEST_NAME

if TYPE_CHECKING:
    from caesura.core.together.motion_collection import MotionCollection


def parse_names(given: Sequence[str]) -> dict[str, str]:
    """New names by old ones, of `OLD=NEW`; an empty one gives back letters. Raises `UsageError` for what is none."""
    names: dict[str, str] = {}
    for text in given:
        old, equals, new = (part.strip() for part in text.partition("="))
        if not equals or not old:
            raise click.UsageError(f"{text!r} names no motion: write it as A=walk.")
        if old in names:
            raise click.UsageError(f"Motion {old} is named twice.")
        if new and (not new.isprintable() or len(new) > LONGEST_NAME):
            raise click.UsageError(f"The name of motion {old} must be one line that prints, of {LONGEST_NAME} letters.")
        names[old] = new
    return names


def rename_motions(collection: "MotionCollection", names: Mapping[str, str]) -> "MotionCollection":
    """The same with its motions named, all at once, so that two may exchange names.

    Raises `ParameterError`: `unknown-motion` for a name that no motion has, `same-name` where two would have one.
    """
    known = {name: motion for motion, name in collection.shown_names.items()}
    for old in names:
        if old not in known:
            there = ", ".join(known)
            raise ParameterError("unknown-motion", f"There is no motion {old}. The motions are {there}.", motion=old)
    for old, new in names.items():
        collection = collection.with_name(known[old], new or None)
    seen: dict[str, int] = {}
    for motion, name in collection.shown_names.items():
        if seen.setdefault(name.casefold(), motion) != motion:
            raise ParameterError("same-name", f"Two motions would be called {name}.", name=name)
    return collection
