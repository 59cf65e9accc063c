"""The result as it reads with a person's segments: what they did not touch stays."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from caesura.core.document import Interval, KeyFrame, Segment, SegmentationDocument, Source
from caesura.core.errors import ParameterError
from caesura.core.revision import Edit, apply_revision, check_edits

FRAMES = 60


def intervals(*bounds):
    return tuple(Interval(start=a, end=b) for a, b in pairwise(bounds))


COMPUTED = SegmentationDocument(
    algorithm="1", method="switching", parameters={}, source=Source(take=0, name="t", fps=30, start_seconds=2.0),
    frames=FRAMES, frame_rate=30, duration_seconds=59 / 30, motions=2, energy=(None,) * FRAMES,
    segments=(
        Segment(start=0, end=30, start_seconds=2, end_seconds=3, motion=0, name="A", confidence=0.7,
                repeats=intervals(0, 10, 20, 30)),
        Segment(start=30, end=60, start_seconds=3, end_seconds=3 + 29 / 30, motion=1, name="B",
                repeats=intervals(30, 45, 60)),
    ),
    key_frames=(KeyFrame(frame=15, seconds=2.5, energy=1, motion=0), KeyFrame(frame=29, seconds=3, energy=1, motion=0)),
)  # fmt: skip


def read(*bounds):
    """The result with segments of one motion after the other."""
    edits = [Edit(start=a, end=b, motion=n) for n, (a, b) in enumerate(pairwise(bounds))]
    return apply_revision(COMPUTED, 1, check_edits(edits, FRAMES))


def repeats(*bounds):
    return [[r.start for r in segment.repeats] for segment in read(*bounds).segments]


def test_the_same_segments_are_the_same_result():
    """But for the number of the revision."""
    assert read(0, 30, 60) == COMPUTED.model_copy(update={"revision": 1})


def test_a_segment_that_is_drawn_out_or_split_keeps_its_repetitions():
    """As far as they lie in it; where two have become one nobody knows them any more."""
    assert repeats(0, 32, 60) == [[0, 10, 20], [32, 45]]
    assert repeats(0, 12, 30, 60) == [[0, 10], [12, 20], [30, 45]]
    assert repeats(0, 60) == [[]]


def test_a_cut_that_moved_is_nobodys_guess():
    """Its confidence is null; that of the others stays, and the end of the take is sure."""
    assert [s.confidence for s in read(0, 12, 30, 60).segments] == [None, 0.7, 1.0]


def test_key_frames_and_times_are_read_anew():
    """By the segments that they lie in now, on the file's clock."""
    found = read(0, 20, 59, 60)
    assert [key.motion for key in found.key_frames] == [0, 1]
    assert [(s.start_seconds, s.end_seconds) for s in found.segments][-1] == (2 + 59 / 30, 2 + 59 / 30)


@given(
    st.lists(st.tuples(st.integers(-2, 9), st.integers(1, 5), st.sampled_from([None, "A", "B", "walk"])), max_size=9)
)
def test_what_is_let_through_tiles_and_is_named_one_to_one(drawn):
    """Whatever comes is refused, or each motion has one name of its own, and motions count from 0 as they appear."""
    at, edits = 0, []
    for motion, length, name in drawn:
        edits.append(Edit(start=at, end=at + length, motion=motion, name=name))
        at += length
    try:
        found = check_edits(edits, at)
    except ParameterError:
        return
    names = dict.fromkeys((edit.motion, edit.name) for edit in found)
    assert [motion for motion, _ in names] == [*range(len(names))]
    assert len({name for _, name in names}) == len(names)
    assert [(e.start, e.end) for e in found] == [(e.start, e.end) for e in edits]
