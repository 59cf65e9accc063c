"""Meshes drawn many times by one node."""

import io
from typing import Any

import numpy as np
import pytest

from caesura.core.errors import InvalidModel, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.upload_summary import read_header
from tests.formats.opening import codes, opened
from tests.glb import SQUARE, Glb, bending_strip, moving_square

EXTENSION = "EXT_mesh_gpu_instancing"
QUARTER = np.sqrt(0.5)


def instanced(**values: tuple[Any, str]) -> Glb:
    """The moving square, drawn as often as there are values; each with its type of number."""
    model = moving_square()
    attributes = {name: model.accessor(value, kind) for name, (value, kind) in values.items()}
    model.json["nodes"][0]["extensions"] = {EXTENSION: {"attributes": attributes}}
    model.json["extensionsRequired"] = [EXTENSION]
    return model


def test_every_instance_is_taken_where_it_is() -> None:
    """Moved by its node, then in order: every instance with its own translation, rotation and scale."""
    model = instanced(
        TRANSLATION=([[0, 0, 0], [0, 5, 0]], "float32"),
        ROTATION=([[0, 0, 0, 1], [0, 0, QUARTER, QUARTER]], "float32"),
        SCALE=([[1, 1, 1], [2, 2, 2]], "float32"),
    )
    animation = opened(model.glb())
    assert (animation.vertex_count, len(animation.triangles)) == (8, 4)
    square = np.array(SQUARE, float)
    turned = 2 * np.stack([-square[:, 1], square[:, 0], square[:, 2]], axis=1) + [0, 5, 0]
    expected = np.concatenate([square, turned])
    np.testing.assert_allclose(animation.vertices(0, 1)[0], expected, atol=1e-6)
    np.testing.assert_allclose(animation.vertices(30, 31)[0], expected + np.array([1, 0, 0]), atol=1e-6)
    np.testing.assert_array_equal(animation.triangles[2:], animation.triangles[:2] + 4)
    assert codes(animation) == {"instances-expanded"}
    assert animation.gltf is None


def test_rotations_may_be_integers() -> None:
    """Normalized, as in compressed files."""
    model = instanced(ROTATION=([[0, 0, 23170, 23170]], "int16"))
    model.json["accessors"][-1]["normalized"] = True
    np.testing.assert_allclose(opened(model.glb()).vertices(0, 1)[0, 1], [0, 1, 0], atol=1e-4)


def test_limits_count_after_instancing() -> None:
    """Before anything is decoded; a hundred thousand of one square are too many."""
    many = instanced(TRANSLATION=(np.zeros((100_000, 3)), "float32")).glb()
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_PRIMITIVES"):
        opened(many)
    few = instanced(TRANSLATION=(np.zeros((10, 3)), "float32")).glb()
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_VERTICES"):
        opened(few, Limits(max_vertices=39))
    with pytest.raises(LimitExceeded, match="CAESURA_MAX_TRIANGLES"):
        opened(few, Limits(max_triangles=19))


def test_a_skin_has_no_instances() -> None:
    """Where a skin is, its joints say where the mesh is; that is noted."""
    model = bending_strip()
    attributes = {"TRANSLATION": model.accessor(np.ones((3, 3)))}
    model.json["nodes"][0]["extensions"] = {EXTENSION: {"attributes": attributes}}
    animation = opened(model.glb())
    assert animation.vertex_count == 6
    assert codes(animation) >= {"instances-ignored"}


@pytest.mark.parametrize(
    ("values", "code"),
    [
        ({}, "invalid-gltf"),
        ({"TRANSLATION": (np.zeros((2, 3)), "float32"), "SCALE": (np.ones((3, 3)), "float32")}, "invalid-gltf"),
        ({"TRANSLATION": (np.zeros((2, 4)), "float32")}, "invalid-gltf"),
        ({"SCALE": (np.ones((2, 3)), "uint16")}, "invalid-gltf"),
        ({"TRANSLATION": ([[np.nan, 0, 0]], "float32")}, "non-finite-data"),
        ({"ROTATION": ([[0, 0, 0, 0]], "float32")}, "invalid-gltf"),
    ],
)
def test_broken_instances_are_refused(values: dict[str, Any], code: str) -> None:
    """By their code."""
    with pytest.raises(InvalidModel) as refused:
        opened(instanced(**values).glb())
    assert refused.value.code == code


def test_no_instances_are_no_mesh() -> None:
    """A count of 0 draws nothing."""
    model = instanced(TRANSLATION=(np.zeros((1, 3)), "float32"))
    model.json["accessors"][-1]["count"] = 0
    with pytest.raises(InvalidModel) as refused:
        opened(model.glb())
    assert refused.value.code == "no-mesh"


def test_a_header_counts_every_instance() -> None:
    """As the reader does; a node with a skin draws its mesh once."""
    model = instanced(TRANSLATION=(np.zeros((7, 3)), "float32"))
    header = read_header(io.BytesIO(model.glb()), "x.glb", Limits())
    assert (header.vertices, header.triangles) == (28, 14)
    model.json["nodes"][0]["skin"] = 0
    assert read_header(io.BytesIO(model.glb()), "x.glb", Limits()).vertices == 4
