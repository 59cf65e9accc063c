"""Redoes the paper's table and figures on what can be had, and writes them into docs/paper.md and its pictures."""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.paper import barbic, figure7, table1
from benchmarks.paper.pictures import curves_picture, opposite_strains
from benchmarks.paper.stand_ins import StandIn, stand_ins
from benchmarks.reports.drawing import bars
from benchmarks.reports.report import DOCS, write_section
from caesura.core.agreement import frame_accuracy, rand_index
from caesura.core.pipeline import analyse, cut
from caesura.core.plot.layout import lay_out_picture
from caesura.core.plot.svg import render_svg
from caesura.core.segmentation import Segmentation

PAGE = DOCS / "paper.md"


def ablation(takes: list[StandIn]) -> list[str]:
    """Each stand-in by the modified energy, the energy of neighbours, and plain distances of frames."""
    lines = ["| take | `energy=` | key-frames | frame accuracy | Eq. 6 as accuracy |", "|---|---|---|---|---|"]
    for take in takes:
        for energy in ("modified", "joint", "distance"):
            asked = take.parameters().model_copy(update={"energy": energy})
            found = cut(analyse(take.animation, asked), asked)
            accuracy, rand = frame_accuracy(found.labels, take.truth), rand_index(found.labels, take.truth)
            lines.append(f"| {take.name} | {energy} | {len(found.key_frames)} | {accuracy:.3f} | {rand:.3f} |")
    return lines


def draw(takes: dict[str, StandIn], found: dict[str, Segmentation]) -> dict[str, str]:
    """The figures that need nobody's data."""
    face, other = takes["Face1"], takes["Face2"]
    joint = analyse(face.animation, face.parameters().model_copy(update={"energy": "joint"})).energy
    energy, total = opposite_strains()
    luo = cut(analyse(other.animation, other.parameters()), other.parameters("luo2014"))
    rows = [("Face2, stand-in", "joint-entropy", other.truth, found["Face2"].labels)]
    rows.append(("Face2, stand-in", "luo2014", other.truth, luo.labels))
    return {
        "figure1": curves_picture(
            "Joint entropy of neighbours and of windows, of a face",
            [("neighbours (Eq. 2)", joint), ("windows (Eq. 3)", found["Face1"].energy)],
        ),
        "figure3-exercise": render_svg(lay_out_picture(found["Exercise"].document())),
        "figure3-squirrel": render_svg(lay_out_picture(found["Squirrel"].document())),
        "figure4": bars(rows),
        "figure8": curves_picture(
            "Two halves of a body deform towards each other", [("energy (nats)", energy), ("sum of strains", total)]
        ),
    }


def main() -> None:
    """Measures, prints and writes."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--cmu", type=Path, help="folder with 86.asf, its trials and mocap.txt")
    options.add_argument("--print", action="store_true", help="print only")
    given = options.parse_args()
    takes = list(stand_ins())
    measured = list(table1.measured(takes))
    sections = {"table1": [*table1.HEAD, *(table1.row(*one) for one in measured)], "ablation": ablation(takes)}
    pictures = draw({take.name: take for take in takes}, {take.name: found for take, found, _ in measured})
    if given.cmu:
        rows = list(figure7.measured(given.cmu))
        sections["figure7"] = figure7.table(rows)
        strain = [row for row in rows if row.descriptors == "strain"]
        pictures["figure6"] = bars([(row.trial, row.method, row.truth, row.labels) for row in strain])
        sections["barbic"] = [*barbic.HEAD, *barbic.rows(given.cmu)]
    for name, lines in sections.items():
        print("\n".join(["", name, *lines]), flush=True)
        if not given.print:
            write_section(PAGE, name, "\n".join(lines))
    for name, picture in pictures.items() if not given.print else ():
        (DOCS / "pictures" / f"paper-{name}.svg").write_text(picture, encoding="utf-8")
    energy, total = opposite_strains()
    span = f"{np.nanmin(energy):.3f} to {np.nanmax(energy):.3f}"
    print(f"\nfigure 8: energy {span}, sums of strains differ by {np.ptp(total):.1e}")


if __name__ == "__main__":
    main()
