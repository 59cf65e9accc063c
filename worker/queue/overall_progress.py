"""How much of a segmentation is done in all its stages, and how long the rest will take."""

from caesura.worker.records.record_types import SegmentationRecord

STAGE_SHARES = {
    "read": 0.10,
    "rest shape": 0.03,
    "strain": 0.50,
    "energy": 0.10,
    "key-frames": 0.05,
    "figure": 0.12,
    "cut": 0.10,
}
"""The stages in order, each with its share of the time that a long take usually needs."""

LEAST_SHARE = 0.05
"""Of the work that must be done before the rest is estimated."""


def overall_fraction(record: SegmentationRecord) -> float:
    """The share of all stages that is done, 0 to 1. A stage that is not known counts as not begun."""
    if record.status != "running":
        return 1.0 if record.status == "done" else 0.0
    done = 0.0
    for stage, share in STAGE_SHARES.items():
        if stage == record.stage:
            return done + share * record.fraction
        done += share
    return 0.0


def remaining_seconds(record: SegmentationRecord) -> float | None:
    """How long the rest takes if it goes on as it went; None where too little is done to say so.

    Both times are the worker's own, so that the clocks of two machines do not matter.
    """
    done, took = overall_fraction(record), record.updated - record.started
    if record.status != "running" or done < LEAST_SHARE or took <= 0:
        return None
    return round(took * (1 - done) / done, 1)
