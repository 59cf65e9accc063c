"""Clips of what is no glTF: files of the kind that was sent, which are the take again one after the other."""

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from caesura.core.errors import ParameterError
from caesura.service.commands.cli import main
from tests.formats.clips.making import clips_of, cut_at, names_of
from tests.formats.opening import opened
from tests.formats.point_caches import MESH, folding_sheet, mdd, obj, pc2
from tests.formats.test_body_poses import amass
from tests.formats.test_zip import zipped

FRAMES = 40
CUTS = [11, 30]
NAMES = ["A_01", "B_01", "A_02"]
PLACES = folding_sheet(FRAMES)
SECONDS = 2 + np.arange(FRAMES) / 24
HEAD = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  End Site
  {
    OFFSET 0 1 0
  }
}
MOTION
Frames: 40
Frame Time: 0.0333333
"""
LINES = [f"{i} 0.25 {i * i}e-1 {i * 3} 0 -{i}" for i in range(FRAMES)]
BVH = (HEAD + "\n".join(LINES) + "\n").encode()


def unzipped(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        return {name: archive.read(name) for name in archive.namelist()}


def drawn(data: bytes | dict[str, bytes], **parameters: float) -> np.ndarray:
    take = opened(data, **parameters)
    return take.vertices(0, take.frames)


def test_clips_of_a_bvh_have_its_lines_word_for_word() -> None:
    """The same skeleton and frame time, and each frame in one clip."""
    clips = unzipped(clips_of(BVH, cut_at(opened(BVH), CUTS)))
    assert list(clips) == [f"{name}.bvh" for name in NAMES]
    heads, lines = zip(*(clip.decode().split("0.0333333\n") for clip in clips.values()), strict=True)
    assert "".join(lines).splitlines() == LINES
    assert list(heads) == [
        (HEAD.replace("Frames: 40", f"Frames: {n}")).removesuffix("0.0333333\n") for n in (11, 19, 10)
    ]
    np.testing.assert_allclose(np.concatenate([drawn(clip) for clip in clips.values()]), drawn(BVH), atol=1e-3)


def test_a_bvh_whose_frames_are_not_lines_is_cut_by_its_numbers() -> None:
    """Two lines a frame: the same numbers, one line a frame."""
    broken = BVH.replace(b" 0.25 ", b" 0.25\n")
    clips = unzipped(clips_of(broken, cut_at(opened(broken), CUTS)))
    np.testing.assert_allclose(np.concatenate([drawn(clip) for clip in clips.values()]), drawn(BVH), atol=1e-3)


def test_clips_are_frames_of_the_file_at_whatever_rate_it_was_read() -> None:
    """Of 30 a second, read at 15 or 60 from half a second on: every frame from there is in one clip."""
    for rate, cuts in ((15, [5]), (60, [21])):
        take = opened(BVH, fps=rate, start=0.5)
        document = cut_at(take, cuts)
        document = document.model_copy(update={"source": document.source.model_copy(update={"start_seconds": 0.5})})
        clips = unzipped(clips_of(BVH, document))
        assert [
            line for clip in clips.values() for line in clip.decode().split("0.0333333\n")[1].splitlines()
        ] == LINES[15:]


@pytest.mark.parametrize("data", [pc2(PLACES), mdd(PLACES, SECONDS)], ids=["pc2", "mdd"])
def test_clips_of_a_cache_are_its_places_and_its_mesh(data: bytes) -> None:
    """One after the other they are the take; each is read with the OBJ that comes with them."""
    kind = "pc2" if data.startswith(b"P") else "mdd"
    parts = {f"sheet.{kind}": data, "sheet.obj": MESH}
    take = opened(parts)
    for upload in (parts, {"a.zip": zipped({f"in/{name}": part for name, part in parts.items()})}):
        files = unzipped(clips_of(upload, cut_at(take, CUTS)))
        assert list(files) == [*(f"{name}.{kind}" for name in NAMES), "sheet.obj"]
        mesh = files.pop("sheet.obj")
        clips = [opened({name: clip, "mesh.obj": mesh}) for name, clip in files.items()]
        assert mesh == MESH
        assert [clip.frames for clip in clips] == [11, 19, 10]
        assert {clip.frame_rate for clip in clips} == {take.frame_rate}
        np.testing.assert_array_equal(
            np.concatenate([c.vertices(0, c.frames) for c in clips]), PLACES.astype(np.float32)
        )


def test_an_mdd_begins_anew_or_keeps_its_time() -> None:
    """As its take begins, at 2 seconds; with `origin=keep` where the clip was in it. So do the frames of a PC2."""
    parts = {"a.mdd": mdd(PLACES, SECONDS), "a.obj": MESH}
    document = cut_at(opened(parts), CUTS)
    for origin, expected in (("start", SECONDS[0]), ("keep", SECONDS[11])):
        clip = unzipped(clips_of(parts, document, origin=origin))["B_01.mdd"]
        assert np.frombuffer(clip, ">f4", 1, 8)[0] == pytest.approx(expected)
        assert np.diff(np.frombuffer(clip, ">f4", 19, 8)) == pytest.approx(1 / 24, rel=1e-4)
    parts = {"a.pc2": pc2(PLACES), "a.obj": MESH}
    for origin, expected in (("start", 0), ("keep", 11)):
        clip = unzipped(clips_of(parts, document, origin=origin))["B_01.pc2"]
        assert np.frombuffer(clip, "<f4", 1, 20)[0] == expected


def test_clips_of_shapes_are_folders_of_them() -> None:
    """Each file as it was sent; those of one folder are an upload again."""
    shapes = {f"walk/f{i:03}.obj": obj(places, [[0, 1, 2], [3, 4, 5]]) for i, places in enumerate(PLACES)}
    data = zipped(shapes)
    files = unzipped(clips_of(data, cut_at(opened(data), CUTS)))
    assert list(files.values()) == list(shapes.values())
    assert list(files)[:2] + list(files)[-1:] == ["A_01/f000.obj", "A_01/f001.obj", "A_02/f039.obj"]
    second = zipped({name: part for name, part in files.items() if name.startswith("B_01/")})
    np.testing.assert_array_equal(drawn(second), drawn(data)[11:30])


def test_shapes_that_are_called_alike_keep_their_folders() -> None:
    """A folder for each frame."""
    data = zipped({f"{i}/shape.obj": obj(places, [[0, 1, 2], [3, 4, 5]]) for i, places in enumerate(PLACES[:8])})
    files = list(unzipped(clips_of(data, cut_at(opened(data), [4]))))
    assert files == [f"{'AB'[i // 4]}_01/{i}/shape.obj" for i in range(8)]


def test_clips_of_poses_are_poses() -> None:
    """Their rows of `poses` and `trans`, and everything else as it was: the person of `betas` stays the same."""
    poses = np.random.default_rng(4).normal(size=(FRAMES, 156))
    data = amass(poses, betas=np.arange(16.0))
    files = unzipped(clips_of(data, cut_at(opened(data), CUTS)))
    assert list(files) == [f"{name}.npz" for name in NAMES]
    clips = [np.load(io.BytesIO(clip)) for clip in files.values()]
    np.testing.assert_array_equal(np.concatenate([clip["poses"] for clip in clips]), poses)
    for clip in clips:
        assert set(clip) == {"poses", "trans", "mocap_framerate", "betas", "gender", "dmpls"}
        np.testing.assert_array_equal(clip["betas"], np.arange(16))
    np.testing.assert_allclose(np.concatenate([drawn(clip) for clip in files.values()]), drawn(data), atol=1e-5)


def test_handles_are_frames_of_the_file() -> None:
    """A tenth of a second of 30 is three, as far as the take goes."""
    files = unzipped(clips_of(BVH, cut_at(opened(BVH), CUTS), handles_seconds=0.1))
    assert [opened(clip).frames for clip in files.values()] == [14, 25, 13]


def test_a_glb_is_made_where_it_can_be_and_asked_for() -> None:
    """Of a skeleton; of vertices that nothing moves the answer is what to send instead."""
    assert names_of(clips_of(BVH, cut_at(opened(BVH), CUTS), form="glb")) == NAMES
    parts = {"a.pc2": pc2(PLACES), "a.obj": MESH}
    with pytest.raises(ParameterError, match="form=source") as refused:
        clips_of(parts, cut_at(opened(parts), CUTS), form="glb")
    assert refused.value.code == "no-glb-clips"


def test_the_same_request_gives_the_same_bytes() -> None:
    """Of every kind."""
    shapes = zipped({f"f{i}.obj": obj(places, [[0, 1, 2], [3, 4, 5]]) for i, places in enumerate(PLACES[:4])})
    for parts, cuts in (
        ({"a.bvh": BVH}, CUTS),
        ({"a.pc2": pc2(PLACES), "a.obj": MESH}, CUTS),
        ({"a.zip": shapes}, [2]),
    ):
        document = cut_at(opened(parts), cuts)
        assert clips_of(parts, document) == clips_of(parts, document)


def test_the_command_writes_what_the_name_says(tmp_path: Path) -> None:
    """`--clips walk.glb` of a BVH is a GLB; any other name gets its own kind; a cache is refused as a GLB."""
    (tmp_path / "walk.bvh").write_bytes(BVH)
    for name, start in (("walk.glb", b"glTF"), ("walk.zip", b"PK")):
        run = CliRunner().invoke(main, ["segment", str(tmp_path / "walk.bvh"), "--clips", str(tmp_path / name)])
        assert run.exit_code == 0, run.output
        assert (tmp_path / name).read_bytes().startswith(start)
    (tmp_path / "a.pc2").write_bytes(pc2(PLACES))
    (tmp_path / "a.obj").write_bytes(MESH)
    files = [str(tmp_path / "a.pc2"), str(tmp_path / "a.obj")]
    run = CliRunner().invoke(main, ["segment", *files, "--clips", str(tmp_path / "a.glb")])
    assert run.exit_code == 2
    assert "form=source" in run.output
