"""Materials: the name and the colour of what a mesh is bound to, or the colour that it has itself."""

from typing import Any

import numpy as np
from pxr import UsdGeom, UsdShade

from caesura.formats.gltf.writer import GlbWriter


class Materials:
    """Materials of a GLB, each written once."""

    def __init__(self, writer: GlbWriter) -> None:
        self._writer = writer
        self._written: dict[tuple[str, tuple[float, ...]], int] = {}

    def of(self, prim: Any) -> int | None:
        """The place of a prim's material; None where it has neither that nor a colour."""
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        colour = _colour_of_surface(material) if material else None
        if colour is None:
            shown = UsdGeom.Gprim(prim).GetDisplayColorAttr().Get()
            colour = tuple(shown[0]) if shown else None
        if colour is None and not material:
            return None
        name = str(material.GetPrim().GetName()) if material else "colour"
        usable = np.clip(np.nan_to_num(np.array(colour or (1, 1, 1), float)), 0, 1).tolist()
        key = (name, tuple(usable))
        if key not in self._written:
            self._written[key] = self._writer.material(name, (*usable, 1.0))
        return self._written[key]


def _colour_of_surface(material: Any) -> tuple[float, ...] | None:
    """The diffuse colour of a preview surface, where it is one for all of the mesh."""
    source = material.ComputeSurfaceSource()[0]
    diffuse = source.GetInput("diffuseColor") if source else None
    value = diffuse.Get() if diffuse and not diffuse.HasConnectedSource() else None
    return tuple(value) if value is not None and len(value) == 3 else None
