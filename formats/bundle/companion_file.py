"""The file that must lie beside another, such as the OBJ of a point cache. Light: no NumPy."""

from collections.abc import Iterable

from caesura.core.errors import InvalidModel
from caesura.formats.input_formats import InputFormat


def find_companion(known: InputFormat, model: str, names: Iterable[str]) -> str:
    """Of `names`, the one that `model` needs: the one called like it, else the only one of its kind.

    Raises `missing-companion`, or `ambiguous-upload` where there are several and none is called like the model.
    """
    companion = known.companion
    if companion is None:
        raise ValueError(f"{known.name} needs no file beside it")
    found = [name for name in names if name.lower().endswith(companion.suffix)]
    alike = [name for name in found if _stem(name) == _stem(model)]
    chosen = alike if len(alike) == 1 else found
    if not chosen:
        raise InvalidModel(
            "missing-companion",
            f"The {known.title} came alone. Send it with the {companion.suffix} that holds {companion.holds}: both in "
            "one upload, one zip or one command.",
        )
    if len(chosen) > 1:
        raise InvalidModel(
            "ambiguous-upload",
            f"{len(chosen)} files end in {companion.suffix}, and none is called like the {known.title}. Send one, or "
            "give both the same name.",
        )
    return chosen[0]


def _stem(name: str) -> str:
    return name.rpartition("/")[2].rpartition(".")[0].lower()
