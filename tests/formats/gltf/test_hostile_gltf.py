"""Hostile glTF: one mutation of a good file each, and the code it is refused with. Never a traceback, never a hang."""

import json
import struct
from collections.abc import Callable
from typing import Any
from urllib.parse import quote

import numpy as np
import pytest

from caesura.core.errors import BrokenContainer, CaesuraError, InputError, InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from tests.formats.opening import codes, opened
from tests.glb import Glb, bending_strip, chunks, moving_square, square

Mutation = Callable[[Glb], object]
Row = tuple[str, Mutation, str, str | None]

POSITIONS, INDICES, TIMES, MOVES = 0, 1, 2, 3  # accessors of the moving square
JOINTS, WEIGHTS, DISPLACED, BIND = 1, 2, 4, 5  # accessors of the bending strip


def _set(*path: Any) -> Mutation:
    """Put the last of `path` at the rest of it."""
    *way, name, value = path

    def mutate(model: Glb) -> None:
        owner: Any = model.json
        for step in way:
            owner = owner[step]
        owner[name] = value

    return mutate


def _accessor(index: int, **members: Any) -> Mutation:
    return lambda model: model.json["accessors"][index].update(members)


def _view(index: int, **members: Any) -> Mutation:
    return lambda model: model.json["bufferViews"][index].update(members)


def _node(index: int, **members: Any) -> Mutation:
    return lambda model: model.json["nodes"][index].update(members)


def _primitive(**members: Any) -> Mutation:
    return lambda model: model.json["meshes"][0]["primitives"][0].update(members)


def _attribute(name: str, values: Any, dtype: str = "float32") -> Mutation:
    def mutate(model: Glb) -> None:
        model.json["meshes"][0]["primitives"][0]["attributes"][name] = model.accessor(values, dtype)

    return mutate


def _data(index: int, place: int, value: float, kind: str = "<f") -> Mutation:
    """Overwrite one number of an accessor's data."""

    def mutate(model: Glb) -> None:
        start = model.json["bufferViews"][model.json["accessors"][index]["bufferView"]]["byteOffset"]
        struct.pack_into(kind, model.binary, start + place * struct.calcsize(kind), value)

    return mutate


def _sampler(**members: Any) -> Mutation:
    return lambda model: model.json["animations"][0]["samplers"][0].update(members)


def _target(**members: Any) -> Mutation:
    return lambda model: model.json["animations"][0]["channels"][0]["target"].update(members)


def _sparse(count: Any, places: list[int]) -> Mutation:
    def mutate(model: Glb) -> None:
        model.json["accessors"][POSITIONS]["sparse"] = {
            "count": count,
            "indices": {"bufferView": model.view(np.array(places, "<u2").tobytes()), "componentType": 5123},
            "values": {"bufferView": model.view(np.zeros((len(places), 3), "<f4").tobytes())},
        }

    return mutate


def _uri(uri: str) -> Mutation:
    return lambda model: model.json.update(buffers=[{"byteLength": len(model.binary), "uri": uri}])


def _nodes(*nodes: dict[str, Any]) -> Mutation:
    return lambda model: model.json["nodes"].extend(nodes)


def _twice_animated(model: Glb) -> None:
    channels = model.json["animations"][0]["channels"]
    channels.append(channels[0])


def _short_times(model: Glb) -> None:
    model.json["accessors"][MOVES]["count"] -= 1


def _short_target(model: Glb) -> None:
    _primitive(targets=[{"POSITION": model.accessor(np.zeros((3, 3)))}])(model)


def _other_targets(model: Glb) -> None:
    """A second primitive with two morph targets where the first has one."""
    first = model.json["meshes"][0]["primitives"][0]
    first["targets"] = [{"POSITION": POSITIONS}]
    model.json["meshes"][0]["primitives"].append(first | {"targets": [{"POSITION": POSITIONS}] * 2})


def _no_weights(model: Glb) -> None:
    del model.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"]


def _no_targets(model: Glb) -> None:
    del model.json["meshes"][0]["primitives"][0]["targets"]


def _ladder(model: Glb) -> None:
    """Forty nodes, each with the next one twice: 2^40 paths."""
    first = len(model.json["nodes"])
    model.json["nodes"] += [{"children": [first + i + 1] * 2} for i in range(40)] + [{}]


STRUCTURE: list[Row] = [
    ("glTF 1.0", _set("asset", "version", "1.0"), "unsupported-gltf-version", "/asset/version"),
    ("no version", _set("asset", {}), "unsupported-gltf-version", "/asset/version"),
    ("asset is a list", _set("asset", []), "unsupported-gltf-version", "/asset/version"),
    ("minVersion 2.1", _set("asset", "minVersion", "2.1"), "unsupported-gltf-version", "/asset/version"),
    ("unknown extension", _set("extensionsRequired", ["X_y"]), "unsupported-extension", "/extensionsRequired/0"),
    ("extension is a number", _set("extensionsRequired", [1]), "unsupported-extension", "/extensionsRequired/0"),
    ("extension is an object", _set("extensionsRequired", [{}]), "unsupported-extension", "/extensionsRequired/0"),
    ("accessors is null", _set("accessors", None), "invalid-gltf", "/accessors"),
    ("nodes is an object", _set("nodes", {}), "invalid-gltf", "/nodes"),
    ("a node is a number", _set("nodes", 0, 7), "invalid-gltf", "/nodes/0"),
    ("mesh is true", _node(0, mesh=True), "invalid-gltf", "/nodes/0/mesh"),
    ("mesh is -1", _node(0, mesh=-1), "invalid-gltf", "/nodes/0/mesh"),
    ("mesh is 0.0", _node(0, mesh=0.0), "invalid-gltf", "/nodes/0/mesh"),
]

ACCESSORS: list[Row] = [
    *(
        (f"count {count!r}", _accessor(POSITIONS, count=count), "invalid-gltf", "/accessors/0/count")
        for count in ("10", 10.5, True, None, -1, [4])
    ),
    ("no count", lambda m: m.json["accessors"][POSITIONS].pop("count"), "invalid-gltf", "/accessors/0/count"),
    ("unknown component type", _accessor(POSITIONS, componentType=5124), "invalid-gltf", "/accessors/0/componentType"),
    ("unknown type", _accessor(POSITIONS, type="VEC5"), "invalid-gltf", "/accessors/0/type"),
    ("normalized is 1", _accessor(POSITIONS, normalized=1), "invalid-gltf", "/accessors/0/normalized"),
    ("view out of range", _accessor(POSITIONS, bufferView=99), "invalid-gltf", "/accessors/0/bufferView"),
    ("view -1", _accessor(POSITIONS, bufferView=-1), "invalid-gltf", "/accessors/0/bufferView"),
    ("one element too long", _accessor(INDICES, count=7), "out-of-bounds", "/accessors/1"),
    ("offset past the view", _accessor(INDICES, byteOffset=2), "out-of-bounds", "/accessors/1"),
    ("count 2^62", _accessor(INDICES, count=2**62), "out-of-bounds", "/accessors/1"),
    ("offset 2^64 - 8", _accessor(INDICES, byteOffset=2**64 - 8), "out-of-bounds", "/accessors/1"),
    ("negative offset", _accessor(INDICES, byteOffset=-4), "out-of-bounds", "/accessors/1/byteOffset"),
    ("view past its buffer", _view(1, byteLength=10**6), "out-of-bounds", "/bufferViews/1"),
    ("view at a negative offset", _view(1, byteOffset=-4), "out-of-bounds", "/bufferViews/1/byteOffset"),
    ("view of length -1", _view(1, byteLength=-1), "out-of-bounds", "/bufferViews/1/byteLength"),
    ("buffer longer than its data", _set("buffers", [{"byteLength": 10**6}]), "out-of-bounds", "/buffers/0"),
    ("buffer of length -1", _set("buffers", [{"byteLength": -1}]), "out-of-bounds", "/buffers/0/byteLength"),
    *(
        (f"stride {stride}", _view(0, byteStride=stride), "invalid-stride", "/bufferViews/0/byteStride")
        for stride in (0, 1, 3, 8, -12, 14, 256, 10**9)
    ),
    ("stride on indices", _view(1, byteStride=4), "invalid-stride", "/bufferViews/1/byteStride"),
    ("stride on key times", _view(2, byteStride=4), "invalid-stride", "/bufferViews/2/byteStride"),
    ("view is null", _accessor(MOVES, bufferView=None), "invalid-gltf", "/accessors/3/bufferView"),
    ("sparse index too large", _sparse(2, [1, 4]), "out-of-bounds", "/accessors/0/sparse"),
    ("sparse indices not increasing", _sparse(2, [2, 2]), "out-of-bounds", "/accessors/0/sparse"),
    ("more sparse than elements", _sparse(5, [0, 1, 2, 3, 3]), "out-of-bounds", "/accessors/0/sparse"),
    ("sparse count 2e9", _sparse(2 * 10**9, [0]), "out-of-bounds", "/accessors/0/sparse"),
    (
        "sparse without values",
        _set("accessors", 0, "sparse", {"count": 1}),
        "invalid-gltf",
        "/accessors/0/sparse/indices",
    ),
]

GEOMETRY: list[Row] = [
    ("index out of range", _data(INDICES, 4, 4, "<H"), "index-out-of-range", "/accessors/1"),
    ("restart value", _data(INDICES, 0, 65535, "<H"), "index-out-of-range", "/accessors/1"),
    ("float indices", lambda m: _primitive(indices=m.accessor([0, 1, 2]))(m), "index-out-of-range", None),
    ("mode 7", _primitive(mode=7), "invalid-gltf", "/meshes/0/primitives/0/mode"),
    ("mode as text", _primitive(mode="TRIANGLES"), "invalid-gltf", "/meshes/0/primitives/0/mode"),
    ("no positions", _primitive(attributes={}), "no-mesh", "/meshes"),
    ("no primitives", _set("meshes", 0, "primitives", []), "no-mesh", None),
    ("points only", _primitive(mode=0), "no-mesh", None),
    ("no vertices", _accessor(POSITIONS, count=0), "no-mesh", None),
    ("positions VEC2", _accessor(POSITIONS, type="VEC2"), "invalid-gltf", "/accessors/0/type"),
    ("fewer normals than positions", _attribute("NORMAL", np.zeros((3, 3))), "invalid-gltf", None),
    ("NaN position", _data(POSITIONS, 4, np.nan), "non-finite-data", "/accessors/0"),
    ("infinite position", _data(POSITIONS, 0, np.inf), "non-finite-data", "/accessors/0"),
    ("target of other count", _short_target, "invalid-gltf", None),
    ("primitives of other targets", _other_targets, "invalid-gltf", "/meshes/0/primitives"),
]

GRAPH: list[Row] = [
    ("its own child", _node(0, children=[0]), "invalid-node-graph", "/nodes/0"),
    ("a cycle", _nodes({"children": [2]}, {"children": [1]}), "invalid-node-graph", None),
    ("two parents", _nodes({"children": [3]}, {"children": [3]}, {}), "invalid-node-graph", "/nodes/3"),
    ("2^40 paths", _ladder, "invalid-node-graph", None),
    ("child out of range", _node(0, children=[9]), "invalid-node-graph", "/nodes/0/children/0"),
    ("child is true", _node(0, children=[True]), "invalid-node-graph", "/nodes/0/children/0"),
    ("scene out of range", _set("scene", 3), "invalid-node-graph", "/scene"),
    ("scene with a node that is not", _set("scenes", [{"nodes": [5]}]), "invalid-node-graph", "/scenes/0/nodes/0"),
    ("scene with a node twice", _set("scenes", [{"nodes": [0, 0]}]), "invalid-node-graph", None),
    ("matrix of 3 numbers", _nodes({"matrix": [1, 0, 0]}), "invalid-gltf", "/nodes/1/matrix"),
    ("translation of 2 numbers", _node(0, translation=[1, 0]), "invalid-gltf", "/nodes/0/translation"),
    ("translation of text", _node(0, translation=["1", 0, 0]), "invalid-gltf", "/nodes/0/translation"),
    (
        "translation of an endless number",
        _node(0, translation=[10**400, 0, 0]),
        "non-finite-data",
        "/nodes/0/translation",
    ),
    ("a quaternion whose square is zero", _node(0, rotation=[0, 0, 0, 1e-200]), "invalid-gltf", "/nodes/0/rotation"),
    ("zero quaternion", _node(0, rotation=[0, 0, 0, 0]), "invalid-gltf", "/nodes/0/rotation"),
]

SKINS: list[Row] = [
    ("joint beyond the skin", _data(JOINTS, 0, 2, "<B"), "invalid-skin", "/meshes/0/primitives/0"),
    ("joint that is no node", _set("skins", 0, "joints", [1, 9]), "invalid-skin", "/skins/0/joints/1"),
    ("joint -1", _set("skins", 0, "joints", [1, -1]), "invalid-skin", "/skins/0/joints/1"),
    ("no joints", _set("skins", 0, "joints", []), "invalid-skin", "/skins/0/joints"),
    ("skin out of range", _node(0, skin=4), "invalid-gltf", "/nodes/0/skin"),
    ("too few bind matrices", _accessor(BIND, count=1), "invalid-skin", "/skins/0/inverseBindMatrices"),
    ("NaN in a bind matrix", _data(BIND, 3, np.nan), "non-finite-data", "/accessors/5"),
    ("NaN weight", _data(WEIGHTS, 0, np.nan), "non-finite-data", "/accessors/2"),
    ("weight 1e38", _data(WEIGHTS, 0, 1e38), "non-finite-data", "/meshes/0/primitives/0/attributes"),
    ("skins is null", _set("skins", None), "invalid-gltf", "/skins"),
    ("joints without weights", _no_weights, "invalid-gltf", None),
    ("weights as VEC3", _accessor(WEIGHTS, type="VEC3"), "invalid-gltf", None),
    ("weights of targets that are gone", _no_targets, "invalid-animation", None),
]

ANIMATIONS: list[Row] = [
    ("NaN key time", _data(TIMES, 3, np.nan), "non-finite-data", "/accessors/2"),
    ("infinite key time", _data(TIMES, 30, np.inf), "non-finite-data", "/accessors/2"),
    ("decreasing key times", _data(TIMES, 3, 0.9), "invalid-animation", "/accessors/2"),
    ("negative key time", _data(TIMES, 0, -1), "invalid-animation", "/accessors/2"),
    ("1e9 seconds", _data(TIMES, 30, 1e9), "animation-too-long", None),
    ("3e38 seconds", _data(TIMES, 30, 3e38), "animation-too-long", None),
    ("NaN translation", _data(MOVES, 0, np.nan), "non-finite-data", "/accessors/3"),
    ("one value too few", _short_times, "invalid-animation", "/animations/0/samplers/0/output"),
    ("a spline without tangents", _sampler(interpolation="CUBICSPLINE"), "invalid-animation", None),
    (
        "unknown interpolation",
        _sampler(interpolation="SMOOTH"),
        "invalid-gltf",
        "/animations/0/samplers/0/interpolation",
    ),
    ("unknown path", _target(path="colour"), "invalid-gltf", "/animations/0/channels/0/target/path"),
    ("weights without morph targets", _target(path="weights"), "invalid-animation", None),
    ("rotations of three numbers", _target(path="rotation"), "invalid-animation", None),
    ("animated twice", _twice_animated, "invalid-animation", "/animations/0/channels/1"),
    ("target is not a node", _target(node=7), "invalid-animation", "/animations/0/channels/0/target/node"),
    ("no such sampler", _set("animations", 0, "channels", 0, "sampler", 5), "invalid-animation", None),
    ("animated node has a matrix", _node(0, matrix=np.eye(4).ravel().tolist()), "invalid-animation", None),
    ("no channels", _set("animations", 0, "channels", []), "no-animation", "/animations/0"),
    (
        "a spline of zero rotations",
        lambda m: m.animate(0, "rotation", [0, 1], np.zeros((6, 4)), "CUBICSPLINE"),
        "invalid-gltf",
        "/accessors/5",
    ),
    ("no keys", lambda m: (_accessor(TIMES, count=0)(m), _accessor(MOVES, count=0)(m)), "invalid-animation", None),
]

RESOURCES: list[Row] = [
    *(
        (f"uri {uri}", _uri(uri), "external-resource", "/buffers/0/uri")
        for uri in (
            "file:///etc/passwd", "/etc/passwd", "../secret.bin", "a/../../b", "%2e%2e/secret.bin", "\\\\host\\share",
            "http://169.254.169.254/", "//host/x", "/dev/zero", "missing.bin", "C:\\x.bin", "",
        )
    ),
    ("bad base64", _uri("data:application/octet-stream;base64,!!!!"), "invalid-data-uri", "/buffers/0/uri"),
    ("unpadded base64", _uri("data:application/octet-stream;base64,AAAAA"), "invalid-data-uri", "/buffers/0/uri"),
    ("no base64", _uri("data:application/octet-stream,abc"), "invalid-data-uri", "/buffers/0/uri"),
    ("short data", _uri("data:application/octet-stream;base64,AAAA"), "invalid-data-uri", "/buffers/0"),
    ("uri is a number", _set("buffers", [{"byteLength": 4, "uri": 4}]), "invalid-gltf", "/buffers/0/uri"),
]  # fmt: skip


def _params(base: Callable[[], Glb], rows: list[Row]) -> list[Any]:
    return [pytest.param(base, mutate, code, pointer, id=name) for name, mutate, code, pointer in rows]


@pytest.mark.parametrize(
    ("base", "mutate", "code", "pointer"),
    [
        *_params(moving_square, STRUCTURE + ACCESSORS + GEOMETRY + GRAPH + ANIMATIONS + RESOURCES),
        *_params(bending_strip, SKINS),
    ],
)
def test_a_hostile_model_is_refused_by_name(
    base: Callable[[], Glb], mutate: Mutation, code: str, pointer: str | None
) -> None:
    """One mutation of a good file: an error of ours, with its code, and where it is."""
    model = base()
    opened(model.glb())
    mutate(model)
    with pytest.raises(CaesuraError) as refused:
        opened(model.glb())
    assert refused.value.code == code
    if pointer is not None:
        assert refused.value.where["pointer"] == pointer
    json.dumps(refused.value.problem()).encode()


GOOD = moving_square().complete()
TEXT, BINARY = json.dumps(GOOD).encode(), bytes(moving_square().binary)
WHOLE = chunks((b"JSON", TEXT), (b"BIN\0", BINARY))

CONTAINERS: list[tuple[str, bytes, str]] = [
    ("version 1", chunks((b"JSON", TEXT), version=1), "unsupported-gltf-version"),
    ("header only", WHOLE[:12], "malformed-glb"),
    ("four bytes", WHOLE[:4], "malformed-glb"),
    ("cut within its JSON", WHOLE[:200], "malformed-glb"),
    ("cut within its data", WHOLE[:-8], "malformed-glb"),
    ("length 0", chunks((b"JSON", TEXT), length=0), "malformed-glb"),
    ("length cuts its data", chunks((b"JSON", TEXT), (b"BIN\0", BINARY), length=len(WHOLE) - 4), "malformed-glb"),
    ("length past its end", chunks((b"JSON", TEXT), length=2**32 - 1), "malformed-glb"),
    ("empty JSON", chunks((b"JSON", b"")), "malformed-glb"),
    ("chunk longer than the file", WHOLE[:12] + struct.pack("<I4s", 2**32 - 1, b"JSON") + WHOLE[20:], "malformed-glb"),
    ("data first", chunks((b"BIN\0", BINARY), (b"JSON", TEXT)), "malformed-glb"),
    ("two JSON", chunks((b"JSON", TEXT), (b"JSON", TEXT)), "malformed-glb"),
    ("two data", chunks((b"JSON", TEXT), (b"BIN\0", BINARY), (b"BIN\0", BINARY)), "malformed-glb"),
    ("17 chunks", chunks((b"JSON", TEXT), *[(b"more", b"")] * 16), "malformed-glb"),
    ("a million chunks", chunks((b"JSON", TEXT), *[(b"more", b"")] * 10**5), "malformed-glb"),
    ("no data chunk", chunks((b"JSON", TEXT)), "out-of-bounds"),
    ("not JSON", chunks((b"JSON", b"hello")), "malformed-json"),
    ("bad UTF-8", TEXT.replace(b"mesh", b"\xff\xfe"), "malformed-json"),
    ("UTF-16", json.dumps(GOOD).encode("utf-16"), "malformed-json"),
    ("UTF-16 without a mark", json.dumps(GOOD).encode("utf-16-le"), "malformed-json"),
    ("NaN", TEXT.replace(b'"scene": 0', b'"scene": NaN'), "malformed-json"),
    ("Infinity", TEXT.replace(b'"scene": 0', b'"scene": -Infinity'), "malformed-json"),
    ("a list", b"[" + TEXT + b"]", "malformed-json"),
    ("a name twice", TEXT.replace(b'"scene": 0', b'"scene": 0, "scene": 0'), "malformed-json"),
    ("cut off", TEXT[:-1], "malformed-json"),
    ("100,000 nested lists", b'{"a":' + b"[" * 100_000 + b"]" * 100_000 + b"}", "malformed-json"),
    ("100,000 nested objects", b'{"a":' * 100_000 + b"1" + b"}" * 100_000, "malformed-json"),
    ("a number of 5,000 digits", b'{"a":' + b"1" * 5000 + b"}", "malformed-json"),
]


@pytest.mark.parametrize(("data", "code"), [pytest.param(data, code, id=name) for name, data, code in CONTAINERS])
def test_a_broken_container_is_refused_by_name(data: bytes, code: str) -> None:
    """Bytes that are no GLB or no JSON are told so, and where they break off."""
    with pytest.raises(InputError) as refused:
        opened(data)
    assert refused.value.code == code
    assert isinstance(refused.value, BrokenContainer) == code.startswith("malformed")


def _many_instances(model: Glb) -> None:
    model.json["nodes"] += [{"mesh": 0}] * 12_000
    model.json["scenes"][0]["nodes"] += range(1, 12_001)


def _overlapping(model: Glb) -> None:
    """One view of 64 kB, referenced as the displacement of 9,000 targets."""
    view = model.view(bytes(3000 * 12))
    for accessor in (POSITIONS, len(model.json["accessors"])):
        model.json["accessors"][accessor : accessor + 1] = [
            {"bufferView": view, "componentType": 5126, "count": 3000, "type": "VEC3"}
        ]
    _primitive(targets=[{"POSITION": POSITIONS}] * 9000)(model)


def _zeros(accessor: int, count: int) -> Mutation:
    def mutate(model: Glb) -> None:
        del model.json["accessors"][accessor]["bufferView"]
        model.json["accessors"][accessor]["count"] = count

    return mutate


def _many_bones(model: Glb) -> None:
    """A hundred meshes on skins of the same 5,000 nodes."""
    first = len(model.json["nodes"])
    model.json["nodes"] += [{}] * 5_000 + [{"mesh": 0, "skin": number} for number in range(1, 101)]
    model.json["skins"] += [{"joints": [*range(first, first + 5_000)]}] * 100
    model.json["scenes"][0]["nodes"] += range(first + 5_000, first + 5_100)


def _many_nodes_for_hours(model: Glb) -> None:
    """A chain that moves one square, whose last key is after three hours."""
    model.json["nodes"] += [{"children": [i]} for i in range(49_000)]
    model.json["scenes"] = [{"nodes": [49_000]}]
    _data(TIMES, 30, 10_000)(model)


def _many_takes(model: Glb) -> None:
    model.json["animations"] *= 20_000


UNFOLDING = [
    pytest.param(_zeros(POSITIONS, 10**9), Limits(), "CAESURA_MAX_DECODED_BYTES", id="a billion positions"),
    pytest.param(_zeros(POSITIONS, 10**6), Limits(), "CAESURA_MAX_VERTICES", id="a million positions"),
    pytest.param(_zeros(MOVES, 10**9), Limits(), "CAESURA_MAX_DECODED_BYTES", id="a billion keys"),
    pytest.param(_overlapping, Limits(max_decoded_bytes=2**20), "CAESURA_MAX_DECODED_BYTES", id="overlaps"),
    pytest.param(_primitive(targets=[{}] * 100_000), Limits(), "CAESURA_MAX_TARGETS", id="100,000 targets"),
    pytest.param(_many_instances, Limits(), "CAESURA_MAX_PRIMITIVES", id="12,000 instances"),
    pytest.param(_set("nodes", [{}] * 60_000), Limits(), "CAESURA_MAX_NODES", id="60,000 nodes"),
    pytest.param(_many_takes, Limits(), "CAESURA_MAX_TAKES", id="20,000 takes"),
    pytest.param(_uri(f"data:;base64,{'A' * 10_000}"), Limits(max_decoded_bytes=5000), "CAESURA_MAX_DECODED_BYTES",
                 id="long data"),
    pytest.param(_node(0), Limits(max_json_bytes=100), "CAESURA_MAX_JSON_BYTES", id="long JSON"),
    pytest.param(_node(0), Limits(max_vertices=3), "CAESURA_MAX_VERTICES", id="vertices"),
    pytest.param(_node(0), Limits(max_triangles=1), "CAESURA_MAX_TRIANGLES", id="triangles"),
    pytest.param(_node(0), Limits(max_frames=30), "CAESURA_MAX_FRAMES", id="frames"),
    pytest.param(_node(0), Limits(max_seconds=0.5), "CAESURA_MAX_SECONDS", id="seconds"),
    pytest.param(_node(0), Limits(max_triangle_frames=61), "CAESURA_MAX_TRIANGLE_FRAMES", id="work"),
    pytest.param(_node(0), Limits(max_node_frames=30), "CAESURA_MAX_NODE_FRAMES", id="poses"),
    pytest.param(_many_nodes_for_hours, Limits(), "CAESURA_MAX_NODE_FRAMES", id="49,000 nodes for hours"),
]  # fmt: skip


@pytest.mark.parametrize(("mutate", "limits", "setting"), UNFOLDING)
def test_a_file_that_unfolds_too_far_is_refused_by_its_limit(mutate: Mutation, limits: Limits, setting: str) -> None:
    """Counted before anything is allocated, and told by the name of the setting."""
    model = moving_square()
    mutate(model)
    with pytest.raises(LimitExceeded, match=setting) as refused:
        opened(model.glb(), limits)
    assert refused.value.where.keys() >= {"limit", "actual", "setting"}
    assert ("pointer" in refused.value.where) == (setting != "CAESURA_MAX_JSON_BYTES")


def test_skins_that_share_nodes_are_counted_by_their_bones() -> None:
    """Half a million matrices in every frame, of 5,000 nodes and six vertices."""
    model = bending_strip()
    _many_bones(model)
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_DECODED_BYTES"):
        opened(model.glb())


def test_a_name_as_long_as_a_file_is_cut() -> None:
    """It would be kept and sent with every answer; that is said. As it is shown, or by all of it, it is found."""
    model = moving_square()
    model.json["animations"] = [{**model.json["animations"][0], "name": name} for name in ("N" * 10**6, "other")]
    shown = "N" * 99 + "…"
    for asked in ("N" * 10**6, shown):
        animation = opened(model.glb(), take=asked)
        assert animation.take.name == shown
        assert "take-name-shortened" in codes(animation)


def test_numbers_that_overflow_are_found_when_they_are_drawn() -> None:
    """1e38 is finite; a thousand times that is not, in float32: the frame and the vertex are named."""
    model = moving_square()
    model.json["nodes"][0]["scale"] = [1e3, 1, 1]
    _data(POSITIONS, 3, 1e38)(model)
    animation = opened(model.glb())
    with pytest.raises(InvalidModel) as refused:
        animation.vertices(7, 9)
    assert refused.value.code == "non-finite-data"
    assert (refused.value.where["frame"], refused.value.where["vertex"]) == (7, 1)


def _deep(model: Glb) -> None:
    model.json["nodes"] = [{"mesh": 0}] + [{"children": [i]} for i in range(20_000)]
    model.json["scenes"] = [{"nodes": [20_000]}]


def _without_node(model: Glb) -> None:
    channels = model.json["animations"][0]["channels"]
    channels.append({"sampler": 0, "target": {"path": "translation"}})


def _pointer(model: Glb) -> None:
    target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/scale"}}}
    model.json["animations"][0]["channels"].append({"sampler": 0, "target": target})


def _no_scene(model: Glb) -> None:
    del model.json["scenes"], model.json["scene"]


ODD: list[tuple[str, Mutation, set[str]]] = [
    ("a chain of 20,000 nodes", _deep, set()),
    ("channel without node", _without_node, set()),
    ("channel of an extension", _pointer, {"channel-skipped"}),
    ("no scenes", _no_scene, {"no-scene"}),
    ("no default scene", lambda m: m.json.pop("scene"), set()),
    ("materials of an extension", _set("extensionsRequired", ["KHR_materials_unlit"]), set()),
    ("an image bomb", _set("images", [{"uri": "http://169.254.169.254/x.png"}]), set()),
    ("zero scale", _node(0, scale=[0, 0, 0]), set()),
    ("a take's name that is no UTF-8", _set("animations", 0, "name", "\ud800"), set()),
    ("a take's name that is a number", _set("animations", 0, "name", 7), set()),
    ("unused accessor that lies", lambda m: m.json["accessors"].append({"count": -1}), set()),
]


@pytest.mark.parametrize(("mutate", "noted"), [pytest.param(mutate, noted, id=name) for name, mutate, noted in ODD])
@pytest.mark.timeout(20)
def test_a_legal_but_odd_model_is_read(mutate: Mutation, noted: set[str]) -> None:
    """Rare is not wrong."""
    model = moving_square()
    mutate(model)
    animation = opened(model.glb())
    assert animation.vertices(0, animation.frames).shape == (31, 4, 3)
    assert codes(animation) == noted
    animation.take.name.encode()


def test_odd_containers_are_read() -> None:
    """A byte order mark before JSON, bytes after a GLB, and chunks of other kinds do no harm."""
    marked = b"\xef\xbb\xbf" + moving_square().gltf()
    more = chunks((b"JSON", TEXT), (b"BIN\0", BINARY), (b"XTRA", b"?"))
    for data, noted in ((marked, set()), (more, set()), (WHOLE + b"trailing", {"extra-data"})):
        assert codes(opened(data)) == noted


def test_base64_may_be_written_as_a_uri_writes_it() -> None:
    """%2B, %2F and %3D are +, / and = (RFC 3986, section 2.1)."""
    model = moving_square()
    model.binary.extend(bytes([251, 255, 191, 0]))  # a buffer may be longer than what is used of it
    plain = model.gltf()
    document = json.loads(plain)
    head, _, text = document["buffers"][0]["uri"].partition(",")
    document["buffers"][0]["uri"] = f"{head},{quote(text, safe='')}"
    assert "%2F" in document["buffers"][0]["uri"]
    written = json.dumps(document).encode()
    np.testing.assert_array_equal(opened(written).vertices(0, 31), opened(plain).vertices(0, 31))


def test_joints_beyond_the_skin_with_weight_0_are_accepted() -> None:
    """Exporters leave anything in the slots that do not count."""
    strip = bending_strip()
    _data(JOINTS, 2, 255, "<B")(strip)
    expected = opened(bending_strip().glb())
    np.testing.assert_array_equal(opened(strip.glb()).vertices(0, 2), expected.vertices(0, 2))


def test_negative_weights_and_singular_bind_matrices_are_noted() -> None:
    """Both are wrong in a way that leaves an answer."""
    strip = bending_strip()
    _data(WEIGHTS, 1, -0.5)(strip)
    for place in range(12):
        _data(BIND, place, 0)(strip)
    assert codes(opened(strip.glb())) >= {"weights-negative", "singular-bind"}


def test_a_take_whose_keys_are_all_at_0_has_one_frame() -> None:
    """A pose and not a motion: whoever segments it refuses it."""
    model = square()
    model.animate(0, "translation", [0], [[1, 2, 3]])
    assert opened(model.glb()).frames == 1
