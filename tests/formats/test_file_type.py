"""What a file is, by its first bytes."""

import pytest

from caesura.core.errors import UnsupportedMedia
from caesura.formats.file_type import detect_file_type


@pytest.mark.parametrize(
    ("head", "kind"),
    [
        (b"glTF\2\0\0\0", "glb"),
        (b'{"asset"', "gltf"),
        (b"\xef\xbb\xbf \r\n\t{", "gltf"),
        (b"[1]", "gltf"),
        ("{}".encode("utf-16"), "gltf"),
        (b"Kaydara FBX Binary  \0", "fbx"),
        (b"\xef\xbb\xbf; FBX 7.7.0 project file", "fbx"),
        (b"PK\3\4", "npz"),
        (b"PK\5\6", "npz"),
    ],
)
def test_formats_that_are_read_are_known_by_their_first_bytes(head: bytes, kind: str) -> None:
    """JSON in the wrong form is sent on too: its reader says what is wrong with it."""
    assert detect_file_type(head) == kind


@pytest.mark.parametrize(
    ("head", "says"),
    [
        (b"", "empty"),
        (b"<!DOCTYPE html><html>", "HTML"),
        (b"\n <html>", "HTML"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0", "git lfs pull"),
        (b"\x89PNG\r\n\x1a\n", "PNG"),
        (b"BLENDER-v300", "Blender"),
        (b"\x93NUMPY\1\0", "numpy.savez"),
        (b"gl", "not known"),
        (b"\0" * 256, "not known"),
    ],
)
def test_other_files_are_refused_by_what_they_are(head: bytes, says: str) -> None:
    """So that a person knows what to send instead."""
    with pytest.raises(UnsupportedMedia, match=says) as refused:
        detect_file_type(head)
    assert refused.value.code == "unsupported-media-type"
