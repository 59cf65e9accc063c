"""Motions are told apart by colour, whatever eyes a person has."""

import re
from itertools import combinations
from pathlib import Path

import numpy as np

# Machado, Oliveira and Fernandes (2009), severity 1, on linear red, green, blue.
VISION = {
    "normal": np.eye(3),
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
}
# Ottosson (2020), OKLab.
CONES = np.array(
    [[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
     [0.0883024619, 0.2817188376, 0.6299787005]]
)  # fmt: skip
LAB = np.array(
    [[0.2104542553, 0.793617785, -0.0040720468], [1.9779984951, -2.428592205, 0.4505937099],
     [0.0259040371, 0.7827717662, -0.808675766]]
)  # fmt: skip


def linear(colours: list[str]) -> np.ndarray:
    """Hexadecimal sRGB as linear light."""
    values = np.array([[int(c[i : i + 2], 16) for i in (1, 3, 5)] for c in colours]) / 255
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def test_twelve_colours_stay_apart_for_every_kind_of_sight(checkout: Path) -> None:
    """The nearest two of the palette are at least 0.09 apart in OKLab, seen with any of four kinds of eyes."""
    source = (checkout / "service" / "static" / "viewer" / "palette.js").read_text(encoding="utf-8")
    listed = source[source.index("COLOURS = [") : source.index("];")]
    colours = re.findall(r"#[0-9a-f]{6}", listed)
    assert len(set(colours)) >= 12
    for name, matrix in VISION.items():
        seen = np.clip(linear(colours) @ np.array(matrix).T, 0, 1)
        lab = np.cbrt(seen @ CONES.T) @ LAB.T
        nearest = min(np.linalg.norm(a - b) for a, b in combinations(lab, 2))
        assert nearest >= 0.09, name
