"""Change point detection by others, told even the number of cuts: KernelCPD of ruptures, ClaSP and FLUSS of aeon.

They find cuts and know no motions that return, so their segments' means are put into K groups for them.
"""

import json
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int
from sklearn.cluster import AgglomerativeClustering

from benchmarks.peers.detectors import DETECTORS
from benchmarks.takes.sequences import Known
from caesura.core.agreement import cut_frames

PEERS = tuple(DETECTORS)


class NotInstalled(Exception):
    """A package that a peer needs is not there."""


@dataclass(frozen=True)
class Peers:
    """The peers, in a process of their own."""

    process: "subprocess.Popen[str]"
    folder: Path

    def labels(self, name: str, known: Known) -> tuple[Int[np.ndarray, "frames"], float]:
        """As many cuts as are true where it can find them, K groups of segments, and the seconds it took.

        Raises `NotInstalled`.
        """
        values = described(known)
        found, seconds = self.cuts(name, values, len(cut_frames(known.truth)))
        bounds = [0, *found, len(values)]
        means = np.stack([values[a:b].mean(axis=0) for a, b in pairwise(bounds)])
        groups = min(known.motions, len(means))
        motions = AgglomerativeClustering(groups).fit_predict(means) if groups > 1 else np.zeros(len(means), np.int64)
        return np.repeat(motions, np.diff(bounds)), seconds

    def cuts(self, name: str, values: Float[np.ndarray, "frames D"], count: int) -> tuple[list[int], float]:
        """The cuts that it finds, told how many, and the seconds it took. Raises `NotInstalled`."""
        np.save(self.folder / "values.npy", values)
        found = self._ask({"detector": name, "values": str(self.folder / "values.npy"), "cuts": count})
        if "missing" in found:
            raise NotInstalled(f"not installed: {found['missing']}")
        return found["cuts"], float(found["seconds"])

    def _ask(self, request: dict[str, Any]) -> Any:
        if self.process.stdin is None or self.process.stdout is None:
            raise RuntimeError("the peers' process was started without pipes")
        print(json.dumps(request), file=self.process.stdin, flush=True)
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{request['detector']} ended the peers' process; what it said is above")
        return json.loads(line)


@contextmanager
def peers(python: str) -> Iterator[Peers]:
    """The peers that this Python has; it may be one of another environment (see benchmarks/peers/requirements.txt)."""
    script = Path(__file__).with_name("detectors.py")
    with tempfile.TemporaryDirectory() as folder:
        pipe = subprocess.PIPE
        with subprocess.Popen([python, str(script)], stdin=pipe, stdout=pipe, text=True) as process:
            try:
                yield Peers(process, Path(folder))
            finally:
                if process.stdin:
                    process.stdin.close()
                process.wait(timeout=60)


def described(known: Known) -> Float[np.ndarray, "frames D"]:
    """Both descriptors side by side, each at unit deviation."""
    shown = [f.values / max(float(f.values.std()), 1e-12) for f in known.analysis.features if f.values.shape[1]]
    return np.concatenate(shown, axis=1).astype(np.float64)
