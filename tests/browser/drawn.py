"""Figures whose picture is known, and the picture that the page makes of a figure."""

import io

import numpy as np
from jaxtyping import Bool, Int
from playwright.sync_api import Page, expect

from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive
from tests.animations import bar

FRAMES, RATE = 90, 30.0
PICTURE = """([width, height]) => new Promise((resolve) => {
    const field = document.getElementById('frame');
    field.dispatchEvent(new Event('change', { bubbles: true }));  // draws; pixels are there to be read in that frame
    requestAnimationFrame(() => {
        const copy = document.createElement('canvas');
        Object.assign(copy, { width, height });
        const context = copy.getContext('2d');
        context.imageSmoothingEnabled = false;
        context.drawImage(document.getElementById('figure'), 0, 0, width, height);
        resolve(Array.from(context.getImageData(0, 0, width, height).data));
    });
})"""


def ellipsoid() -> bytes:
    """An NPZ: three times as long along z as it is thick, and breathing, first slowly, then fast."""
    down, around = np.meshgrid(np.linspace(0, np.pi, 25), 2 * np.pi * np.arange(32) / 32, indexing="ij")
    ball = np.stack([np.sin(down) * np.cos(around), np.sin(down) * np.sin(around), 3 * np.cos(down)], -1)
    i = np.arange(25 * 32).reshape(25, 32)
    a, b, c, d = (part.ravel() for part in (i[:-1], np.roll(i[:-1], -1, 1), i[1:], np.roll(i[1:], -1, 1)))
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)])
    time = np.arange(FRAMES) / RATE
    swell = 0.05 * np.sin(np.where(time < 1.5, 3, 12) * time)
    vertices = ball.reshape(-1, 3) * (1 + swell[:, None, None] * np.array([1, 1, 0.2]))
    stored = io.BytesIO()
    np.savez(stored, vertices=vertices.astype(np.float32), triangles=triangles, frame_rate=RATE)
    return stored.getvalue()


def bar_that_turns() -> bytes:
    """An NPZ: a bar that bends and straightens twice, the second time turned by a right angle and some steps away."""
    places, triangles = bar()
    half = FRAMES // 2
    bend = np.sin(np.pi * np.arange(half) / half)[:, None] * np.maximum(places[:, 0] - 0.4, 0) ** 2
    once = np.stack([places + bend[frame][:, None] * np.array([0, 1, 0]) for frame in range(half)])
    again = once[..., [2, 1, 0]] * np.array([1, 1, -1]) + np.array([2, 0, 1])
    stored = io.BytesIO()
    vertices = np.concatenate([once, again]).astype(np.float32)
    np.savez(stored, vertices=vertices, triangles=triangles, frame_rate=RATE)
    return stored.getvalue()


def jointed_bar(*, mirrored: bool) -> bytes:
    """A GLB: a tube of two materials on two joints, the outer of which bends; the inner may mirror it all."""
    places, triangles = bar()
    normals = places * np.array([0, 20, 20], np.float32)
    outer = np.clip(4 * places[:, :1] - 1.5, 0, 1)
    writer = GlbWriter()
    root = writer.node("root", scale=(-1.0 if mirrored else 1.0, 1.0, 1.0))
    joint = writer.node("outer", parent=root, translation=(0.5, 0.0, 0.0))
    halves = np.array_split(triangles[np.argsort(places[triangles].mean(1)[:, 0], kind="stable")], 2)
    parts = [
        Primitive(
            positions=places,
            triangles=half,
            normals=normals,
            joints=np.tile([0, 1, 0, 0], (len(places), 1)),
            weights=np.hstack([1 - outer, outer, 0 * outer, 0 * outer]).astype(np.float32),
            material=writer.material(name, (1.0, 1.0, 1.0, 1.0)),
        )
        for name, half in zip(("inner", "outer"), halves, strict=True)
    ]
    bind = np.tile(np.eye(4), (2, 1, 1))
    bind[1, 0, 3] = -0.5
    skin = writer.skin([root, joint], bind)
    writer.node("tube", mesh=writer.mesh("tube", parts), skin=skin)
    time = np.arange(FRAMES) / RATE
    half_angle = 0.4 * np.sin(np.where(time < 1.5, 2, 9) * time)
    turns = np.stack([0 * time, 0 * time, np.sin(half_angle), np.cos(half_angle)], 1)
    writer.animation("bend", [Channel(joint, "rotation", time, turns)])
    return writer.to_bytes()


def picture(page: Page, width: int = 240, height: int = 150) -> Int[np.ndarray, "height width 4"]:
    """The 3D view of now, (height, width, 4): red, green, blue, alpha. The camera stays where it is."""
    expect(page.locator("#stage-note")).to_be_hidden()
    return np.array(page.evaluate(PICTURE, [width, height])).reshape(height, width, 4)


def body(drawn: Int[np.ndarray, "height width 4"]) -> Bool[np.ndarray, "height width"]:
    """Where the figure is: the floor is never opaque."""
    return drawn[..., 3] == 255


def extent(where: Bool[np.ndarray, "height width"]) -> tuple[int, int]:
    """How wide and how high what is marked is, in pixels."""
    across, down = np.flatnonzero(where.any(0)), np.flatnonzero(where.any(1))
    return int(across[-1] - across[0] + 1), int(down[-1] - down[0] + 1)
