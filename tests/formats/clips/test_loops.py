"""Clips that loop: which segments, how they are closed, and what becomes of their travel."""

import numpy as np
import pytest

from caesura.core.errors import ParameterError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from caesura.core.segmentation_document import Interval, Loop
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.clip_plan import TakeFrames, plan_clips
from tests.formats.clips.making import chunks_of, clips_of, cut_at, names_of
from tests.formats.opening import opened
from tests.glb import bending_strip

RATE = 30


def walk(drift=(0.4, 0.0, 0.0), uneven=0.0):
    """A strip that bends once a second for three seconds, travels, and comes back a little off."""
    times = np.arange(0, 3 + 1e-9, 1 / RATE)
    bend = 0.4 * np.sin(2 * np.pi * times) + uneven * times
    turns = np.stack([0 * times, 0 * times, np.sin(bend / 2), np.cos(bend / 2)], axis=1)
    bob = np.stack([0 * times, 0.02 * np.sin(4 * np.pi * times), 0 * times], axis=1)
    model = bending_strip()
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    model.animate(2, "rotation", times.tolist(), turns, "LINEAR")
    model.animate(1, "translation", times.tolist(), bob + times[:, None] * np.array(drift), "LINEAR")
    return model.glb()


def looped(data, loops, cuts=()):
    """The document of a take, its segments with these best loops."""
    document = cut_at(opened(data, fps=RATE), cuts)
    segments = tuple(s.model_copy(update={"best_loop": loop}) for s, loop in zip(document.segments, loops, strict=True))
    return document.model_copy(update={"segments": segments})


def loop(start, end, seam=0.5):
    return Loop(start=start, end=end, cycles=1, seam=seam, match="good")


def planned(document, **options):
    last = document.source.start_seconds + (document.frames - 1) / document.frame_rate
    return plan_clips(document, ClipOptions.of(options), [TakeFrames(0, 0, document.frames, 0.0, last, last)])


def test_auto_cuts_the_best_segment_of_each_motion_to_its_loop():
    """The others stay as they are, but for those a person has marked; a discarded one is no loop."""
    data = walk()
    document = looped(data, [loop(2, 14), None, loop(33, 43, seam=0.1), loop(50, 55)], [20, 30, 48])
    clips = planned(document, loop="auto", handles_seconds=0.1)
    assert [(clip.name, clip.start_frame, clip.end_frame) for clip in clips] == [
        ("A_01", 0, 20), ("B_01", 20, 30), ("A_02-loop", 33, 43), ("B_02-loop", 50, 55),
    ]  # fmt: skip
    assert (clips[2].start, clips[2].end) == (pytest.approx(33 / 30), pytest.approx(43 / 30))  # no handles
    assert clips[2].extras["loop"] == {"cycles": 1, "seam": 0.1, "match": "good"}
    marked = document.segments[0].model_copy(update={"loop": True})
    everything = document.model_copy(update={"segments": (marked, *document.segments[1:])})
    assert [clip.name for clip in planned(everything, loop="auto", only="1")] == ["A_01-loop"]
    assert planned(everything, loop="auto", only="1")[0].end_frame == 14
    dead = document.segments[2].model_copy(update={"discard": True})
    left = document.model_copy(update={"segments": (*document.segments[:2], dead, document.segments[3])})
    assert [clip.name for clip in planned(left, loop="auto")] == ["A_01-loop", "B_01", "B_02-loop"]


def test_a_loop_is_not_split_at_repetitions():
    """It is whole repetitions already."""
    document = looped(walk(), [loop(0, 60)])
    repeated = document.segments[0].model_copy(
        update={"repeats": tuple(Interval(start=a, end=a + 30) for a in (0, 30))}
    )
    document = document.model_copy(update={"segments": (repeated,)})
    assert len(planned(document, loop="auto", split_repeats=True)) == 1


def poses(glb, name, rate=RATE):
    """Every vertex of a clip, frame by frame."""
    clip = opened(glb, take=name, fps=rate)
    return clip.vertices(0, clip.frames).astype(float)


def test_a_blend_closes_the_loop_and_leaves_the_rest_alone():
    """The last pose is the first; before the blend nothing moves otherwise than in the take."""
    data = walk(drift=(0, 0, 0), uneven=0.1)
    document = looped(data, [loop(10, 70)])
    plain, closed = (
        poses(clips_of(data, document, loop="auto", **more), "A_01-loop") for more in ({}, {"loop_blend_seconds": 0.5})
    )
    assert np.abs(plain[-1] - plain[0]).max() > 0.02
    np.testing.assert_allclose(closed[-1], closed[0], atol=1e-5)
    np.testing.assert_allclose(closed[:45], plain[:45], atol=1e-5)
    assert np.abs(np.diff(closed, axis=0)).max() < 1.5 * np.abs(np.diff(plain, axis=0)).max()


def test_travel_is_kept_with_a_blend_and_taken_out_in_place():
    """A walker that goes on stays where it goes, or walks on the spot and still bobs."""
    data = walk()
    document = looped(data, [loop(0, 60)])
    kept = poses(clips_of(data, document, loop="auto", loop_blend_seconds=0.3), "A_01-loop")
    assert (kept[-1] - kept[0]).mean(axis=0)[0] == pytest.approx(0.8, abs=1e-3)
    placed = poses(clips_of(data, document, loop="auto", root="in_place"), "A_01-loop")
    np.testing.assert_allclose(placed[-1], placed[0], atol=1e-4)
    middle = placed.mean(axis=1)
    assert np.ptp(middle[:, 1]) > 0.03  # it bobs
    take = opened(data, fps=RATE).vertices(0, 61).astype(float)
    np.testing.assert_allclose(np.diff(take.mean(1)[:, 0]) - np.diff(middle[:, 0]), 0.4 / RATE, atol=1e-4)


@pytest.mark.parametrize("interpolation", ["STEP", "CUBICSPLINE"])
def test_other_interpolations_are_closed_or_stay(interpolation):
    """A spline becomes keys that are mixed, close enough; steps stay steps, for nothing is between them."""
    times = np.linspace(0, 2, 21)
    turned = 0.6 * np.sin(np.pi * times) + 0.1 * times
    turns = np.stack([0 * times, 0 * times, np.sin(turned / 2), np.cos(turned / 2)], axis=1)
    if interpolation == "CUBICSPLINE":
        turns = np.stack([0 * turns, turns, 0 * turns], 1).reshape(-1, 4)
    model = bending_strip()
    model.json["animations"] = [{"name": "take", "samplers": [], "channels": []}]
    model.animate(2, "rotation", times.tolist(), turns, interpolation)
    data = model.glb()
    document = looped(data, [loop(0, 60)])
    glb = clips_of(data, document, loop="auto", loop_blend_seconds=0.4)
    made = poses(glb, "A_01-loop")
    take = opened(data, fps=RATE).vertices(0, 61).astype(float)
    np.testing.assert_allclose(made[:40], take[:40], atol=2e-3)
    if interpolation == "CUBICSPLINE":
        np.testing.assert_allclose(made[-1], made[0], atol=1e-5)
    samplers = chunks_of(glb)[0]["animations"][0]["samplers"]
    assert {s.get("interpolation", "LINEAR") for s in samplers} == {"STEP" if interpolation == "STEP" else "LINEAR"}


def test_kinds_of_files_that_stay_as_they_are_say_so(shared):
    """A BVH is cut to its loop, but its motion is not bent: that needs GLB."""
    data = (shared / "data" / "real" / "performed" / "86_01_30fps.bvh").read_bytes()[:]
    document = cut_at(opened({"a.bvh": data}), [100])
    with pytest.raises(ParameterError) as refused:
        clips_of({"a.bvh": data}, document, loop="auto", root="in_place")
    assert refused.value.where["parameter"] == "root"
    assert "form=glb" in str(refused.value)


@pytest.mark.parametrize(
    ("name", "take", "labels"),
    [
        ("gltf/Fox.glb", 1, "Walk"),
        ("gltf/Fox.glb", 2, "Run"),
        ("gltf/CesiumMan.glb", 0, "Walk"),
        ("gltf/Horse.glb", 0, "Run"),
        ("takes/fox_hard_0.glb", 0, None),
        ("takes/fox_hard_1.glb", 0, None),
        ("takes/godotman_hard_0.glb", 0, None),
        ("takes/godotman_hard_1.glb", 0, None),
    ],
)
def test_the_seam_of_walks_and_runs_is_no_more_than_a_step_at_twice_the_speed(shared, name, take, labels):
    """In the exported clip: the last pose is as near to the first as two frames that are two apart are."""
    data = (shared / "data" / name).read_bytes()
    animation = opened(data, take=take)
    document = segment(animation, Parameters(take=take)).document()
    glb = clips_of(data, document, loop="auto", root="in_place")
    loops = [name for name in names_of(glb) if name.endswith("-loop")]
    assert len(loops) >= document.motions - (0 if labels else 1)
    for clip in loops:
        shown = poses(glb, clip, animation.frame_rate)
        apart = np.linalg.norm(shown[2:] - shown[:-2], axis=2).mean(axis=1)
        assert np.linalg.norm(shown[-1] - shown[0], axis=1).mean() <= np.median(apart), (clip, len(shown))
