"""What becomes of takes at the edge of what can be cut, by every method: a named error or honest segments.

    python -m benchmarks.edges

Writes its table into docs/accuracy.md, or with `--print` not. Whatever is no named error ends the program.
"""

import argparse
from collections.abc import Iterator

import numpy as np
from jaxtyping import Float, Int

from benchmarks.reports.report import ACCURACY, write_section
from caesura.core.animation import Animation, Take
from caesura.core.errors import CaesuraError
from caesura.core.parameters import Parameters
from caesura.core.pipeline import segment
from caesura.core.registry.methods import METHODS

RATE = 30.0
FRAMES = 150
TOO_MANY = 1000

Case = tuple[str, Animation, int]
"""What it is, the take, and how many motions the methods are told that must be told."""


def cases() -> Iterator[Case]:
    """Every edge."""
    rest, triangles = sheet()
    swinging = swing(rest, FRAMES)
    broken = swinging.copy()
    broken[70, 3, 1] = np.nan
    yield "a coordinate that is no number", take(broken, triangles), 2
    yield "one frame", take(swinging[:1], triangles), 2
    yield "two frames", take(swinging[:2], triangles), 2
    yield "nothing moves", take(np.repeat(rest[None], FRAMES, axis=0), triangles), 2
    yield "moves as one rigid piece", take(rest + np.linspace(0, 5, FRAMES)[:, None, None], triangles), 2
    yield f"{TOO_MANY} motions asked of {FRAMES} frames", take(swinging, triangles), TOO_MANY
    yield "one triangle", take(swinging[:, :3], triangles[:1]), 2
    yield "no triangle has area", take(np.zeros_like(swinging), triangles), 2


def sheet() -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "T 3"]]:
    """A strip of paper, and its triangles."""
    rest = np.array([[x, y, 0.0] for x in range(8) for y in (0, 1)])
    return rest, np.array([[i, i + 1, i + 2] for i in range(len(rest) - 2)])


def swing(rest: Float[np.ndarray, "V 3"], frames: int) -> Float[np.ndarray, "frames V 3"]:
    """The strip bends and stretches, slowly and then fast."""
    angle = np.sin(np.arange(frames) ** 1.4 / 12)
    moved = np.repeat(rest[None], frames, axis=0)
    moved[..., 2] = 0.1 * angle[:, None] * rest[:, 0] ** 2
    moved[..., 1] *= 1 + 0.3 * angle[:, None]
    return moved


def take(vertices: Float[np.ndarray, "frames V 3"], triangles: Int[np.ndarray, "T 3"]) -> Animation:
    """These vertices as a take."""
    frames = len(vertices)
    drawn = vertices.astype(np.float32)
    about = Take(0, "take", frames / RATE, frames, RATE)
    return Animation(lambda a, b: drawn[a:b].copy(), drawn.shape[1], triangles, None, frames, RATE, about)


def outcome(animation: Animation, method: str, motions: int) -> str:
    """What the method answers, in a few words."""
    try:
        found = segment(animation, Parameters(method=method, motions=motions))
    except CaesuraError as refused:
        return f"`{refused.code}`"
    said = [f"`{notice.code}`" for notice in found.notices]
    count = len(found.segments)
    return ", ".join([f"{count} segment{'s' * (count > 1)}", *said])


def main() -> None:
    """Prints and writes the table."""
    options = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    lines = [f"| take | {' | '.join(f'`{method}`' for method in METHODS)} |", "|---" * (len(METHODS) + 1) + "|"]
    for name, animation, motions in cases():
        lines.append(f"| {name} | {' | '.join(outcome(animation, method, motions) for method in METHODS)} |")
    print("\n".join(lines))
    if not given.print:
        write_section(ACCURACY, "edges", "\n".join(lines))


if __name__ == "__main__":
    main()
