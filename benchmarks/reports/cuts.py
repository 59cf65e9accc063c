"""How near found cuts are to true ones, whether the wrong ones are doubted, and whether missed ones are candidates."""

from dataclasses import dataclass
from math import ceil

import numpy as np
from jaxtyping import Float, Int

from benchmarks.takes.real import RealTake
from caesura.core.agreement import cut_frames
from caesura.core.analysis import Analysis
from caesura.core.parameters import Parameters
from caesura.core.pipeline import cut

NEAR_SECONDS = 0.5
FIFTH = 0.2
HEAD = """| takes | true cuts | missed | of them candidates | candidates | found | wrong | in the least sure fifth |
|---|---|---|---|---|---|---|---|"""


@dataclass(frozen=True)
class JudgedCuts:
    """Of a take cut with nothing told: seconds from each found, true and proposed cut to the nearest of the others."""

    confidence: Float[np.ndarray, "found"]
    astray: Float[np.ndarray, "found"]
    missed_by: Float[np.ndarray, "true"]
    proposed_by: Float[np.ndarray, "true"]
    candidates: int

    @classmethod
    def of(cls, analysis: Analysis, starts: Int[np.ndarray, "true"], ends: Int[np.ndarray, "true"]) -> "JudgedCuts":
        """Cuts truly lie anywhere in frames starts … ends."""
        found, rate = cut(analysis, Parameters()), analysis.frame_rate
        apart = _apart(starts, ends, found.cuts) / rate
        proposed = _apart(starts, ends, np.array([frame for frame, _ in found.candidates], np.int64)) / rate
        nearest, proposed_by = apart.min(axis=1, initial=np.inf), proposed.min(axis=1, initial=np.inf)
        return cls(found.confidence, apart.min(axis=0, initial=np.inf), nearest, proposed_by, len(found.candidates))


def cut_table(kinds: dict[str, list[JudgedCuts]]) -> list[str]:
    """A line for each kind of takes."""
    return [HEAD, *(_line(kind, takes) for kind, takes in kinds.items())]


def _line(kind: str, takes: list[JudgedCuts]) -> str:
    sure, astray = (np.concatenate([getattr(take, name) for take in takes]) for name in ("confidence", "astray"))
    missed = np.concatenate([take.missed_by for take in takes]) > NEAR_SECONDS
    proposed = np.concatenate([take.proposed_by for take in takes])[missed] <= NEAR_SECONDS
    wrong = astray > NEAR_SECONDS
    doubted = wrong[np.argsort(sure, kind="stable")[: ceil(FIFTH * len(sure))]].sum()
    candidates = sum(take.candidates for take in takes)
    counts = (len(missed), missed.sum(), proposed.sum(), candidates, len(wrong), wrong.sum(), doubted)
    return f"| {kind} | " + " | ".join(map(str, counts)) + " |"


def true_cuts(take: RealTake) -> tuple[Int[np.ndarray, "true"], Int[np.ndarray, "true"]]:
    """Where each may lie, from its first frame to its last: anywhere in what is unlabelled around it."""
    cuts = cut_frames(take.truth)
    gaps = {start: end for start, end in take.document.get("unlabelled", ()) if start > 0 and end < len(take.truth)}
    spans = [next(((s, e) for s, e in gaps.items() if s <= at <= e), (at, at)) for at in cuts.tolist()]
    starts, ends = np.array(sorted(set(spans)), np.int64).reshape(-1, 2).T
    return starts, ends


def _apart(
    starts: Int[np.ndarray, "true"], ends: Int[np.ndarray, "true"], frames: Int[np.ndarray, "n"]
) -> Float[np.ndarray, "true n"]:
    """Frames from each true cut to each of the others."""
    return np.asarray(np.maximum(np.maximum(starts[:, None] - frames, frames - ends[:, None]), 0.0))
