"""A figure as fine as those of games: some 34,000 vertices on 21 joints, 1,047 frames."""

from dataclasses import replace

import numpy as np
from jaxtyping import Int

from caesura.samples.figure_glb import smooth_glb
from caesura.samples.implicit_surface import Surface
from caesura.samples.performed_take import RATE, Part, Take, perform_take
from caesura.samples.repertoire import MOTIONS
from caesura.samples.sample_figures import CHOREOGRAPHIES, SEEDS
from caesura.samples.skin_weights import strongest_weights
from caesura.samples.smooth_body import Body, build_body

CELL = 0.0178  # metres: a fourth of the triangles wanted; every one is cut into four
FRAMES = 1_047


def fine_figure() -> bytes:
    """The GLB. The same bytes at every call."""
    random = np.random.default_rng(SEEDS["smooth"])
    motions = [(MOTIONS[motion], times) for motion, times in CHOREOGRAPHIES["smooth"]]
    take = perform_take([Part(motion, motion.ends(times, RATE, random)) for motion, times in motions], random)
    cut = Take(take.rotations[:, :FRAMES], take.places[:FRAMES], take.truth)
    return smooth_glb(_finer(build_body(CELL)), cut)


def _finer(coarse: Body) -> Body:
    """Every triangle cut into four at the middles of its edges, whose weights and colours are those of their ends."""
    triangles = coarse.surface.triangles
    ends, middle = np.unique(np.sort(_edges(triangles), axis=1), axis=0, return_inverse=True)
    a, b, c = triangles.T
    ab, bc, ca = len(coarse.surface.vertices) + middle.reshape(3, -1)
    corners = np.concatenate([np.stack(of, axis=1) for of in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])

    def refined(values: np.ndarray) -> np.ndarray:
        return np.concatenate([values, values[ends].mean(axis=1)])

    weights = np.zeros((len(coarse.joints), coarse.joints.max() + 1))
    np.add.at(weights, (np.arange(len(weights))[:, None], coarse.joints), coarse.weights)
    joints, kept = strongest_weights(refined(weights))
    surface = Surface(refined(coarse.surface.vertices), corners, refined(coarse.surface.normals))
    return replace(coarse, surface=surface, joints=joints, weights=kept, colours=refined(coarse.colours))


def _edges(triangles: Int[np.ndarray, "T 3"]) -> Int[np.ndarray, "edges 2"]:
    """All first edges, then all second, then all third."""
    return np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
