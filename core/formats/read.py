"""The one door for files: whatever is read becomes an Animation here."""

from collections.abc import Callable, Mapping
from mmap import mmap

from core.animation import Animation
from core.errors import InvalidModel, UnsupportedMedia
from core.formats.gltf.read import read_gltf
from core.formats.npz import read_npz
from core.formats.sniffing import SNIFFED, sniff
from core.limits import Limits
from core.parameters import Parameters

Scratch = Callable[[int], memoryview]
"""Gives a writable buffer of so many bytes, for what must be inflated; the caller decides where it lies."""

Part = bytes | memoryview | mmap


def read_animation(parts: Mapping[str, Part], parameters: Parameters, limits: Limits, scratch: Scratch) -> Animation:
    """The animation in an upload of one or several files, by name. The buffers must outlive it.

    Raises `CaesuraError`: `UnsupportedMedia`, `BrokenContainer`, `InvalidModel`, `LimitExceeded` or, for a take
    that is not there, `ParameterError`.
    """
    views = {name: memoryview(part).toreadonly() for name, part in parts.items()}
    model = main_part(views)
    data = views.pop(model)
    if sniff(bytes(data[:SNIFFED])) == "npz":
        return read_npz(data, parameters, limits, scratch)
    return read_gltf(data, views, parameters, limits)


def main_part(parts: Mapping[str, memoryview]) -> str:
    """The name of the part that is the model: the only one, or the only one that is a glTF."""
    if len(parts) == 1:
        return next(iter(parts))
    models = [name for name, data in parts.items() if _is_model(data)]
    if len(models) == 1:
        return models[0]
    raise InvalidModel(
        "ambiguous-upload",
        f"{len(models)} of the {len(parts)} files sent are models. Send one .gltf or .glb with the files it names.",
    )


def _is_model(data: memoryview) -> bool:
    try:
        return sniff(bytes(data[:SNIFFED])) in {"glb", "gltf"}
    except UnsupportedMedia:
        return False
