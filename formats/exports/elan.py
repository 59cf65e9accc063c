"""A result as ELAN reads it: an EAF 3.0 document with a tier of motions, one of those that a person
discarded, one of key-frames, one of repetitions.

Format: H. Sloetjes, P. Wittenburg, ELAN Annotation Format 3.0 (Max Planck Institute for Psycholinguistics).
"""

import itertools
from collections.abc import Iterable, Iterator
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from caesura.core.plot.svg import FORBIDDEN_CHARACTERS
from caesura.core.segmentation_document import SegmentationDocument

SCHEMA = "http://www.mpi.nl/tools/elan/EAFv3.0.xsd"
INSTANCE = "http://www.w3.org/2001/XMLSchema-instance"
DATE = "1970-01-01T00:00:00+00:00"
"""The format wants one. The same result is the same bytes, whenever it is asked for."""

TYPE = "interval"

Annotation = tuple[float, float, str]
"""From second to second, and what is said of it."""

Interval = tuple[int, int, str]
"""The same in whole milliseconds."""


def segments_eaf(document: SegmentationDocument) -> str:
    """Times are those of the file's own clock, so a recording that runs by it can be linked in ELAN as it is."""
    rate, begin = document.frame_rate, document.source.start_seconds
    tiers = {
        "motions": [(s.start_seconds, s.end_seconds, s.name) for s in document.segments],
        "discarded": [(s.start_seconds, s.end_seconds, s.name) for s in document.segments if s.discard],
        "key-frames": [(k.seconds, k.seconds + 1 / rate, f"{k.energy:.4f}") for k in document.key_frames],
        "repetitions": [
            (begin + repeat.start / rate, begin + repeat.end / rate, f"{segment.name} {number}")
            for segment in document.segments
            if len(segment.repeats) > 1
            for number, repeat in enumerate(segment.repeats, 1)
        ],
    }
    return _text({name: list(_in_milliseconds(tier)) for name, tier in tiers.items() if tier})


def _in_milliseconds(annotations: Iterable[Annotation]) -> Iterator[Interval]:
    """Whole, from 0 on, each at least one long, none before the one before has ended: ELAN takes no others."""
    free = 0
    for start, end, value in annotations:
        begin = max(round(start * 1000), free)
        free = max(round(end * 1000), begin + 1)
        yield begin, free, FORBIDDEN_CHARACTERS.sub("", value)


def _text(tiers: dict[str, list[Interval]]) -> str:
    about = {"AUTHOR": "Caesura", "DATE": DATE, "FORMAT": "3.0", "VERSION": "3.0"}
    root = Element("ANNOTATION_DOCUMENT", {**about, "xmlns:xsi": INSTANCE, "xsi:noNamespaceSchemaLocation": SCHEMA})
    header = SubElement(root, "HEADER", MEDIA_FILE="", TIME_UNITS="milliseconds")
    intervals = list(itertools.chain.from_iterable(tiers.values()))
    SubElement(header, "PROPERTY", NAME="lastUsedAnnotationId").text = str(len(intervals))
    annotations = zip(_slots(SubElement(root, "TIME_ORDER"), intervals), itertools.count(1), strict=False)
    for name, tier in tiers.items():
        element = SubElement(root, "TIER", LINGUISTIC_TYPE_REF=TYPE, TIER_ID=name)
        for (*_, value), ((start, end), number) in zip(tier, annotations, strict=False):
            at = {"ANNOTATION_ID": f"a{number}", "TIME_SLOT_REF1": start, "TIME_SLOT_REF2": end}
            annotation = SubElement(SubElement(element, "ANNOTATION"), "ALIGNABLE_ANNOTATION", at)
            SubElement(annotation, "ANNOTATION_VALUE").text = value
    SubElement(root, "LINGUISTIC_TYPE", GRAPHIC_REFERENCES="false", LINGUISTIC_TYPE_ID=TYPE, TIME_ALIGNABLE="true")
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def _slots(order: Element, intervals: list[Interval]) -> Iterator[tuple[str, str]]:
    """Two slots for each interval, in the order of time. None is shared: in ELAN, what shares a slot moves with it."""
    sides = [
        (side, begins, n) for n, (start, end, _) in enumerate(intervals) for side, begins in ((start, 1), (end, 0))
    ]
    names = {}
    for place, (time, begins, number) in enumerate(sorted(sides), 1):
        names[number, begins] = f"ts{place}"
        SubElement(order, "TIME_SLOT", TIME_SLOT_ID=f"ts{place}", TIME_VALUE=str(time))
    return ((names[number, 1], names[number, 0]) for number in range(len(intervals)))
