"""The names of what Redis holds of ours, in one place. RQ's keys are RQ's own affair.

| key | type | value |
|---|---|---|
| caesura:secret | string | key of all ids |
| caesura:layout | string | version of what is stored; `caesura.worker.records.layout_version` |
| caesura:animation:ID | string | AnimationRecord, JSON |
| caesura:takes:ID | string | TakeSummary of each take of an animation, JSON |
| caesura:animations:OWNER | sorted set | ids of animations by time of creation |
| caesura:used | sorted set | ids of all animations by the time of their last use |
| caesura:segmentation:ID | string | SegmentationRecord, JSON |
| caesura:segmentation:ID:document | string | the result document, JSON |
| caesura:segmentation:ID:energy | string | little-endian float32, one per frame, NaN where there is none |
| caesura:segmentation:ID:labels | string | little-endian uint16, one per frame |
| caesura:revisions:ID | list | RevisionRecord of each revision in order, JSON |
| caesura:revised:ID | hash | number of a revision: its segments, JSON |
| caesura:alternatives:ID | hash | number of motions: what it would be cut into that many (`worker.alternatives`) |
| caesura:segmentations:ANIMATION | sorted set | ids of segmentations by time of creation |
| caesura:live | set | ids of segmentations that are queued or running |
| caesura:lease:TOKEN | string, expires | the attempt has a living worker |
| caesura:analysis:ANIMATION:DIGEST | string | AnalysisRecord, JSON |
| caesura:analyses:ANIMATION | set | the digests of an animation's analyses |
| caesura:export:ID:FORM | string | ExportRecord, JSON; the form is a name and its options |
| caesura:exports:ID | set | the forms that were ever asked for |
| caesura:worker:NAME | string, expires | the host of a warm worker that lives; RQ's sets say which queues it serves |
| caesura:swept | string, expires | somebody looked lately for what is kept too long |
| caesura:clock | hash | the time of the last look, and since when the clock has gone evenly; `caesura.worker.clock` |
| caesura:deleted | string | something was deleted since Redis was last asked to rewrite its append-only file |
| caesura:tally | hash | what workers have counted; `caesura.worker.records.counters` |
| caesura:doubted | hash | keys of blobs that no record pointed to when it was looked last, each with since when |
| caesura:store | hash | kinds of blobs, each with the bytes they took when it was looked last |
| caesura:keys | hash | names of API keys, each with its digest |
| caesura:key:DIGEST | string | KeyRecord, JSON |
| caesura:session:DIGEST | string, expires | the digest of the key that was signed in with |
| caesura:rate:DIGEST:ADDRESS | hash, expires | how many requests are left |
| caesura:changed:ID | channel | told at every change of a segmentation or its exports |
"""

from typing import Literal

LIVE_SEGMENTATIONS_KEY = "caesura:live"
LAST_USED_KEY = "caesura:used"
LAST_SWEEP_KEY = "caesura:swept"
CLOCK_KEY = "caesura:clock"
DELETED_KEY = "caesura:deleted"
LAYOUT_KEY = "caesura:layout"
COUNTERS_KEY = "caesura:tally"
ORPHAN_CANDIDATES_KEY = "caesura:doubted"
STORE_KEY = "caesura:store"
API_KEYS_KEY = "caesura:keys"


def animation_key(identifier: str) -> str:
    """One animation."""
    return f"caesura:animation:{identifier}"


def takes_key(animation: str) -> str:
    """The takes of one animation."""
    return f"caesura:takes:{animation}"


def animations_key(owner: str) -> str:
    """An owner's animations, by time."""
    return f"caesura:animations:{owner}"


def segmentation_key(identifier: str, part: Literal["", "document", "energy", "labels"] = "") -> str:
    """One segmentation's record, or a part of its result."""
    return f"caesura:segmentation:{identifier}" + (f":{part}" if part else "")


def revisions_key(segmentation: str) -> str:
    """A result's revisions, in order."""
    return f"caesura:revisions:{segmentation}"


def revised_key(segmentation: str) -> str:
    """The segments of a result's revisions, by number."""
    return f"caesura:revised:{segmentation}"


def alternatives_key(segmentation: str) -> str:
    """What a result would be with other numbers of motions."""
    return f"caesura:alternatives:{segmentation}"


def segmentations_key(animation: str) -> str:
    """An animation's segmentations, by time."""
    return f"caesura:segmentations:{animation}"


def analysis_key(animation: str, digest: str) -> str:
    """One analysis."""
    return f"caesura:analysis:{animation}:{digest}"


def analyses_key(animation: str) -> str:
    """An animation's analyses."""
    return f"caesura:analyses:{animation}"


def export_key(segmentation: str, form: str) -> str:
    """One file made of a result."""
    return f"caesura:export:{segmentation}:{form}"


def exports_key(segmentation: str) -> str:
    """The forms of a result that were asked for."""
    return f"caesura:exports:{segmentation}"


def lease_key(token: str) -> str:
    """The sign of life of an attempt."""
    return f"caesura:lease:{token}"


def worker_key(name: str) -> str:
    """The sign of life of a worker."""
    return f"caesura:worker:{name}"


def api_key_key(digest: str) -> str:
    """One API key, by its digest."""
    return f"caesura:key:{digest}"


def session_key(digest: str) -> str:
    """One browser that is signed in, by the digest of its cookie."""
    return f"caesura:session:{digest}"


def rate_key(digest: str, address: str) -> str:
    """The requests of one key from one address."""
    return f"caesura:rate:{digest}:{address}"


def channel(segmentation: str) -> str:
    """Where changes of a segmentation are told."""
    return f"caesura:changed:{segmentation}"
