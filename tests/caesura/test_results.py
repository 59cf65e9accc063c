"""A result is at home where researchers work: it compares, prints, and is a table, a plot and change points."""

import base64
import dataclasses
import io
import math
import pickle
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

from caesura import Segmentation, open_animation, segment
from caesura.core.errors import ParameterError
from caesura.core.segmentation_document import SegmentationDocument
from tests.animations import performing_bar
from tests.conftest import installed


@pytest.fixture(scope="module")
def bar():
    """Two motions in four segments, 720 frames."""
    return performing_bar((0, 1, 0, 1), rings=16)


@pytest.fixture(scope="module")
def found(bar):
    return segment(bar.animation, motions=2)


def test_results_of_the_same_take_are_equal(bar, found):
    """Where every value is, in sets too; another number of motions, or one other label, is another result."""
    again = segment(bar.animation, motions=2)
    assert again == found
    assert len({again, found, pickle.loads(pickle.dumps(found))}) == 1
    assert segment(bar.animation, motions=1) != found
    labels = found.labels.copy()
    labels[-1] = 0
    assert dataclasses.replace(found, labels=labels) != found
    assert found != "a result"


def test_a_result_prints_in_two_lines(found):
    """What was found, and where; of many segments the rest are counted. Its document prints no longer."""
    first, second = repr(found).splitlines()
    assert first == "<Segmentation: 720 frames at 30 a second, 2 motions in 4 segments by switching"
    assert second.startswith(" A 0:")
    assert len(repr(found.document()).splitlines()) == 2
    many = dataclasses.replace(found, labels=np.arange(720) // 10 % 2, confidence=np.ones(71), repeats=(), loops=())
    assert "… 64 more" in repr(many)
    assert len(repr(many)) < 250


class Tags(HTMLParser):
    """Which tags are opened, and all text."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.texts = [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)

    def handle_data(self, data):
        self.texts.append(data)


def test_a_notebook_shows_the_curve_and_the_segments(found):
    """A picture and a row for each segment; a name is text and no markup."""
    shown = Tags(found._repr_html_())
    assert shown.tags.count("svg") == 1
    assert shown.tags.count("tr") == 1 + len(found.segments)
    hostile = found.document().model_copy(
        update={"segments": tuple(one.model_copy(update={"name": "<script>"}) for one in found.segments)}
    )
    from caesura.core.plot.notebook import render_html

    assert "script" not in Tags(render_html(hostile)).tags


def test_a_notebook_shows_an_animation_as_poses(bar):
    """Six of them, as a picture that is not empty; joints without triangles are dots."""
    skeleton = open_animation(np.array(bar.animation.vertices(0, 90))[:, ::16])
    for shown in (bar.animation, skeleton):
        (encoded,) = re.findall(r"base64,([^\"]+)", shown._repr_html_())
        picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(encoded))))
        assert picture.shape == (160, 960)
        assert all((pose < 250).any() for pose in np.split(picture, 6, axis=1))
    assert repr(skeleton) == "<Animation 'vertices': 90 frames at 30 a second, 8 vertices in 0 triangles>"


def test_a_long_list_of_segments_is_cut_short_in_a_notebook(found):
    """Forty rows, then how many more there are."""
    many = dataclasses.replace(found, labels=np.arange(720) // 10 % 2, confidence=np.ones(71), repeats=(), loops=())
    shown = Tags(many._repr_html_())
    assert shown.tags.count("tr") == 41
    assert "… and 32 more segments" in shown.texts


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_a_result_is_a_data_frame(found, library):
    """A row for each segment, frame or key-frame, in the columns of the CSV."""
    installed(library)
    segments, frames, keys = (found.to_frame(rows, library) for rows in ("segments", "frames", "key_frames"))
    assert type(segments).__module__.startswith(library)
    assert [len(segments), len(frames), len(keys)] == [4, 720, len(found.key_frames)]
    assert list(segments["end"]) == found.change_points
    assert list(frames["motion"]) == found.labels.tolist()
    assert list(keys["frame"]) == found.key_frames.tolist()
    assert math.isnan(frames["energy"][0])


def test_a_table_that_there_is_not_is_named(found):
    """With what there is."""
    with pytest.raises(ParameterError, match="'segments', 'frames' or 'key_frames'"):
        found.to_frame("cuts")
    with pytest.raises(ParameterError, match="'pandas', 'polars' or 'auto'"):
        found.to_frame(library="excel")


def test_without_a_library_of_tables_or_plots_it_is_named(found, monkeypatch):
    """In a sentence that says what to install; nothing else of a result needs either."""
    monkeypatch.setattr("caesura.core.plot.data_frame.find_spec", lambda name: None)
    monkeypatch.setitem(__import__("sys").modules, "matplotlib", None)
    with pytest.raises(ImportError, match="pandas or polars, which is not installed: pip install pandas"):
        found.to_frame()
    with pytest.raises(ImportError, match="polars, which is not installed: pip install polars"):
        found.to_frame(library="polars")
    with pytest.raises(ImportError, match=r"caesura\[plot\]"):
        found.plot()


def test_a_plot_has_the_curve_the_segments_and_the_key_frames(found, monkeypatch):
    """On axes of one's own too; every motion is in the legend once."""
    monkeypatch.setenv("MPLBACKEND", "agg")
    pyplot = installed("matplotlib.pyplot")
    _, (_, mine) = pyplot.subplots(2)
    axes = found.plot(mine)
    assert axes is mine
    curve, keys = axes.lines
    assert np.array_equal(curve.get_ydata(), np.round(found.energy, 6), equal_nan=True)
    assert len(keys.get_xdata()) == len(found.key_frames)
    assert len(axes.patches) == len(found.segments)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["A", "B"]
    assert found.plot().figure is not axes.figure
    pyplot.close("all")


def test_change_points_are_those_of_other_libraries(found):
    """ruptures: every end, the last too; aeon: the cuts alone, or a label for each frame."""
    assert found.change_points == [one.end for one in found.segments]
    assert found.to_aeon() == found.change_points[:-1]
    assert found.to_aeon("sparse").tolist() == found.labels.tolist()


def test_a_document_is_a_result_again(found):
    """From JSON, of the command or of a service: equal but for energies beyond six places and sureness beyond four."""
    again = Segmentation.of(SegmentationDocument.model_validate_json(found.to_json()))
    assert again.document() == found.document()
    assert again.labels.tolist() == found.labels.tolist()
    assert np.allclose(again.energy, found.energy, atol=1e-6, equal_nan=True)
