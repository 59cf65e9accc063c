"""Try one file again that the fuzzer has kept."""

import sys
from pathlib import Path

from tests.fuzz.target import attempt

if __name__ == "__main__":
    print("read" if attempt(Path(sys.argv[1]).read_bytes()) else "refused by name")
