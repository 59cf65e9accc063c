"""A result as the paper's figures show one: as SVG for the web process, as PNG with Pillow."""

import io
import re
import subprocess
import sys
from itertools import pairwise
from xml.etree import ElementTree

import pytest
from PIL import Image

from caesura.core.document import KeyFrame, Segment, SegmentationDocument, Source, motion_name
from caesura.core.errors import ParameterError
from caesura.core.plot.layout import BAR, COLOURS, CURVE, DISCARDED, GAP, TOP, lay_out_picture
from caesura.core.plot.picture import Box, Dot, Label, Line
from caesura.core.plot.png import SCALE, render_png
from caesura.core.plot.svg import render_svg


def document(cuts=(60, 100), frames=200, names=(), energy=None, discard=(), start=0.0):
    """A result of frames at 30 a second; its motions are all different, or named so."""
    bounds = [0, *cuts, frames]
    called = [*names] or [motion_name(i) for i in range(len(cuts) + 1)]
    segments = tuple(
        Segment(start=a, end=b, start_seconds=start + a / 30, end_seconds=start + b / 30, motion=i, name=n,
                discard=i in discard)
        for i, (a, b, n) in enumerate(zip(bounds[:-1], bounds[1:], called, strict=True))
    )  # fmt: skip
    curve = energy or tuple(None if f < 20 or f >= frames - 20 else 1 + f % 40 / 40 for f in range(frames))
    keys = tuple(
        KeyFrame(frame=f, seconds=f / 30, energy=e, motion=0) for f, e in enumerate(curve) if e and f % 80 == 0
    )
    return SegmentationDocument(
        algorithm="1", method="switching", parameters={}, source=Source(take=0, name="t", fps=30, start_seconds=start),
        frames=frames, frame_rate=30, duration_seconds=(frames - 1) / 30, motions=len(segments), segments=segments,
        key_frames=keys, energy=curve,
    )  # fmt: skip


def of(kind, found):
    return [shape for shape in lay_out_picture(found).shapes if isinstance(shape, kind)]


def test_it_shows_curve_key_frames_cuts_and_segments():
    """A box for each segment, side by side; a dashed line for each cut; a dot on the curve for each key-frame."""
    found = document()
    boxes = of(Box, found)
    assert [box.fill for box in boxes] == list(COLOURS[:3])
    assert all(a.x + a.width == pytest.approx(b.x) for a, b in pairwise(boxes))
    assert [line.points[0][0] for line in of(Line, found) if line.dashed] == [box.x for box in boxes[1:]]
    assert len(of(Dot, found)) == len(found.key_frames)
    assert {"A", "B", "C", "energy (nats)", "seconds"} <= {label.text for label in of(Label, found)}


def test_what_is_discarded_is_grey():
    """So that a figure of a revision says so."""
    assert [box.fill for box in of(Box, document(discard=[1]))] == [COLOURS[0], DISCARDED, COLOURS[2]]


def test_a_session_is_drawn_in_few_points():
    """72,000 frames in a column of pixels each: their extremes are kept, and the file is small."""
    energy = tuple(1.0 if f != 50_001 else 9.0 for f in range(72_000))
    found = document(cuts=[40_000], frames=72_000, energy=energy)
    highest = min(y for line in of(Line, found) for _, y in line.points if line.width == 1.5)
    assert highest < 30
    assert len(render_svg(lay_out_picture(found))) < 100_000
    assert "minutes" in {label.text for label in of(Label, found)}


@pytest.mark.parametrize(
    "found",
    [
        document(cuts=(), frames=1, energy=(None,)),
        document(cuts=(), frames=2, energy=(0.0, 0.0)),
        document(cuts=(1,), frames=2, energy=(1e-300, None)),
        document(cuts=range(1, 2000), frames=2000),
        document(start=1e6),
    ],
)
def test_odd_results_are_drawn_too(found):
    """One frame, no curve, a flat one, 2,000 segments of a frame each, a clock that is late."""
    picture = lay_out_picture(found)
    ElementTree.fromstring(render_svg(picture))
    assert Image.open(io.BytesIO(render_png(picture))).size == (picture.width * SCALE, picture.height * SCALE)


HOSTILE = '</text><script>alert("1")</script>&amp;\x00\x1b\ufffe'


def test_a_name_stays_a_name():
    """Nothing in it is markup, and what XML cannot hold is left out."""
    text = render_svg(lay_out_picture(document(cuts=(), names=[HOSTILE])))
    root = ElementTree.fromstring(text)
    assert "script" not in {element.tag.rpartition("}")[2] for element in root.iter()}
    assert '</text><script>alert("1")</script>&amp;' in {element.text for element in root.iter()}


def drawn(name, font=None):
    """The picture of a result whose first motion has a name: the bar of its segments, and the foot."""
    picture = lay_out_picture(document(names=[name, "B", "C"]))
    image = Image.open(io.BytesIO(render_png(picture, font)))
    bar = (TOP + CURVE + GAP) * SCALE, (TOP + CURVE + GAP + BAR) * SCALE
    above, below = (image.crop((0, start, image.width, end)) for start, end in (bar, (bar[1], image.height)))
    return above, below


def test_a_name_that_the_font_lacks_is_still_named_and_that_is_said():
    """Pillow's font has plain letters alone: accents are left away in the PNG, and for ideographs stands a letter."""
    bar, foot = drawn("A")
    for name, shown in (("été", drawn("ete")[0]), ("歩く", bar)):
        changed, said = drawn(name)
        assert changed == shown
        assert said != foot
    assert drawn("ete")[1] == foot


def font_of(letters):
    """A bitmap font (BDF) in which every one of these letters is a block, and every other is blank."""
    glyphs = "".join(
        f"STARTCHAR u{ord(one):04X}\nENCODING {ord(one)}\nSWIDTH 500 0\nDWIDTH 16 0\nBBX 16 26 0 0\nBITMAP\n"
        + ("0000\n" if one == " " else "FFFF\n") * 26 + "ENDCHAR\n"
        for one in " " + letters
    )  # fmt: skip
    return (
        "STARTFONT 2.1\nFONT -t-t-medium-r-normal--26-190-96-96-c-160-iso10646-1\nSIZE 26 72 72\n"
        "FONTBOUNDINGBOX 16 26 0 0\nSTARTPROPERTIES 4\nFONT_ASCENT 26\nFONT_DESCENT 0\n"
        'CHARSET_REGISTRY "ISO10646"\nCHARSET_ENCODING "1"\nENDPROPERTIES\n'
        f"CHARS {len(letters) + 1}\n{glyphs}ENDFONT\n"
    ).encode()


def test_a_font_that_is_handed_in_writes_what_the_other_lacks():
    """Plain names stay as they are on every machine; with all letters there, nothing is said below."""
    font = font_of("ét歩く")
    for name in ("été", "歩く"):
        bar, foot = drawn(name, font)
        assert bar != drawn(name)[0]
        assert foot == drawn("A")[1]
    assert [drawn("walk", font)[part].tobytes() for part in (0, 1)] == [
        drawn("walk")[part].tobytes() for part in (0, 1)
    ]


def test_what_is_no_font_is_refused():
    """In words that say which files are."""
    with pytest.raises(ParameterError, match=r"\.ttf or \.otf"):
        drawn("été", b"no font")


def test_the_same_result_is_the_same_bytes():
    """Also in another process, whatever its hashes are."""
    program = (
        "import hashlib; from tests.core.plot.test_plot import *;"
        "picture = lay_out_picture(document());"
        "print(hashlib.sha256(render_svg(picture).encode() + render_png(picture)).hexdigest())"
    )
    said = [subprocess.run([sys.executable, "-c", program], capture_output=True, check=True).stdout for _ in range(2)]
    assert said[0] == said[1]


def test_colours_are_those_of_the_page(checkout):
    """A motion looks the same in the page and in the paper."""
    page = (checkout / "service/static/viewer/palette.js").read_text(encoding="utf-8")
    assert tuple(re.findall(r"'(#[0-9a-f]{6})',", page.partition("];")[0])) == COLOURS
