"""Text forms: times as players and spreadsheets read them, names that cannot be taken for anything else."""

from xml.etree import ElementTree

from core.document import Interval, KeyFrame, Segment, SegmentationDocument, Source
from service.elan import segments_eaf
from service.exports import segments_csv, segments_vtt


def document(name, start=0.0):
    segment = Segment(start=0, end=2, start_seconds=start, end_seconds=start + 1 / 30, motion=0, name=name)
    return SegmentationDocument(
        algorithm="1", method="switching", parameters={}, source=Source(take=0, name="t", fps=30, start_seconds=start),
        frames=2, frame_rate=30, duration_seconds=1 / 30, motions=1, segments=(segment,), key_frames=(),
        energy=(None, None),
    )  # fmt: skip


def test_hours_are_written_out():
    """One hour and a bit, to the millisecond."""
    assert "01:00:00.500 --> 01:00:00.533" in segments_vtt(document("A", 3600.5))


def test_a_name_stays_a_name():
    """Markup, arrows and line breaks in VTT; commas and quotes in CSV."""
    assert "a &lt;b&gt; --&gt; c" in segments_vtt(document("a <b>\n\n--> c"))
    assert segments_csv(document('walk, "fast"')).splitlines()[1].startswith('"walk, ""fast""",0,0,2,')


ORDER = ["HEADER", "TIME_ORDER", "TIER", "LINGUISTIC_TYPE"]
REQUIRED = {
    "ANNOTATION_DOCUMENT": {"AUTHOR", "DATE", "VERSION"},
    "TIME_SLOT": {"TIME_SLOT_ID"},
    "TIER": {"TIER_ID", "LINGUISTIC_TYPE_REF"},
    "ALIGNABLE_ANNOTATION": {"ANNOTATION_ID", "TIME_SLOT_REF1", "TIME_SLOT_REF2"},
    "LINGUISTIC_TYPE": {"LINGUISTIC_TYPE_ID"},
}
CHILDREN = {
    "ANNOTATION_DOCUMENT": set(ORDER), "HEADER": {"PROPERTY"}, "TIME_ORDER": {"TIME_SLOT"}, "TIER": {"ANNOTATION"},
    "ANNOTATION": {"ALIGNABLE_ANNOTATION"}, "ALIGNABLE_ANNOTATION": {"ANNOTATION_VALUE"},
}  # fmt: skip


def checked_eaf(text):
    """The tiers of an EAF, as (from, to, value) in milliseconds, once it is as the format's schema wants it."""
    root = ElementTree.fromstring(text)
    tags = [child.tag for child in root]
    assert tags == sorted(tags, key=ORDER.index)
    for element in root.iter():
        assert REQUIRED.get(element.tag, set()) <= set(element.attrib), element.tag
        assert {child.tag for child in element} <= CHILDREN.get(element.tag, set()), element.tag
    slots = {slot.get("TIME_SLOT_ID"): int(slot.get("TIME_VALUE")) for slot in root.iter("TIME_SLOT")}
    numbers = [one.get("ANNOTATION_ID") for one in root.iter("ALIGNABLE_ANNOTATION")]
    assert len({*slots, *numbers}) == len(slots) + len(numbers)
    assert [*slots.values()] == sorted(set(slots.values()))
    types = {kind.get("LINGUISTIC_TYPE_ID") for kind in root.iter("LINGUISTIC_TYPE")}
    assert {tier.get("LINGUISTIC_TYPE_REF") for tier in root.iter("TIER")} <= types
    return {
        tier.get("TIER_ID"): [
            (slots[one.get("TIME_SLOT_REF1")], slots[one.get("TIME_SLOT_REF2")], one.findtext("ANNOTATION_VALUE"))
            for one in tier.iter("ALIGNABLE_ANNOTATION")
        ]
        for tier in root.iter("TIER")
    }


def test_elan_reads_motions_key_frames_and_repetitions():
    """Tiers of intervals in whole milliseconds, with the attributes and in the order of the EAF 3.0 schema."""
    found = document("walk")
    segment = found.segments[0].model_copy(update={"repeats": (Interval(start=0, end=1), Interval(start=1, end=2))})
    key = KeyFrame(frame=1, seconds=1 / 30, energy=1.5, motion=0)
    assert checked_eaf(segments_eaf(found.model_copy(update={"segments": (segment,), "key_frames": (key,)}))) == {
        "motions": [(0, 33, "walk")],
        "key-frames": [(33, 67, "1.5000")],
        "repetitions": [(0, 33, "walk 1"), (33, 67, "walk 2")],
    }


def test_elan_takes_only_intervals_that_last():
    """A segment of the last frame alone, and a clock before 0: none is empty, negative or over another."""
    last = document("A", -5.0).segments[0].model_copy(update={"end_seconds": -5.0})
    found = document("A", -5.0).model_copy(update={"segments": (last, last)})
    assert checked_eaf(segments_eaf(found)) == {"motions": [(0, 1, "A"), (1, 2, "A")]}
    assert "00:00:00.000 --> 00:00:00.001" in segments_vtt(found)


def test_a_name_is_no_markup_for_elan():
    """Nor can it hold what XML has no way to write."""
    name = "</ANNOTATION_VALUE>&lt;\x00\ufffe<x a='b'>"
    assert checked_eaf(segments_eaf(document(name)))["motions"][0][2] == "</ANNOTATION_VALUE>&lt;<x a='b'>"
