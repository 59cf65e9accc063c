"""Takes that meshoptimizer compressed: streams stay where keys do, and what is new is compressed as they are."""

import numpy as np
import pytest

from core.formats.clips.free_space import free_ranges
from core.formats.clips.placement import UNUSED, NewAccessor, placed
from core.formats.clips.self_contained import SelfContained
from core.formats.gltf.accessors import Accessors
from core.formats.gltf.document import Document
from core.limits import Limits
from tests.core.formats.clips.compressing import EXTENSION, bytes_of, compressed, streams_of
from tests.core.formats.clips.making import chunks_of, clips_of, cut_at, worst_miss
from tests.core.formats.clips.test_clip_sizes import CLOSE, CUTS, swaying
from tests.core.formats.opening import opened
from tests.glb import Glb

LONG = 601
LATER = [111, 240, 391]


def with_another_take(keys: int = LONG) -> Glb:
    """The swaying strip and a second take, the same backwards, in the same views once they are compressed."""
    model = swaying(keys)
    other = {"name": "other", "samplers": [], "channels": model.json["animations"][0]["channels"]}
    for sampler in model.json["animations"][0]["samplers"]:
        values = np.frombuffer(bytes_of(model, sampler["output"]), "<f4").reshape(keys, -1)
        output = model.accessor(values[::-1])
        other["samplers"].append({"input": model.accessor(np.arange(keys) / 30), "output": output})
    model.json["animations"].append(other)
    return model


def test_cut_on_keys_streams_stay_as_they_are():
    """Values are windows of the views that were there, which are decoded from the same bytes."""
    data = compressed(swaying()).glb()
    document = cut_at(opened(data), CUTS)
    glb = clips_of(data, document)
    before, after = streams_of(data), streams_of(glb)
    assert {12, 16} <= after.keys()
    for stride in (12, 16):
        assert after[stride] == before[stride]
    assert worst_miss(opened(data), glb, document) <= CLOSE
    assert len(chunks_of(glb)[1]) <= len(chunks_of(data)[1]) + 4 * (61 + len(CUTS))


@pytest.mark.parametrize("make", [swaying, with_another_take])
def test_cut_between_keys_what_is_new_is_compressed(make):
    """It takes the place of what it was made of, be that all of a view or a part, and moves as it did."""
    data = compressed(make(keys=LONG)).glb()
    document = cut_at(opened(data, take="take", fps=29), LATER)
    glb = clips_of(data, document)
    assert len(chunks_of(glb)[1]) <= 1.1 * len(chunks_of(data)[1])
    assert worst_miss(opened(data, take="take", fps=29), glb, document) <= CLOSE


def test_another_take_of_a_view_keeps_its_numbers():
    """Its stream is told again without the take that is gone: shorter, and what stays is the same bit by bit."""
    data = compressed(with_another_take()).glb()
    glb = clips_of(data, cut_at(opened(data, take="take", fps=29), LATER))
    assert len(streams_of(glb)[16]) < 0.7 * len(streams_of(data)[16])
    before, after = (opened(file, take="other").vertices(0, LONG) for file in (data, glb))
    np.testing.assert_array_equal(before, after)


def test_a_stream_that_two_views_share_stays():
    """Nobody knows here what the other one is for."""
    model = compressed(with_another_take())
    views = [view for view in model.json["bufferViews"] if EXTENSION in view.get("extensions", {})]
    model.json["bufferViews"] += views
    data = model.glb()
    glb = clips_of(data, cut_at(opened(data, take="take", fps=29), LATER))
    for stride, stream in streams_of(data).items():
        assert streams_of(glb)[stride] == stream


def test_a_file_that_can_be_read_without_the_codec_still_can():
    """Where plain bytes lie beside the streams, new ones are plain too."""
    data = compressed(swaying(LONG), required=False).glb()
    document = cut_at(opened(data, fps=29), LATER)
    glb = clips_of(data, document)
    root, _ = chunks_of(glb)
    for animation in root["animations"]:
        for sampler in animation["samplers"]:
            views = [root["bufferViews"][root["accessors"][number]["bufferView"]] for number in sampler.values()]
            assert all(view["buffer"] == 0 and "extensions" not in view for view in views)
    assert worst_miss(opened(data, fps=29), glb, document) <= CLOSE


def test_room_for_so_few_that_they_are_not_worth_it_is_left():
    """Of thousands of short, noisy arrays a few go into the room that is left only where that saves something."""
    model = compressed(swaying(LONG))
    freed = model.accessor(np.zeros(300))
    model.accessor(np.zeros(300))
    model.json["buffers"][0]["byteLength"] = len(model.binary)
    view = model.json["bufferViews"][model.json["accessors"][freed]["bufferView"]]
    room = view["byteOffset"], view["byteOffset"] + view["byteLength"]
    assert free_ranges(model.json, [freed], []) == [room]  # though in the stand-in others lie there
    document = Document(memoryview(model.glb()), {}, Limits.none())
    noise = np.random.default_rng(0).integers(0, 256, (2000, 30, 16), np.uint8)
    noise[:, :, ::8] = 0
    first = len(model.json["accessors"])
    about = {"componentType": 5126, "count": 30, "type": "VEC4"}
    new = [NewAccessor(first + n, dict(about), keys.tobytes(), 16) for n, keys in enumerate(noise)]
    file = SelfContained(document)
    file.json["accessors"] += [UNUSED] * len(new)
    chunk = placed(file, Accessors(document), [freed], new)
    assert len({accessor.json["bufferView"] for accessor in new}) == 1
    assert chunk.length < len(model.binary) + 0.95 * noise.size
