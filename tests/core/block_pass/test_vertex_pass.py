"""The pass over the vertices, where the frames looked at beforehand mislead."""

import numpy as np
import pytest

from caesura.core.animation import Animation, Take
from caesura.core.block_pass.descriptor_set import DescriptorSet
from caesura.core.block_pass.range_estimate import FRAMES
from caesura.core.errors import InvalidModel
from caesura.core.frames.sampled_frames import choose_sample_frames
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from tests import oracles
from tests.animations import bar

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], np.float32)


@pytest.mark.parametrize(("others", "looked_at"), [(0.05, 1.8), (0.5, 1.0003)])
def test_the_percentile_is_right_though_the_frames_looked_at_are_nothing_like_the_rest(others, looked_at) -> None:
    """Too few for the percentile to be among them, they are strained most of all, or so little that the codes chosen by
    them do not reach the others."""
    frames = 33_000
    stretch = 1 + others * np.random.default_rng(0).random(frames)
    stretch[choose_sample_frames(frames, FRAMES)] = looked_at
    vertices = (stretch[:, None, None] * SQUARE).astype(np.float32)
    take = Take(0, "", frames / 30, frames, 30.0)
    square = Animation(lambda a, b: vertices[a:b], 4, np.array([[0, 1, 2], [1, 3, 2]]), SQUARE, frames, 30.0, take)
    expected = np.percentile(np.sqrt(2) * np.log(np.repeat(stretch, 2)), 99.9)
    assert analyse(square, Parameters()).strain_scale == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("triangles", [[[0, 1, 2], [1, 3, 2]], [[0, 1, 2]]])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 2e15])
def test_a_coordinate_that_is_no_place_is_named(triangles, value) -> None:
    """Whether its vertex is the corner of a triangle, looked at with the strain, or of none."""
    vertices = np.repeat(SQUARE[None], 200, axis=0) * np.linspace(1, 1.2, 200, dtype=np.float32)[:, None, None]
    vertices[133, 3, 1] = value
    take = Take(0, "", 200 / 30, 200, 30.0)
    square = Animation(lambda a, b: vertices[a:b], 4, np.array(triangles), SQUARE, 200, 30.0, take)
    with pytest.raises(InvalidModel) as refused:
        analyse(square, Parameters(), threads=2)
    assert refused.value.code == "non-finite-data"
    assert "frame 133, vertex 3" in str(refused.value)


@pytest.fixture(scope="module")
def strained_in_one_place():
    """A take that all but rests, where one ring is stretched up to eight times; and its strains, one by one."""
    rest, triangles = bar(rings=700)
    draw = np.random.default_rng(0)
    moved = rest * (1 + 1e-4 * np.sin(np.arange(8))[:, None, None])
    moved[:, 3_600:3_608] *= 1 + 7 * draw.random((8, 1, 1))
    moved = np.asarray(moved, np.float32)
    take = Take(0, "", 8 / 30, 8, 30.0)
    animation = Animation(lambda a, b: moved[a:b], len(rest), triangles, rest, 8, 30.0, take)
    return animation, oracles.strain(moved, rest, triangles)


@pytest.mark.parametrize("normalize", ["max", 2.0, 1e-5, "p99.9"])
def test_no_bin_is_lost_where_strain_is_in_a_place_that_was_not_looked_at(strained_in_one_place, normalize) -> None:
    """Whatever counts as 1: the codes that were chosen by what was looked at hold neither the largest nor the least."""
    animation, strains = strained_in_one_place
    found = analyse(animation, Parameters(normalize=normalize, window_seconds=0.07, rest="bind"))
    expected = oracles.energy(oracles.bins(strains, found.strain_scale, 10), 10, 2)
    np.testing.assert_allclose(found.energy, expected, atol=1e-3)


def test_points_without_a_mesh_have_the_energy_of_their_pairs() -> None:
    """The strains that are counted are those of each pair in each frame."""
    draw = np.random.default_rng(0)
    rest = draw.random((24, 3)).astype(np.float32)
    steps = draw.normal(0, 0.02, (100, 24, 3)).cumsum(axis=0)
    moved = np.asarray(rest + steps, np.float32)
    take = Take(0, "", 100 / 30, 100, 30.0)
    points = Animation(lambda a, b: moved[a:b], 24, np.zeros((0, 3), np.int64), rest, 100, 30.0, take)
    body, _ = DescriptorSet.of(points, rest, Parameters())
    [(_, strains)] = body.surface.tiles(moved)
    found = analyse(points, Parameters(window_seconds=0.1, rest="bind"))
    expected = oracles.energy(oracles.bins(strains.T, found.strain_scale, 10), 10, 3)
    np.testing.assert_allclose(found.energy, expected, atol=1e-2)
