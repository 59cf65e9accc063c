"""Takes that meshoptimizer compressed: streams stay where keys do, and what is new is plain."""

import numpy as np
import pytest

from tests.formats.clips.compressing import bytes_of, compressed, streams_of
from tests.formats.clips.making import chunks_of, clips_of, cut_at, worst_miss
from tests.formats.clips.test_clip_sizes import CLOSE, CUTS, swaying
from tests.formats.opening import opened
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


@pytest.mark.parametrize("required", [True, False])
def test_cut_between_keys_new_keys_are_plain(required):
    """Readers that know the codec read plain numbers too; the streams of other takes are the same bit by bit."""
    data = compressed(with_another_take(), required=required).glb()
    document = cut_at(opened(data, take="take", fps=29), LATER)
    glb = clips_of(data, document)
    root, _ = chunks_of(glb)
    for animation in root["animations"][:-1]:
        for sampler in animation["samplers"]:
            views = [root["bufferViews"][root["accessors"][number]["bufferView"]] for number in sampler.values()]
            assert all(view["buffer"] == 0 and "extensions" not in view for view in views)
    assert worst_miss(opened(data, take="take", fps=29), glb, document) <= CLOSE
    before, after = (opened(file, take="other").vertices(0, LONG) for file in (data, glb))
    np.testing.assert_array_equal(before, after)


def test_a_stream_that_nothing_names_is_gone():
    """All its keys are written anew."""
    data = compressed(swaying(LONG)).glb()
    glb = clips_of(data, cut_at(opened(data, fps=29), LATER))
    assert streams_of(data)
    assert not streams_of(glb)
