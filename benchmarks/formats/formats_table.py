"""One take in every format: whether it is cut the same, and how far its vertices are from those of the GLB.

`python -m benchmarks.formats.formats_table ../shared/data/formats` also reads every file of `real` and of `ufbx`, and
says what it is read as, or the sentence that refuses it. An FBX beside the same GLB in time: `python -m
benchmarks.formats.fbx`.
"""

import argparse
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from caesura import open_animation, segment
from caesura.core.animation import Animation
from caesura.core.errors import CaesuraError
from caesura.formats.input_formats import MODEL_SUFFIXES
from tests.formats.test_shared_formats import without_meshes

TAKES = ("fox_hard_0", "godotman_hard_0")
SHOWN_FRAMES = 7
SIMPLIFIED = ("_simplified", "_zup_units")
"""Files whose keys Blender has thinned out: they do not hold the same frames."""

Upload = bytes | Mapping[str, bytes]


def main() -> None:
    """Print both tables."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("folder", type=Path)
    folder = arguments.parse_args().folder
    print("| file | frames | segments | largest shift of a cut, frames | labels | vertices, of the diagonal |")
    print("|---|--:|--:|--:|---|--:|")
    for take in TAKES:
        glb = (folder.parent / "takes" / f"{take}.glb").read_bytes()
        for path in sorted((folder / "made").glob(f"{take}*")):
            if path.suffix in MODEL_SUFFIXES:
                print(_row(path, glb), flush=True)
    print("\n| file | read as |\n|---|---|")
    read: Counter[str] = Counter()
    for path in sorted([*(folder / "real").rglob("*"), *(folder / "ufbx").glob("*.fbx")]):
        if path.suffix in MODEL_SUFFIXES:
            said = _reading(path)
            read["refused" if said.startswith("refused") else "read"] += 1
            print(f"| {path.relative_to(folder)} | {said} |", flush=True)
    print(f"\n{read['read']} read, {read['refused']} refused in a sentence")


def _row(path: Path, glb: bytes) -> str:
    upload = _upload(path)
    take = open_animation(upload)
    seconds = (take.frames - 1) / take.frame_rate
    reference = without_meshes(glb) if path.suffix == ".bvh" else glb
    starts, names = _cuts(upload)
    expected_starts, expected_names = _cuts(reference, end=seconds)
    shift = max(abs(a - b) for a, b in zip(starts, expected_starts, strict=False))
    shift_text = str(shift) if len(starts) == len(expected_starts) else f"{len(expected_starts)} segments in the GLB"
    same = "same" if names == expected_names else "other"
    away = _distance(path, take, open_animation(reference))
    return f"| {path.name} | {take.frames} | {len(starts)} | {shift_text} | {same} | {away} |"


def _upload(path: Path) -> Upload:
    mesh = path.with_name(f"{path.stem}_base.obj")
    if path.suffix in {".pc2", ".mdd"} and mesh.exists():
        return {path.name: path.read_bytes(), mesh.name: mesh.read_bytes()}
    return path.read_bytes()


def _cuts(upload: Upload, end: float | None = None) -> tuple[list[int], list[str]]:
    result = segment(upload) if end is None else segment(upload, end=end)
    found = result.document().segments
    return [one.start for one in found], [one.name for one in found]


def _distance(path: Path, take: Animation, glb: Animation) -> str:
    """The largest distance between nearest vertices, both ways; of a lighter mesh, from its point cache."""
    if path.suffix == ".bvh":
        return "joints, in axes of their own"
    if any(word in path.stem for word in SIMPLIFIED):
        return "keys thinned out"
    reference = glb
    if path.suffix in {".abc", ".pc2", ".mdd"} or "_points" in path.stem:
        stem = path.stem.removesuffix("_points")
        cache = next(
            path.with_name(f"{stem}{suffix}")
            for suffix in (".pc2", ".mdd")
            if path.with_name(f"{stem}{suffix}").exists()
        )
        if path == cache:
            return "its own numbers"
        reference = open_animation(_upload(cache))
        turned = cache.suffix == ".pc2"  # Z up
    else:
        turned = False
    frames = np.linspace(0, min(take.frames, reference.frames) - 1, SHOWN_FRAMES).astype(int)
    away = []
    for frame in frames:
        found, expected = (np.array(one.vertices(frame, frame + 1)[0], float) for one in (take, reference))
        if turned:
            expected = expected[:, [0, 2, 1]] * [1, 1, -1]
        away.append(_farthest(found, expected))
    return f"{max(away):.0e}"


def _farthest(found: Float[np.ndarray, "V 3"], expected: Float[np.ndarray, "W 3"]) -> float:
    away = max(cKDTree(found).query(expected)[0].max(), cKDTree(expected).query(found)[0].max())
    return float(away / np.linalg.norm(np.ptp(expected, axis=0)))


def _reading(path: Path) -> str:
    try:
        take = open_animation(_upload(path))
    except CaesuraError as refused:
        return f"refused, {refused.code}: {refused.detail}"
    kind = f"{take.vertex_count} vertices, {len(take.triangles)} triangles"
    return f"{take.frames} frames at {take.frame_rate:g} a second, {kind}"


if __name__ == "__main__":
    main()
