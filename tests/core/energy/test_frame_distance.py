"""The ablation with plain distances of frames, against strains that are all at hand."""

import numpy as np
import pytest

from caesura.core.energy.frame_distance import compute_distance_curve
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from tests import oracles
from tests.animations import performing_bar


@pytest.mark.parametrize("size", [1, 2, 7, 40])
def test_distances_do_not_depend_on_how_frames_come(size):
    """In blocks of any size: the length of the step to the next frame, and nothing after the last."""
    strains = np.random.default_rng(0).random((40, 5)).astype(np.float32)
    blocks = (strains[i : i + size] for i in range(0, 40, size))
    found = compute_distance_curve(blocks, 40)
    np.testing.assert_allclose(found[:-1], np.linalg.norm(np.diff(strains, axis=0), axis=1), rtol=1e-6)
    assert np.isnan(found[-1])


@pytest.mark.parametrize("memory", [2**28, 0])
def test_the_curve_of_a_take_is_of_its_normalised_strains(memory):
    """Whether their codes are kept or computed twice; to the rounding of codes."""
    source = performing_bar([0, 2], seconds=1.0, rings=10).animation
    found = analyse(source, Parameters(energy="distance"), memory_bytes=memory)
    strains = oracles.strain(source.vertices(0, source.frames), source.rest, source.triangles)
    steps = np.linalg.norm(np.diff(np.minimum(strains / found.strain_scale, 1), axis=0), axis=1)
    np.testing.assert_allclose(found.energy[:-1], steps, atol=2e-3 * np.sqrt(strains.shape[1]))
    assert len(found.peaks) > 0
