"""`make fuzz`, second part: files for the readers of native code, changed and read, each in a process of its own.

FUZZ_MUTANTS files of each format (2,000), made of the project's own or of those in the folder FUZZ_FILES. A process
that crashes, fills its memory or runs out of time is an answer as it should be; a fault is any other error than a
refusal by name, and a wait beyond the limit. The file that did it is kept.
"""

import hashlib
import importlib.util
import os
import random
import resource
import sys
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from caesura.core.parameters import Parameters
from caesura.formats.read import list_takes, read_animation
from tests.formats.native import usd_text
from tests.formats.native.alembic_files import archive, moved
from tests.formats.native.fbx_binary import binary
from tests.formats.native.fbx_text import bending_strip, blending_square, moving_square
from tests.formats.test_zip import zipped
from tests.fuzz.mutations import numbered, scrambled, worded

FOLDER = Path(".fuzz")
SECONDS, BYTES = 10, 2**29
LIMITS = Limits(
    max_reader_seconds=SECONDS, max_reader_bytes=BYTES, max_frames=20_000, max_node_frames=2_000_000,
    max_inflated_bytes=2**26, max_decoded_bytes=2**26,
)  # fmt: skip
ENDINGS = {"fbx": (".fbx",), "abc": (".abc",), "usd": (".usda", ".usdc", ".usdz")}
LIBRARIES = {"abc": "alembic3d", "usd": "pxr"}
GENTLE = 0.6
"""Share of files of which a few bits alone are changed."""

LARGEST = 2**20
"""Bytes of a file of FUZZ_FILES: small ones are read in less time, and are changed where it matters."""


def seeds(kind: str) -> Iterator[bytes]:
    """Files of a format, of the project's own making."""
    if kind == "fbx":
        for made in (moving_square(), bending_strip(), blending_square()):
            yield made.data()
            yield binary(made.data())
    elif kind == "abc":
        yield archive([moved(x=i) for i in range(5)], places=[(0, i, 0) for i in range(5)])
        yield archive([moved(x=i) for i in range(3)], kind="SubD", times=[0, 0.1, 0.3])
    else:
        texts = (
            usd_text.bending_strip(), usd_text.blending_square(), usd_text.sliding_points(), usd_text.sliding_square(),
            usd_text.nested_references(4),
        )  # fmt: skip
        yield from texts
        yield zipped({"a.usda": texts[0]}, 0)
        yield from (_crate(text) for text in texts)


def _crate(text: bytes) -> bytes:
    """A layer as the library writes it in binary."""
    import tempfile

    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text.decode())
    with tempfile.TemporaryDirectory() as folder:
        layer.Export(f"{folder}/a.usdc")
        return Path(f"{folder}/a.usdc").read_bytes()


def mutant(data: bytes, draw: random.Random) -> bytes:
    """A file with a few bytes changed, which is mostly still one; or with changes of all kinds."""
    if draw.random() < GENTLE:
        out = bytearray(data)
        for _ in range(draw.choice((1, 1, 2, 4, 8))):
            out[draw.randrange(len(out))] ^= 1 << draw.randrange(8)
        return bytes(out)
    for _ in range(draw.choice((1, 1, 2, 4))):
        textual = b"\0" not in data[:1000]
        data = draw.choice((scrambled, worded) if textual else (scrambled, numbered, numbered))(data, draw)
    return data


def attempt(data: bytes) -> tuple[str, float]:
    """What became of a file, and in how many seconds; raises whatever is a fault of ours."""
    began = time.monotonic()
    try:
        list_takes({"model": data}, LIMITS)
        read = read_animation({"model": data}, Parameters(), LIMITS, lambda size: memoryview(bytearray(size)))
        read.vertices(0, min(read.frames, 2))
        became = "read"
    except CaesuraError as refused:
        if not refused.problem()["detail"].encode():
            raise AssertionError(refused.problem()) from None
        became = refused.code if refused.code in {"reader-crashed", "limit-exceeded"} else "refused"
    seconds = time.monotonic() - began
    if seconds > 3 * SECONDS:
        raise TimeoutError(f"{seconds:.0f} seconds")
    return became, seconds


def main() -> int:
    """All formats whose libraries are here; 1 where a fault was found."""
    count = int(os.environ.get("FUZZ_MUTANTS", "2000"))
    seed = int(os.environ.get("FUZZ_SEED", "0")) or int(time.time()) % 2**31
    return max(_fuzz(kind, count, seed) for kind in ENDINGS if _is_here(kind))


def _is_here(kind: str) -> bool:
    here = kind not in LIBRARIES or importlib.util.find_spec(LIBRARIES[kind]) is not None
    if not here:
        print(f"{kind}: {LIBRARIES[kind]} is not installed here: make extras")
    return here


def _fuzz(kind: str, count: int, seed: int) -> int:
    beginnings = list(seeds(kind))
    if folder := os.environ.get("FUZZ_FILES"):
        files = (path for path in sorted(Path(folder).rglob("*")) if path.suffix in ENDINGS[kind])
        beginnings += [path.read_bytes() for path in files if path.stat().st_size <= LARGEST]
    draw = random.Random(f"{kind} {seed}")
    mutants = (mutant(draw.choice(beginnings), draw) for _ in range(count))
    became: Counter[str] = Counter()
    slowest, faults, began = 0.0, 0, time.monotonic()

    def one(data: bytes) -> tuple[bytes, str, float, BaseException | None]:
        try:
            return (data, *attempt(data), None)
        except Exception as fault:  # noqa: BLE001  to be shown, with the file that caused it
            return data, "FAULT", 0.0, fault

    with ThreadPoolExecutor(os.cpu_count()) as several:
        for data, outcome, seconds, fault in several.map(one, mutants):
            became[outcome] += 1
            slowest = max(slowest, seconds)
            if fault is not None:
                faults += 1
                FOLDER.mkdir(exist_ok=True)
                kept = FOLDER / f"found-{kind}-{hashlib.sha256(data).hexdigest()[:12]}"
                kept.write_bytes(data)
                print(f"FOUND: {str(fault)[-1500:]}\nthe file is {kept}")
    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
    listed = ", ".join(f"{number} {what}" for what, number in became.most_common())
    print(
        f"{kind}: {count:,} files of {len(beginnings)} in {time.monotonic() - began:,.0f} s, seed {seed}: {listed}. "
        f"The slowest took {slowest:.1f} s, the largest process {largest / 1e6:,.0f} MB."
    )
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
