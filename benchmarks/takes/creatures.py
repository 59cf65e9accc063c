"""Creatures made up by a seed: bodies and motions that no constant of ours was fixed on.

A trunk of one to three pieces and three to seven limbs of two or three links: insects, robots, things with a tail. Even
seeds are of rigid parts on nodes, odd ones are skinned. Each has as many clips as are asked for, all of them cycles.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.transform import Rotation

from caesura.formats.gltf.writer import Channel, GlbWriter, Primitive
from caesura.samples.implicit_surface import Limb, polygonise_limbs
from caesura.samples.skin_weights import heat_weights, strongest_weights

RATE = 30.0
SECONDS = (0.7, 2.6)  # of one cycle
SHARPNESS = 0.4
CELL = 0.05  # metres


@dataclass(frozen=True)
class Creature:
    """Links in an order where parents come first, each a stick from its joint to `tips`, as thick as `radii`."""

    parents: tuple[int, ...]
    places: Float[np.ndarray, "links 3"]  # of the joints, standing
    tips: Float[np.ndarray, "links 3"]
    radii: Float[np.ndarray, "links"]
    limb: Int[np.ndarray, "links"]  # which limb a link is of, 0 the trunk

    @property
    def limbs(self) -> list[Limb]:
        """The links as round cones."""
        rows = zip(self.places, self.tips, self.radii.tolist(), strict=True)
        return [Limb(i, start, end, radius, 0.8 * radius) for i, (start, end, radius) in enumerate(rows)]

    @classmethod
    def of(cls, random: np.random.Generator) -> "Creature":
        """A body made up by chance."""
        parents, places, tips, radii, limb = [-1], [np.zeros(3)], [np.array([0, 0, 0.3])], [0.14], [0]
        for _ in range(random.integers(0, 3)):
            parents.append(len(parents) - 1)
            places.append(tips[-1])
            tips.append(tips[-1] + np.array([0, 0, random.uniform(0.15, 0.3)]))
            radii.append(random.uniform(0.09, 0.14))
            limb.append(0)
        trunk = len(parents)
        for number in range(1, random.integers(4, 9)):
            at = int(random.integers(trunk))
            along = random.normal(size=3)
            along /= np.linalg.norm(along)
            start = places[at] + random.uniform(0.1, 0.9) * (tips[at] - places[at]) + 0.6 * radii[at] * along
            thick = random.uniform(0.045, 0.075)
            for link in range(random.integers(2, 4)):
                bent = along + random.normal(0, 0.25, 3)
                parents.append(len(parents) - 1 if link else at)
                places.append(start)
                start = start + random.uniform(0.2, 0.38) * bent / np.linalg.norm(bent)
                tips.append(start)
                radii.append(thick * 0.85**link)
                limb.append(number)
        return cls(tuple(parents), np.array(places), np.array(tips), np.array(radii), np.array(limb))


def creature(seed: int, clips: int) -> bytes:
    """The GLB of a creature with so many clips, one cycle each, named "motion 1" on. The same bytes at every call."""
    random = np.random.default_rng(seed)
    made = Creature.of(random)
    writer = GlbWriter()
    nodes = _smooth(writer, made) if seed % 2 else _rigid(writer, made)
    for number in range(1, clips + 1):
        times, turns = cycle(made, random)
        channels = [Channel(node, "rotation", times, turns[:, i]) for i, node in enumerate(nodes)]
        writer.animation(f"motion {number}", channels)
    return writer.to_bytes()


def cycle(made: Creature, random: np.random.Generator) -> tuple[Float[np.ndarray, "keys"], Float[np.ndarray, "k l 4"]]:
    """Key times and turns of every link over one cycle: a pose, and a swing about it of the limbs that take part.

    Limbs that do not take part hold the pose; a second harmonic makes each swing its own.
    """
    seconds = random.uniform(*SECONDS)
    frames = max(round(seconds * RATE), 8)
    phase = np.arange(frames + 1) / frames * 2 * np.pi
    limbs = int(made.limb.max()) + 1
    lively = np.concatenate([[0.25], np.where(random.random(limbs - 1) < 0.6, 1.0, 0.05)])
    lively[1 + random.integers(limbs - 1)] = 1.0
    pose = random.normal(0, 0.28, (len(made.parents), 3)) * np.where(made.limb > 0, 1.0, 0.25)[:, None]
    turns = np.repeat(pose[None], frames + 1, axis=0)
    for harmonic, size in ((1, 0.38), (2, 0.12)):
        swing = random.normal(0, size, (2, len(made.parents), 3)) * lively[made.limb][None, :, None]
        turns += np.cos(harmonic * phase)[:, None, None] * swing[0] + np.sin(harmonic * phase)[:, None, None] * swing[1]
    quaternions = Rotation.from_rotvec(turns.reshape(-1, 3)).as_quat().reshape(*turns.shape[:2], 4)
    return np.arange(frames + 1) / RATE, quaternions


def _nodes(writer: GlbWriter, made: Creature) -> list[int]:
    nodes: list[int] = []
    for i, parent in enumerate(made.parents):
        place = made.places[i] - (made.places[parent] if parent >= 0 else 0)
        nodes.append(writer.node(f"link {i}", parent=nodes[parent] if parent >= 0 else None, translation=place))
    return nodes


def _rigid(writer: GlbWriter, made: Creature) -> list[int]:
    """Every link a box on its node."""
    nodes = _nodes(writer, made)
    for i, node in enumerate(nodes):
        along = made.tips[i] - made.places[i]
        turn = Rotation.align_vectors([along], [[0, 0, np.linalg.norm(along)]])[0].as_matrix()
        corners = BOX * [made.radii[i], made.radii[i], np.linalg.norm(along)] @ turn.T
        writer.node(f"part {i}", parent=node, mesh=writer.mesh(f"part {i}", [Primitive(corners, BOX_TRIANGLES)]))
    return nodes


def _smooth(writer: GlbWriter, made: Creature) -> list[int]:
    """One surface around all links, skinned."""
    limbs = made.limbs
    surface = polygonise_limbs(limbs, CELL)
    joints, weights = strongest_weights(heat_weights(surface, limbs, len(limbs), SHARPNESS))
    nodes = _nodes(writer, made)
    inverse = np.tile(np.eye(4), (len(nodes), 1, 1))
    inverse[:, :3, 3] = -made.places
    primitive = Primitive(surface.vertices, surface.triangles, surface.normals, joints=joints, weights=weights)
    writer.node("creature", mesh=writer.mesh("creature", [primitive]), skin=writer.skin(nodes, inverse))
    return nodes


BOX = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)], float)
BOX_TRIANGLES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
