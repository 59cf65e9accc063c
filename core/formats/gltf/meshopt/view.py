"""A compressed buffer view: what it must be, and its bytes decoded."""

from typing import NoReturn

import numpy as np

from core.errors import InvalidModel
from core.formats.gltf.entry import Entry
from core.formats.gltf.meshopt.attributes.kernels import attributes
from core.formats.gltf.meshopt.filters import FILTERS
from core.formats.gltf.meshopt.indices.kernels import sequence, triangles

MODES = ("ATTRIBUTES", "TRIANGLES", "INDICES")
LONGEST_ELEMENT = 256


def decoded_size(view: Entry, extension: Entry) -> int:
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


def decode(extension: Entry, data: memoryview) -> memoryview:
    """The bytes of a view that `decoded_size` has seen, from its compressed ones; raises `decompression-failed`."""
    count, stride = extension.whole("count"), extension.whole("byteStride")
    mode, source = extension.text("mode"), np.frombuffer(data, np.uint8)
    if mode == "ATTRIBUTES":
        elements = np.zeros((count, stride), np.uint8)
        good = attributes(source, elements)
        undo, _ = FILTERS[extension.text("filter", "NONE")]
        if good and undo is not None and count:
            with np.errstate(all="ignore"):
                elements = undo(elements)
    else:
        corners = np.zeros(count, np.int64)
        good = triangles(source, corners.reshape(-1, 3)) if mode == "TRIANGLES" else sequence(source, corners)
        elements = corners.astype(f"<u{stride}").view(np.uint8).reshape(count, stride)
    if not good:
        _fail(extension, "breaks off, or goes on after its end")
    return elements.reshape(-1).data


def _fail(extension: Entry, what: str) -> NoReturn:
    raise InvalidModel(
        "decompression-failed", f"The compressed view {what}. Export the file again.", pointer=extension.pointer
    )
