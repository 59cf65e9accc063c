"""The vertices of a mesh in every frame, and its triangles, as the NPZ that the service reads."""

import zipfile
from pathlib import Path
from typing import Any

import numpy as np

BLOCK_BYTES = 2**22


class VertexFile:
    """An NPZ in the making: frames are written as they come, so that no take is in memory."""

    def __init__(self, path: Path, frames: int, vertices: int, triangles: Any, rate: float) -> None:
        self._zip = zipfile.ZipFile(path, "w", zipfile.ZIP_STORED)
        self._array("triangles", np.ascontiguousarray(triangles, np.int32).reshape(-1, 3))
        self._array("frame_rate", np.float64(rate))
        self._member = self._zip.open("vertices.npy", "w", force_zip64=True)
        header = {"descr": "<f4", "fortran_order": False, "shape": (frames, vertices, 3)}
        np.lib.format.write_array_header_1_0(self._member, header)

    def write(self, points: Any, worlds: Any) -> None:
        """Add frames: points (n, V, 3) in the object's space, and what takes columns of it to the world (n, 4, 4)."""
        placed = np.einsum("nij,nvj->nvi", worlds[:, :3, :3], points) + worlds[:, None, :3, 3]
        self._member.write(np.ascontiguousarray(y_up(placed), "<f4").data)

    def close(self) -> None:
        """Finish the file."""
        self._member.close()
        self._zip.close()

    def _array(self, name: str, array: Any) -> None:
        with self._zip.open(f"{name}.npy", "w") as member:
            np.lib.format.write_array(member, np.asarray(array), allow_pickle=False)


def y_up(points: Any) -> Any:
    """Blender's z up as y up."""
    return np.stack([points[..., 0], points[..., 2], -points[..., 1]], axis=-1)
