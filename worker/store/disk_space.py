"""Free space on the disk of the data folder: every write leaves the bytes free that the operator asks for."""

import errno
import shutil
from pathlib import Path

from caesura.core.errors import CaesuraError

FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""Errors of the system that mean: no more can be written."""


class StorageFull(CaesuraError):
    """The disk has no room for this."""

    kind = "worker"


def check_disk_space(folder: Path, coming: int, stays_free: int) -> None:
    """Raises `StorageFull` where `coming` more bytes in a folder would leave fewer than `stays_free` of its disk."""
    if shutil.disk_usage(folder).free - coming < stays_free:
        raise storage_full_error(setting="CAESURA_MIN_FREE_BYTES")


def storage_full_error(**where: str) -> StorageFull:
    """The refusal, for a disk that is full already too."""
    detail = "The disk of the service is full. Nothing is stored; tell the operator, or try again later."
    return StorageFull("storage-full", detail, **where)
