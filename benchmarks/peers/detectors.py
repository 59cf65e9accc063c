"""Change point detection by others: a process of its own, in an environment of its own, that knows nothing of ours.

Reads a line of JSON for each request, {"detector", "values": a .npy of (frames, D), "cuts": how many}, and answers
one: {"cuts": [frames], "seconds"} or {"missing": a package}. ClaSP and FLUSS take one course over time: the leading
component. A detector's first take includes the time in which it is compiled.
"""

import json
import sys
from collections.abc import Callable
from importlib import import_module
from time import perf_counter
from typing import Any

import numpy as np

SHORTEST_FRAMES = 15


def kernel_cpd(values: Any, cuts: int) -> Any:
    """Ruptures' KernelCPD, a Gaussian kernel on all components."""
    return (
        import_module("ruptures")
        .KernelCPD(kernel="rbf", min_size=SHORTEST_FRAMES)
        .fit(values)
        .predict(n_bkps=cuts)[:-1]
    )


def clasp(values: Any, cuts: int) -> Any:
    """ClaSP of aeon, its window chosen by aeon."""
    aeon, course = import_module("aeon.segmentation"), leading(values)
    return aeon.ClaSPSegmenter(aeon.find_dominant_window_sizes(course), n_cps=cuts).fit_predict(course)


def fluss(values: Any, cuts: int) -> Any:
    """FLUSS of aeon, its window chosen by aeon."""
    aeon, course = import_module("aeon.segmentation"), leading(values)
    return aeon.FLUSSSegmenter(aeon.find_dominant_window_sizes(course), n_regimes=cuts + 1).fit_predict(course)


def leading(values: Any) -> Any:
    """The component along which the values vary most."""
    centred = values - values.mean(axis=0)
    return centred @ np.linalg.svd(centred, full_matrices=False)[2][0]


DETECTORS: dict[str, Callable[[Any, int], Any]] = {"kernel-cpd": kernel_cpd, "clasp": clasp, "fluss": fluss}


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """The cuts that a detector finds; a package that is not there is named."""
    values = np.load(request["values"], allow_pickle=False)
    start = perf_counter()
    try:
        found = DETECTORS[request["detector"]](values, request["cuts"])
    except ImportError as missing:
        return {"missing": str(missing.name or missing)}
    return {"cuts": sorted({int(cut) for cut in found if 0 < cut < len(values)}), "seconds": perf_counter() - start}


def main() -> None:
    """Answers until there is no more to answer. What libraries print goes to the other stream."""
    out, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), file=out, flush=True)


if __name__ == "__main__":
    main()
