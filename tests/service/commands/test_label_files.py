"""`caesura score` reads what people write: ELAN's EAF, tables and JSON; what is hostile is refused in a sentence."""

import json
import time

import pytest
from click.testing import CliRunner

from caesura import Segmentation, segment
from caesura.core.errors import InvalidModel, LimitExceeded
from caesura.formats.exports.csv_tables import frames_csv, segments_csv
from caesura.formats.exports.elan import segments_eaf
from caesura.service.commands.cli import main
from caesura.service.commands.label_files import read
from caesura.service.commands.label_files.read import read_both
from tests.animations import performing_bar

TRUTH = {
    "fps": 30,
    "frames": 300,
    "segments": [{"label": "pull", "start": 0, "end": 150}, {"label": "widen", "start": 150, "end": 300}],
}


@pytest.fixture
def truth(tmp_path):
    """Ten seconds, two motions."""
    path = tmp_path / "truth.json"
    path.write_text(json.dumps(TRUTH))
    return path


@pytest.fixture(scope="module")
def document():
    """A result whose clock starts at five seconds."""
    found = segment(performing_bar((0, 1, 0), seconds=2.0, rings=8).animation, motions=2).document()
    later = found.model_copy(update={"source": found.source.model_copy(update={"start_seconds": 5.0})})
    return Segmentation.of(later).document()


def score(*arguments, **given):
    return CliRunner().invoke(main, ["score", *map(str, arguments), "--json"], **given)


def eaf(*annotations, tier="motions", slots=None, head="", units="milliseconds"):
    """An EAF with one tier: (start, end, label), milliseconds."""
    times = [time for start, end, _ in annotations for time in (start, end)] if slots is None else slots
    order = "".join(f'<TIME_SLOT TIME_SLOT_ID="ts{i}" TIME_VALUE="{time}"/>' for i, time in enumerate(times))
    body = "".join(
        f'<ANNOTATION><ALIGNABLE_ANNOTATION TIME_SLOT_REF1="ts{2 * i}" TIME_SLOT_REF2="ts{2 * i + 1}">'
        f"<ANNOTATION_VALUE>{label}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
        for i, (_, _, label) in enumerate(annotations)
    )
    return (
        f'<?xml version="1.0"?>{head}<ANNOTATION_DOCUMENT><HEADER TIME_UNITS="{units}"/>'
        f'<TIME_ORDER>{order}</TIME_ORDER><TIER TIER_ID="empty"/><TIER TIER_ID="{tier}">{body}</TIER>'
        "</ANNOTATION_DOCUMENT>"
    )


SAME = [
    ("t.eaf", eaf((0, 5000, "pull"), (5000, 10_000, "widen"))),
    ("t.eaf", eaf((0, 5000, "a &amp; b"), (5000, 10_900, "c"), units="milliseconds")),
    ("t.csv", "label,start,end\npull,0,150\nwiden,150,300\n"),
    ("t.csv", "\ufeffLabel;Start_Seconds;End_Seconds;note\r\npull;0,0;5,0;x\r\nwiden;5,0;10,0;y\r\n\r\n"),
    ("t.tsv", "start\tend\tname\n150\t300\twiden\n0\t150\tpull\n"),
    ("t.csv", "frame,motion\n" + "".join(f"{frame},{frame // 150}\n" for frame in range(300))),
    ("t.json", json.dumps(TRUTH)),
]


@pytest.mark.parametrize(("name", "content"), SAME, ids=range(len(SAME)))
def test_one_truth_in_every_form_is_one_truth(truth, tmp_path, name, content):
    """As EAF, as a table with frames or seconds, in any order and by any delimiter, on either side."""
    other = tmp_path / name
    other.write_text(content, encoding="utf-8")
    for run in (score(truth, other), score(other, truth), score(truth, "-", input=content)):
        assert run.exit_code == 0, run.output
        figures = json.loads(run.stdout)
        assert figures.pop("error_measure") == 0
        assert set(figures.values()) == {1.0}


def test_our_own_exports_are_read(document, tmp_path):
    """EAF, both tables and the document of a result agree with each other, whenever the file's clock starts."""
    forms = {"a.json": document.model_dump_json(), "a.csv": segments_csv(document), "b.csv": frames_csv(document)}
    for name, content in {**forms, "a.eaf": segments_eaf(document)}.items():
        (tmp_path / name).write_text(content)
        found, labels = read_both(tmp_path / "a.json", tmp_path / name)
        assert [one[:2] for one in labels.segments] == [one[:2] for one in found.segments]


def test_what_nobody_labelled_is_a_label_of_its_own(truth, tmp_path):
    """Before, between and after labels; a second too long is cut off."""
    (tmp_path / "t.csv").write_text("label,start,end\nx,10,20\ny,30,310\n")
    _, labels = read_both(truth, tmp_path / "t.csv")
    assert labels.segments == ((0, 10, ""), (10, 20, "x"), (20, 30, ""), (30, 300, "y"))


def test_two_tables_need_a_frame_rate(tmp_path):
    """Of which neither says one; they are as long as the longer."""
    (tmp_path / "a.csv").write_text("label,start_seconds,end_seconds\nx,0,2\n")
    (tmp_path / "b.eaf").write_text(eaf((0, 1000, "x"), (1000, 1800, "y")))
    assert "give --fps" in score(tmp_path / "a.csv", tmp_path / "b.eaf").stderr
    run = score(tmp_path / "a.csv", tmp_path / "b.eaf", "--fps", "50")
    assert run.exit_code == 0, run.output
    assert json.loads(run.stdout)["frame_accuracy"] == 0.5


def test_a_tier_is_chosen_by_its_name(truth, tmp_path):
    """Another than the first, which has annotations too."""
    one, other = (
        eaf((0, 9000, "x")),
        eaf((0, 5000, "pull"), (5000, 10_000, "widen"), tier="hands").replace('"ts', '"us'),
    )
    order, tier = (
        other[other.index("<TIME_SLOT ") : other.index("</TIME_ORDER>")],
        other[other.index('<TIER TIER_ID="h') :],
    )
    both = one.replace("</TIME_ORDER>", f"{order}</TIME_ORDER>").replace("</ANNOTATION_DOCUMENT>", tier)
    (tmp_path / "t.eaf").write_text(both)
    assert json.loads(score(truth, tmp_path / "t.eaf").stdout)["frame_accuracy"] < 1
    assert json.loads(score(truth, tmp_path / "t.eaf", "--tier", "hands").stdout)["frame_accuracy"] == 1
    assert "it has 'motions', 'hands'" in score(truth, tmp_path / "t.eaf", "--tier", "feet").stderr


LAUGHS = "<!DOCTYPE x [" + '<!ENTITY a0 "ha">' + "".join(
    f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10)
) + "]>"  # fmt: skip
HOSTILE = {
    "a billion laughs": (eaf((0, 5000, "&a9;"), head=LAUGHS), "declares a document type"),
    "a file of this machine": (
        eaf((0, 5000, "&x;"), head='<!DOCTYPE x [<!ENTITY x SYSTEM "file:///etc/passwd">]>'),
        "declares a document type",
    ),
    "a definition elsewhere": (
        eaf((0, 5000, "x"), head='<!DOCTYPE x SYSTEM "http://127.0.0.1:1/x.dtd">'),
        "declares a document type",
    ),
    "an unknown entity": (eaf((0, 5000, "&x;")), "no XML that can be read"),
    "a deep document": ("<a>" * 1_000_000, "more than 50 elements within each other"),
    "a cut document": (eaf((0, 5000, "x"))[:-9], "no XML that can be read"),
    "no slot": (eaf((0, 5000, "x"), slots=[0]), "begins or ends at no time"),
    "another unit": (eaf((0, 5000, "x"), units="NTSC-frames"), "not in milliseconds"),
    "no annotation": (eaf(), "no such tier"),
    "a long number": (eaf((0, "9" * 5000, "x")), "it reaches to frame"),
    "no number": (eaf((0, "soon", "x")), "invalid literal"),
    "overlap": ("label,start,end\na,0,100\nb,50,300\n", "overlap at frame 50"),
    "10^14 frames": ("label,start,end\na,0,100000000000000\n", "it reaches to frame 1e+14, and the take has 300"),
    "infinity": ("label,start,end\na,0,inf\n", "line 2 has no numbers"),
    "not a number": ("label,start_seconds,end_seconds\na,nan,1\n", "line 2 has no numbers"),
    "a short row": ("start,end,label\n0,1\n", "line 2 has no numbers"),
    "no columns": ("a,b,c\n0,1,2\n", "none of the columns motion, label, name"),
    "no times": ("label\nx\n", "neither start and end"),
    "no rows": ("label,start,end\n", "it has no rows"),
    "a long field": ("label,start,end\n" + "x" * 10**6 + ",0,1\n", "field larger than field limit"),
    "nothing": ("", "none of the columns"),
    "JSON of 10^14 frames": (
        json.dumps({"fps": 30, "frames": 10**14, "segments": [{"label": 1, "start": 0, "end": 10**14}]}),
        "more than 1000000000 frames",
    ),
    "a number of 5000 digits": ('{"fps": 30, "frames": ' + "9" * 5000 + ', "segments": []}', "4300 digits"),
}


@pytest.mark.parametrize("what", HOSTILE)
def test_what_is_hostile_or_broken_is_refused_in_a_sentence(truth, tmp_path, what):
    """At once, with 3, without a traceback, and without a word of any other file."""
    content, said = HOSTILE[what]
    wrong = tmp_path / "wrong"
    wrong.write_text(content, encoding="utf-8")
    since = time.monotonic()
    run = score(truth, wrong)
    assert time.monotonic() - since < 2
    assert run.exit_code == 3, run.output
    problem = json.loads(run.stderr)
    assert problem["code"] == "not-a-labelling"
    assert said in problem["detail"]
    assert len(problem["detail"]) < 600
    assert "root:" not in run.output


def test_so_many_annotations_are_refused_before_they_fill_the_memory(truth, tmp_path, monkeypatch):
    """In a tier, in a table, and of a file that is larger than labels can be."""
    monkeypatch.setattr("caesura.service.commands.label_files.eaf_file.MOST_INTERVALS", 100)
    monkeypatch.setattr("caesura.service.commands.label_files.csv_file.MOST_INTERVALS", 100)
    (tmp_path / "t.eaf").write_text(eaf(*((i, i + 1, "x") for i in range(200))))
    (tmp_path / "t.csv").write_text("label,start,end\n" + "".join(f"x,{i},{i + 1}\n" for i in range(200)))
    for name in ("t.eaf", "t.csv"):
        with pytest.raises(InvalidModel, match="more than 100"):
            read_both(truth, tmp_path / name)
    monkeypatch.setattr(read, "MOST_BYTES", 1000)
    with pytest.raises(LimitExceeded):
        read_both(truth, tmp_path / "t.csv")


def test_standard_input_is_one_of_the_two(truth):
    """Both cannot be it."""
    assert score("-", "-", input="{}").exit_code == 2


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("label,start,end\na,-1e308,150\nb,150,300\n", None),
        ("label,start_seconds,end_seconds\na,-1e308,-1e307\nb,0,10\n", None),
        ("frame,label\n" + "".join(f"{n},{n}\n" for n in range(3000)), "more than"),
        ("label,start,end\n" + "".join(f"{n},{n},{n + 1}\n" for n in range(3000)), "more than"),
    ],
    ids=["before all time", "seconds before all time", "a label a frame", "a label a row"],
)
def test_labels_without_end_are_refused_or_cut_off(tmp_path, content, said):
    """Numbers beyond the take are no fault, and more labels than can be matched are said."""
    frames = 3000 if said else 300
    stated = {"fps": 30, "frames": frames, "segments": [{"label": "all", "start": 0, "end": frames}]}
    (tmp_path / "stated.json").write_text(json.dumps(stated))
    other = tmp_path / "t.csv"
    other.write_text(content)
    run = score(tmp_path / "stated.json", other)
    assert run.exit_code == (3 if said else 0), run.output
    assert said is None or said in run.stderr


def test_a_value_of_many_lines_takes_no_time(tmp_path, truth):
    """The letters of a label that are kept are few, however many there are."""
    other = tmp_path / "t.eaf"
    other.write_text(eaf((0, 5000, "x\n" * 400_000), (5000, 10_000, "y")))
    began = time.process_time()
    assert score(truth, other).exit_code == 0
    assert time.process_time() - began < 5
