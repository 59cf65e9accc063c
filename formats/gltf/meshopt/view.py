"""A compressed buffer view: what it must be, and its bytes decoded."""

from typing import NoReturn

import numpy as np
from jaxtyping import UInt8

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.meshopt.filters import FILTERS
from caesura.formats.kernels.meshopt_attributes import decode_attributes
from caesura.formats.kernels.meshopt_indices import decode_index_sequence, decode_triangles

MODES = ("ATTRIBUTES", "TRIANGLES", "INDICES")
LONGEST_ELEMENT = 256

MOST_TIMES = 1024
"""So many bytes come out of one at most: a quarter of one says that 256 are as those before."""


def decoded_size(view: JsonObject, extension: JsonObject) -> int:
    """Bytes that come out, which must be as many as the view says; raises `decompression-failed`."""
    count, stride = extension.whole("count"), extension.whole("byteStride")
    if count * stride != view.whole("byteLength", code="out-of-bounds") or view.whole("byteStride", stride) != stride:
        _fail(extension, f"says {count} elements of {stride} bytes, and the view is of another size")
    mode = extension.choice("mode", MODES)
    _, strides = FILTERS[extension.choice("filter", tuple(FILTERS), "NONE")]
    if mode == "ATTRIBUTES":
        fits = 0 < stride <= LONGEST_ELEMENT and stride % 4 == 0 and (not strides or stride in strides)
    else:
        fits = stride in (2, 4) and extension.text("filter", "NONE") == "NONE" and (mode == "INDICES" or count % 3 == 0)
    if not fits:
        _fail(extension, f"cannot have {count} elements of {stride} bytes in this mode and filter")
    return count * stride


def decode_view(extension: JsonObject, data: memoryview) -> memoryview:
    """The bytes of a view that `decoded_size` has seen, from its compressed ones; raises `decompression-failed`."""
    count, stride = extension.whole("count"), extension.whole("byteStride")
    mode, source = extension.text("mode"), np.frombuffer(data, np.uint8)
    if mode == "ATTRIBUTES":
        elements = _attributes(extension, data)
        undo, _ = FILTERS[extension.text("filter", "NONE")]
        if undo is not None and count:
            with np.errstate(all="ignore"):
                elements = undo(elements)
        return elements.reshape(-1).data
    corners = np.zeros(count, np.int64)
    if not (
        decode_triangles(source, corners.reshape(-1, 3))
        if mode == "TRIANGLES"
        else decode_index_sequence(source, corners)
    ):
        _broken(extension)
    return corners.astype(f"<u{stride}").view(np.uint8).reshape(-1).data


def _attributes(extension: JsonObject, data: memoryview) -> UInt8[np.ndarray, "count stride"]:
    """Attributes as the codec has them, before any filter."""
    shape = extension.whole("count"), extension.whole("byteStride")
    if shape[0] * shape[1] > MOST_TIMES * len(data):
        _broken(extension)
    elements = np.zeros(shape, np.uint8)
    if not decode_attributes(np.frombuffer(data, np.uint8), elements):
        _broken(extension)
    return elements


def _broken(extension: JsonObject) -> NoReturn:
    _fail(extension, "breaks off, or goes on after its end")


def _fail(extension: JsonObject, what: str) -> NoReturn:
    raise InvalidModel(
        "decompression-failed", f"The compressed view {what}. Export the file again.", pointer=extension.pointer
    )
