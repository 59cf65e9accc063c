"""Labels as the fuzzer reads them beside models: as JSON, a table or an EAF, compared as `caesura score` does."""

import json
from pathlib import Path

from caesura.core.errors import CaesuraError
from caesura.service.commands.frame_labels import Labelling, compute_agreement
from caesura.service.commands.label_files.read import on_same_frames, parse_labels

TRUTH = Labelling(30.0, 90, ((0, 40, "a"), (40, 90, "b")), start_seconds=0.5)
HERE = Path("labels")


def seeds() -> list[bytes]:
    """One file of each kind."""
    document = {"fps": 30, "frames": 90, "segments": [{"start": 0, "end": 40, "label": "a"}]}
    document["segments"] += [{"start": 40, "end": 90, "motion": 1}]  # type: ignore[operator]
    return [
        json.dumps(document).encode(),
        b"label,start,end\na,0,40\nb,40,90\n",
        b"\xef\xbb\xbfLabel;Start_Seconds;End_Seconds;note\r\na;0,5;1,8;x\r\nb;1,8;3,5;y\r\n",
        b"start\tend\tname\n40\t90\tb\n0\t40\ta\n",
        b"frame,motion\n" + b"".join(b"%d,%d\n" % (frame, frame // 40) for frame in range(90)),
        b"name,start,end\n" + b"".join(b"%d,%d,%d\n" % (n, n, n + 1) for n in range(90)),
        (
            b'<?xml version="1.0"?>\n<ANNOTATION_DOCUMENT> <HEADER TIME_UNITS="milliseconds" />\n<TIME_ORDER>\n'
            b'<TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="500" />\n<TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="1800" />\n'
            b'</TIME_ORDER>\n<TIER TIER_ID="empty" />\n<TIER TIER_ID="motions">\n<ANNOTATION>\n'
            b'<ALIGNABLE_ANNOTATION TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2">\n'
            b"<ANNOTATION_VALUE>a &amp; b</ANNOTATION_VALUE>\n</ALIGNABLE_ANNOTATION>\n</ANNOTATION>\n</TIER>\n"
            b"</ANNOTATION_DOCUMENT>\n"
        ),
    ]


def attempt_labels(data: bytes) -> list[CaesuraError]:
    """Compare `data` with a truth and with itself; the refusals. Whatever else is raised is a fault of ours."""
    refusals: list[CaesuraError] = []
    for fps in (None, 30.0):
        try:
            found = parse_labels(HERE, data)
            compute_agreement(*on_same_frames([(HERE, found), (HERE, TRUTH if fps is None else found)], fps))
        except CaesuraError as refused:
            refusals.append(refused)
    return refusals
