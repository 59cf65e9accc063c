"""The reader of accessors, held to a slow and obvious twin: any number, shape, place, distance and replacement."""

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from caesura.core.errors import CaesuraError, InvalidModel
from caesura.core.limits import Limits
from caesura.formats.gltf.document import GltfDocument
from caesura.formats.gltf.geometry.accessors import Accessors
from tests.glb import Glb

CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535, 5125: 2**32 - 1}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
BYTES = 3000

often = settings(max_examples=150, deadline=None, derandomize=True, database=None)


@st.composite
def models(draw: st.DrawFn) -> tuple[Glb, bool]:
    """An accessor 0 of any kind that is legal, over bytes of any value; whether it is vertex data."""
    kind, code = draw(st.sampled_from([*WIDTHS])), draw(st.sampled_from([*CODES]))
    size = struct.calcsize(CODES[code])
    count, normalized = draw(st.integers(0, 12)), draw(st.booleans())
    accessor: dict[str, Any] = {"type": kind, "componentType": code, "count": count, "normalized": normalized}
    model, vertex_data = Glb(), draw(st.booleans())
    model.binary.extend(draw(st.randoms(use_true_random=False)).randbytes(BYTES))
    if draw(st.booleans()):
        view: dict[str, Any] = {"buffer": 0, "byteOffset": size * draw(st.integers(0, 20)), "byteLength": 2400}
        least = -(-size * WIDTHS[kind] // 4)  # in steps of four bytes
        if vertex_data and draw(st.booleans()):
            view["byteStride"] = 4 * draw(st.integers(max(least, 1), 40))
        accessor |= {"bufferView": 0, "byteOffset": size * draw(st.integers(0, 20))}
        model.json["bufferViews"].append(view)
    if draw(st.booleans()):
        places = sorted(draw(st.sets(st.integers(0, 11), max_size=count)))
        places = [place for place in places if place < count]
        index = draw(st.sampled_from([5121, 5123, 5125]))
        packed = struct.pack(f"<{len(places)}{CODES[index]}", *places)
        values = {"bufferView": model.view(model.binary[:1000]), "byteOffset": size * draw(st.integers(0, 4))}
        accessor["sparse"] = {
            "count": len(places),
            "indices": {"bufferView": model.view(packed), "componentType": index},
            "values": values,
        }
    model.json["accessors"].append(accessor)
    return model, vertex_data


def twin(model: Glb) -> list[list[float]]:
    """What accessor 0 holds, one number at a time (glTF 2.0, sections 3.6.2.2 to 3.6.2.4)."""
    accessor = model.json["accessors"][0]
    code, width = accessor["componentType"], WIDTHS[accessor["type"]]
    size = struct.calcsize(CODES[code])

    def numbers(part: dict[str, Any], place: int, code: int, width: int) -> list[float]:
        view = model.json["bufferViews"][part["bufferView"]]
        size = struct.calcsize(CODES[code])
        start = view["byteOffset"] + part.get("byteOffset", 0) + place * view.get("byteStride", size * width)
        return [struct.unpack_from("<" + CODES[code], model.binary, start + i * size)[0] for i in range(width)]

    assert size
    elements = [
        numbers(accessor, place, code, width) if "bufferView" in accessor else [0] * width
        for place in range(accessor["count"])
    ]
    if "sparse" in accessor:
        sparse = accessor["sparse"]
        for k in range(sparse["count"]):
            (place,) = numbers(sparse["indices"], k, sparse["indices"]["componentType"], 1)
            elements[int(place)] = numbers(sparse["values"], k, code, width)
    return elements


def read(model: Glb) -> Accessors:
    return Accessors(GltfDocument(memoryview(model.glb()), {}, Limits()))


@often
@given(models())
def test_elements_are_those_of_the_twin(drawn: tuple[Glb, bool]) -> None:
    """As stored, bit by bit."""
    model, vertex_data = drawn
    accessors = read(model)
    layout = accessors.layout(0)
    found = accessors.elements(layout, vertex_data=vertex_data)
    accessors.check(layout, vertex_data=vertex_data)
    expected = np.array(twin(model), layout.dtype).reshape(layout.count, layout.width)
    assert found.tobytes() == expected.tobytes()


@often
@given(models())
def test_floats_are_what_normalized_integers_stand_for(drawn: tuple[Glb, bool]) -> None:
    """Fractions of the largest integer, at least -1; and numbers that are not finite are refused, with the first."""
    model, vertex_data = drawn
    accessor = model.json["accessors"][0]
    expected = np.array(twin(model), np.float64).reshape(accessor["count"], WIDTHS[accessor["type"]])
    if accessor["normalized"] and accessor["componentType"] != 5126:
        expected = np.maximum(expected / LARGEST[accessor["componentType"]], -1)
    accessors = read(model)
    if np.isfinite(expected).all():
        found = accessors.floats(accessors.layout(0), vertex_data=vertex_data)
        assert found.dtype == np.float32
        np.testing.assert_allclose(found, expected, rtol=3e-7, atol=0)
    else:
        with pytest.raises(InvalidModel, match=f"Element {np.argwhere(~np.isfinite(expected))[0][0]} ") as refused:
            accessors.floats(accessors.layout(0), vertex_data=vertex_data)
        assert refused.value.code == "non-finite-data"


@often
@given(models(), st.data())
def test_one_number_changed_is_read_or_refused(drawn: tuple[Glb, bool], data: st.DataObject) -> None:
    """Whatever a place, a length or a distance is changed to: nothing outside the view is read, or else raised."""
    model, vertex_data = drawn
    owners = [model.json["accessors"][0], *model.json["bufferViews"]]
    owners += [part for part in model.json["accessors"][0].get("sparse", {}).values() if isinstance(part, dict)]
    owner = data.draw(st.sampled_from(owners))
    name = data.draw(
        st.sampled_from(["count", "byteOffset", "byteLength", "byteStride", "bufferView", "componentType"])
    )
    owner[name] = data.draw(
        st.one_of(st.integers(-4, 3100), st.sampled_from([2**31, 2**62, 2**64 - 8, None, 1.5, True]))
    )
    try:
        accessors = read(model)
        layout = accessors.layout(0)
        found = accessors.elements(layout, vertex_data=vertex_data)
    except CaesuraError as refused:
        assert refused.code in {"invalid-gltf", "out-of-bounds", "invalid-stride", "limit-exceeded"}  # noqa: PT017
    else:
        expected = np.array(twin(model), layout.dtype).reshape(layout.count, layout.width)
        assert found.tobytes() == expected.tobytes()
