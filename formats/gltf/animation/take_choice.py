"""Which animation of a file is the take, and how long it is."""

from dataclasses import dataclass

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.animation.channels import Channel, read_channels
from caesura.formats.gltf.geometry.accessors import Accessors
from caesura.formats.gltf.gltf_document import GltfDocument
from caesura.formats.takes.take_selection import select_take


@dataclass(frozen=True)
class ChosenTake:
    """An animation's place in the file, its name, and what it moves."""

    index: int
    name: str
    channels: list[Channel]


def find_chosen_takes(document: GltfDocument, accessors: Accessors, wanted: str | int) -> list[ChosenTake]:
    """The take that is wanted, or with `all` every take that moves something; raises as `choose_animation` does."""
    if wanted != "all" or len(document.animations) < 2 or "all" in document.take_names:
        return [
            ChosenTake(
                *choose_animation(
                    document, accessors, "longest" if wanted == "all" and "all" not in document.take_names else wanted
                )
            )
        ]
    names = document.take_names
    every = [
        ChosenTake(place, names[place], read_channels(document, accessors, entry))
        for place, entry in enumerate(document.animations)
    ]
    moving = [take for take in every if take.channels]
    return moving or [ChosenTake(*choose_animation(document, accessors, "longest"))]


def choose_animation(document: GltfDocument, accessors: Accessors, wanted: str | int) -> tuple[int, str, list[Channel]]:
    """The chosen animation's place, name and channels; the longest, the first on ties, unless one is named.

    Raises `no-animation` saying what the file has instead, or `ParameterError` for a take that is not there.
    """
    animations = document.animations
    if not animations:
        raise InvalidModel(
            "no-animation",
            f"Nothing is animated in the file; it has {len(document.meshes)} meshes, {len(document.skins)} skins and "
            f"{len(document.nodes)} nodes. Export it with its animations.",
            pointer="/animations",
        )
    names = document.take_names
    place = select_take(names, wanted) if len(names) > 1 or wanted != "longest" else 0
    if place is None:
        lengths = [last_key_seconds(accessors, read_channels(document, accessors, entry)) for entry in animations]
        place = max(range(len(animations)), key=lengths.__getitem__)
    channels = read_channels(document, accessors, animations[place])
    if not channels:
        raise InvalidModel("no-animation", f"Take {names[place]!r} moves nothing.", pointer=animations[place].pointer)
    return place, names[place], channels


def last_key_seconds(accessors: Accessors, channels: list[Channel]) -> float:
    """Seconds of the last key, which is how long a take is; -1 where nothing moves."""
    inputs = {channel.input.index: channel.input for channel in channels}
    return max((accessors.last_scalar(layout) for layout in inputs.values()), default=-1.0)
