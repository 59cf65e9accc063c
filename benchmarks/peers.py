"""Change point detection by others, where it is installed: ruptures' KernelCPD, told even the number of cuts."""

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from itertools import pairwise

import numpy as np
from jaxtyping import Int
from sklearn.cluster import AgglomerativeClustering

from benchmarks.sequences import Known
from core.agreement import cuts_of

Peer = Callable[[Known], Int[np.ndarray, "frames"]]


def peers() -> dict[str, Peer]:
    """Those that are installed, by name."""
    return {"kernel-cpd": kernel_cpd} if find_spec("ruptures") else {}


def kernel_cpd(known: Known) -> Int[np.ndarray, "frames"]:
    """As many cuts as are true, by the kernel cost (rbf) on all descriptors, and K groups of the segments' means."""
    shown = [f.values / max(float(f.values.std()), 1e-12) for f in known.analysis.features if f.values.shape[1]]
    values = np.concatenate(shown, axis=1).astype(np.float64)
    detection = import_module("ruptures").KernelCPD(kernel="rbf", min_size=15).fit(values)
    bounds = [0, *detection.predict(n_bkps=len(cuts_of(known.truth)))]
    means = np.stack([values[a:b].mean(axis=0) for a, b in pairwise(bounds)])
    motions = AgglomerativeClustering(len(np.unique(known.truth))).fit_predict(means)
    return np.asarray(np.repeat(motions, np.diff(bounds)))
