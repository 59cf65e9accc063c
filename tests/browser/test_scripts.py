"""The page's own arithmetic, run by Node."""

import re
from pathlib import Path

import pytest


def test_a_thinned_curve_keeps_its_peaks_and_its_order(answer) -> None:
    """Of 72,000 frames on 500 columns, a peak of one frame is still there, and a gap stays a gap."""
    frames, values = answer("""
        import { decimate } from 'VIEWER/timeline/decimation.js';
        const values = Array.from({ length: 72000 }, (_, i) => i < 2000 ? null : i === 41234 ? 9 : Math.sin(i / 50));
        console.log(JSON.stringify(decimate(values, 0, 72000, 500)));
    """)
    assert len(frames) <= 1000
    assert frames == sorted(frames)
    assert frames[values.index(9)] == 41234
    assert values[0] is None


def test_every_stage_has_words(answer, checkout: Path) -> None:
    """What the worker and the method tell of themselves, and nothing that they never tell, is put to a person."""
    known = answer(
        "import { STAGES } from 'VIEWER/start/progress.js'; console.log(JSON.stringify(Object.keys(STAGES)));"
    )
    sources = [
        path.read_text(encoding="utf-8")
        for part in ("core", "formats", "worker")
        for path in checkout.glob(f"{part}/**/*.py")
    ]
    told = {name for text in sources for name in re.findall(r'\b(?:progress\(|stage=)"([\w -]+)"', text)}
    assert told | {"upload", "queued"} == {*known}


def test_a_short_curve_is_drawn_as_it_is(answer) -> None:
    """Where every frame has a column, nothing is left out."""
    frames, values = answer("""
        import { decimate } from 'VIEWER/timeline/decimation.js';
        console.log(JSON.stringify(decimate([1, 2, 3, 4, 5], 0, 5, 500)));
    """)
    assert frames == [0, 1, 2, 3, 4]
    assert values == [1, 2, 3, 4, 5]


def test_zooming_keeps_the_frame_under_the_pointer_and_the_take_in_view(answer) -> None:
    """In and out again is where one began; nothing outside the take is ever shown."""
    steps = answer("""
        import { VisibleRange } from 'VIEWER/timeline/visible_range.js';
        const span = new VisibleRange(1000);
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
    """Apart they zoom in, aside they move; one finger alone, or two on the same place, change nothing; of three, the
    outer ones count."""
    on, seen = answer("""
        import { Pinch } from 'VIEWER/timeline/pinch.js';
        import { VisibleRange } from 'VIEWER/timeline/visible_range.js';
        const span = new VisibleRange(1000);
        const pinch = new Pinch(span);
        const seen = [];
        const note = () => seen.push([Math.round(span.from), Math.round(span.to)]);
        pinch.press(1, 0.4); pinch.move(1, 0.3); note();
        pinch.press(2, 0.6); note();
        pinch.move(1, 0.2); pinch.move(2, 0.8); note();
        pinch.move(1, 0.1); pinch.move(2, 0.7); note();
        pinch.move(1, 0.7); note();
        pinch.release(1); pinch.move(2, 0.2); note();
        pinch.press(1, 0.8); pinch.press(3, 0.5); pinch.move(1, 0.6); note();
        console.log(JSON.stringify([pinch.on, seen]));
    """)
    assert on
    assert seen.pop() == [200, 950]
    assert seen[:2] == [[0, 1000], [0, 1000]]
    assert seen[2] == [200, 700]  # frames 300 and 600 at 0.2 and 0.8 of the width
    assert seen[3] == [250, 750]
    assert seen[4:] == [seen[3]] * 2


def test_playing_ends_with_the_take_and_waits_for_what_is_not_there(answer) -> None:
    """The clock never leaves the take, waits for what is not loaded, and repeats a segment that is looped."""
    seen = answer("""
        import { Playhead } from 'VIEWER/timeline/playhead.js';
        let now = 0;
        const waiting = [];
        globalThis.requestAnimationFrame = (action) => waiting.push(action);
        const step = () => waiting.splice(0).forEach((action) => action(now += 50));
        const clock = new Playhead(100, 30);
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
        const late = new Playhead(100, 30, () => loaded);
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
        import { fitText } from 'VIEWER/timeline/segment_track.js';
        const context = { measureText: (text) => ({ width: 10 * [...text].length }) };
        console.log(JSON.stringify([200, 110, 60, 30, 15].map((room) => fitText(context, 'walk forward', ' ↻', room))));
    """) == ["walk forward ↻", "walk for… ↻", "wal… ↻", "", ""]


def test_a_second_around_a_cut_is_played_once_whatever_is_repeated(answer) -> None:
    """It ends at the cut, also where every segment is repeated, if it is asked for while it plays, and if the cut
    has to be fetched first."""
    seen = answer("""
        import { Playhead } from 'VIEWER/timeline/playhead.js';
        let now = 0;
        const waiting = [];
        globalThis.requestAnimationFrame = (action) => waiting.push(action);
        const step = () => waiting.splice(0).forEach((action) => action(now += 50));
        const clock = new Playhead(100, 30);
        clock.listen(() => { if (!clock.loop && !clock.until) clock.loop = [0, 50]; });
        const told = [];
        clock.listen(() => told.push([clock.frame, clock.playing]));
        clock.playOnce(35, 65, 50);
        for (let i = 0; i < 5; i++) step();
        clock.playOnce(35, 65, 50);
        for (let i = 0; i < 60; i++) step();
        const most = Math.max(...told.map(([frame]) => frame));
        let loaded = true;
        const late = new Playhead(100, 30, () => loaded);
        late.playOnce(35, 65, 50);
        while (late.frame < 63) step();
        loaded = false;
        for (let i = 0; i < 9; i++) step();
        loaded = true;
        for (let i = 0; i < 9; i++) step();
        console.log(JSON.stringify([told[0], told.at(-1), [late.frame, late.playing], most]));
    """)
    assert seen[:3] == [[35, True], [50, False], [50, False]]
    assert 60 < seen[3] < 65
