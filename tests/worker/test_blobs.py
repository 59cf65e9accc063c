"""Files by key: moved in where they can be, read by range, mapped from where they are."""

import pytest

from worker.blobs import BlobMissing, Blobs
from worker.mapping import mapped_parts, scratch_space
from worker.schema import Part


@pytest.fixture
def blobs(tmp_path):
    """A local store, with its scratch on the same file system."""
    return Blobs.open(str(tmp_path / "blobs"), tmp_path / "scratch")


def test_an_upload_is_moved_and_not_copied(blobs, tmp_path):
    """The adopted file is the same file: no byte of a large upload is written twice."""
    received = tmp_path / "scratch" / "received"
    received.write_bytes(b"motion")
    number = received.stat().st_ino
    key = blobs.adopt(received)
    assert not received.exists()
    with blobs.path(key) as path:
        assert path.stat().st_ino == number


def test_a_blob_is_read_by_range(blobs):
    """A stream has the bytes asked for, and all of them where none are."""
    content = bytes(range(256)) * 10_000
    key = blobs.put(iter([content[:5], content[5:]]), "viewer")
    assert blobs.size(key) == len(content)
    assert b"".join(blobs.stream(key, 300, 2_000_000)) == content[300:2_000_000]
    assert b"".join(blobs.stream(key)) == content
    assert list(blobs.stream(key, 7, 7)) == []


def test_a_missing_blob_is_told_at_once(blobs):
    """Also by `stream`, before the first byte; deleting it twice is no fault."""
    key = blobs.put(b"motion", "exports")
    blobs.delete(key)
    blobs.delete(key)
    for ask in (blobs.read, blobs.size, blobs.stream, lambda key: blobs.path(key).__enter__()):
        with pytest.raises(BlobMissing):
            ask(key)


def test_a_stream_cut_short_leaves_nothing(blobs, tmp_path):
    """Whatever is raised while a blob is made is raised here, and there is no half blob."""

    def interrupted():
        yield b"half"
        raise InterruptedError

    with pytest.raises(InterruptedError):
        blobs.put(interrupted(), "viewer")
    assert not [path for path in (tmp_path / "blobs").rglob("*") if path.is_file()]


def test_a_store_by_url_lends_copies(tmp_path):
    """A store that is no folder gives its blob as a scratch file, which is gone afterwards."""
    (tmp_path / "remote").mkdir()
    blobs = Blobs.open((tmp_path / "remote").as_uri(), tmp_path / "scratch")
    received = tmp_path / "received"
    received.write_bytes(b"motion")
    key = blobs.adopt(received)
    assert not received.exists()
    with blobs.path(key) as path:
        assert path.parent == tmp_path / "scratch"
        assert path.read_bytes() == b"motion"
    assert not path.exists()


def test_parts_are_mapped_and_their_bytes_granted(blobs):
    """Each part is a read-only buffer, an empty one too; what is mapped is told to the allowance."""
    granted = []
    parts = [Part(name=str(i), key=blobs.put(c, "uploads"), bytes=len(c)) for i, c in enumerate((b"motion", b""))]
    with mapped_parts(blobs, parts, granted.append) as mapped:
        assert [bytes(mapped["0"]), bytes(mapped["1"])] == [b"motion", b""]
        assert mapped["0"].readonly
    assert granted == [6]


def test_scratch_is_a_file_without_a_name(tmp_path):
    """A buffer to write to that leaves nothing behind, whatever happens."""
    granted = []
    scratch = scratch_space(tmp_path, granted.append)
    buffer = scratch(5000)
    buffer[:6] = b"motion"
    assert (len(buffer), bytes(buffer[:6]), granted) == (5000, b"motion", [5000])
    assert list(tmp_path.iterdir()) == []
    assert len(scratch(0)) == 0
