"""What the method saw on its way: the curves of Eq. 5 and the means of Eq. 4."""

import numpy as np
import pytest

from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.core.plot.layout import lay_out_picture
from caesura.core.plot.svg import render_svg
from caesura.core.segmentation import Segmentation
from tests import oracles
from tests.animations import performing_bar

PAPER = Parameters(method="joint-entropy", motions=3, window_seconds=0.5, keyframe_window_seconds=0.7, details=True)


@pytest.fixture(scope="module")
def performance():
    """The bar, bending, stretching and swaying."""
    return performing_bar([0, 2, 1], seconds=3.0, rings=10)


@pytest.fixture(scope="module")
def analysis(performance):
    return analyse(performance.animation, PAPER)


def test_each_cut_is_where_its_curve_of_variances_is_least(analysis):
    """Between its two key-frames; and the curve is that of the variances as NumPy has them."""
    found = cut(analysis, PAPER)
    assert [curve.boundary for curve in found.variances] == found.cuts.tolist()
    for curve in found.variances:
        stop = curve.start + len(curve.values)
        assert {curve.start - 1, stop} <= set(found.key_frames.tolist())
        plain = [
            np.var(found.energy[curve.start - 1 : m + 1]) + np.var(found.energy[m : stop + 1])
            for m in range(curve.start, stop)
        ]
        np.testing.assert_allclose(curve.values, plain, atol=1e-6)
        assert plain[curve.boundary - curve.start] == pytest.approx(min(plain))


def test_each_motion_has_the_mean_strain_of_its_key_frames(performance, analysis):
    """Of every triangle, in the order of the take, and of all together; every key-frame is of one group."""
    found, source = cut(analysis, PAPER), performance.animation
    keys = sorted(frame for cluster in found.clusters for frame in cluster.key_frames)
    assert keys == found.key_frames.tolist()
    for cluster in found.clusters:
        frames = np.array(cluster.key_frames)
        strains = oracles.strain(source.vertices(0, source.frames)[frames], source.rest, source.triangles)
        expected = np.minimum(strains / analysis.strain_scale, 1).mean(axis=0)
        np.testing.assert_allclose(cluster.strain, expected, atol=2e-4)
        assert cluster.mean_strain == pytest.approx(expected.mean(), abs=1e-4)
        assert len({int(found.labels[frame]) for frame in frames}) == 1


def test_details_are_there_only_where_they_were_asked_for(analysis):
    """They survive the document, and are drawn."""
    found = cut(analysis, PAPER)
    assert Segmentation.of(found.document()).clusters == found.clusters
    plain = cut(analysis, PAPER.model_copy(update={"details": False}))
    assert plain.variances == plain.clusters == ()
    strokes = [render_svg(lay_out_picture(one.document())).count("<polyline") for one in (found, plain)]
    assert strokes[0] == strokes[1] + len(found.variances)


def test_the_mean_strains_of_a_fine_mesh_are_left_out(analysis, monkeypatch):
    """Its means over all triangles are not."""
    monkeypatch.setattr("caesura.core.methods.joint_entropy.details.MOST_TRIANGLES", 3)
    for cluster in cut(analysis, PAPER).clusters:
        assert cluster.strain == ()
        assert cluster.mean_strain > 0
