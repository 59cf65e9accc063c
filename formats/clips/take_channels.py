"""The channels of the take, as they stand in the JSON: those too that an extension defines."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from caesura.formats.clips.animation_replacement import AnimationReplacement
from caesura.formats.clips.channel_keys import ChannelKeys, key_layout, read_keys
from caesura.formats.gltf.geometry.accessors import AccessorLayout
from caesura.formats.gltf.json_object import JsonObject

NODE_PATHS = frozenset({"translation", "rotation", "scale"})
"""What has a meaning without meshes."""
EDITED_MEMBERS = ("input", "output", "interpolation")


@dataclass(frozen=True)
class TakeChannel:
    """`target` is what moves, word for word; `output` is where its keys are stored; `more` else of its sampler."""

    target: dict[str, Any]
    keys: ChannelKeys
    output: AccessorLayout
    sampler_extras: dict[str, Any]


def take_channels(file: AnimationReplacement, take: int, *, nodes_only: bool = False) -> Iterator[TakeChannel]:
    """One after the other, so that the keys of one alone are decoded at a time."""
    animation = file.document.animations[take]
    samplers = animation.entries("samplers")
    for entry in animation.entries("channels"):
        target = entry.entry("target") or JsonObject({}, entry.pointer)
        path = target.text("path")
        if nodes_only and path not in NODE_PATHS:
            continue
        sampler = samplers[entry.index("sampler", len(samplers), "samplers", "invalid-animation")]
        keys = read_keys(file.accessors, sampler, path == "rotation" or _is_rotation(target))
        more = {name: value for name, value in sampler.value.items() if name not in EDITED_MEMBERS}
        yield TakeChannel(target.value, keys, key_layout(file.accessors, sampler, "output"), more)


def _is_rotation(target: JsonObject) -> bool:
    pointer = target.extension("KHR_animation_pointer")
    return pointer is not None and pointer.text("pointer", "").endswith("/rotation")


class ClipTracks:
    """The channels and samplers of one new animation, as its JSON. What moves alike shares a sampler."""

    def __init__(self) -> None:
        self.channels: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []

    def add(self, target: dict[str, Any], sampler: dict[str, Any]) -> None:
        """One more channel."""
        if sampler not in self.samplers:
            self.samplers.append(sampler)
        self.channels.append({"sampler": self.samplers.index(sampler), "target": target})

    def animation(self, name: str, source: dict[str, Any], extras: dict[str, Any]) -> dict[str, Any]:
        """The animation, with what the take had besides its movement."""
        more = {key: value for key, value in source.items() if key not in {"name", "channels", "samplers", "extras"}}
        before = source.get("extras")
        kept = before if isinstance(before, dict) else {}
        return {
            "name": name, **more, "extras": {**kept, "caesura": extras},
            "channels": self.channels, "samplers": self.samplers,
        }  # fmt: skip
