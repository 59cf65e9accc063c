"""Writes point caches and their meshes: the twins of what reads them."""

import struct

import numpy as np


def pc2(places: np.ndarray, *, step: float = 1.0, version: int = 1) -> bytes:
    """Places (samples, points, 3) as a PC2."""
    samples, points, _ = places.shape
    head = struct.pack("<12siiffi", b"POINTCACHE2\0", version, points, 0.0, step, samples)
    return head + places.astype("<f4").tobytes()


def mdd(places: np.ndarray, seconds: np.ndarray) -> bytes:
    """The same as an MDD with the seconds of the samples."""
    samples, points, _ = places.shape
    return struct.pack(">ii", samples, points) + seconds.astype(">f4").tobytes() + places.astype(">f4").tobytes()


def obj(vertices: np.ndarray, faces: list[list[int]]) -> bytes:
    """Vertices and faces, which count from 0 here and from 1 there."""
    lines = ["# made by hand", "o body"]
    lines += ["v " + " ".join(f"{x:.6f}" for x in vertex) for vertex in vertices]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    return "\n".join(lines).encode() + b"\n"


def folding_sheet(frames: int = 40) -> np.ndarray:
    """Six points of two squares, of which one folds up and down about their common edge."""
    angle = np.abs(np.sin(np.arange(frames) / 7))
    places = np.zeros((frames, 6, 3))
    places[:, :, 0] = [-1, -1, 0, 0, 1, 1]
    places[:, :, 1] = [0, 1, 1, 0, 0, 1]
    places[:, 4:, 0], places[:, 4:, 2] = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return places


FACES = [[0, 3, 2, 1], [3, 4, 5, 2]]
MESH = obj(folding_sheet(1)[0], FACES)
