"""Projection: what it keeps, and that it is the same everywhere."""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from caesura.core.block_pass.projection import Projection, choose_sample_frames


def sample(frames=300, size=90, rank=5):
    random = np.random.default_rng(0)
    return (random.normal(size=(frames, rank)) * 2.0 ** -np.arange(rank)) @ random.normal(size=(rank, size)) + 7


@pytest.mark.parametrize(("frames", "size"), [(300, 90), (40, 90)])
def test_distances_survive(frames, size):
    """Of a descriptor of rank five nothing is lost: distances between frames stay, and the share is 1."""
    values = sample(frames, size)
    projection = Projection.of(values)
    kept = projection.project(values)
    assert kept.shape == (frames, 5)
    assert projection.energy_share == pytest.approx(1)
    np.testing.assert_allclose(
        np.linalg.norm(kept[1:] - kept[:-1], axis=1), np.linalg.norm(values[1:] - values[:-1], axis=1), rtol=1e-4
    )


def test_columns_are_centred_and_ordered_by_variance():
    """The first component varies most."""
    values = sample()
    kept = Projection.of(values).project(values)
    np.testing.assert_allclose(kept.mean(axis=0), 0, atol=1e-3)
    assert (np.diff(kept.var(axis=0)) < 0).all()


def test_the_share_is_what_is_kept():
    """Two components of five keep the share of the variance that the singular values say."""
    values = sample()
    energy = np.linalg.svd(values - values.mean(axis=0), compute_uv=False) ** 2
    assert Projection.of(values, components=2).energy_share == pytest.approx(energy[:2].sum() / energy.sum())


def test_what_does_not_vary_has_no_components():
    """A constant descriptor keeps everything of nothing."""
    projection = Projection.of(np.full((10, 4), 3.5, np.float32))
    assert projection.project(np.ones((2, 4), np.float32)).shape == (2, 0)
    assert projection.energy_share == 1


def test_the_number_of_threads_does_not_matter():
    """One BLAS thread or two around it: the same bytes."""
    values = sample(600, 400, 60)
    components = []
    for threads in (1, 2):
        with threadpool_limits(threads):
            components.append(Projection.of(values).components.tobytes())
    assert components[0] == components[1]


def test_the_sample_spans_the_take():
    """Few frames are all taken; of many, 2,000 from the first to the last."""
    assert choose_sample_frames(5).tolist() == [0, 1, 2, 3, 4]
    frames = choose_sample_frames(72_000)
    assert (len(frames), frames[0], frames[-1]) == (2000, 0, 71_999)
    assert (np.diff(frames) > 30).all()
