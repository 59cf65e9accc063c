"""What a person does to a list of segments, as plain values, run by Node."""

SEGMENTS = """
    import * as edits from 'VIEWER/editing/segment_edits.js';
    const one = (start, end, motion, name) => ({ start, end, motion, name, confidence: 0.9, repeats: [] });
    const all = [one(0, 10, 0, 'A'), one(10, 20, 1, 'B'), one(20, 30, 0, 'A'), one(30, 40, 2, 'C')];
    const told = (segments) => segments.map(({ start, end, motion, name }) => [start, end, motion, name]);
"""


def test_edits_keep_the_take_tiled_and_motions_numbered_as_they_come(answer) -> None:
    """A cut stops at its neighbours; merging over the first motion renumbers the rest; nothing changes in place."""
    moved, merged, after, cut, whole = answer(f"""{SEGMENTS}
        const moved = edits.moveCut(all, 1, 99);
        const merged = edits.mergeCut(all, 0, true);
        const back = edits.mergeCut(edits.split(all, 5), 0);
        console.log(JSON.stringify([told(moved), told(merged), told(back), told(edits.split(all, 20)), told(all)]));
    """)
    assert [start for start, *_ in moved] == [0, 10, 29, 30]
    assert merged == [[0, 20, 0, "B"], [20, 30, 1, "A"], [30, 40, 2, "C"]]
    assert after == cut == whole


def test_a_motion_called_like_another_becomes_it_and_a_new_one_gets_a_free_letter(answer) -> None:
    """Names and motions stay one to one, whatever a person types."""
    renamed, joined, fresh, spaced = answer(f"""{SEGMENTS}
        console.log(JSON.stringify([edits.renameMotion(all, 0, ' walk '), edits.renameMotion(all, 2, 'B'),
            edits.assignMotion(all, [2], null), edits.renameMotion(all, 1, '  ')].map(told)));
    """)
    assert [name for *_, name in renamed] == ["walk", "B", "walk", "C"]
    assert [tuple(one[2:]) for one in joined] == [(0, "A"), (1, "B"), (0, "A"), (1, "B")]
    assert [tuple(one[2:]) for one in fresh] == [(0, "A"), (1, "B"), (2, "D"), (3, "C")]
    assert [name for *_, name in spaced] == ["A", "B", "A", "C"]


def test_undo_goes_back_by_what_was_done_in_one_go(answer) -> None:
    """Five nudges of one cut are one step; after an undo, something else done forgets what was undone."""
    seen = answer("""
        import { UndoHistory } from 'VIEWER/editing/undo_history.js';
        const history = new UndoHistory('computed');
        const seen = [];
        history.push('renamed');
        for (const step of [1, 2, 3]) history.push(`nudged ${step}`, 'nudge 4');
        history.undo(); seen.push(history.present);
        history.redo(); seen.push(history.present);
        history.undo(); history.undo(); seen.push(history.present, history.canUndo);
        history.push('other'); seen.push(history.canRedo, history.push('other'));
        console.log(JSON.stringify(seen));
    """)
    assert seen == ["renamed", "nudged 3", "computed", False, False, False]


def test_a_frame_is_in_one_segment(answer) -> None:
    """The first of a segment is in it, the one before is not."""
    assert answer(f"""{SEGMENTS}
        console.log(JSON.stringify([0, 9, 10, 29, 30, 39].map((frame) => edits.segmentIndexAt(all, frame))));
    """) == [0, 0, 1, 2, 3, 3]
