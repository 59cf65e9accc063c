"""C3D: markers in the numbers of three processors, their gaps, their units and their axes."""

import io
from collections.abc import Callable

import numpy as np
import pytest

from caesura.core.errors import CaesuraError, InvalidModel
from caesura.core.limits import Limits
from caesura.formats.upload_summary import HeaderTake, read_header
from tests.formats.c3d_files import DEC, INTEL, SGI, c3d, real
from tests.formats.clips.making import chunks_of
from tests.formats.opening import codes, opened

FRAMES = 250
WALK = 1000 * np.random.default_rng(2).normal(size=(1, 5, 3)) + 300 * np.sin(
    np.arange(FRAMES)[:, None, None] / 20 + np.arange(5)[:, None]
)
"""Five markers in millimetres, z up; at 100 a second, two and a half seconds."""

READ = {"skeleton-only"}
"""What is said of every file of markers."""


def places_of(data: bytes) -> np.ndarray:
    """Frames of the markers in their order, in millimetres, z up, as they were written."""
    take = opened(data)
    names = [node["name"] for node in nodes_of(data)]
    order = np.argsort([int(name[1:]) for name in names if name.startswith("m")])
    x, y, z = np.moveaxis(take.vertices(0, take.frames)[:, order] * 1000, 2, 0)
    return np.stack([x, -z, y], axis=2)


def nodes_of(data: bytes) -> list[dict]:
    """The nodes of the glTF that a file becomes, in the order of the figure's vertices."""
    root, _ = chunks_of(bytes(opened(data).gltf[""]))
    order, found = [*root["scenes"][0]["nodes"]], []
    while order:
        node = root["nodes"][order.pop(0)]
        found.append(node)
        order = [*node.get("children", []), *order]
    return found


@pytest.mark.parametrize("processor", [INTEL, DEC, SGI], ids=["Intel", "DEC", "SGI"])
@pytest.mark.parametrize("scale", [-1.0, 0.1], ids=["reals", "integers"])
def test_markers_are_where_each_processor_wrote_them(processor: int, scale: float) -> None:
    """In metres and with y up; integers are off by half of their scale at most."""
    data = c3d(WALK, processor=processor, scale=scale)
    np.testing.assert_allclose(places_of(data), WALK, atol=0.051 if scale > 0 else 1e-3)
    take = opened(data)
    assert (take.frames, take.frame_rate, take.vertex_count, len(take.triangles)) == (FRAMES, 100.0, 5, 0)
    assert codes(take) == READ


def test_analog_numbers_are_passed_over_and_frames_count_from_0() -> None:
    """A take that begins at frame 49 begins at 0 here; what force plates measured is said to be left out."""
    for scale in (-1.0, 0.1):
        data = c3d(WALK, first=49, analog=6, scale=scale)
        np.testing.assert_allclose(places_of(data), WALK, atol=0.051)
        assert codes(opened(data)) == READ | {"analog-ignored"}


def test_short_gaps_are_filled_and_said() -> None:
    """By a straight line between what was seen before and after; at the ends a marker stands still."""
    hidden = np.zeros((FRAMES, 5), bool)
    hidden[100:130, 2] = hidden[:7, 3] = hidden[-9:, 3] = True
    wild = np.where(hidden[:, :, None], 9e9, WALK)
    found = places_of(c3d(wild, hidden=hidden))
    share = ((np.arange(100, 130) - 99) / 31)[:, None]
    np.testing.assert_allclose(found[100:130, 2], WALK[99, 2] * (1 - share) + WALK[130, 2] * share, atol=1e-3)
    np.testing.assert_allclose(found[:7, 3], np.tile(WALK[7, 3], (7, 1)), atol=1e-3)
    np.testing.assert_allclose(found[-9:, 3], np.tile(WALK[-10, 3], (9, 1)), atol=1e-3)
    np.testing.assert_allclose(found[~hidden], WALK[~hidden], atol=1e-3)
    (said,) = (n.detail for n in opened(c3d(wild, hidden=hidden)).notices if n.code == "gaps-filled")
    assert said == "3 gaps of markers, the longest of 0.30 s, were filled by straight lines."


def test_a_marker_that_is_hidden_for_long_is_left_out() -> None:
    """For 101 frames of a hundred a second; with none left, there is nothing to segment."""
    hidden = np.zeros((FRAMES, 5), bool)
    hidden[10:110, 0] = hidden[10:111, 1] = True
    take = opened(c3d(WALK, hidden=hidden))
    assert take.vertex_count == 4
    (said,) = (n.detail for n in take.notices if n.code == "markers-left-out")
    assert said == "Hidden for more than 1 s and left out: m1."
    for scale in (-1.0, 0.1):
        with pytest.raises(InvalidModel, match="Fill the gaps") as refused:
            opened(c3d(WALK, hidden=np.ones((FRAMES, 5), bool), scale=scale))
        assert refused.value.code == "hidden-markers"


def test_places_that_are_no_numbers_are_gaps() -> None:
    """As some programs write them, with a residual of 0."""
    gone = WALK.copy()
    gone[50:60, 4] = np.nan
    assert codes(opened(c3d(gone))) == READ | {"gaps-filled"}


@pytest.mark.parametrize(
    ("screen", "expected"),
    [(("+X", "+Z"), [1, 3, -2]), (("+X", "+Y"), [1, 2, 3]), (("-Y", "+Z"), [-2, 3, -1]), (("+X", "-X"), [1, 3, -2])],
)
def test_what_is_up_on_the_screen_is_up(screen: tuple[str, str], expected: list[int]) -> None:
    """The file's own words; z where they contradict each other."""
    more = {("POINT", "X_SCREEN"): screen[0], ("POINT", "Y_SCREEN"): screen[1], ("POINT", "UNITS"): "m"}
    found = opened(c3d(np.tile([[[1.0, 2, 3]]], (3, 1, 1)), more=more)).vertices(0, 1)[0, 0]
    assert found.tolist() == expected


def test_points_that_are_no_places_are_left_out() -> None:
    """Angles and forces are points too, by the format; the parameters list them."""
    take = opened(c3d(WALK, more={("POINT", "ANGLES"): ["m1", "m3"]}))
    assert (take.vertex_count, codes(take)) == (3, READ | {"points-ignored"})


def test_more_names_than_a_parameter_holds_go_on_in_the_next() -> None:
    """Three hundred markers: `LABELS` and `LABELS2`; those without a name are called by their number."""
    many = np.random.default_rng(3).normal(size=(3, 300, 3))
    data = c3d(many, more={("POINT", "LABELS2"): [f"m{i}" for i in range(255, 299)]})
    names = {node["name"] for node in nodes_of(data)}
    assert names == {f"m{i}" for i in range(299)} | {"marker 299"}


@pytest.mark.parametrize(
    "more",
    [
        {("TRIAL", "ACTUAL_START_FIELD"): [1, 0], ("TRIAL", "ACTUAL_END_FIELD"): [70_000 - 65_536, 1]},
        {("POINT", "LONG_FRAMES"): 70_000.0},
    ],
)
def test_a_take_beyond_sixteen_bits_is_read_to_its_end(more: dict) -> None:
    """By either of the parameters that count more frames than the head can."""
    ramp = np.arange(70_000.0)[:, None, None] * np.ones((1, 2, 3)) / 10
    take = opened(c3d(ramp, scale=1.0, more=more))
    assert take.frames == 70_000
    assert take.vertices(69_999, 70_000)[0, 0, 0] == 7.0


def test_a_parameter_that_counts_frames_that_are_gone_is_not_believed() -> None:
    """Programs that cut a take change its head alone."""
    more = {("TRIAL", "ACTUAL_START_FIELD"): [1, 0], ("TRIAL", "ACTUAL_END_FIELD"): [900, 0]}
    assert opened(c3d(WALK, more=more)).frames == FRAMES


def test_near_markers_are_linked() -> None:
    """A chain along each of two bars that move apart, and one link between them; all below one node."""
    bars = np.zeros((50, 6, 3))
    bars[:, :, 0] = [0, 1, 2, 0, 1, 2]
    bars[:, 3:, 1] = 5 + np.arange(50)[:, None]
    nodes = {node["name"]: node for node in nodes_of(c3d(bars))}
    children = {name: len(node.get("children", [])) for name, node in nodes.items()}
    assert sum(children.values()) == 5
    assert max(children.values()) <= 2


def test_the_header_tells_markers_and_frames() -> None:
    """Without reading one of their places."""
    header = read_header(io.BytesIO(c3d(WALK, processor=SGI)), "walk.c3d", Limits())
    assert (header.format, header.vertices, header.triangles) == ("c3d", 5, 0)
    assert header.takes == (HeaderTake(0, "motion", pytest.approx(2.49), FRAMES, 100.0),)


def _put(place: int, data: bytes) -> Callable[[bytes], bytes]:
    return lambda whole: whole[:place] + data + whole[place + len(data) :]


BROKEN = {
    "cut off": (lambda data: data[:-1], "malformed-c3d"),
    "of a head": (lambda data: data[:300], "malformed-c3d"),
    "of no processor": (_put(515, b"\x57"), "malformed-c3d"),
    "of parameters behind the end": (_put(0, b"\x1f"), "malformed-c3d"),
    "of many points": (_put(2, b"\xff\xff"), "limit-exceeded"),
    "of many analog numbers": (_put(4, b"\xff\xff"), "malformed-c3d"),
    "that ends before it begins": (_put(6, b"\xff\xff"), "malformed-c3d"),
    "of a scale of nothing": (_put(12, bytes(4)), "malformed-c3d"),
    "of a scale that is no number": (_put(12, real(float("nan"), INTEL)), "malformed-c3d"),
    "without a place for its data": (_put(16, b"\0\0"), "malformed-c3d"),
    "of no rate": (_put(20, real(0.0, INTEL)), "malformed-c3d"),
    "of a rate below none": (_put(20, real(-30.0, INTEL)), "malformed-c3d"),
    "of a rate without end": (_put(20, real(float("inf"), INTEL)), "malformed-c3d"),
    "without markers": (_put(2, b"\0\0"), "malformed-c3d"),
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_broken_file_is_refused(fault: str) -> None:
    """With a sentence, before anything is read."""
    change, code = BROKEN[fault]
    with pytest.raises(CaesuraError) as refused:
        opened(change(c3d(WALK)))
    assert refused.value.code == code


def test_parameters_that_lead_nowhere_are_read_as_far_as_they_go() -> None:
    """Names that run past the end, or an entry that is its own successor: the head alone is enough."""
    for broken in (_put(516, b"\x7f\x7f" + b"\xff" * 100), _put(523, b"\0\0"), _put(516, b"\0")):
        take = opened(broken(c3d(WALK)))
        assert (take.frames, take.vertex_count) == (FRAMES, 5)
