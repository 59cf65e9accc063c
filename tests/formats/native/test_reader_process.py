"""A reader of native code in a process of its own: its answer comes through, and whatever ends it ends it alone."""

import os
import sys
import time

import pytest

from caesura.core.errors import BrokenContainer, CaesuraError, InvalidModel, LimitExceeded, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.gltf.converted_gltf import GltfConversion
from caesura.formats.native.landlock import landlock_version
from caesura.formats.native.read_as_gltf import read_as_glb
from caesura.formats.native.reader_process import NativeReader, ReaderProcess
from tests.formats.native.misbehaving import BROKEN_OUT

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="enforced by Linux")


def read(function: str, data: bytes = b"data", **limits: int) -> GltfConversion:
    """What a reader of `misbehaving` answers."""
    reader = NativeReader("toy", "json", f"tests.formats.native.misbehaving:{function}")
    return read_as_glb(reader, memoryview(data), Limits(**limits))  # type: ignore[arg-type]


def refusal(function: str, **limits: int) -> CaesuraError:
    """Why such a reader has failed."""
    with pytest.raises(CaesuraError) as refused:
        read(function, **limits)
    return refused.value


def test_an_answer_comes_through_whatever_is_printed() -> None:
    """A megabyte, and what the reader noted; what it prints is no part of it."""
    data = os.urandom(2**20)
    answer = read("echo", data, max_vertices=7)
    assert bytes(answer.glb) == data
    assert [(notice.code, notice.detail) for notice in answer.notices] == [("said", "7 vertices are allowed.")]
    assert bytes(read("echo", b"").glb) == b""


def test_a_refusal_is_the_same_as_in_this_process() -> None:
    """Its kind, code, sentence and place."""
    refused = refusal("refuse")
    assert isinstance(refused, InvalidModel)
    assert (refused.code, refused.detail, refused.where) == ("no-mesh", "There is nothing in it.", {"frame": 3})


@pytest.mark.parametrize("function", ["crash", "abort"])
def test_a_crash_is_a_broken_file(function: str) -> None:
    """With a sentence that says what to do."""
    refused = refusal(function)
    assert isinstance(refused, BrokenContainer)
    assert refused.code == "reader-crashed"
    assert "SIG" in refused.detail
    assert "Export the file again" in refused.detail


@pytest.mark.parametrize("function", ["compute_for_ever", "wait_for_ever"])
def test_time_has_a_limit(function: str) -> None:
    """Of the processor, or of the clock where it waits; the setting is named."""
    began = time.monotonic()
    refused = refusal(function, max_reader_seconds=1)
    assert time.monotonic() - began < 10
    assert isinstance(refused, LimitExceeded)
    assert refused.where["setting"] == "CAESURA_MAX_READER_SECONDS"


@LINUX
def test_memory_has_a_limit() -> None:
    """The setting is named; the process that waits for the answer has its memory to itself."""
    refused = refusal("take_all_memory", max_reader_bytes=2**28)
    assert isinstance(refused, LimitExceeded)
    assert refused.where["setting"] == "CAESURA_MAX_READER_BYTES"


@pytest.mark.parametrize("function", ["stumble", "leave_early", "say_nonsense"])
def test_a_fault_of_ours_is_no_fault_of_the_file(function: str) -> None:
    """An exception that is no refusal, and an answer that is none."""
    with pytest.raises(RuntimeError, match="AttributeError" if function == "stumble" else "answered wrongly"):
        read(function)


@pytest.mark.skipif(landlock_version() < 1, reason="this system has no Landlock")
def test_a_reader_reaches_nothing_but_its_file() -> None:
    """No network, no program, no other file: whether Python is asked or the system itself."""
    tried = {notice.code: notice.detail for notice in read("break_out").notices}
    delete, many, kill = tried.pop("delete"), tried.pop("many-files"), tried.pop("kill")
    assert set(tried.values()) == {"PermissionError"}, tried
    assert delete in {"PermissionError", "FileNotFoundError"}
    assert many == "OSError"
    assert kill == "PermissionError"
    assert not BROKEN_OUT.exists()


def test_a_reader_that_nobody_waits_for_is_ended() -> None:
    """When the context is left, before there is an answer."""
    reader = NativeReader("toy", "json", "tests.formats.native.misbehaving:wait_for_ever")
    with ReaderProcess(reader, memoryview(b""), Limits()) as process:
        started = process._process
        assert started.poll() is None
    assert started.poll() is not None


def test_a_library_that_is_missing_is_named() -> None:
    """With the extra that brings it."""
    reader = NativeReader("Toy", "no_such_library", "x:y", extra="toy")
    with pytest.raises(UnsupportedMedia, match=r"Install caesura\[toy\]") as refused:
        read_as_glb(reader, memoryview(b""), Limits())
    assert refused.value.code == "reader-missing"
