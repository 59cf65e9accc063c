"""What stops a reader from outside, such as the end of a job's time, is never called a fault of the file."""

import subprocess
import sys
from typing import Any

from tests.formats.gltf.test_draco import compressed
from tests.formats.opening import opened
from tests.formats.test_bvh import ARM
from tests.formats.test_npz import npz
from tests.formats.test_zip import separate, zipped
from tests.glb import bending_strip

MOMENTS = 40


class TimeUp(Exception):
    """Raised in the midst of a call, as the handler of a signal would raise it."""


class Interruption:
    """Raises `TimeUp` at the call of this number; counts calls."""

    def __init__(self, at: int) -> None:
        self.calls, self._at = 0, at

    def __call__(self, frame: Any, event: str, given: Any) -> None:
        if event in {"call", "c_call"}:
            self.calls += 1
            if self.calls == self._at:
                raise TimeUp


def opened_until(data: bytes, at: int) -> int:
    """Open a file, but for what comes after the call of this number; how many calls there were."""
    interruption = Interruption(at)
    sys.setprofile(interruption)
    try:
        opened(data)
    except TimeUp:
        pass
    finally:
        sys.setprofile(None)
    return interruption.calls


# Not OBJ and PLY: trimesh, which reads them, and NumPy below it have handlers that pass not everything on.
FILES = {
    "zip": lambda: zipped(separate()),
    "npz": lambda: npz(deflate=True),
    "glb": lambda: bending_strip().glb(),
    "draco": lambda: compressed().glb(),
    "bvh": ARM.encode,
}


def main() -> None:
    """Interrupt the reading of each file at forty moments."""
    for name, make in FILES.items():
        data = make()
        opened(data)
        calls = opened_until(data, 0)
        for moment in range(MOMENTS):
            opened_until(data, 1 + moment * calls // MOMENTS)
        print(name, calls)


def test_an_interruption_is_passed_on() -> None:
    """Wherever it comes: a refusal in its place would be the answer for ever. Apart from the checks of types that tests
    add, which pass nothing on.
    """
    done = subprocess.run([sys.executable, "-m", __name__], check=True, capture_output=True, text=True)
    assert [line.split()[0] for line in done.stdout.splitlines()] == [*FILES]


if __name__ == "__main__":
    main()
