"""One layer of a stage: opened, without what it refers to outside, and with bounded references inside.

References multiply what is in a file: twenty levels of two are a million prims. So they are counted before anything
is composed.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, UsdUtils

from caesura.core.errors import BrokenContainer, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.notices import Notices

CRATE = b"PXR-USDC"
ADVICE = "Flatten the stage to fewer prims"


def open_layer(path: str, limits: Limits, notices: Notices) -> tuple[Any, tuple[str, ...]]:
    """The layer, and the files that it is composed of and that are left out; to be called within `library_errors`."""
    with Path(path).open("rb") as file:
        kind = "usdc" if file.read(len(CRATE)) == CRATE else "usda"
    layer = Sdf.Layer.CreateAnonymous("take", Sdf.FileFormat.FindById(kind))
    if not layer.Import(path):
        raise malformed("it is not what its first bytes say")
    outside = tuple(sorted(dependency for dependency in layer.GetCompositionAssetDependencies() if dependency))
    UsdUtils.ModifyAssetPaths(layer, lambda _: "")
    _drop_clips(layer)
    PrimCount(layer, limits).check()
    if outside:
        notices.add("references-left-out", describe_outside(outside))
    return layer, outside


def describe_outside(outside: tuple[str, ...]) -> str:
    """What is said of files that a layer refers to."""
    return (
        f"The USD refers to {len(outside)} other files, such as {outside[0][-80:]!r}, which are not read. Flatten it "
        "with usdcat --flatten, and send it again."
    )


@contextmanager
def library_errors() -> Iterator[None]:
    """Say of what the library cannot read that the file is broken."""
    try:
        yield
    except Tf.ErrorException as wrong:
        raise malformed("; ".join(map(_commentary, wrong.args))) from None
    except UnicodeDecodeError:
        raise malformed("a name in it is no text") from None
    except RuntimeError as wrong:
        raise malformed(str(wrong)) from None


def _commentary(error: Any) -> str:
    """What the library says; it repeats the file, which may be no text."""
    try:
        return str(error.commentary)
    except UnicodeDecodeError:
        return "something in it is no text"


def malformed(what: str) -> BrokenContainer:
    """The refusal of a USD."""
    said = " ".join(what.split())[:200]
    return BrokenContainer("malformed-usd", f"The USD cannot be read ({said}). Export it again.")


def _drop_clips(layer: Any) -> None:
    """Take out value clips: their files may be named by a pattern, which is no asset path."""
    clipped: list[Any] = []

    def look(path: Any) -> None:
        found = layer.GetObjectAtPath(path)
        if isinstance(found, Sdf.PrimSpec) and found.HasInfo("clips"):
            clipped.append(found)

    layer.Traverse(Sdf.Path.absoluteRootPath, look)
    for prim in clipped:
        prim.ClearInfo("clips")


class PrimCount:
    """An upper bound of the prims that a layer is composed to, each as often as it is referred to."""

    def __init__(self, layer: Any, limits: Limits) -> None:
        self._layer = layer
        self._limits = limits
        self._known: dict[Any, int] = {}
        self._open: set[Any] = set()

    def check(self) -> None:
        """Raise `LimitExceeded` where they are too many."""
        try:
            count = sum(self._of(prim) for prim in self._layer.rootPrims)
        except RecursionError:
            raise LimitExceeded(
                "limit-exceeded", f"The prims of the USD are nested too deeply. {ADVICE}.", setting="CAESURA_MAX_NODES"
            ) from None
        self._limits.check("max_nodes", count, ADVICE)

    def _of(self, prim: Any) -> int:
        path = prim.path
        if path in self._known or path in self._open:
            return self._known.get(path, 0)  # what refers to itself is refused by the library
        self._open.add(path)
        parts = [
            *prim.nameChildren,
            *(variant.primSpec for sets in prim.variantSets for variant in sets.variants.values()),
        ]
        targets = [self._target(found) for found in self._references(prim)]
        count = 1 + sum(self._of(part) for part in [*parts, *targets] if part is not None)
        self._open.discard(path)
        self._known[path] = count
        self._limits.check("max_nodes", count, ADVICE)
        return count

    def _references(self, prim: Any) -> list[Any]:
        """The paths of what is composed onto a prim."""
        listed = [*prim.referenceList.GetAppliedItems(), *prim.payloadList.GetAppliedItems()]
        paths = [*prim.inheritPathList.GetAppliedItems(), *prim.specializesList.GetAppliedItems()]
        return [item.primPath or self._layer.defaultPrim for item in listed] + paths

    def _target(self, path: Any) -> Any:
        """The prim at a path; of one that is there by composition alone, the nearest one above it."""
        path = Sdf.Path(str(path))
        path = path if path.IsAbsolutePath() else Sdf.Path.absoluteRootPath.AppendPath(path)
        while path != Sdf.Path.absoluteRootPath and not path.isEmpty:
            found = self._layer.GetPrimAtPath(path)
            if found is not None:
                return found
            path = path.GetParentPath()
        return None
