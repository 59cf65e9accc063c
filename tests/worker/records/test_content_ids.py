"""Ids are made of content and a secret."""

from caesura.core.parameters import ALGORITHM, Parameters
from caesura.worker.records import content_ids
from caesura.worker.records.connection import connect

SECRET = b"s" * 32
PARTS = [("a.gltf", 10, "00ff"), ("a.bin", 20, "ff00")]


def test_the_order_of_parts_does_not_count():
    """A form may send its files in any order."""
    assert content_ids.animation_id(SECRET, "", PARTS) == content_ids.animation_id(SECRET, "", PARTS[::-1])


def test_a_lone_part_has_no_name():
    """A raw body and a form of one file with the same bytes are the same animation."""
    assert content_ids.animation_id(SECRET, "", [("", 10, "00ff")]) == content_ids.animation_id(
        SECRET, "", [("fox.glb", 10, "00ff")]
    )


def test_owner_content_and_secret_count():
    """Another owner, other bytes or another installation is another id, of 26 characters."""
    same = content_ids.animation_id(SECRET, "", PARTS)
    others = [
        content_ids.animation_id(SECRET, "someone", PARTS),
        content_ids.animation_id(SECRET, "", [*PARTS[:1], ("a.bin", 20, "ff01")]),
        content_ids.animation_id(b"t" * 32, "", PARTS),
    ]
    assert len({same, *others}) == 4
    assert {len(identifier) for identifier in (same, *others)} == {26}


def test_every_choice_counts():
    """Another parameter, or another version of the method, is another segmentation."""
    chosen = [Parameters(), Parameters(motions=2), Parameters(take=1)]
    found = {content_ids.segmentation_id(SECRET, "a", parameters.canonical(), ALGORITHM) for parameters in chosen}
    found.add(content_ids.segmentation_id(SECRET, "a", Parameters().canonical(), ALGORITHM + "x"))
    assert len(found) == 4


def test_the_secret_is_made_once(redis_url):
    """Every process of an installation has the same; where one is configured, that counts."""
    with connect(redis_url) as client:
        made = content_ids.installation_secret(client)
        assert content_ids.installation_secret(client) == made
        assert content_ids.installation_secret(client, "chosen") != made
