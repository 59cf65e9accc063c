"""The whole way, through its two doors: `analyse` and `cut`."""

import itertools

import numpy as np
import pytest

from caesura.core.analysis import Analysis
from caesura.core.errors import InvalidModel, ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut, segment
from caesura.core.registry.methods import METHODS
from tests import oracles
from tests.animations import animation, bar, performing_bar, tumbling

PAPER = Parameters(method="joint-entropy")
ORDER = [0, 1, 2, 3, 0]


@pytest.fixture(scope="module")
def performance():
    """The bar, bending, swaying, stretching, swelling and bending again."""
    return performing_bar(ORDER)


@pytest.fixture(scope="module")
def analysed(performance):
    """Its analysis."""
    return analyse(performance.animation, PAPER)


def codes(result):
    """The codes of its notices."""
    return [notice.code for notice in result.notices]


def with_vertices(source, vertices, **changes):
    """The same mesh and rest, other vertices."""
    return animation(vertices, changes.get("triangles", source.triangles), rest=changes.get("rest", source.rest))


def test_the_energy_curve_is_the_papers(performance):
    """Strain by singular values, normalised by NumPy's percentile, binned and counted by loops: the same curve."""
    short = performing_bar([0, 1], seconds=1.0, rings=12).animation
    parameters = PAPER.model_copy(update={"window_seconds": 0.3})
    strains = oracles.strain(short.vertices(0, 60), short.rest, short.triangles)
    scale = np.percentile(strains, 99.9)
    expected = oracles.energy(oracles.bins(strains, scale, 10), 10, 9)
    found = analyse(short, parameters)
    assert found.strain_scale == pytest.approx(scale, rel=1e-4)
    np.testing.assert_allclose(found.energy, expected, atol=2e-3)
    neighbours = analyse(short, parameters.model_copy(update={"energy": "joint"}))
    np.testing.assert_allclose(neighbours.energy, oracles.energy(oracles.bins(strains, scale, 10), 10, 1), atol=2e-3)


def test_segments_tile_the_take(analysed):
    """Every frame has one label, for any K, and the document says the same."""
    for motions in (1, 2, 3, 5, "auto"):
        result = cut(analysed, PAPER.model_copy(update={"motions": motions}))
        spans = [(s.start, s.end) for s in result.segments]
        assert spans[0][0] == 0
        assert spans[-1][1] == analysed.frames == len(result.labels)
        assert all(a[1] == b[0] for a, b in itertools.pairwise(spans))
        assert len(result.document().segments) == len(spans)
        assert motions == "auto" or result.motions <= motions


def test_the_bars_motions_are_found(performance):
    """Motions that deform different parts are told apart, with a window and ω that suit their swings."""
    parameters = PAPER.model_copy(update={"motions": 4, "keyframe_window_seconds": 0.7, "window_seconds": 0.5})
    labels = segment(performance.animation, parameters).labels
    middle = [round((i + 0.5) * 6 * 30) for i in range(5)]
    assert labels[middle[0]] == labels[middle[4]]
    assert len(set(labels[middle[:4]].tolist())) == 4


def test_the_number_of_threads_changes_no_byte(performance):
    """With the codes in memory, and with strain computed twice."""
    for memory in (2**28, 0):
        one, two = (analyse(performance.animation, PAPER, threads=n, memory_bytes=memory) for n in (1, 2))
        assert one.to_bytes() == two.to_bytes()


def test_strain_computed_twice_gives_the_same_analysis(performance, analysed):
    """Codes that do not fit the memory change nothing."""
    assert analyse(performance.animation, PAPER, memory_bytes=0).to_bytes() == analysed.to_bytes()


@pytest.mark.parametrize("size", [8, 24, 1000])
def test_the_size_of_blocks_changes_no_energy(performance, analysed, size, monkeypatch):
    """Nor where the peaks are; features agree to rounding."""
    for module in ("vertex_pass", "features", "strain_at_peaks"):
        monkeypatch.setattr(f"caesura.core.block_pass.{module}.frames_per_block", lambda _: size)
    other = analyse(performance.animation, PAPER)
    np.testing.assert_array_equal(other.energy, analysed.energy)
    np.testing.assert_array_equal(other.peak_strain, analysed.peak_strain)
    for mine, theirs in zip(other.features, analysed.features, strict=True):
        np.testing.assert_allclose(mine.values, theirs.values, atol=1e-5)


def test_renumbered_vertices_give_the_same_curve(performance, analysed):
    """As do triangles in another order."""
    source, draw = performance.animation, np.random.default_rng(7)
    new = draw.permutation(source.vertex_count)
    place = np.argsort(new)
    shuffled = with_vertices(
        source,
        source.vertices(0, source.frames)[:, new],
        triangles=draw.permutation(place[source.triangles]),
        rest=source.rest[new],
    )
    np.testing.assert_array_equal(analyse(shuffled, PAPER).energy, analysed.energy)


def test_a_body_that_tumbles_through_space_has_the_same_curve(performance, analysed):
    """Rigid motion on top of the deformation changes the curve by no more than its rounding."""
    source = performance.animation
    vertices = source.vertices(0, source.frames).astype(np.float64)
    spun = np.stack([tumbling(v, 1, far=2.0, seed=i)[0] for i, v in enumerate(vertices)])
    found = analyse(with_vertices(source, spun), PAPER).energy
    np.testing.assert_allclose(found, analysed.energy, atol=0.02)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motions", [1, 3, "auto"])
def test_a_rigid_body_is_one_segment(method, motions):
    """Done, and it says so; there is nothing that any method could tell frames apart by."""
    rest, triangles = bar()
    parameters = Parameters(method=method, motions=motions)
    result = segment(animation(tumbling(rest, 120, far=3.0), triangles, rest=rest), parameters)
    assert "no-deformation" in codes(result)
    assert len(result.segments) == 1
    assert np.nanmax(result.energy) == 0


def test_rigid_parts_are_told_apart_by_their_distances():
    """Two boxes that only move against each other strain no triangle, and still have an energy curve."""
    rest, triangles = bar(rings=6)
    pair = np.concatenate([rest, rest + np.float32([2, 0, 0])])
    faces = np.concatenate([triangles, triangles + len(rest)])
    vertices = np.repeat(pair[None], 200, axis=0)
    vertices[:, len(rest) :, 1] += np.sin(np.arange(200) / 9)[:, None].astype(np.float32)
    found = analyse(animation(vertices, faces, rest=pair), PAPER)
    assert "no-strain" in codes(found)
    assert np.nanmax(found.energy) > 0.1
    assert [f.values.shape[1] > 0 for f in found.features] == [False, True]


def test_a_small_gesture_of_a_still_body_is_seen():
    """One corner of the mesh moves for a moment: less than a thousandth of all strains, and not taken for noise."""
    rest, triangles = bar(rings=100)
    vertices = np.repeat(rest[None], 300, axis=0)
    vertices[150:165, -1, 0] += 0.02 * np.sin(np.arange(15)).astype(np.float32)
    found = analyse(animation(vertices, triangles, rest=rest), PAPER)
    assert codes(found) == []
    assert found.strain_scale > 0.1
    assert found.features[0].values.shape[1] > 0


def test_a_skeleton_without_a_mesh_has_a_curve():
    """By the bends and distances of its joints, and it says so."""
    source = performing_bar([0, 1], rings=12).animation
    joints = source.vertices(0, source.frames)[:, ::8]
    found = analyse(animation(joints, np.zeros((0, 3))), PAPER)
    assert "no-mesh-skeleton" in codes(found)
    assert np.nanmax(found.energy) > 0.1
    assert all(features.values.shape[1] for features in found.features)


def test_a_skeleton_of_few_joints_has_a_curve_too():
    """No two of three joints are as near as those of a limb, or those that are stay so: all pairs count then."""
    time = np.arange(200) / 30
    joints = np.zeros((200, 3, 3), np.float32)
    joints[:, 1, 1] = 1
    joints[:, 2] = joints[:, 1] + np.stack([0 * time, np.cos(time), np.sin(time)], axis=1) / 5
    found = analyse(animation(joints, np.zeros((0, 3))), PAPER)
    assert np.nanmax(found.energy) > 0.1


def test_a_single_point_is_one_segment():
    """No triangle and no pair: nothing can deform."""
    points = np.random.default_rng(0).normal(size=(100, 1, 3))
    result = segment(animation(points, np.zeros((0, 3))), PAPER)
    assert len(result.segments) == 1
    assert "no-deformation" in codes(result)


def test_one_frame_is_no_motion():
    """Refused by name."""
    rest, triangles = bar(rings=3)
    with pytest.raises(InvalidModel) as refused:
        analyse(animation(rest[None], triangles), PAPER)
    assert refused.value.code == "no-motion"


@pytest.mark.parametrize("frames", [2, 3, 40])
def test_a_take_shorter_than_the_windows_is_one_segment(frames):
    """Two frames are enough to be answered; what is missing is said."""
    result = segment(animation(performing_bar([0], rings=5).animation.vertices(0, frames), bar(rings=5)[1]), PAPER)
    assert len(result.segments) == 1
    assert np.isnan(result.energy).all()
    assert {"shorter-than-windows", "no-key-frames"} <= set(codes(result))


def test_one_triangle_is_enough():
    """Stretched to and fro."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    size = 1 + 0.5 * np.abs(np.sin(np.arange(300) / 20))
    result = segment(animation(size[:, None, None] * corners, [[0, 1, 2]]), PAPER)
    assert result.energy[np.isfinite(result.energy)].size
    assert result.segments[-1].end == 300


def test_more_motions_than_key_frames_are_as_many_as_there_are(analysed):
    """And it says so."""
    result = cut(analysed, PAPER.model_copy(update={"motions": 500}))
    assert "fewer-motions" in codes(result)
    assert result.motions <= len(result.key_frames)


def test_no_area_anywhere_is_refused():
    """A mesh of coinciding corners."""
    with pytest.raises(InvalidModel) as refused:
        analyse(animation(np.zeros((5, 3, 3)), [[0, 1, 2]]), PAPER)
    assert refused.value.code == "degenerate-mesh"


def test_triangles_without_area_are_counted_and_left_out(performance, analysed):
    """The curve is that of the others."""
    source = performance.animation
    more = np.concatenate([source.triangles, [[0, 0, 1], [5, 5, 5]]])
    found = analyse(with_vertices(source, source.vertices(0, source.frames), triangles=more), PAPER)
    assert "2 of 626" in found.notices[-1].detail
    np.testing.assert_array_equal(found.energy, analysed.energy)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e30])
@pytest.mark.parametrize("frame", [0, 71])
def test_what_is_no_number_is_refused_by_frame_and_vertex(performance, value, frame):
    """Wherever it is, and also where it is a number too large to square."""
    vertices = performance.animation.vertices(0, 200).copy()
    vertices[frame, 17, 2] = value
    with pytest.raises(InvalidModel) as refused:
        analyse(with_vertices(performance.animation, vertices), PAPER, threads=2)
    assert refused.value.code == "non-finite-data"
    assert refused.value.where == {"frame": frame, "vertex": 17}


def test_a_rest_shape_that_is_no_number_is_refused(performance):
    """It is not a frame, so the vertex alone is named."""
    rest = performance.animation.rest.copy()
    rest[5, 1] = np.nan
    with pytest.raises(InvalidModel) as refused:
        analyse(with_vertices(performance.animation, performance.animation.vertices(0, 9), rest=rest), PAPER)
    assert (refused.value.code, refused.value.where) == ("non-finite-data", {"vertex": 5})


def test_the_rest_shape_can_be_chosen(performance):
    """A frame (which must be there), or the mean, which a tumbling body does not shrink."""
    source = performance.animation
    third = analyse(source, Parameters(rest=3)).energy
    assert not np.array_equal(third, analyse(source).energy, equal_nan=True)
    with pytest.raises(ParameterError, match="no-such-frame"):
        analyse(source, Parameters(rest=source.frames))
    rest, triangles = bar()
    spun = animation(tumbling(rest, 100), triangles)
    assert "no-deformation" in codes(analyse(spun, Parameters(rest="mean")))


def test_many_peaks_are_kept_as_patch_means(performance, analysed, monkeypatch):
    """Above the budget; key-frames are told apart all the same."""
    monkeypatch.setattr("caesura.core.pipeline.measure_strain_at_peaks", small_budget)
    found = analyse(performance.animation, PAPER)
    assert found.peak_strain.shape[1] <= 256 < analysed.peak_strain.shape[1]
    assert 0 <= found.peak_strain.min() <= found.peak_strain.max() <= 1


def small_budget(*arguments):
    """Strain at the peaks with room for nothing."""
    from caesura.core.block_pass.strain_at_peaks import measure_strain_at_peaks

    return measure_strain_at_peaks(*arguments, most_bytes=0)


def test_an_analysis_survives_being_stored(analysed):
    """The same cut from its bytes."""
    again = Analysis.from_bytes(analysed.to_bytes())
    assert cut(again, PAPER).to_json() == cut(analysed, PAPER).to_json()


def test_features_of_long_takes_are_learnt_from_a_sample(monkeypatch):
    """Drawn beforehand where the descriptors do not fit the memory: the same features to rounding."""
    source = performing_bar([0, 1, 2], seconds=25.0, rings=6).animation
    held = analyse(source, PAPER)
    monkeypatch.setattr("caesura.core.block_pass.features.HELD_BYTES", 0)
    one, two = (analyse(source, PAPER, threads=n) for n in (1, 2))
    assert one.to_bytes() == two.to_bytes()
    for sampled, whole in zip(one.features, held.features, strict=True):
        assert sampled.values.shape[0] == 2250
        assert sampled.energy_share > 0.99
        np.testing.assert_allclose(sampled.values, whole.values, atol=1e-5)


def test_progress_tells_every_stage(performance):
    """In order, each from 0; and what it raises ends the analysis."""
    heard = []
    segment(performance.animation, PAPER, threads=2, progress=lambda *told: heard.append(told))
    assert list(dict.fromkeys(stage for stage, _ in heard)) == ["rest shape", "strain", "energy", "key-frames", "cut"]
    assert all(0 <= fraction <= 1 for _, fraction in heard)

    def cancel(stage, fraction):
        raise TimeoutError(stage)

    with pytest.raises(TimeoutError, match="rest shape"):
        analyse(performance.animation, PAPER, threads=2, progress=cancel)


@pytest.mark.parametrize("method", ["switching", "joint-entropy"])
def test_a_take_is_cut_as_its_whole_analysis_is(method) -> None:
    """Though the strain at the peaks is measured only for methods that look at it."""
    source = performing_bar([0, 2, 0], seconds=2.0, rings=10).animation
    parameters = Parameters(method=method, motions=2)
    assert segment(source, parameters).to_json() == cut(analyse(source, parameters), parameters).to_json()
