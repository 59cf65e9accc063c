"""What a clip takes over of a file. Each clip is a copy, so the author's own data (`extras`) goes along if small."""

import json
from collections import deque
from collections.abc import Mapping
from typing import Any

from caesura.core.limits import Limits
from caesura.formats.gltf.container import open_container
from caesura.formats.notices import Notices
from caesura.formats.read import find_main_part

MOST_EXTRAS_BYTES = 64 * 1024
"""Of all `extras` together, as JSON."""

CHUNK = "binary chunk of the source.bin"


def clip_source(parts: Mapping[str, memoryview]) -> dict[str, memoryview]:
    """The parts of a glTF with little `extras`, as the source of many files; its buffers are not copied."""
    main = find_main_part(parts)
    root, binary, _ = open_container(parts[main], Limits.none(), Notices())
    drop_large_extras(root.value)
    lean = dict(parts)
    if binary is not None and root.value.get("buffers") and "uri" not in root.value["buffers"][0]:
        root.value["buffers"][0]["uri"] = CHUNK
        lean[CHUNK] = binary
    lean[main] = memoryview(json.dumps(root.value).encode())
    return lean


def drop_large_extras(value: dict[str, Any]) -> None:
    """Take out `extras` that have no room, those of the outermost objects last."""
    room = MOST_EXTRAS_BYTES
    waiting: deque[Any] = deque([value])
    while waiting:
        found = waiting.popleft()
        if isinstance(found, dict) and "extras" in found:
            size = len(json.dumps(found["extras"]))
            if size > room:
                del found["extras"]
            else:
                room -= size
        waiting += found.values() if isinstance(found, dict) else found if isinstance(found, list) else ()
