"""The pictures of docs/method.md, of the smooth sample figure: python -m benchmarks.method_pictures [FOLDER]."""

import base64
import struct
import sys
import zlib
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int, UInt8
from sklearn.cluster import KMeans

from benchmarks.timing.numpy_twin import twin
from caesura.api import open_animation
from caesura.core.analysis import Analysis
from caesura.core.methods.pose_features import pose_features
from caesura.core.methods.switching.initial_segments import InitialSegments
from caesura.core.methods.switching.switching_k_means import run_switching_k_means
from caesura.core.methods.switching.views import CHANGE_SECONDS, SHORT
from caesura.core.methods.switching.windowed_signal import DescriptorWindows
from caesura.core.parameters import Parameters
from caesura.core.pipeline import analyse, cut
from caesura.samples.performed_take import Truth
from caesura.samples.sample_figures import build_figure

WIDTH, LEFT, BAR = 860, 150, 24  # pixels
COLOURS = ("#4477aa", "#ccbb44", "#ee6677", "#228833", "#66ccee", "#aa3377")  # Tol's bright scheme, colour-blind safe
INK = "#222222"
LEVELS = 10


def main(folder: Path) -> None:
    """Write the four pictures."""
    sample = build_figure("smooth")
    take = open_animation(sample.glb)
    motions = len({label for label, _, _ in sample.truth.segments})
    parameters = Parameters(motions=motions)
    analysis = analyse(take, parameters)
    pictures = {
        "method-energy.svg": energy(analysis, parameters, sample.truth),
        "method-histograms.svg": histograms(np.array(take.vertices(0, take.frames)), take.rest, take.triangles),
        "method-similarity.svg": similarity(analysis, sample.truth),
        "method-changes.svg": changes(analysis, motions, sample.truth),
    }
    for name, picture in pictures.items():
        (folder / name).write_text(picture, encoding="utf-8")


def energy(analysis: Analysis, parameters: Parameters, truth: Truth) -> str:
    """The curve with its key-frames, above bars of the truth, of the paper's cut and of the default's."""
    paper = cut(analysis, parameters.model_copy(update={"method": "joint-entropy"}))
    ours = cut(analysis, parameters)
    height = 160
    y = height - (height - 20) * paper.energy / np.nanmax(paper.energy)
    known = np.flatnonzero(np.isfinite(paper.energy)).tolist()
    at = [_x(frame, analysis.frames) for frame in range(analysis.frames)]
    line = " ".join(f"{at[f]:.1f},{y[f]:.1f}" for f in known)
    parts = [
        _text(LEFT - 8, height / 2, "energy curve", "end"),
        f'<polyline points="{line}" fill="none" stroke="{COLOURS[0]}" stroke-width="1.6"/>',
        *(
            f'<circle cx="{at[k]:.1f}" cy="{y[k]:.1f}" r="4" fill="white" stroke="{INK}" stroke-width="1.5"/>'
            for k in paper.key_frames.tolist()
        ),
    ]
    rows = [("truth", _labels(truth)), ("joint-entropy", paper.labels), ("switching", ours.labels)]
    return _svg(height + len(rows) * (BAR + 6) + 40, [*parts, *_bars(rows, truth, height + 14)])


def histograms(
    vertices: Float[np.ndarray, "F V 3"], rest: Float[np.ndarray, "V 3"] | None, triangles: np.ndarray
) -> str:
    """The joint distribution of the levels of strain at the calmest and at the highest moment of the curve."""
    window = round(1.3 * 30)
    plain = twin(vertices, vertices[0] if rest is None else rest, triangles, window, LEVELS)
    level = np.clip(np.ceil(np.minimum(plain.strain / plain.scale, 1) * LEVELS).astype(np.int64) - 1, 0, LEVELS - 1)
    parts: list[str] = []
    cell = 20
    for place, (name, m) in enumerate(
        [("lowest", np.nanargmin(plain.energy)), ("highest", np.nanargmax(plain.energy))]
    ):
        first, then = level[m - window + 1 : m + 1], level[m + 1 : m + window + 1]
        counts = np.bincount((first * LEVELS + then).ravel(), minlength=LEVELS**2).reshape(LEVELS, LEVELS)
        share = counts / counts.sum()
        left = LEFT + place * 360
        parts.append(_text(left, 22, f"{name}: frame {m}, H = {plain.energy[m]:.2f}", "start"))
        for (i, j), p in np.ndenumerate(share):
            dark = 1 + np.log10(max(float(p), 1e-4)) / 4
            y = 36 + (LEVELS - 1 - i) * cell
            parts.append(
                f'<rect x="{left + j * cell}" y="{y}" width="{cell - 1}" height="{cell - 1}" fill="{_blue(dark)}"/>'
            )
        parts.append(_text(left + LEVELS * cell / 2, 36 + LEVELS * cell + 18, "level in the later window", "middle"))
    parts.append(_text(LEFT - 8, 36 + LEVELS * cell / 2, "in the earlier", "end"))
    return _svg(36 + LEVELS * cell + 30, parts)


def similarity(analysis: Analysis, truth: Truth) -> str:
    """How far every pose is from every other: dark squares are motions, dark stripes in them repetitions."""
    every = max(analysis.frames // 300, 1)
    values = pose_features(analysis.features)[::every]
    squares = np.einsum("fd,fd->f", values, values)
    far = np.sqrt(np.maximum(squares[:, None] + squares - 2 * values @ values.T, 0))
    grey = np.asarray(np.clip(255 * far / np.percentile(far, 98), 0, 255), np.uint8)
    size = 520
    data = base64.b64encode(_png(grey)).decode()
    parts = [f'<image x="{LEFT}" y="10" width="{size}" height="{size}" href="data:image/png;base64,{data}"/>']
    for name, start, end in truth.segments:
        a, b = (10 + size * frame / analysis.frames for frame in (start, end))
        parts.append(_text(LEFT - 8, (a + b) / 2 + 4, name, "end"))
        parts += [f'<path d="M{LEFT} {b:.1f}h{size}M{LEFT + b - 10:.1f} 10v{size}" stroke="white" opacity="0.7"/>']
    return _svg(size + 24, parts)


def changes(analysis: Analysis, motions: int, truth: Truth) -> str:
    """What windows do, and what it does that a change costs something: single poses and windows, without and with."""
    single, rate = pose_features(analysis.features), analysis.frame_rate
    centres = KMeans(motions, n_init=4, random_state=0).fit(single).cluster_centers_
    values = tuple(feature.values for feature in analysis.features if feature.values.shape[1])
    signal = DescriptorWindows.of(values, rate, SHORT).signal()
    assert signal is not None
    penalty = CHANGE_SECONDS / signal.seconds_per_step
    means = InitialSegments.of(signal, penalty, at_least=motions).grouped(motions)
    rows = [
        ("truth", _labels(truth)),
        ("poses, λ = 0", run_switching_k_means(single, centres, 0.0).labels),
        (
            "poses, λ = 1/3 s",
            run_switching_k_means(single, centres, CHANGE_SECONDS * rate * _mean_square(single)).labels,
        ),
        ("windows, λ = 0", signal.per_frame(run_switching_k_means(signal.values, means, 0.0).labels)),
        ("windows, λ = 1/3 s", signal.per_frame(run_switching_k_means(signal.values, means, penalty).labels)),
    ]
    return _svg(len(rows) * (BAR + 6) + 40, _bars(rows, truth, 14))


def _mean_square(values: Float[np.ndarray, "frames D"]) -> float:
    return float(np.einsum("fd,fd->", values, values)) / len(values)


def _labels(truth: Truth) -> Int[np.ndarray, "frames"]:
    names = list(dict.fromkeys(label for label, _, _ in truth.segments))
    return np.concatenate([np.full(end - start, names.index(label)) for label, start, end in truth.segments])


def _bars(rows: Sequence[tuple[str, Int[np.ndarray, "frames"]]], truth: Truth, top: float) -> Iterable[str]:
    """A bar for each row, coloured by the true motion that a found one covers most; frames below."""
    true = _labels(truth)
    for row, (name, labels) in enumerate(rows):
        y = top + row * (BAR + 6)
        yield _text(LEFT - 8, y + BAR - 7, name, "end")
        for start, end in pairwise([0, *(np.flatnonzero(np.diff(labels)) + 1).tolist(), len(labels)]):
            motion = int(np.bincount(true[labels == labels[start]]).argmax())
            x, width = _x(start, len(labels)), _x(end, len(labels)) - _x(start, len(labels))
            yield f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{BAR}" fill="{COLOURS[motion]}"/>'
    for label, start, end in truth.segments:
        yield _text(_x((start + end) / 2, len(true)), top + BAR - 7, label, "middle")
    for frame in range(0, len(true), 300):
        yield _text(_x(frame, len(true)), top + len(rows) * (BAR + 6) + 12, str(frame), "middle")


def _svg(height: float, parts: Iterable[str]) -> str:
    look = f'font-family="sans-serif" font-size="13" fill="{INK}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 20} {height:.0f}" {look}>'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>\n"])


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def _x(frame: float, frames: int) -> float:
    return LEFT + WIDTH * frame / frames


def _blue(dark: float) -> str:
    """White to blue."""
    return "#" + "".join(f"{round(255 + (end - 255) * min(max(dark, 0.0), 1.0)):02x}" for end in (0x22, 0x55, 0x99))


def _png(grey: UInt8[np.ndarray, "rows columns"]) -> bytes:
    """A picture in grey, as a file."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("docs/pictures"))
