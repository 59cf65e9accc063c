"""Clips of a part of a take, and of all takes one after the other."""

import numpy as np
import pytest

from caesura.core.document import Source
from tests.formats.clips.making import chunks_of, clips_of, cut_at, key_poses_of, names_of
from tests.formats.opening import opened
from tests.glb import square


def two_takes() -> bytes:
    """A square that moves along x for a second, and then one that moves along y for two, its first key at 0.5 s."""
    model = square()
    model.json["animations"] = []
    for name, axis, times in (("along", 0, np.arange(31) / 30), ("up", 1, 0.5 + np.arange(46) / 30)):
        places = np.zeros((len(times), 3))
        places[:, axis] = times**2
        sampler = {"input": model.accessor(times), "output": model.accessor(places)}
        channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
        model.json["animations"].append({"name": name, "samplers": [sampler], "channels": [channel]})
    return model.glb()


def drawn(data: bytes, cuts: list[int], **parameters: object):
    """The animation and its document, which knows how it was drawn."""
    animation = opened(data, **parameters)
    document = cut_at(animation, cuts)
    source = Source(
        take=animation.take.index, name=animation.take.name, fps=animation.frame_rate,
        start_seconds=animation.start_seconds,
    )  # fmt: skip
    return animation, document.model_copy(
        update={"source": source, "parameters": document.parameters | {"take": animation.take.name} | parameters}
    )


@pytest.mark.parametrize("trim", [False, True])
def test_all_takes_become_clips_of_their_own(trim):
    """A motion across two takes is a clip in each, and every frame of the film is in its clip."""
    data = two_takes()
    film, document = drawn(data, [10, 40], take="all", trim=trim, fps=30)
    glb = clips_of(data, document)
    assert names_of(glb) == ["A_01", "B_01", "B_02", "A_02"]
    bounds = [(0, 10), (10, 31), (31, 40), (40, film.frames)]
    for name, (start, end) in zip(names_of(glb), bounds, strict=True):
        clip = opened(glb, take=name, fps=30)
        expected = film.vertices(start, end)
        np.testing.assert_allclose(clip.vertices(0, end - start), expected, atol=1e-6)
    poses = opened(key_poses_of(data, document), take="key_frames_01", fps=30)
    frame = document.key_frames[0].frame
    np.testing.assert_allclose(poses.vertices(frame, frame + 1), film.vertices(frame, frame + 1), atol=1e-6)


def test_a_part_of_a_take_is_cut_on_its_own_clock():
    """Frame 0 is at the second where the part begins; the clips end where it does, and say when that was."""
    data = two_takes()
    part, document = drawn(data, [5], take="along", start=0.2, end=0.7, fps=30)
    glb = clips_of(data, document)
    assert names_of(glb) == ["A_01", "B_01", "up"]
    root, _ = chunks_of(glb)
    said = [animation["extras"]["caesura"] for animation in root["animations"][:2]]
    assert [s["start_seconds"] for s in said] == pytest.approx([0.2, 0.2 + 5 / 30], abs=1e-6)
    assert said[1]["end_seconds"] == pytest.approx(0.7, abs=1e-6)
    for name, start, end in (("A_01", 0, 5), ("B_01", 5, part.frames)):
        clip = opened(glb, take=name, fps=30)
        np.testing.assert_allclose(clip.vertices(0, end - start), part.vertices(start, end), atol=1e-6)
