"""Every descriptor carries the whole method."""

from typing import get_args

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.descriptors.table import DESCRIPTORS
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, segment
from tests.animations import animation, performing_bar
from tests.core.mesh.shapes import in_pieces, sheet
from tests.formats.opening import opened

DESCRIPTOR_NAMES = get_args(Parameters.model_fields["descriptor"].annotation)
CHOICES = [{"descriptor": name} for name in DESCRIPTOR_NAMES] + [{"descriptor": "curvature", "curvature": "mean"}]
every = pytest.mark.parametrize("choice", CHOICES, ids=lambda choice: "-".join(choice.values()))


@pytest.fixture(scope="module")
def performance():
    """The bar, bending, swaying, stretching and bending again."""
    return performing_bar([0, 1, 2, 0], seconds=4.0, rings=16)


def test_every_name_has_a_surface():
    """Pair distances are no surface, but pairs of points."""
    assert set(DESCRIPTORS) | {"pair-distances"} == set(DESCRIPTOR_NAMES)


def test_an_unknown_descriptor_is_told_the_known_ones():
    """By name."""
    with pytest.raises(ParameterError) as refused:
        Parameters.parse({"descriptor": "colour"})
    assert all(name in refused.value.detail for name in DESCRIPTOR_NAMES)


@every
def test_motions_are_found_by_every_descriptor(performance, choice):
    """By the default method, told nothing else."""
    found = segment(performance.animation, Parameters(**choice, motions=3))
    assert frame_accuracy(found.labels, performance.truth) > 0.95


@every
def test_the_papers_method_runs_on_every_descriptor(performance, choice):
    """A curve with peaks, values within 0 and 1 at each, and more than one motion."""
    parameters = Parameters(
        **choice, method="joint-entropy", window_seconds=0.5, keyframe_window_seconds=0.7, motions=3
    )
    analysis = analyse(performance.animation, parameters)
    assert np.nanmax(analysis.energy) > 0.5
    assert analysis.strain_scale > 0
    assert (analysis.peak_strain >= 0).all()
    assert (analysis.peak_strain <= 1).all()
    assert cut(analysis, parameters).motions == 3
    features = {feature.name for feature in analysis.features if feature.values.shape[1]}
    assert features == {choice["descriptor"], "pair-distances"}


@every
def test_the_number_of_threads_changes_no_byte(choice):
    """Nor do codes that do not fit the memory."""
    source = performing_bar([0, 2], seconds=2.0, rings=10).animation
    first, *others = (
        analyse(source, Parameters(**choice), threads=threads, memory_bytes=memory).to_bytes()
        for threads, memory in ((1, 2**28), (2, 2**28), (2, 0))
    )
    assert all(other == first for other in others)


@every
def test_triangles_in_pieces_are_one_surface(performance, choice):
    """The same bar in separate triangles has the same curve, to rounding."""
    source = performing_bar([0, 2], seconds=1.5, rings=10).animation
    loose, rest, frames = in_pieces(source.triangles, source.rest, source.vertices(0, source.frames))
    parameters = Parameters(**choice, window_seconds=0.3)
    whole = analyse(source, parameters)
    apart = analyse(animation(frames, loose, rest=rest), parameters)
    if choice["descriptor"] != "pair-distances":  # whose points are chosen among the vertices
        np.testing.assert_allclose(apart.energy, whole.energy, atol=0.05)
        assert apart.strain_scale == pytest.approx(whole.strain_scale, rel=1e-3)


@pytest.mark.parametrize("name", sorted(DESCRIPTORS))
def test_a_body_in_pieces_that_only_turn_is_measured_by_pairs(name):
    """No triangle changes by any descriptor; the distances between the pieces do."""
    place, triangles = sheet(columns=4, rows=3)
    swing = np.sin(np.arange(120) / 5)
    still, moving = np.repeat(place[None], 120, axis=0), np.repeat(place[None] + np.float32([0, 0, 3]), 120, axis=0)
    moving[:, :, 0] += swing[:, None].astype(np.float32)
    both = np.concatenate([triangles, triangles + len(place)])
    found = analyse(animation(np.concatenate([still, moving], axis=1), both), Parameters(descriptor=name))
    assert "no-strain" in {notice.code for notice in found.notices}
    assert np.isfinite(found.peak_strain).all()


@pytest.mark.parametrize("name", sorted(DESCRIPTORS))
@pytest.mark.parametrize("file", ["Fox.glb", "CesiumMan.glb"])
def test_real_characters_are_measured(shared, file, name):
    """One in separate triangles, one in pieces: every value is finite, and the surface is seen to move."""
    source = opened((shared / "data" / "gltf" / file).read_bytes(), fps="12")
    found = analyse(source, Parameters(descriptor=name, energy="joint"), threads=2)
    assert found.notices == source.notices
    assert np.nanmax(found.energy) > 0.3
    assert np.isfinite(found.features[0].values).all()
    assert found.features[0].values.shape[1] > 2
