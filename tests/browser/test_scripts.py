"""The page's own arithmetic, run by Node."""

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def answer(node: Path, checkout: Path):
    """Run a script that may import the page's modules; answers the JSON it prints."""
    viewer = checkout / "service" / "static" / "viewer"

    def run(script: str) -> Any:
        done = subprocess.run(
            [node, "--input-type=module", "--disable-warning=MODULE_TYPELESS_PACKAGE_JSON"],
            input=script.replace("VIEWER", viewer.as_uri()),
            text=True,
            capture_output=True,
            check=True,
        )
        return json.loads(done.stdout)

    return run


def test_a_thinned_curve_keeps_its_peaks_and_its_order(answer) -> None:
    """Of 72,000 frames on 500 columns, a peak of one frame is still there, and a gap stays a gap."""
    frames, values = answer("""
        import { thinned } from 'VIEWER/thinning.js';
        const values = Array.from({ length: 72000 }, (_, i) => i < 2000 ? null : i === 41234 ? 9 : Math.sin(i / 50));
        console.log(JSON.stringify(thinned(values, 0, 72000, 500)));
    """)
    assert len(frames) <= 1000
    assert frames == sorted(frames)
    assert frames[values.index(9)] == 41234
    assert values[0] is None


def test_every_stage_has_words(answer, checkout: Path) -> None:
    """What the worker and the method tell of themselves, and nothing that they never tell, is put to a person."""
    known = answer("import { STAGES } from 'VIEWER/stages.js'; console.log(JSON.stringify(Object.keys(STAGES)));")
    sources = [
        path.read_text(encoding="utf-8") for part in ("core", "worker") for path in checkout.glob(f"{part}/**/*.py")
    ]
    told = {name for text in sources for name in re.findall(r'\b(?:progress\(|stage=)"([\w -]+)"', text)}
    assert told | {"upload", "queued"} == {*known}


def test_a_short_curve_is_drawn_as_it_is(answer) -> None:
    """Where every frame has a column, nothing is left out."""
    frames, values = answer("""
        import { thinned } from 'VIEWER/thinning.js';
        console.log(JSON.stringify(thinned([1, 2, 3, 4, 5], 0, 5, 500)));
    """)
    assert frames == [0, 1, 2, 3, 4]
    assert values == [1, 2, 3, 4, 5]


def test_zooming_keeps_the_frame_under_the_pointer_and_the_take_in_view(answer) -> None:
    """In and out again is where one began; nothing outside the take is ever shown."""
    steps = answer("""
        import { Span } from 'VIEWER/span.js';
        const span = new Span(1000);
        const seen = [];
        const note = () => seen.push([span.from, span.to]);
        span.zoom(4, 300); note();
        span.pan(-5000); note();
        span.zoom(0.001, 10); note();
        span.reveal(999); note();
        console.log(JSON.stringify(seen));
    """)
    (start, stop), panned, out, revealed = steps
    assert stop - start == 250
    assert (300 - start) / 250 == pytest.approx(0.3)
    assert panned == [0, 250]
    assert out == revealed == [0, 1000]


def test_two_fingers_keep_the_frames_under_them(answer) -> None:
    """Apart they zoom in, aside they move; one finger alone, or two on the same place, change nothing."""
    seen = answer("""
        import { Pinch } from 'VIEWER/pinch.js';
        import { Span } from 'VIEWER/span.js';
        const span = new Span(1000);
        const pinch = new Pinch(span);
        const seen = [];
        const note = () => seen.push([Math.round(span.from), Math.round(span.to)]);
        pinch.press(1, 0.4); pinch.move(1, 0.3); note();
        pinch.press(2, 0.6); note();
        pinch.move(1, 0.2); pinch.move(2, 0.8); note();
        pinch.move(1, 0.1); pinch.move(2, 0.7); note();
        pinch.move(1, 0.7); note();
        pinch.release(1); pinch.move(2, 0.2); note();
        console.log(JSON.stringify(seen));
    """)
    assert seen[:2] == [[0, 1000], [0, 1000]]
    assert seen[2] == [200, 700]  # frames 300 and 600 at 0.2 and 0.8 of the width
    assert seen[3] == [250, 750]
    assert seen[4:] == [seen[3]] * 2


def test_playing_ends_with_the_take_and_waits_for_what_is_not_there(answer) -> None:
    """The clock never leaves the take, waits for what is not loaded, and repeats a segment that is looped."""
    seen = answer("""
        import { Clock } from 'VIEWER/clock.js';
        let now = 0;
        const waiting = [];
        globalThis.requestAnimationFrame = (action) => waiting.push(action);
        const step = () => waiting.splice(0).forEach((action) => action(now += 50));
        const clock = new Clock(100, 30);
        clock.seek(95);
        clock.toggle();
        for (let i = 0; i < 9; i++) step();
        const end = [clock.frame, clock.playing];
        clock.loop = [10, 20];
        clock.seek(12);
        clock.toggle();
        const frames = [];
        for (let i = 0; i < 40; i++) { step(); frames.push(clock.frame); }
        let loaded = false;
        const late = new Clock(100, 30, () => loaded);
        late.toggle();
        for (let i = 0; i < 5; i++) step();
        const held = late.frame;
        loaded = true;
        for (let i = 0; i < 5; i++) step();
        console.log(JSON.stringify([end, [Math.min(...frames), Math.max(...frames)], held, late.frame > 0]));
    """)
    assert seen == [[99, False], [10, 19], 0, True]


def test_a_name_is_shortened_to_what_there_is_room_for(answer) -> None:
    """What does not fit ends in three dots and keeps its mark; where not even that fits, nothing is written."""
    assert answer("""
        import { fitted } from 'VIEWER/timeline.js';
        const context = { measureText: (text) => ({ width: 10 * [...text].length }) };
        console.log(JSON.stringify([200, 110, 60, 30, 15].map((room) => fitted(context, 'walk forward', ' ↻', room))));
    """) == ["walk forward ↻", "walk for… ↻", "wal… ↻", "", ""]


def test_a_frame_is_in_one_segment(answer) -> None:
    """The first of a segment is in it, the one before is not."""
    assert answer(f"""{SEGMENTS}
        console.log(JSON.stringify([0, 9, 10, 29, 30, 39].map((frame) => edits.indexAt(all, frame))));
    """) == [0, 0, 1, 2, 3, 3]


SEGMENTS = """
    import * as edits from 'VIEWER/segments.js';
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
            edits.giveMotion(all, 2, null), edits.renameMotion(all, 1, '  ')].map(told)));
    """)
    assert [name for *_, name in renamed] == ["walk", "B", "walk", "C"]
    assert [tuple(one[2:]) for one in joined] == [(0, "A"), (1, "B"), (0, "A"), (1, "B")]
    assert [tuple(one[2:]) for one in fresh] == [(0, "A"), (1, "B"), (2, "D"), (3, "C")]
    assert [name for *_, name in spaced] == ["A", "B", "A", "C"]


def test_undo_goes_back_by_what_was_done_in_one_go(answer) -> None:
    """Five nudges of one cut are one step; after an undo, something else done forgets what was undone."""
    seen = answer("""
        import { History } from 'VIEWER/history.js';
        const history = new History('computed');
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
