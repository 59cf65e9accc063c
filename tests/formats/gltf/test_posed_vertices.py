"""Skinned and morphed vertices against sums in float64, near and far, in any block of frames."""

from dataclasses import replace

import numpy as np
import pytest

from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.frames.sampled_frames import read_vertices
from caesura.core.parameters import Parameters
from caesura.formats.gltf.posing.posed_vertices import PosedVertices
from caesura.formats.gltf.scene_mesh import ScenePart
from caesura.samples.long_session import long_session
from tests.formats.opening import opened

FRAMES = 130
"""Two runs of 64, and two frames more."""


@pytest.fixture(scope="module")
def figure():
    """A skinned figure of some 3,000 vertices, at most four joints each."""
    return opened(long_session(600).glb)


def modelled_at(vertices: PosedVertices, place: float) -> PosedVertices:
    """The same figure, modelled so far from its origin: bind matrices take it back."""
    figure, bind = vertices.figure, vertices.skeleton.bone_bind.reshape(-1, 3, 4).copy()
    bind[:, :, 3] -= bind[:, :, :3] @ np.full(3, place)
    moved = (figure.positions + place).astype(np.float32)
    return replace(
        vertices,
        figure=replace(figure, positions=moved),
        skeleton=replace(vertices.skeleton, bone_bind=bind.reshape(-1, 12)),
    )


def morphed(vertices: PosedVertices) -> PosedVertices:
    """The same figure with two morph targets on the second half of its vertices; the second goes in and out."""
    figure, half = vertices.figure, len(vertices.figure.positions) // 2
    shifts = np.random.default_rng(0).normal(0, 0.1, (2, 3 * (len(figure.positions) - half))).astype(np.float32)
    parts = (ScenePart(0, half), ScenePart(half, len(figure.positions), 7, shifts))
    return replace(
        vertices,
        figure=replace(figure, parts=parts),
        tracks=replace(vertices.tracks, rest_pose=np.append(vertices.tracks.rest_pose, [0.0, 0.75])),
        weight_slots={7: len(vertices.tracks.rest_pose)},
    )


def plain(vertices: PosedVertices, frames: range) -> np.ndarray:
    """Σ weight · world · bind · (position + Σ share · shift), one frame after another in float64."""
    figure, out = vertices.figure, []
    vertex = np.repeat(np.arange(len(figure.positions)), np.diff(figure.first))
    for frame in frames:
        poses = vertices.tracks.poses(np.array([vertices.start_seconds + frame / vertices.frame_rate]))
        matrices = vertices.skeleton.palette(poses)[:, :, 0].reshape(-1, 3, 4)
        positions = figure.positions.astype(np.float64)
        for part in figure.parts:
            if part.targets is not None:
                slot = vertices.weight_slots[part.node]
                shares = poses[0, slot : slot + len(part.targets)]
                positions[part.start : part.stop] += (shares @ part.targets.astype(np.float64)).reshape(-1, 3)
        bones = matrices[figure.bones]
        moved = np.einsum("irc,ic->ir", bones[:, :, :3], positions[vertex]) + bones[:, :, 3]
        out.append(np.add.reduceat(moved * figure.weights[:, None], figure.first[:-1], axis=0))
    return np.array(out)


@pytest.mark.parametrize("place", [0.0, 1000.0])
@pytest.mark.parametrize("change", [lambda vertices: vertices, morphed], ids=["skinned", "morphed"])
def test_vertices_are_those_of_sums_in_float64(figure, place, change) -> None:
    """To the last digit of their place and two millionths of the body, wherever that was modelled."""
    vertices = change(modelled_at(figure.vertices, place))
    expected = plain(vertices, range(0, FRAMES, 13))
    found = vertices(0, FRAMES)[::13]
    size = np.ptp(expected[0], axis=0).max()
    allowed = np.spacing(np.abs(expected).astype(np.float32)) / 2 + 2e-6 * size
    assert (np.abs(found - expected) <= allowed).all()


@pytest.mark.parametrize("change", [lambda vertices: vertices, morphed], ids=["skinned", "morphed"])
def test_a_frame_has_the_same_bits_with_any_others(figure, change) -> None:
    """In a block, alone, and with the frames innermost."""
    vertices = change(figure.vertices)
    block = vertices(5, 5 + FRAMES)
    for frame in (5, 68, 69, 134):
        assert np.array_equal(vertices(frame, frame + 1)[0], block[frame - 5])
    assert np.array_equal(vertices.rows(np.arange(5, 5 + FRAMES)), block.transpose(1, 2, 0))
    some = np.array([5, 6, 90, 134])
    assert np.array_equal(vertices.rows(some), block[some - 5].transpose(1, 2, 0))


@pytest.mark.parametrize("block", [(0, 64), (64, 192), (70, 75)], ids=str)
def test_what_is_measured_does_not_depend_on_the_order_in_memory(figure, block) -> None:
    """Strain and pair distances of vertices with the frames innermost are those of vertices frame by frame."""
    body, _ = DescriptorSet.of(figure, figure.rest, Parameters())
    rows, frames = read_vertices(figure, block), figure.vertices(*block)
    assert not rows.flags.c_contiguous
    for one, other in zip(body.measure_features(rows), body.measure_features(frames), strict=True):
        np.testing.assert_array_equal(one, other)
