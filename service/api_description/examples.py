"""One example of each main document, as the OpenAPI description shows it."""

from typing import Any

ANIMATION_ID = "5c7f2nqk6m3vta4xw2jhe7dr3u"
SEGMENTATION_ID = "x3t6kq2v5hn7ma4zr2wye6jd4p"

_ANIMATION = f"/v1/animations/{ANIMATION_ID}"
_SEGMENTATION = f"/v1/segmentations/{SEGMENTATION_ID}"

_SEGMENTS: list[dict[str, Any]] = [
    {
        "start": 0,
        "end": 2,
        "start_seconds": 0.0,
        "end_seconds": 0.066667,
        "motion": 0,
        "name": "A",
        "confidence": 0.9,
    },
    {
        "start": 2,
        "end": 4,
        "start_seconds": 0.066667,
        "end_seconds": 0.1,
        "motion": 1,
        "name": "B",
        "confidence": 1.0,
    },
]

PROBLEM: dict[str, Any] = {
    "type": "urn:caesura:problem:upload-too-large",
    "title": "Upload too large",
    "status": 413,
    "kind": "limit",
    "code": "upload-too-large",
    "detail": "The upload is larger than the 2147483648 bytes this service takes. Send a smaller file, …",
    "limit": 2147483648,
    "actual": 3000000000,
    "setting": "CAESURA_MAX_UPLOAD_BYTES",
}

EXAMPLES: dict[str, dict[str, Any]] = {
    "AnimationDocument": {
        "id": ANIMATION_ID,
        "name": "session.glb",
        "format": "glb",
        "bytes": 812345,
        "take_count": 1,
        "duration_seconds": 30.533,
        "vertices": 1728,
        "triangles": 576,
        "created": "2026-09-21T14:13:20Z",
        "links": {"self": _ANIMATION, "file": f"{_ANIMATION}/file"},
        "takes": [{"index": 0, "name": "Take 001", "duration_seconds": 30.533, "frames": 917, "frame_rate": 30.0}],
    },
    "StatusDocument": {
        "id": SEGMENTATION_ID,
        "animation": ANIMATION_ID,
        "name": "session.glb",
        "status": "done",
        "position": None,
        "progress": {"stage": "", "fraction": 1.0, "overall": 1.0, "remaining_seconds": None},
        "problem": None,
        "motions": 2,
        "frames": 4,
        "segments": _SEGMENTS,
        "revision": 1,
        "parameters": {"take": 0, "motions": 2},
        "created": "2026-09-21T14:20:00Z",
        "started": "2026-09-21T14:20:01Z",
        "finished": "2026-09-21T14:20:03Z",
        "links": {"self": _SEGMENTATION, "result": f"{_SEGMENTATION}/result"},
    },
    "SegmentationDocument": {
        "id": SEGMENTATION_ID,
        "algorithm": "1",
        "method": "switching",
        "parameters": {"take": 0, "motions": 2},
        "source": {"take": 0, "name": "Take 001", "fps": 30.0, "start_seconds": 0.0},
        "frames": 4,
        "frame_rate": 30.0,
        "duration_seconds": 0.1,
        "motions": 2,
        "segments": _SEGMENTS,
        "key_frames": [{"frame": 1, "seconds": 0.033333, "energy": 1.25, "motion": 0}],
        "energy": [None, 1.25, 1.1, None],
    },
    "RevisionRequest": {
        "segments": [
            {"start": 0, "end": 3, "motion": 0, "name": "walk", "loop": True},
            {"start": 3, "end": 4, "motion": 1, "discard": True},
        ],
        "note": "the turn still belongs to the walk",
    },
    "RevisionDocument": {
        "revision": 1,
        "created": "2026-09-21T14:21:40Z",
        "note": "the turn still belongs to the walk",
        "links": {"self": f"{_SEGMENTATION}/revisions/1", "result": f"{_SEGMENTATION}/result?revision=1"},
        "segments": [
            {**_SEGMENTS[0], "end": 3, "end_seconds": 0.1, "name": "walk", "confidence": None, "loop": True},
            {**_SEGMENTS[1], "start": 3, "start_seconds": 0.1, "name": "A", "discard": True},
        ],
    },
    "Problem": PROBLEM,
}
