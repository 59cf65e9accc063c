"""What is coloured is the descriptor that was chosen."""

from typing import get_args

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse
from caesura.formats.playback.playback_files import _patches
from caesura.formats.playback.strain_blocks import write_strain_blocks
from tests.animations import performing_bar
from tests.formats.playback.test_play import unpacked


@pytest.mark.parametrize("name", get_args(Parameters.model_fields["descriptor"].annotation))
def test_the_chosen_descriptor_is_shown(name: str) -> None:
    """Its bytes go from near 0 at the pose nearest to rest up to a good part of 255; pairs of points show nothing."""
    animation = performing_bar([0], seconds=2.0, rings=12).animation
    analysis = analyse(animation, Parameters(descriptor=name))
    shown = _patches(animation, analysis)
    if name == "pair-distances":
        assert shown is None
        return
    assert shown is not None
    header, blocks = unpacked(b"".join(write_strain_blocks(animation, shown, analysis.strain_scale)))
    found = np.frombuffer(blocks, "u1").reshape(60, header["patches"])
    assert header["patches"] > 64
    assert found.max() > 100
    assert found.mean(axis=1).min() < 40


def test_what_is_shown_is_measured_without_the_threads_of_algebra() -> None:
    """A heat kernel solves small systems; the algebra's own threads would wait for each other, and for ours."""
    animation = performing_bar((0, 1), seconds=1.0).animation
    parameters = Parameters(descriptor="heat-kernel")
    analysis = analyse(animation, parameters)
    shown = _patches(animation, analysis)
    with threadpool_limits(2):
        blocks = write_strain_blocks(animation, shown, analysis.strain_scale)
        next(blocks)
        assert {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"} == {1}
        blocks.close()
        assert {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"} == {2}
