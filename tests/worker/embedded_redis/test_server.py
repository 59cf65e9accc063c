"""The embedded server: one per folder, and what it was told survives its end."""

import os
import signal
import subprocess
import time

import pytest
import redis

from caesura.worker.embedded_redis.data_folder import ServerUnavailable
from caesura.worker.embedded_redis.server import EmbeddedRedis
from caesura.worker.records.connection import connect


def test_what_it_holds_survives_a_kill(tmp_path):
    """SIGKILL, then a new start: the append-only file has everything that is older than a second."""
    first = EmbeddedRedis(tmp_path)
    first.start()
    with connect(first.url) as client:
        client.set("kept", "yes")
        time.sleep(1.1)
    os.kill(first.pid, signal.SIGKILL)
    first.stop()
    second = EmbeddedRedis(tmp_path)
    second.start()
    with connect(second.url) as client:
        assert client.get("kept") == b"yes"
    second.stop()


def test_one_server_for_a_folder(tmp_path):
    """A second one would share the file: it is refused, with the process to end."""
    first = EmbeddedRedis(tmp_path)
    first.start()
    with pytest.raises(ServerUnavailable, match=f"process {os.getpid()}"):
        EmbeddedRedis(tmp_path).start()
    first.stop()


def test_a_long_folder_name_has_a_short_socket(tmp_path):
    """A socket's name has room for about 100 bytes; with more, it lies elsewhere."""
    server = EmbeddedRedis(tmp_path / ("long and spaced " * 8))
    server.start()
    with connect(server.url) as client:
        assert client.ping()
    server.stop()


def test_a_newer_file_is_not_given_to_an_older_server(tmp_path):
    """An older server would start empty, or not at all."""
    (tmp_path / "valkey").mkdir()
    (tmp_path / "valkey" / "version").write_text("99")
    with pytest.raises(ServerUnavailable, match="99"):
        EmbeddedRedis(tmp_path).start()


def test_a_version_that_a_full_disk_cut_short_is_written_again(tmp_path):
    """The file is there and empty: the server starts, and says which it is."""
    (tmp_path / "valkey").mkdir()
    (tmp_path / "valkey" / "version").touch()
    server = EmbeddedRedis(tmp_path)
    server.start()
    assert int((tmp_path / "valkey" / "version").read_text())
    server.stop()


def test_a_system_server_serves_as_well(tmp_path, redis_server):
    """Redis or Valkey of the system, where the wheel's is not wanted."""
    server = EmbeddedRedis(tmp_path, str(redis_server))
    server.start()
    with redis.Redis.from_url(server.url) as client:
        assert client.ping()
    server.stop()


def test_a_damaged_file_is_mended_by_the_program_that_is_there(tmp_path):
    """Valkey's log names a program that is not installed; the error has a command that is, and it works."""
    server = EmbeddedRedis(tmp_path)
    server.start()
    with connect(server.url) as client:
        client.mset({"first": "kept"})
        client.mset({f"later-{number}": "lost" for number in range(100)})
    server.stop()
    (file,) = tmp_path.glob("valkey/appendonlydir/*.incr.aof")
    content = file.read_bytes()
    file.write_bytes(content[:200] + bytes(20) + content[220:])
    with pytest.raises(ServerUnavailable, match="append-only file is damaged") as refused:
        server.start()
    server.stop()
    command = str(refused.value).partition("which is lost: ")[2]
    subprocess.run(command, shell=True, input=b"y\n", check=True, timeout=30, stdout=subprocess.DEVNULL)
    server.start()
    with connect(server.url) as client:
        assert client.keys() == [b"first"]
    server.stop()
