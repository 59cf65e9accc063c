"""Every line of a table names what is there: a place that is wrong would be found by a user's file only."""

import pytest

from caesura.core.registry.descriptors import DESCRIPTORS
from caesura.core.registry.methods import METHODS
from caesura.formats.input_formats import INPUT_FORMATS


@pytest.mark.parametrize("known", INPUT_FORMATS.values(), ids=lambda known: known.name)
def test_the_functions_of_every_input_format_are_found(known):
    """Its header, and what reads it or turns it into glTF."""
    assert all(callable(known.load(place)) for place in (known.header, known.to_gltf, known.reader) if place)


@pytest.mark.parametrize("known", [*METHODS.values(), *DESCRIPTORS.values()], ids=lambda known: known.name)
def test_every_method_and_descriptor_is_found(known):
    """By the name of its module and of what is in it."""
    assert callable(known.load())
