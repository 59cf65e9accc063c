"""How much anonymous memory a long take and a large file need, each in a process of its own.

    python -m benchmarks.memory 64000 5000    # the analysis of a take in memory: MB beyond that take

In a process that has measured other things, what those have freed would be used again and hide the need.
"""

import subprocess
import sys
import time
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.takes.tube import FRAME_RATE, Tube
from benchmarks.timing.stopwatch import AnonymousPeak, anonymous
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse

LOOK_SECONDS = 0.02
WARMING_FRAMES = 128


def beyond_input(frames: int, triangles: int) -> float:
    """MB that a whole analysis needs beyond its vertices, at most at any moment, measured in a new process."""
    command = [sys.executable, "-m", "benchmarks.memory", str(frames), str(triangles)]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def of_the_command(gigabytes: float) -> float:
    """MB that `caesura segment` needs for a stored NPZ of so many GB, which it maps; the file is written for it."""
    with TemporaryDirectory(prefix="caesura-bench-") as folder:
        path = Path(folder) / "large.npz"
        _write(path, gigabytes)
        command = [
            sys.executable,
            "-m",
            "caesura.service.commands.cli",
            "segment",
            str(path),
            "--motions",
            "3",
            "--json",
        ]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        most = 0
        while process.poll() is None:
            most = max(most, anonymous(str(process.pid)))
            time.sleep(LOOK_SECONDS)
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command)
    return most / 1e6


def _write(path: Path, gigabytes: float) -> None:
    """A bending tube that repeats itself, block by block."""
    tube = Tube.of(1_024, 50_000)
    repeats = round(gigabytes * 1e9 / tube.vertices.nbytes)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        with archive.open("vertices.npy", "w", force_zip64=True) as member:
            shape = (repeats * len(tube.vertices), *tube.rest.shape)
            header = {"descr": "<f4", "fortran_order": False, "shape": shape}
            np.lib.format.write_array_header_2_0(member, header)
            for _ in range(repeats):
                member.write(tube.vertices.data)
        for name, values in (("triangles", tube.triangles), ("frame_rate", np.float64(FRAME_RATE))):
            with archive.open(f"{name}.npy", "w") as member:
                np.lib.format.write_array(member, np.asarray(values))


def main() -> None:
    """One analysis in this process, after one of a short take, with which compiled code is loaded."""
    frames, triangles = (int(word) for word in sys.argv[1:3])
    tube = Tube.of(frames, triangles)
    analyse(tube.animation(WARMING_FRAMES), Parameters(), threads=2)
    with AnonymousPeak() as peak:
        analyse(tube.animation(frames), Parameters(), threads=2)
    print(peak.bytes / 1e6)


if __name__ == "__main__":
    main()
