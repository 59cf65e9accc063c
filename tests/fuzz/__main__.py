"""`make fuzz`: files made of files, tried for FUZZ_SECONDS; how many, how fast, and whether one was too much for us.

A crash is any error that is not a refusal by name, and the end of the process; a hang is more processor time than any
file may take; too much memory ends as a crash. The file that did it is kept, and the exit status is 1.
"""

import hashlib
import importlib.util
import os
import platform
import subprocess
import sys
import time
from pathlib import Path

from tests.fuzz.process import ROOM, Board

FOLDER = Path(".fuzz")


def main() -> int:
    """Run the fuzzer in a process of its own, so that nothing it does can hide its own end."""
    seconds = int(os.environ.get("FUZZ_SECONDS", "300"))
    seed = int(os.environ.get("FUZZ_SEED", "0")) or int(time.time()) % 2**31
    corpus = FOLDER / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    path = FOLDER / "board"
    path.write_bytes(bytes(ROOM))
    guided = importlib.util.find_spec("atheris") is not None
    print(
        f"{seconds} s, seed {seed}, {'guided by coverage' if guided else 'not guided: atheris is not installed here'}"
    )
    began = time.monotonic()
    with (FOLDER / "log").open("w") as log:
        command = [sys.executable, "-m", "tests.fuzz.process", str(path), str(corpus), str(seconds), str(seed)]
        ended = subprocess.run(command, stdout=log, stderr=log, check=False).returncode
    took = time.monotonic() - began
    board = Board(path)
    print(
        f"{board.tried:,} files in {took:,.0f} s, {board.tried / took:,.0f} a second; {board.read:,} were read, "
        f"{board.tried - board.read:,} refused by name. The slowest took {board.slowest:.2f} processor seconds, the "
        f"process {board.largest / 1e6:,.0f} MB. {platform.platform()}, Python {platform.python_version()}."
    )
    if ended == 0 and not board.at_hand:
        print("No crash, no hang, no file over the memory.")
        return 0
    kept = FOLDER / f"found-{hashlib.sha256(board.at_hand).hexdigest()[:12]}"
    kept.write_bytes(board.at_hand)
    print((FOLDER / "log").read_text(errors="replace")[-3000:])
    print(f"FOUND: the process ended with {ended}; the file is {kept}. Again: python -m tests.fuzz.again {kept}")
    return 1


if __name__ == "__main__":
    sys.exit(main())
