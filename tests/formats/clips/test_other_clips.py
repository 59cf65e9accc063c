"""Vertex sequences as clips, and key-frames as one file."""

import io
import zipfile

import numpy as np
import pytest

from caesura.core.errors import InvalidModel
from tests.formats.clips.making import chunks_of, clips_of, cut_at, key_poses_of, names_of
from tests.formats.opening import opened
from tests.glb import bending_strip


@pytest.fixture
def sequence():
    """Ten frames of a triangle, as the bytes of an NPZ; numbers of double precision."""
    out = io.BytesIO()
    vertices = np.random.default_rng(3).normal(size=(10, 3, 3))
    np.savez_compressed(out, vertices=vertices, triangles=[[0, 1, 2]], frame_rate=25.0, rest=vertices[4])
    return out.getvalue(), vertices


def test_a_sequence_becomes_a_zip_of_sequences(sequence):
    """One after the other they are the take again, number by number, and each can be uploaded by itself."""
    data, vertices = sequence
    document = cut_at(opened(data), [3, 7])
    made = clips_of(data, document)
    assert made == clips_of(data, document)
    with zipfile.ZipFile(io.BytesIO(made)) as archive:
        assert archive.namelist() == ["A_01.npz", "B_01.npz", "A_02.npz"]
        clips = [np.load(io.BytesIO(archive.read(name))) for name in archive.namelist()]
        assert opened(archive.read("B_01.npz")).frames == 4
    np.testing.assert_array_equal(np.concatenate([clip["vertices"] for clip in clips]), vertices)
    assert [float(clip["start_seconds"]) for clip in clips] == [0, 3 / 25, 7 / 25]
    assert {float(clip["frame_rate"]) for clip in clips} == {25}
    np.testing.assert_allclose(clips[0]["rest"], vertices[4].astype(np.float32))


def test_handles_of_a_sequence_are_whole_frames(sequence):
    """0.08 seconds of 25 a second are two, as far as the take goes."""
    data, _ = sequence
    with zipfile.ZipFile(io.BytesIO(clips_of(data, cut_at(opened(data), [3, 7]), handles_seconds=0.08))) as archive:
        lengths = [len(np.load(io.BytesIO(archive.read(name)))["vertices"]) for name in archive.namelist()]
    assert lengths == [5, 8, 5]


def test_key_poses_of_a_gltf_step_from_one_to_the_next():
    """From each key-frame until the next the pose is the one that the take has at it."""
    data = bending_strip().glb()
    take = opened(data, fps=30)
    document = cut_at(take, [12])
    poses = opened(key_poses_of(data, document), take="key_frames", fps=30)
    first, second = (key.frame for key in document.key_frames)
    assert poses.frames == second + 1
    for frame in range(poses.frames):
        expected = first if frame < second else second
        np.testing.assert_allclose(poses.vertices(frame, frame + 1), take.vertices(expected, expected + 1), atol=1e-6)


def test_key_poses_of_a_sequence_are_morph_targets(sequence):
    """The same, of what has no skeleton."""
    data, vertices = sequence
    document = cut_at(opened(data), [5])
    poses = opened(key_poses_of(data, document), fps=25)
    first, second = (key.frame for key in document.key_frames)
    assert poses.frames == second + 1
    np.testing.assert_allclose(poses.vertices(first, first + 1)[0], vertices[first], atol=1e-6)
    np.testing.assert_allclose(poses.vertices(second, second + 1)[0], vertices[second], atol=1e-6)
    assert chunks_of(key_poses_of(data, document))[0]["asset"]["extras"]["segmentation"] == document.id


def test_no_key_frames_are_no_file():
    """A refusal says what to ask for instead."""
    data = bending_strip().glb()
    with pytest.raises(InvalidModel, match="threshold") as refused:
        key_poses_of(data, cut_at(opened(data, fps=30), [12]).model_copy(update={"key_frames": ()}))
    assert refused.value.code == "no-key-frames"


def test_a_bvh_can_come_back_as_a_glb_of_its_skeleton():
    """What is read as a glTF is written as one, where that is asked for."""
    frames = "\n".join(f"{i} 0 0 {i * 3} 0 0" for i in range(20))
    data = (
        "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
        "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
        f"End Site\n{{\nOFFSET 0 1 0\n}}\n}}\nMOTION\nFrames: 20\nFrame Time: 0.0333333\n{frames}\n"
    ).encode()
    take = opened(data, fps=30)
    document = cut_at(take, [8])
    glb = clips_of(data, document, form="glb")
    assert names_of(glb) == ["A_01", "B_01"]
    clip = opened(glb, take="B_01", fps=30)
    np.testing.assert_allclose(clip.vertices(0, clip.frames), take.vertices(8, 8 + clip.frames), atol=1e-5)
