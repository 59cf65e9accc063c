"""Takes as gltfpack writes them: keys of one size in one view, compressed by meshoptimizer's codec."""

import base64

import numpy as np

from tests.formats.clips.making import chunks_of
from tests.formats.gltf.test_meshopt import literal
from tests.glb import Glb

EXTENSION = "EXT_meshopt_compression"
BYTES = {"SCALAR": 4, "VEC3": 12, "VEC4": 16}


def compressed(model: Glb, *, required: bool = True) -> Glb:
    """The model with its keys compressed; where that is not `required`, beside the plain bytes."""
    packed = Glb(**model.json | {"bufferViews": [], "accessors": []})
    strips: dict[int, bytearray] = {}
    for number, accessor in enumerate(model.json["accessors"]):
        data, strip = bytes_of(model, number), strips.setdefault(BYTES.get(accessor["type"], 0), bytearray())
        if number in keys_of(model):
            place = {"bufferView": -BYTES[accessor["type"]], "byteOffset": len(strip)}
            strip += data
        else:
            place = {"bufferView": packed.view(data)}
        packed.json["accessors"].append(accessor | place)
    plain = bytearray()
    for stride in filter(None, strips):
        number = _compress(packed, strips[stride], stride, len(plain))
        plain += strips[stride]
        for accessor in packed.json["accessors"]:
            accessor["bufferView"] = number if accessor["bufferView"] == -stride else accessor["bufferView"]
    stand_in = {"byteLength": len(plain), "extensions": {EXTENSION: {"fallback": True}}}
    uri = {} if required else {"uri": "data:;base64," + base64.b64encode(plain).decode()}
    packed.json["buffers"] = [{"byteLength": len(packed.binary)}, stand_in | uri]
    packed.json |= {"extensionsUsed": [EXTENSION]} | ({"extensionsRequired": [EXTENSION]} if required else {})
    return packed


def streams_of(glb: bytes) -> dict[int, bytes]:
    """What compressed views are decoded from, by the size of a key; the first view of each."""
    root, binary = chunks_of(glb)
    found: dict[int, bytes] = {}
    for view in root["bufferViews"]:
        if stream := view.get("extensions", {}).get(EXTENSION):
            found.setdefault(stream["byteStride"], binary[stream["byteOffset"] :][: stream["byteLength"]])
    return found


def bytes_of(model: Glb, number: int) -> bytes:
    """What an accessor with a view of its own is made of."""
    view = model.json["bufferViews"][model.json["accessors"][number]["bufferView"]]
    return bytes(model.binary[view["byteOffset"] :][: view["byteLength"]])


def keys_of(model: Glb) -> set[int]:
    """Accessors that animations name."""
    samplers = [sampler for animation in model.json["animations"] for sampler in animation["samplers"]]
    return {sampler[name] for sampler in samplers for name in ("input", "output")}


def _compress(packed: Glb, strip: bytearray, stride: int, offset: int) -> int:
    elements = np.frombuffer(strip, np.uint8).reshape(-1, stride)
    number = packed.view(literal(elements))
    more = {"byteStride": stride, "count": len(elements), "mode": "ATTRIBUTES"}
    stream = packed.json["bufferViews"][number] | more
    view = {"buffer": 1, "byteOffset": offset, "byteLength": len(strip), "extensions": {EXTENSION: stream}}
    packed.json["bufferViews"][number] = view
    return number
