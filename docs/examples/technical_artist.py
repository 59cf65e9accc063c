"""One long take in, the same file with one named animation a motion out; and the cuts to look at first.

    python docs/examples/technical_artist.py take.glb clips.glb

Materials, textures and everything else stay as they are. Frame numbers are your editor's, counted from 0.
"""

import sys
from pathlib import Path

from caesura import segment
from caesura.formats.clips.clip_options import ClipOptions
from caesura.formats.clips.write import write_clips

DOUBTFUL = 3


def main(take: Path, clips: Path) -> None:
    """Find the motions, print them and the doubtful cuts, and write the clips."""
    content = take.read_bytes()
    found = segment(content, motions="auto", threads=2)

    print(f"{take.name}: {found.motions} motions in {len(found.segments)} segments")
    for one in found.segments:
        times = f", {len(one.repeats)} times" if len(one.repeats) > 1 else ""
        print(f"  {one.name:<3} frames {one.start} to {one.end - 1}{times}")

    cuts = [one for one in found.segments[:-1] if one.confidence is not None]
    print("Look at these cuts first:")
    for one in sorted(cuts, key=lambda one: one.confidence)[:DOUBTFUL]:
        print(f"  frame {one.end}, {one.end_seconds:.2f} s: {one.confidence:.0%} sure")

    # Motion A goes round and round in the game; nothing shorter than half a second becomes a clip.
    options = ClipOptions(loop="A", min_seconds=0.5)
    written = write_clips({take.name: content}, found.document(), options, lambda size: memoryview(bytearray(size)))
    with clips.open("wb") as file:
        file.writelines(written.pieces)
    print(f"{clips} is ready for Unity, Godot or Unreal.")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
