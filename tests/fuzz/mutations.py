"""Changes of a file that know how it is made: an upload is taken apart, one piece changed, and put together again.

Bytes changed at random rarely get past the outer shape of a file. Deterministic for a given generator.
"""

import base64
import io
import json
import random
import re
import struct
import warnings
import zipfile
import zlib

from tests.fuzz.parts import joined, parted
from tests.fuzz.trees import changed
from tests.glb import chunks

WORDS = (0, 1, 0x7FC00000, 0x7F800000, 0xFF800000, 0x7E967699, 0x80000000, 0xFFFFFFFF, 0x3F800000, 0xFFFF, 0x00FF00FF)
"""As float32: zeros, a denormal, NaN, infinities, 1e38, 1; as integers: restart values and counts."""

TEXT = [
    *b"0 -1 -3 1e400 1e39 nan inf 99999999999999999999 x { } ROOT JOINT End OFFSET CHANNELS MOTION Frames:".split(),
    *b"Frame Time: f v 1/1/1 element property list '|O' '<f8' '<u8' '>i2' '<c8' (3,) () True ((1,2),3)".split(),
    *(b"f 1 2 3 4", b"format binary_little_endian 1.0", b"(9, 5, 3)", b"(0, 0, 3)", b"(1000000000, 5, 3)"),
    *b":DEGREES :RADIANS dof rx tx l axis XYZ direction length begin end root :hierarchy :units".split(),
    *b'TIME_VALUE="1e9" TIME_VALUE="-9" TIME_SLOT_REF1="ts9" <TIER> </TIER> <!DOCTYPE &a; &#x41; <![CDATA['.split(),
    *b"start,end,label start_seconds,end_seconds,motion frame,name -1e308 ;;; \t".split(),
    *b"usemtl g o vn vt l / // -1/2 1//0 uint8 float64 ascii end_header vertex face".split(),
    *(
        b"\nusemtl x\nf 1 2 3",
        b"\ng x\nf -1 -2 -3",
        b"f 1 2 3 " * 20,
        b"property list uint uint a",
        b"element x 1000000",
    ),
]
"""Words of BVH, OBJ, PLY, ASF, AMC, of labels and of the headers of NumPy's arrays."""

FIGURES = (b"0", b"-1", b"0.5", b"1e9", b"-1e308", b"1e308", b"1e400", b"nan", b"1,5", b"100000000000000", b"7" * 5000)
"""Numbers that a text may hold where others stood."""

NAMES = (
    "rest.npy", "fps.npy", "a/b.obj", "x.gltf", "x.bin", "../v", "9" * 400 + "a.obj", "9" * 20_000 + "a1.obj", "1.obj",
    "1 " * 240 + ".ply", "frame_" + "1" * 20_000 + ".npy", "vertices" + "1" * 400 + "x.npy", "\u0661" * 40 + ".obj",
    "__MACOSX/1.obj", "a" * 501, "x" * 20_000 + ".gltf", "%s%n\n.obj", "1" * 19 + ".obj", "0.OBJ",
)  # fmt: skip
"""Names of members: numbers without end, folders, and what is no name."""

MANY = (2, 50, 5000)
"""How often a word or a line is repeated; deflated, many lines are few bytes."""


def mutated(data: bytes, draw: random.Random, largest: int) -> bytes:
    """One upload, changed in one of its files."""
    parts = parted(data)
    name = draw.choice(list(parts))
    parts[name] = _file(parts[name], draw)
    if draw.random() < 0.02:
        parts[draw.choice(("x.bin", "", "../x", "model", "a" * 300))] = parts.pop(name)
    return joined(parts)[:largest]


def _file(data: bytes, draw: random.Random) -> bytes:
    if draw.random() < 0.1:
        return scrambled(data, draw)
    try:
        if data.startswith(b"glTF"):
            return _glb(data, draw)
        if data.lstrip()[:1] == b"{":
            return _json(data, draw)
        if data.startswith(b"PK"):
            return _zip(data, draw)
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError, struct.error,
            OSError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):  # fmt: skip
        return scrambled(data, draw)
    changed_as = numbered if b"\0" in data[:64] else worded
    return changed_as(data, draw) if draw.random() < 0.8 else scrambled(data, draw)


def _glb(data: bytes, draw: random.Random) -> bytes:
    length = int.from_bytes(data[12:16], "little")
    text, rest = data[20 : 20 + length], data[28 + length :]
    if draw.random() < 0.75 or not rest:
        text = json.dumps(changed(json.loads(text), draw)).encode()
    else:
        rest = numbered(rest, draw)
    if draw.random() < 0.05:
        return chunks((b"JSON", text), (b"BIN\0", rest), (b"more", b"?"), length=draw.choice((0, 12, 20, 2**32 - 1)))
    return chunks((b"JSON", text), (b"BIN\0", rest))


def _json(data: bytes, draw: random.Random) -> bytes:
    root = json.loads(data)
    buffers = root.get("buffers", [])
    if buffers and draw.random() < 0.3:
        head, _, text = buffers[0]["uri"].partition(",")
        buffers[0]["uri"] = f"{head},{base64.b64encode(numbered(base64.b64decode(text), draw)).decode()}"
    else:
        root = changed(root, draw)
    return json.dumps(root).encode()


def _zip(data: bytes, draw: random.Random) -> bytes:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = [(info.filename, info.compress_type, archive.read(info)) for info in archive.infolist()[:32]]
    place = draw.randrange(len(members))
    name, method, content = members[place]
    action = draw.random()
    if action < 0.7:
        inner = _file(content, draw) if content[:1] != b"\x93" else draw.choice((worded, numbered))(content, draw)
        members[place] = (name, method, inner)
    elif action < 0.8:
        members[place] = (draw.choice((*NAMES, name, name + "9" * 400)), method, content)
    elif action < 0.9:
        members.append(draw.choice(members))
    else:
        del members[place]
    out = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(out, "w") as archive:
        warnings.simplefilter("ignore")
        for called, how, inner in members:
            archive.writestr(called, inner, how if draw.random() < 0.8 else zipfile.ZIP_DEFLATED)
    return out.getvalue()


def numbered(data: bytes, draw: random.Random) -> bytes:
    """Numbers of four bytes changed for others that are special, or a piece moved, cut off or doubled."""
    out = bytearray(data)
    if len(out) < 8:
        return bytes(out) + b"\0\1\2\3"
    for _ in range(draw.choice((1, 1, 2, 8))):
        place = draw.randrange(len(out) // 4) * 4
        action = draw.random()
        if action < 0.6:
            out[place : place + 4] = draw.choice(WORDS).to_bytes(4, "little")
        elif action < 0.8:
            out[place + draw.randrange(4) :][:1] = b""
            out[place] ^= 1 << draw.randrange(8)
        elif action < 0.9:
            out[place : place + 16] = out[:16]
        elif len(out) > 16:
            del out[place : place + draw.choice((1, 4, 12))]
    return bytes(out)


def worded(data: bytes, draw: random.Random) -> bytes:
    """Words of a text changed for others, lines doubled, dropped or moved."""
    lines = data.split(b"\n")
    for _ in range(draw.choice((1, 1, 2, 4))):
        place = draw.randrange(len(lines))
        words = lines[place].split(b" ")
        action = draw.random()
        if action < 0.45:
            words[draw.randrange(len(words))] = draw.choice(TEXT)
            lines[place] = b" ".join(words)
        elif action < 0.55:
            numbers = list(re.finditer(rb"-?\d[\d.]*", lines[place][:1000]))
            start, end = draw.choice(numbers).span() if numbers else (0, 0)
            lines[place] = lines[place][:start] + draw.choice(FIGURES) + lines[place][end:]
        elif action < 0.6:
            lines[place] = b" ".join(words[:1] + [word[:64] for word in words[1:9]] * draw.choice(MANY))
        elif action < 0.75:
            lines.insert(place, draw.choice(lines))
        elif action < 0.9 and len(lines) > 1:
            del lines[place]
        else:
            lines[place : place + 1] = [lines[place][:64]] * draw.choice(MANY)
    return b"\n".join(lines)


def scrambled(data: bytes, draw: random.Random) -> bytes:
    """Bytes changed, cut off, moved or doubled, without a thought of what they mean."""
    out = bytearray(data)
    for _ in range(draw.choice((1, 1, 2, 4, 16))):
        if not out:
            return bytes(out) + b"glTF"
        place = draw.randrange(len(out))
        action = draw.random()
        if action < 0.5:
            out[place] = draw.choice((0, 1, 127, 128, 255, out[place] ^ 1 << draw.randrange(8)))
        elif action < 0.65:
            del out[place : place + draw.choice((1, 1, 4, 64))]
        elif action < 0.8:
            out[place:place] = out[: draw.choice((1, 4, 64))]
        elif action < 0.9:
            out[place : place + 4] = draw.choice(WORDS).to_bytes(4, "little")
        else:
            del out[place:]
    return bytes(out)
