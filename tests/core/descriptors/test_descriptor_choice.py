"""Descriptors are chosen as a set, which every method sees; the curve is of the first that is of triangles."""

import numpy as np
import pytest

from caesura.core.agreement import frame_accuracy
from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from tests.animations import animation, performing_bar
from tests.core.mesh.shapes import sheet


@pytest.fixture(scope="module")
def performance():
    """The bar, bending, swaying and stretching."""
    return performing_bar([0, 1, 2], seconds=3.0, rings=12)


def names(analysis):
    return [feature.name for feature in analysis.features if feature.values.shape[1]]


@pytest.mark.parametrize(
    ("given", "set_of"),
    [
        ({}, ("strain", "pair-distances")),
        ({"descriptor": "curvature"}, ("curvature", "pair-distances")),
        ({"descriptor": "pair-distances"}, ("pair-distances",)),
        ({"descriptors": "strain"}, ("strain",)),
        ({"descriptors": "pair-distances,strain"}, ("strain", "pair-distances")),
        ({"descriptors": "strain,strain,pair-distances"}, ("strain", "pair-distances")),
        ({"descriptors": ["geodesic", "strain"]}, ("geodesic", "strain")),
        ({"descriptors": "geodesic", "descriptor": "curvature"}, ("geodesic",)),
    ],
)
def test_one_set_has_one_spelling(given, set_of):
    """However it is spelled; `descriptor`, as it was before there were sets, still is one and pair distances."""
    chosen = Parameters.parse(given)
    assert chosen.descriptor_names == set_of
    assert chosen.descriptor == set_of[0]
    assert chosen.canonical() == Parameters(descriptors=",".join(set_of)).canonical()
    assert Parameters.model_validate(chosen.model_dump()) == chosen


@pytest.mark.parametrize("given", ["colour", "strain,colour", "", "strain,", "auto,strain", 3])
def test_what_is_no_set_of_descriptors_is_refused(given):
    """Naming the parameter and the names that there are."""
    with pytest.raises(ParameterError) as refused:
        Parameters.parse({"descriptors": given})
    assert refused.value.where["parameter"] == "descriptors"


@pytest.mark.parametrize("chosen", ["strain", "pair-distances", "strain,curvature", "curvature,strain,pair-distances"])
def test_the_features_are_those_chosen_and_no_others(performance, chosen):
    """In memory or projected as they come, and motions are found by them."""
    parameters = Parameters(descriptors=chosen, motions=3)
    analysis = analyse(performance.animation, parameters)
    assert names(analysis) == chosen.split(",")
    assert frame_accuracy(cut(analysis, parameters).labels, performance.truth) > 0.9


def test_features_of_several_descriptors_are_learnt_from_a_sample(performance, monkeypatch):
    """Drawn beforehand where they do not fit the memory: the same to rounding."""
    parameters = Parameters(descriptors="strain,curvature,pair-distances")
    held = analyse(performance.animation, parameters)
    monkeypatch.setattr("caesura.core.block_pass.features.HELD_BYTES", 0)
    for sampled, whole in zip(analyse(performance.animation, parameters).features, held.features, strict=True):
        np.testing.assert_allclose(sampled.values, whole.values, atol=1e-3)


def test_strain_alone_gives_way_to_pairs_where_nothing_strains():
    """Two plates that move towards each other: the result says so, and has their motion."""
    place, triangles = sheet(columns=4, rows=3)
    swing = np.sin(np.arange(120) / 5)
    still, moving = np.repeat(place[None], 120, axis=0), np.repeat(place[None] + np.float32([0, 0, 3]), 120, axis=0)
    moving[:, :, 0] += swing[:, None].astype(np.float32)
    both = np.concatenate([triangles, triangles + len(place)])
    found = analyse(animation(np.concatenate([still, moving], axis=1), both), Parameters(descriptors="strain"))
    assert names(found) == ["pair-distances"]
    assert "no-strain" in {notice.code for notice in found.notices}


@pytest.mark.parametrize(("chosen", "named"), [("strain", ["strain"]), ("pair-distances", ["pair-distances"])])
def test_a_skeleton_has_the_strain_of_its_limbs_or_distances(chosen, named):
    """Joints without triangles."""
    source = performing_bar([0, 1], seconds=1.0, rings=6).animation
    found = analyse(animation(source.vertices(0, source.frames), []), Parameters(descriptors=chosen))
    assert names(found) == named
