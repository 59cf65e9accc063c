"""Files by key: moved in where they can be, read by range, mapped from where they are."""

import time

import pytest

from caesura.worker.records.record_types import Part
from caesura.worker.store.blobs import PIECE_BYTES, BlobMissing, Blobs
from caesura.worker.store.memory_maps import map_parts, scratch_space
from tests.object_store import BUCKET, ObjectStore


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


@pytest.mark.parametrize("key", ["../outside", "uploads/../../outside", "{}/outside"])
def test_no_key_leads_out_of_the_folder(blobs, tmp_path, key):
    """Keys come from Redis: one that somebody put there reads nothing else, and deletes nothing."""
    outside = tmp_path / "outside"
    outside.write_text("of the machine")
    key = key.format(tmp_path)
    for ask in (blobs.read, blobs.size, blobs.stream, lambda key: blobs.path(key).__enter__()):
        with pytest.raises(BlobMissing):
            ask(key)
    blobs.delete(key)
    assert outside.exists()


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
    with map_parts(blobs, parts, granted.append) as mapped:
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


@pytest.fixture(scope="module")
def bucket():
    """A real object store."""
    store = ObjectStore.start()
    yield store
    store.stop()


@pytest.fixture
def remote(bucket, tmp_path, monkeypatch):
    """The blobs below a prefix of its bucket."""
    for name, value in bucket.environment.items():
        monkeypatch.setenv(name, value)
    return Blobs.open(f"s3://{BUCKET}/some/prefix", tmp_path / "scratch")


@pytest.mark.parametrize("store", ["blobs", "remote"])
def test_several_small_blobs_are_kept_at_once(request, store):
    """Each under a key of its own, in their order; none at all is fine."""
    blobs = request.getfixturevalue(store)
    contents = [bytes([n]) * n for n in range(20)]
    keys = blobs.put_all(contents, "collections")
    assert [blobs.read(key) for key in keys] == contents
    assert len(set(keys)) == 20
    assert blobs.put_all([], "collections") == []
    assert len(list(blobs.all())) == 20
    for key in keys:
        blobs.delete(key)


def test_a_bucket_keeps_what_a_folder_keeps(remote, bucket, tmp_path):
    """Moved in, made piece by piece, read whole and by range, lent, listed by the keys that were given, deleted."""
    large = bytes(range(256)) * 30_000
    received = tmp_path / "received"
    received.write_bytes(large)
    adopted = remote.adopt(received)
    made = remote.put(iter([large, b"more"]), "exports")
    assert not received.exists()
    assert remote.read(made) == large + b"more"
    assert b"".join(remote.stream(adopted, 300, 6_000_000)) == large[300:6_000_000]
    with remote.path(adopted) as path:
        assert path.read_bytes() == large
    assert not list((tmp_path / "scratch").iterdir())
    assert sorted(remote.all()) == sorted([(adopted, len(large)), (made, len(large) + 4)])
    assert sorted(bucket.keys()) == sorted(f"some/prefix/{key}" for key in (adopted, made))
    for key in (adopted, made, adopted):
        remote.delete(key)
    for ask in (remote.read, remote.size, remote.stream, lambda key: remote.path(key).__enter__()):
        with pytest.raises(BlobMissing):
            ask(adopted)


def test_a_bucket_has_no_half_blob_either(remote, bucket):
    """What is cut short in the middle of its parts leaves neither an object nor parts that are paid for."""

    def interrupted():
        yield bytes(6_000_000)
        raise InterruptedError

    with pytest.raises(InterruptedError):
        remote.put(interrupted(), "viewer")
    assert (bucket.keys(), bucket.half_written()) == ([], [])


def test_a_slow_reader_gets_all_of_a_large_blob(bucket, tmp_path, monkeypatch):
    """A download may take longer than one request to the store: a person's line is slower than the store's."""
    for name, value in (bucket.environment | {"AWS_TIMEOUT": "1s"}).items():
        monkeypatch.setenv(name, value)
    remote = Blobs.open(f"s3://{BUCKET}", tmp_path / "scratch")
    content = bytes(range(256)) * (5 * PIECE_BYTES // 512)
    key = remote.put(content, "exports")
    read = b""
    for piece in remote.stream(key):
        time.sleep(0.5)
        read += piece
    assert read == content
    remote.delete(key)
