"""A folder that nobody but its owner enters: uploads, results and Redis's socket lie in it."""

import logging
import os
import stat
from pathlib import Path

log = logging.getLogger(__name__)


def make_private(folder: Path) -> None:
    """Make it, or take others' permissions from one that was there. What another user owns stays."""
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    found = folder.stat()
    if found.st_uid == os.geteuid():
        folder.chmod(stat.S_IMODE(found.st_mode) & stat.S_IRWXU)
    elif found.st_mode & stat.S_IRWXO:
        log.warning("Others on this machine may enter %s, which belongs to user %d", folder, found.st_uid)
