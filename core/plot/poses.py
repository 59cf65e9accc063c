"""Poses of a body side by side, as PNG: what a notebook shows of an animation."""

import io

import numpy as np
from jaxtyping import Float, Int
from PIL import Image, ImageDraw

SIDE, FINER = 160, 2
"""Pixels of a pose, and how much finer it is drawn before it is made smaller: its edges are smooth."""
MOST_TRIANGLES = 12_000
"""Of more, evenly spaced ones are drawn, so that a picture takes a fraction of a second."""
LIGHT = np.array([0.35, 0.5, 0.8])
DARKEST, LIGHTEST = 70, 225


def draw_poses(
    poses: Float[np.ndarray, "poses V 3"], triangles: Int[np.ndarray, "T 3"], *, upright: int | None = None
) -> bytes:
    """Each pose from the front, from left to right and to one scale; joints are dots where there is no triangle.

    `upright` is the axis that points up; without it, the y or z along which the first pose reaches farther.
    """
    poses = poses.astype(np.float64)
    extent = np.ptp(poses[0], axis=0)
    up = (1 if extent[1] >= extent[2] else 2) if upright is None else upright
    across, depth = (0, 3 - up) if extent[0] >= 0.3 * extent[3 - up] else (3 - up, 0)
    centres = (poses.min(axis=1) + poses.max(axis=1)) / 2
    reach = float(np.ptp(poses, axis=1)[:, [across, up]].max()) or 1.0
    side = SIDE * FINER
    flat = (poses - centres[:, None]) * (0.9 * side / reach)
    picture = Image.new("L", (side * len(poses), side), 255)
    draw = ImageDraw.Draw(picture)
    for place, pose in enumerate(flat):
        points = np.stack([pose[:, across] + side * (place + 0.5), side / 2 - pose[:, up]], axis=1)
        _draw_pose(draw, points, pose[:, [across, up, depth]], triangles)
    out = io.BytesIO()
    picture.resize((SIDE * len(poses), SIDE), Image.Resampling.LANCZOS).save(out, "PNG")
    return out.getvalue()


def _draw_pose(
    draw: ImageDraw.ImageDraw,
    points: Float[np.ndarray, "V 2"],
    pose: Float[np.ndarray, "V 3"],
    triangles: Int[np.ndarray, "T 3"],
) -> None:
    """Triangles from the farthest to the nearest, each as bright as it faces the light."""
    if not len(triangles):
        for x, y in points.tolist():
            draw.ellipse((x - 3, y - 3, x + 3, y + 3), fill=DARKEST)
        return
    shown = triangles[:: -(-len(triangles) // MOST_TRIANGLES)]
    corners = pose[shown]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    facing = np.abs(np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0) @ LIGHT)
    shades = (DARKEST + (LIGHTEST - DARKEST) * facing).astype(int)
    for triangle in np.argsort(corners[:, :, 2].mean(axis=1), kind="stable").tolist():
        draw.polygon([tuple(point) for point in points[shown[triangle]].tolist()], fill=int(shades[triangle]))
