"""What an animation moves: its channels, checked, their keys not yet read."""

from dataclasses import dataclass

from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.accessors import AccessorLayout, Accessors
from caesura.formats.gltf.json_object import JsonObject

WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}
INTERPOLATIONS = ("STEP", "LINEAR", "CUBICSPLINE")


@dataclass(frozen=True)
class Channel:
    """`path` of `node` follows `output` at the times of `input`."""

    node: int
    path: str
    interpolation: str
    input: AccessorLayout
    output: AccessorLayout
    entry: JsonObject


def read_channels(document: GltfDocument, accessors: Accessors, animation: JsonObject) -> list[Channel]:
    """The channels that move a node; raises `invalid-animation`, also where two move the same thing."""
    samplers = animation.entries("samplers")
    channels: dict[tuple[int, str], Channel] = {}
    for entry in animation.entries("channels"):
        channel = _channel(document, accessors, samplers, entry)
        if channel is None:
            continue
        if (channel.node, channel.path) in channels:
            raise entry.refusal(f"The {channel.path} of node {channel.node} is animated twice.", "invalid-animation")
        channels[channel.node, channel.path] = channel
    return list(channels.values())


def _channel(
    document: GltfDocument, accessors: Accessors, samplers: list[JsonObject], entry: JsonObject
) -> Channel | None:
    target = entry.entry("target")
    if target is None:
        raise entry.refusal("The channel has no target.", "invalid-animation", "target")
    sampler = samplers[entry.index("sampler", len(samplers), "samplers", "invalid-animation")]
    path = target.text("path")
    if path == "pointer" or (path not in {*WIDTHS, "weights"} and "extensions" in target):
        document.notices.add("channel-skipped", f"{entry.pointer} animates what an extension defines; it was left out.")
        return None
    target.choice("path", (*WIDTHS, "weights"))
    if "node" not in target:
        return None
    node = target.index("node", len(document.nodes), "nodes", "invalid-animation")
    if path in WIDTHS and "matrix" in document.nodes[node]:
        raise entry.refusal(f"Node {node} has a matrix and cannot have its {path} animated.", "invalid-animation")
    channel = Channel(
        node=node,
        path=path,
        interpolation=sampler.choice("interpolation", INTERPOLATIONS, "LINEAR"),
        input=accessors.layout(sampler.index("input", len(accessors), "accessors", "invalid-animation")),
        output=accessors.layout(sampler.index("output", len(accessors), "accessors", "invalid-animation")),
        entry=sampler,
    )
    _check(document, channel)
    return channel


def _check(document: GltfDocument, channel: Channel) -> None:
    if channel.input.type != "SCALAR" or channel.input.dtype.kind != "f" or channel.input.count == 0:
        raise channel.entry.refusal("Key times must be one float or more.", "invalid-animation", "input")
    width, kind = values_per_key(document, channel)
    needed = channel.input.count * (3 if channel.interpolation == "CUBICSPLINE" else 1)
    given = channel.output.count if channel.path != "weights" else channel.output.count / width
    if given != needed or channel.output.type != kind:
        raise channel.entry.refusal(
            f"{channel.input.count} keys of {channel.path} ({channel.interpolation}) need {needed} values of {kind}, "
            f"not {given:g} of {channel.output.type}.",
            "invalid-animation",
            "output",
        )


def values_per_key(document: GltfDocument, channel: Channel) -> tuple[int, str]:
    """Numbers in one key of a channel, and the type of its accessor."""
    if channel.path != "weights":
        return WIDTHS[channel.path], f"VEC{WIDTHS[channel.path]}"
    targets = morph_targets(document, document.nodes[channel.node])
    if not targets:
        raise channel.entry.refusal(f"Node {channel.node} has no morph targets to animate.", "invalid-animation")
    return targets, "SCALAR"


def morph_targets(document: GltfDocument, node: JsonObject) -> int:
    """How many morph targets the mesh of a node has."""
    if "mesh" not in node:
        return 0
    mesh = document.meshes[node.index("mesh", len(document.meshes), "meshes")]
    return max((len(primitive.values("targets")) for primitive in mesh.entries("primitives")), default=0)
