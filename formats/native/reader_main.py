"""What runs in a reader's process: it is told a file and a function, and writes the answer to its standard output.

    python -m caesura.formats.native.reader_main '{"place": …, "path": …, "descriptor": …, "parent": …, "limits": …}'

The process leaves without tidying up: objects of a library that has failed, or counts its references wrongly, are
never taken apart.
"""

import gc
import json
import os
import sys
import traceback
from importlib import import_module
from typing import Any

from caesura.core.errors import CaesuraError, LimitExceeded
from caesura.core.limits import Limits
from caesura.formats.native.confinement import confine, end_with_parent, limit_time
from caesura.formats.native.reader_answer import write_answer, write_json
from caesura.formats.notices import Notices

FAULT = 70
"""Exit status after an error that is not the file's: a fault of ours."""


def memory_problem(title: str, limits: Limits) -> LimitExceeded:
    """The refusal of a file that a reader needs too much memory for."""
    return LimitExceeded(
        "limit-exceeded",
        f"To read this {title} takes more than {limits.max_reader_bytes:,} bytes of memory. Send a smaller model, or "
        "ask the operator of this service to raise CAESURA_MAX_READER_BYTES.",
        limit=limits.max_reader_bytes,
        setting="CAESURA_MAX_READER_BYTES",
    )


def main(request: dict[str, Any]) -> None:
    """Read one file, and leave."""
    end_with_parent(request["parent"])
    limits = Limits(**request["limits"])
    limit_time(limits)
    gc.disable()
    with os.fdopen(os.dup(1), "wb", buffering=0) as pipe:
        os.dup2(2, 1)  # what a library prints is no part of the answer
        module, _, name = request["place"].partition(":")
        read = getattr(import_module(module), name)
        confine(request["descriptor"], limits)
        notices = Notices()

        def write(data: bytes | memoryview) -> None:
            rest = memoryview(data).cast("B")
            while rest:
                rest = rest[pipe.write(rest) :]

        try:
            write_answer(read(request["path"], limits, notices, **request["arguments"]), notices.in_order(), write)
        except CaesuraError as refused:
            write_json(refused.problem(), write)
        except MemoryError:
            write_json(memory_problem(request["title"], limits).problem(), write)


if __name__ == "__main__":
    status = FAULT
    try:
        main(json.loads(sys.argv[1]))
        status = 0
    except BaseException:  # noqa: BLE001  the parent raises what is printed here
        traceback.print_exc()
    sys.stderr.flush()
    os._exit(status)
