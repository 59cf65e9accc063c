"""The names of what Redis holds of ours, in one place. RQ's keys are RQ's own affair.

| key | type | value |
|---|---|---|
| caesura:secret | string | key of all ids |
| caesura:layout | string | version of what is stored; `caesura.worker.records.storage_version` |
| caesura:animation:ID | string | AnimationRecord, JSON |
| caesura:takes:ID | string | TakeSummary of each take of an animation, JSON |
| caesura:animations:OWNER | sorted set | ids of animations by time of creation |
| caesura:used | sorted set | ids of all animations by the time of their last use |
| caesura:segmentation:ID | string | SegmentationRecord, JSON |
| caesura:segmentation:ID:document | string | the result document, JSON |
| caesura:segmentation:ID:energy | string | little-endian float32, one per frame, NaN where there is none |
| caesura:segmentation:ID:labels | string | little-endian uint16, one per frame |
| caesura:revisions:ID | list | RevisionRecord of each revision in order, JSON |
| caesura:revised:ID | hash | number of a revision: its segments, JSON; `N:loops`: their best loops, JSON |
| caesura:loop-search:TOKEN | string, expires | the loops that a search has found, JSON |
| caesura:alternatives:ID | hash | number of motions: what it would be cut into that many (`worker.alternatives`) |
| caesura:segmentations:ANIMATION | sorted set | ids of segmentations by time of creation |
| caesura:made:OWNER | sorted set | ids of an owner's segmentations by time of creation |
| caesura:edited:ANIMATION | sorted set | ids of segmentations that a person edited, by time of the last edit |
| caesura:live | set | ids of segmentations that are queued or running |
| caesura:collection:ID | string | CollectionRecord, JSON |
| caesura:collection-takes:ID | hash | TakeRecord of each animation in a collection, JSON |
| caesura:collection-entries:ID | hash | TakeEntry of each, JSON: what a list of takes and the counts of motions need |
| caesura:collection-order:ID | sorted set | animations in a collection by the time when they were added |
| caesura:collection-proposals:ID | hash | ProposalRecord of each proposal, JSON |
| caesura:collection-searches:ID | hash, expires | SearchRecord of each search, JSON |
| caesura:collection-job:ID | string, expires | the job that labels what waits in a collection |
| caesura:collections | sorted set | ids of all collections by the time of their last change |
| caesura:collections:OWNER | sorted set | ids of an owner's collections by time of creation |
| caesura:collected:ANIMATION | set | ids of collections that an animation is in |
| caesura:awaiting:ID | set | what waits for a segmentation: ids of collections, and of searches in them |
| caesura:callbacks:ID | set | addresses to call once a segmentation is over |
| caesura:deliveries | sorted set | ids of calls that are to be made, by the time when they are due |
| caesura:delivery:ID | string | DeliveryRecord, JSON |
| caesura:upload:ID | string, expires | UploadRecord, JSON |
| caesura:uploads:OWNER | sorted set, expires | ids of an owner's unfinished uploads by the end of their time |
| caesura:lease:TOKEN | string, expires | the attempt has a living worker |
| caesura:analysis:ANIMATION:DIGEST | string | AnalysisRecord, JSON |
| caesura:analyses:ANIMATION | set | the digests of an animation's analyses |
| caesura:export:ID:FORM | string | ExportRecord, JSON; the form is a name and its options |
| caesura:exports:ID | set | the forms that were ever asked for |
| caesura:worker:NAME | string, expires | the host of a warm worker that lives; RQ's sets say which queues it serves |
| caesura:swept | string, expires | somebody looked lately for what is kept too long |
| caesura:clock | hash | when the clock was last checked, and since when it is steady; `worker/clock_check.py` |
| caesura:deleted | string | something was deleted since Redis was last asked to rewrite its append-only file |
| caesura:tally | hash | what workers have counted; `caesura.worker.records.counters` |
| caesura:doubted | hash | keys of blobs that no record pointed to when it was looked last, each with since when |
| caesura:store | hash | kinds of blobs, each with the bytes they took when it was looked last |
| caesura:keys | hash | names of API keys, each with its digest |
| caesura:key:DIGEST | string | KeyRecord, JSON |
| caesura:session:DIGEST | string, expires | the digest of the key that was signed in with |
| caesura:rate:DIGEST:ADDRESS | hash, expires | how many requests are left |
| caesura:due | channel | a message when a call is to be made |
| caesura:changed:ID | channel | a message at every change of a segmentation or its exports |
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
COLLECTIONS_KEY = "caesura:collections"
API_KEYS_KEY = "caesura:keys"
DELIVERIES_KEY = "caesura:deliveries"
DELIVERIES_CHANNEL = "caesura:due"


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


def loop_search_key(token: str) -> str:
    """What a search for loops has found, for a minute."""
    return f"caesura:loop-search:{token}"


def revised_key(segmentation: str) -> str:
    """The segments of a result's revisions, by number."""
    return f"caesura:revised:{segmentation}"


def alternatives_key(segmentation: str) -> str:
    """What a result would be with other numbers of motions."""
    return f"caesura:alternatives:{segmentation}"


def segmentations_key(animation: str) -> str:
    """An animation's segmentations, by time."""
    return f"caesura:segmentations:{animation}"


def owned_segmentations_key(owner: str) -> str:
    """An owner's segmentations, by time."""
    return f"caesura:made:{owner}"


def collection_key(identifier: str) -> str:
    """One collection."""
    return f"caesura:collection:{identifier}"


def collection_takes_key(identifier: str) -> str:
    """The takes of a collection, whole."""
    return f"caesura:collection-takes:{identifier}"


def collection_entries_key(identifier: str) -> str:
    """The takes of a collection, in short."""
    return f"caesura:collection-entries:{identifier}"


def collection_order_key(identifier: str) -> str:
    """The takes of a collection, by time."""
    return f"caesura:collection-order:{identifier}"


def collection_proposals_key(identifier: str) -> str:
    """The proposals of a collection."""
    return f"caesura:collection-proposals:{identifier}"


def collection_searches_key(identifier: str) -> str:
    """The searches in a collection."""
    return f"caesura:collection-searches:{identifier}"


def collection_job_key(identifier: str) -> str:
    """The job that labels what waits in a collection."""
    return f"caesura:collection-job:{identifier}"


def keys_of_collection(identifier: str) -> tuple[str, ...]:
    """All that lies beside a collection's record."""
    return (
        collection_takes_key(identifier), collection_entries_key(identifier), collection_order_key(identifier),
        collection_proposals_key(identifier), collection_searches_key(identifier), collection_job_key(identifier),
    )  # fmt: skip


def collections_key(owner: str) -> str:
    """An owner's collections, by time."""
    return f"caesura:collections:{owner}"


def collected_key(animation: str) -> str:
    """The collections that an animation is in."""
    return f"caesura:collected:{animation}"


def awaiting_key(segmentation: str) -> str:
    """What waits for a segmentation."""
    return f"caesura:awaiting:{segmentation}"


def callbacks_key(segmentation: str) -> str:
    """The addresses to call once a segmentation is over."""
    return f"caesura:callbacks:{segmentation}"


def delivery_key(identifier: str) -> str:
    """One call that is to be made."""
    return f"caesura:delivery:{identifier}"


def upload_key(identifier: str) -> str:
    """One upload that may go on."""
    return f"caesura:upload:{identifier}"


def uploads_key(owner: str) -> str:
    """An owner's uploads that are not whole yet."""
    return f"caesura:uploads:{owner}"


def edited_key(animation: str) -> str:
    """An animation's segmentations that have revisions, by the time of the newest."""
    return f"caesura:edited:{animation}"


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
    """The channel with the changes of a segmentation."""
    return f"caesura:changed:{segmentation}"
