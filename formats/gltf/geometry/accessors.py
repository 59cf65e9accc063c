"""Arrays out of accessors: every bound is checked in Python's integers, which do not wrap, before NumPy sees it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float, Int, Shaped

from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.buffers import Buffers
from caesura.formats.gltf.json_object import JsonObject

COMPONENTS: dict[int, str] = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


@dataclass(frozen=True)
class AccessorLayout:
    """What an accessor says it is: `count` elements of `width` components. Where it lies is checked too.

    With `unpack` its elements come out of compressed geometry and not out of a view of its own.
    """

    entry: JsonObject
    index: int
    count: int
    type: str
    width: int
    dtype: np.dtype[np.generic]
    normalized: bool
    unpack: "Callable[[AccessorLayout], Shaped[np.ndarray, 'count width']] | None" = None


class Accessors:
    """Decodes accessors, within the document's budget of decoded bytes; each use is counted."""

    def __init__(self, document: GltfDocument) -> None:
        self._document = document
        self._buffers = Buffers(document)
        self.layout = cache(self._layout)

    def __len__(self) -> int:
        return len(self._document.accessors)

    def floats(self, layout: AccessorLayout, *, vertex_data: bool = False) -> Float[np.ndarray, "count width"]:
        """Elements as float32, normalized integers as the fractions they stand for; all finite.

        c / (2^b - 1) unsigned, max(c / (2^(b-1) - 1), -1) signed (glTF 2.0, section 3.6.2.2).
        """
        raw = self.elements(layout, vertex_data=vertex_data)
        if raw.dtype.kind == "f":
            values = np.ascontiguousarray(raw, np.float32)
        else:
            self._document.budget.spend(raw.size * 4, layout.entry.pointer)
            values = raw.astype(np.float32)
            if layout.normalized:
                values = np.maximum(values / np.float32(np.iinfo(raw.dtype).max), np.float32(-1))
        if not np.isfinite(values).all():
            where = int(np.argmin(np.isfinite(values).all(axis=1)))
            raise layout.entry.refusal(f"Element {where} is not a finite number.", "non-finite-data")
        return values

    def indices(self, layout: AccessorLayout) -> Int[np.ndarray, "count"]:
        """Elements as places in a list, int64."""
        return self.elements(layout).reshape(-1).astype(np.int64)

    def elements(self, layout: AccessorLayout, *, vertex_data: bool = False) -> Shaped[np.ndarray, "count width"]:
        """Elements as stored; a view of the file where that is possible."""
        entry = layout.entry
        size = layout.count * layout.width * layout.dtype.itemsize
        if layout.unpack is not None:
            self._document.budget.spend(size, entry.pointer)
            return layout.unpack(layout)
        if "bufferView" in entry:
            values = self._strided(layout, *self._place(entry, layout.count, layout.dtype, layout.width, vertex_data))
            self._document.budget.spend(size, entry.pointer)
        else:
            self._document.budget.spend(size, entry.pointer)
            values = np.zeros((layout.count, layout.width), layout.dtype)
        sparse = entry.entry("sparse")
        return values if sparse is None else self._replaced(values, layout, sparse)

    def last(self, layout: AccessorLayout) -> float:
        """The last element of a list of scalars, without reading the others; NaN of an empty list."""
        if layout.count == 0 or "bufferView" not in layout.entry or "sparse" in layout.entry:
            values = self.elements(layout)
        else:
            values = self._strided(layout, *self._place(layout.entry, layout.count, layout.dtype, layout.width, False))
        return float(values[-1, 0]) if len(values) else float("nan")

    def check(self, layout: AccessorLayout, *, vertex_data: bool) -> None:
        """Raise where the accessor does not lie within its view; nothing is decoded."""
        if "bufferView" in layout.entry and layout.unpack is None:
            self._place(layout.entry, layout.count, layout.dtype, layout.width, vertex_data)

    def view(self, number: int) -> memoryview:
        """The bytes of a buffer view that is no list of elements."""
        return self._buffers.view(number)

    def _layout(self, index: int) -> AccessorLayout:
        entry = self._document.accessors[index]
        kind = entry.choice("type", tuple(WIDTHS))
        layout = AccessorLayout(
            entry=entry,
            index=index,
            count=entry.whole("count"),
            type=kind,
            width=WIDTHS[kind],
            dtype=_component(entry, tuple(COMPONENTS)),
            normalized=entry.flag("normalized"),
        )
        if "bufferView" not in entry:
            # Zeros of any number: refused before their count is compared with that of anything else.
            self._document.budget.check(layout.count * layout.width * layout.dtype.itemsize, entry.pointer)
        return layout

    def _place(
        self, entry: JsonObject, count: int, dtype: np.dtype[np.generic], width: int, vertex_data: bool
    ) -> tuple[memoryview, int, int]:
        """Bytes, offset and stride of `count` elements: offset + (count - 1) · stride + size within the view."""
        number = entry.index("bufferView", len(self._document.views), "buffer views")
        view = self._document.views[number]
        data = self._buffers.view(number)
        size = width * dtype.itemsize
        stride = _stride(view, size, vertex_data)
        offset = entry.whole("byteOffset", 0, code="out-of-bounds")
        end = offset + (max(count, 1) - 1) * stride + (size if count else 0)
        if end > len(data):
            raise entry.refusal(f"The accessor ends at byte {end} of a view of {len(data)}.", "out-of-bounds")
        if (offset + view.whole("byteOffset", 0)) % dtype.itemsize:
            self._document.notices.add(
                "misaligned", f"Data at {entry.pointer} is not aligned; it was read all the same."
            )
        return data, offset, stride

    def _strided(
        self, layout: AccessorLayout, data: memoryview, offset: int, stride: int
    ) -> Shaped[np.ndarray, "count width"]:
        shape, strides = (layout.count, layout.width), (stride, layout.dtype.itemsize)
        return np.ndarray(shape, layout.dtype, data, offset, strides) if layout.count else np.zeros(shape, layout.dtype)

    def _replaced(
        self, values: Shaped[np.ndarray, "count width"], layout: AccessorLayout, sparse: JsonObject
    ) -> Shaped[np.ndarray, "count width"]:
        """The elements with some of them replaced (glTF 2.0, section 3.6.2.3)."""
        count = sparse.whole("count")
        if count > layout.count:
            raise sparse.refusal(f"{count} elements of {layout.count} are replaced.", "out-of-bounds")
        places = self._sparse_part(sparse, "indices", count, 1, None).reshape(-1).astype(np.int64)
        if count and (places[-1] >= layout.count or (np.diff(places) <= 0).any()):
            raise sparse.refusal(f"Indices must increase and stay below {layout.count}.", "out-of-bounds")
        replaced = values.copy()
        replaced[places] = self._sparse_part(sparse, "values", count, layout.width, layout.dtype)
        return replaced

    def _sparse_part(
        self, sparse: JsonObject, name: str, count: int, width: int, dtype: np.dtype[np.generic] | None
    ) -> Shaped[np.ndarray, "count width"]:
        entry = sparse.entry(name)
        if entry is None:
            raise sparse.refusal(f"{name} is missing.", name=name)
        dtype = dtype or _component(entry, (5121, 5123, 5125))
        data, offset, stride = self._place(entry, count, dtype, width, False)
        self._document.budget.spend(count * width * dtype.itemsize, sparse.pointer)
        return (
            np.ndarray((count, width), dtype, data, offset, (stride, dtype.itemsize))
            if count
            else np.zeros((0, width), dtype)
        )


def _component(entry: JsonObject, known: tuple[int, ...]) -> np.dtype[np.generic]:
    code = entry.whole("componentType")
    if code not in known:
        raise entry.refusal(f"componentType must be one of {known}, not {code}.", name="componentType")
    return np.dtype(COMPONENTS[code])


def _stride(view: JsonObject, size: int, vertex_data: bool) -> int:
    """Bytes from one element to the next: 4 … 252, a multiple of 4, and for vertex data only."""
    if "byteStride" not in view:
        return size
    stride = view.whole("byteStride", code="invalid-stride")
    if not vertex_data:
        raise view.refusal("byteStride is for vertex data only.", "invalid-stride", "byteStride")
    if not 4 <= stride <= 252 or stride % 4 or stride < size:
        raise view.refusal(
            f"byteStride is {stride} for elements of {size} bytes; it must be a multiple of 4 up to 252.",
            "invalid-stride",
            "byteStride",
        )
    return stride
