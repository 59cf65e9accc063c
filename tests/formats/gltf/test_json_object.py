"""Names and numbers of any length, in the JSON of a stranger: a refusal that can be told, and nothing else."""

import json

import pytest

from caesura.core.errors import CaesuraError
from caesura.core.limits import Limits
from tests.formats.opening import opened
from tests.glb import moving_square

LONGEST_INTEGER = int("9" * 4300)
"""The longest that Python's JSON reader takes; its product with anything cannot be printed any more."""


@pytest.mark.parametrize("count", [10**400, LONGEST_INTEGER], ids=["400 digits", "4300 digits"])
@pytest.mark.parametrize(
    ("owner", "place", "name", "code"),
    [
        ("accessors", 1, "count", "out-of-bounds"),
        ("accessors", 1, "byteOffset", "out-of-bounds"),
        ("bufferViews", 1, "byteLength", "out-of-bounds"),
        ("bufferViews", 1, "byteOffset", "out-of-bounds"),
        ("bufferViews", 0, "byteStride", "invalid-stride"),
        ("accessors", 0, "componentType", "invalid-gltf"),
    ],
)
def test_an_endless_integer_is_refused_like_any_other(owner, place, name, code, count):
    """Sums of it are compared, and told, without an error of Python's own."""
    model = moving_square()
    model.json[owner][place][name] = count
    with pytest.raises(CaesuraError) as refused:
        opened(model.glb())
    assert refused.value.code == code
    assert len(json.dumps(refused.value.problem())) < 1000


@pytest.mark.parametrize("count", [10**400, LONGEST_INTEGER], ids=["400 digits", "4300 digits"])
def test_endless_zeros_are_refused_by_their_limit(count):
    """An accessor without data, of more elements than a float can count."""
    model = moving_square()
    model.json["accessors"][0].pop("bufferView")
    model.json["accessors"][0]["count"] = count
    with pytest.raises(CaesuraError, match="CAESURA_MAX_DECODED_BYTES"):
        opened(model.glb(), Limits())


@pytest.mark.parametrize("name", ["\ud800", "N" * 10**6], ids=["half a surrogate pair", "a million letters"])
def test_a_name_that_cannot_be_told_whole_is_told_in_part(name):
    """The pointer of a refusal holds names of the file: it stays text, and short."""
    model = moving_square()
    model.json["meshes"][0]["primitives"][0]["attributes"][name] = -1
    with pytest.raises(CaesuraError) as refused:
        opened(model.glb())
    assert refused.value.code == "invalid-gltf"
    assert refused.value.where["pointer"].startswith("/meshes/0/primitives/0/attributes/")
    assert len(json.dumps(refused.value.problem(), ensure_ascii=False).encode()) < 2000
