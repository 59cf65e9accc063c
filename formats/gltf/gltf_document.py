"""A glTF as the readers of its parts see it: the lists of its JSON, its limits, and what was noted on the way."""

from collections.abc import Mapping
from functools import cached_property

from caesura.core.errors import InvalidModel
from caesura.core.limits import Limits
from caesura.formats.decode_budget import DecodeBudget
from caesura.formats.gltf.container import open_container
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.notices import Notices
from caesura.formats.takes.take_selection import LONGEST, take_name

IGNORABLE_EXTENSIONS = (
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_xmp",
    "VRM",
)
"""Beginnings of the names of extensions that change no vertex by themselves; images and materials are never read."""

READABLE_EXTENSIONS = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
}

COMPRESSED = {"EXT_meshopt_compression", "KHR_meshopt_compression"}
"""Extensions of a buffer view whose bytes are elsewhere, and compressed."""


class GltfDocument:
    """An opened glTF. `data` is the file itself, `parts` what was sent beside it, by name."""

    def __init__(self, data: memoryview, parts: Mapping[str, memoryview], limits: Limits) -> None:
        self.notices = Notices()
        self.limits = limits
        self.budget = DecodeBudget(limits)
        self.parts = parts
        self.root, self.binary, self.is_glb = open_container(data, limits, self.notices)
        check_extensions(self.root)

    @cached_property
    def nodes(self) -> list[JsonObject]:
        """All nodes, of any scene."""
        self.limits.check("max_nodes", len(self.root.values("nodes")), pointer="/nodes")
        return self.root.entries("nodes")

    @cached_property
    def meshes(self) -> list[JsonObject]:
        """All meshes."""
        return self.root.entries("meshes")

    @cached_property
    def skins(self) -> list[JsonObject]:
        """All skins."""
        return self.root.entries("skins")

    @cached_property
    def animations(self) -> list[JsonObject]:
        """All animations, the takes."""
        self.limits.check("max_takes", len(self.root.values("animations")), pointer="/animations")
        return self.root.entries("animations")

    @cached_property
    def take_names(self) -> list[str]:
        """The names of all takes; that one is shortened is noted."""
        given = [entry.value.get("name") for entry in self.animations]
        for name in given:
            if isinstance(name, str) and len(name) > LONGEST:
                self.notices.add(
                    "take-name-shortened", f"{name[:40]!r} … is the name of a take; {LONGEST} letters are kept."
                )
        return [take_name(name, place) for place, name in enumerate(given)]

    @cached_property
    def accessors(self) -> list[JsonObject]:
        """All accessors."""
        return self.root.entries("accessors")

    @cached_property
    def views(self) -> list[JsonObject]:
        """All buffer views."""
        return self.root.entries("bufferViews")

    @cached_property
    def buffers(self) -> list[JsonObject]:
        """All buffers."""
        return self.root.entries("buffers")


def check_extensions(root: JsonObject) -> None:
    """Raise `unsupported-extension` where the file cannot be understood without one that is not read here."""
    for place, name in enumerate(root.values("extensionsRequired")):
        if not isinstance(name, str) or (name not in READABLE_EXTENSIONS and not name.startswith(IGNORABLE_EXTENSIONS)):
            raise unsupported(name if isinstance(name, str) else "?", f"/extensionsRequired/{place}")


def unsupported(name: str, pointer: str) -> InvalidModel:
    """The refusal of an extension, with what to do about it."""
    return InvalidModel(
        "unsupported-extension",
        f"The file needs the extension {name[:80]!r}, not read here. Export the file without it.",
        pointer=pointer,
    )
