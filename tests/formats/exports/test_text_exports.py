"""Text forms: times as players and spreadsheets read them, names that cannot be taken for anything else."""

from caesura.core.segmentation_document import Segment, SegmentationDocument, Source
from caesura.formats.exports.csv_tables import segments_csv
from caesura.formats.exports.elan import segments_eaf
from caesura.formats.exports.webvtt import segments_vtt


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


def test_a_discarded_segment_is_marked():
    """Who subtitles a video or annotates it sees which are no clips."""
    kept = document("T-pose").segments[0]
    found = document("A").model_copy(update={"segments": (kept.model_copy(update={"discard": True}), kept)})
    assert [line for line in segments_vtt(found).splitlines() if "T-pose" in line] == ["T-pose (discarded)", "T-pose"]
    assert segments_eaf(found).count('TIER_ID="discarded"') == 1
    assert 'TIER_ID="discarded"' not in segments_eaf(document("A"))


def test_players_take_only_cues_that_last():
    """A segment of the last frame alone, and a clock before 0: none is empty or negative."""
    last = document("A", -5.0).segments[0].model_copy(update={"end_seconds": -5.0})
    assert "00:00:00.000 --> 00:00:00.001" in segments_vtt(document("A").model_copy(update={"segments": (last,)}))
