"""Results for ELAN: what the EAF 3.0 schema asks of a document, and what ELAN itself asks of annotations."""

import re
from collections import Counter
from itertools import pairwise
from xml.etree import ElementTree

from caesura.core.document import Interval, KeyFrame, Segment
from caesura.service.results.elan import segments_eaf
from tests.service.test_exports import document

NAME = r"[A-Za-z_][\w.-]*"  # xsd:ID and xsd:IDREF
TEXT = r"(?s).*"
DATE = r"-?\d{4,}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|[+-]\d\d:\d\d)?"  # xsd:dateTime
BOOLEAN = r"true|false|1|0"
UNITS = r"NTSC-frames|PAL-frames|PAL-50-frames|milliseconds"

# Of the schema's elements those written here: the children in their order, and the attributes, those with ! required.
SCHEMA = {
    "ANNOTATION_DOCUMENT": (["HEADER", "TIME_ORDER", "TIER", "LINGUISTIC_TYPE"],
                            {"AUTHOR!": TEXT, "DATE!": DATE, "VERSION!": TEXT, "FORMAT": TEXT}),
    "HEADER": (["MEDIA_DESCRIPTOR", "LINKED_FILE_DESCRIPTOR", "PROPERTY"], {"MEDIA_FILE": TEXT, "TIME_UNITS": UNITS}),
    "PROPERTY": ([], {"NAME": TEXT}),
    "TIME_ORDER": (["TIME_SLOT"], {}),
    "TIME_SLOT": ([], {"TIME_SLOT_ID!": NAME, "TIME_VALUE": r"\d{1,10}"}),
    "TIER": (["ANNOTATION"], {"TIER_ID!": TEXT, "LINGUISTIC_TYPE_REF!": TEXT, "PARENT_REF": TEXT}),
    "ANNOTATION": (["ALIGNABLE_ANNOTATION"], {}),
    "ALIGNABLE_ANNOTATION": (["ANNOTATION_VALUE"],
                             {"ANNOTATION_ID!": NAME, "TIME_SLOT_REF1!": NAME, "TIME_SLOT_REF2!": NAME}),
    "ANNOTATION_VALUE": ([], {}),
    "LINGUISTIC_TYPE": ([], {"LINGUISTIC_TYPE_ID!": TEXT, "TIME_ALIGNABLE": BOOLEAN, "GRAPHIC_REFERENCES": BOOLEAN}),
}  # fmt: skip
ONCE = {"HEADER", "TIME_ORDER", "ALIGNABLE_ANNOTATION", "ANNOTATION_VALUE"}
LOCATION = "{http://www.w3.org/2001/XMLSchema-instance}noNamespaceSchemaLocation"


def read(text):
    """The tiers of an EAF, as (from, to, value) in milliseconds, once it is found to be as ELAN wants it."""
    root = ElementTree.fromstring(text)
    for element in root.iter():
        _follows_the_schema(element)
    identifiers = Counter(
        value for one in root.iter() for name, value in one.items() if name in {"TIME_SLOT_ID", "ANNOTATION_ID"}
    )
    assert set(identifiers.values()) == {1}
    slots = {slot.get("TIME_SLOT_ID"): int(slot.get("TIME_VALUE")) for slot in root.iter("TIME_SLOT")}
    assert max(slots.values()) < 2**32
    assert [*slots.values()] == sorted(slots.values())
    annotations = [*root.iter("ALIGNABLE_ANNOTATION")]
    # What shares a slot is moved by whoever moves the other, so no two annotations may.
    assert Counter(one.get(f"TIME_SLOT_REF{side}") for one in annotations for side in (1, 2)) == Counter(slots.keys())
    assert root.findtext("HEADER/PROPERTY[@NAME='lastUsedAnnotationId']") == str(len(annotations))
    types = {kind.get("LINGUISTIC_TYPE_ID") for kind in root.iter("LINGUISTIC_TYPE")}
    assert {tier.get("LINGUISTIC_TYPE_REF") for tier in root.iter("TIER")} <= types
    tiers = {
        tier.get("TIER_ID"): [
            (slots[one.get("TIME_SLOT_REF1")], slots[one.get("TIME_SLOT_REF2")], one.findtext("ANNOTATION_VALUE"))
            for one in tier.iter("ALIGNABLE_ANNOTATION")
        ]
        for tier in root.iter("TIER")
    }
    assert len(tiers) == len(root.findall("TIER"))
    for found in tiers.values():
        assert all(start < end for start, end, _ in found)
        assert all(one[1] <= other[0] for one, other in pairwise(found))
    return tiers


def _follows_the_schema(element):
    """Every child where it may stand and as often, every attribute known and of its type, no required one missing."""
    children, attributes = SCHEMA[element.tag]
    tags = [child.tag for child in element]
    assert tags == sorted(tags, key=children.index)
    assert all(tags.count(tag) == 1 for tag in ONCE & {*children})
    known = {name.rstrip("!"): pattern for name, pattern in attributes.items()}
    for name, value in element.items():
        assert name == LOCATION or re.fullmatch(known[name], value), (element.tag, name, value)
    assert {name[:-1] for name in attributes if name.endswith("!")} <= {*element.keys()}


def test_elan_reads_motions_key_frames_and_repetitions():
    """Tiers of intervals in whole milliseconds, of a document as the EAF 3.0 schema has it."""
    found = document("walk")
    segment = found.segments[0].model_copy(update={"repeats": (Interval(start=0, end=1), Interval(start=1, end=2))})
    key = KeyFrame(frame=1, seconds=1 / 30, energy=1.5, motion=0)
    assert read(segments_eaf(found.model_copy(update={"segments": (segment,), "key_frames": (key,)}))) == {
        "motions": [(0, 33, "walk")],
        "key-frames": [(33, 67, "1.5000")],
        "repetitions": [(0, 33, "walk 1"), (33, 67, "walk 2")],
    }


def test_elan_takes_only_intervals_that_last():
    """A segment of the last frame alone, and a clock before 0: none is empty, negative or over another."""
    last = document("A", -5.0).segments[0].model_copy(update={"end_seconds": -5.0})
    found = document("A", -5.0).model_copy(update={"segments": (last, last)})
    assert read(segments_eaf(found)) == {"motions": [(0, 1, "A"), (1, 2, "A")]}


def test_a_name_is_no_markup_for_elan():
    """Nor can it hold what XML has no way to write."""
    name = "</ANNOTATION_VALUE>&lt;\x00\ufffe<x a='b'>"
    assert read(segments_eaf(document(name)))["motions"][0][2] == "</ANNOTATION_VALUE>&lt;<x a='b'>"


def test_what_is_moved_in_elan_takes_nothing_else_along():
    """Motions that meet, and repetitions that begin with them, are annotations of their own."""
    repeats = (Interval(start=0, end=1), Interval(start=1, end=2))
    segments = [
        Segment(start=2 * n, end=2 * n + 2, start_seconds=n, end_seconds=n + 1, motion=n, name=str(n), repeats=repeats)
        for n in range(3)
    ]
    text = segments_eaf(document("A").model_copy(update={"segments": tuple(segments)}))
    slots = re.findall(r'TIME_SLOT_REF\d="(\w+)"', text)
    assert len(slots) == len(set(slots)) == 2 * (3 + 6)
