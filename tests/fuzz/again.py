"""Try one file again that the fuzzer has kept."""

import sys
from pathlib import Path

from tests.fuzz.target import attempt

if __name__ == "__main__":
    read, seconds = attempt(Path(sys.argv[1]).read_bytes())
    print(f"{'read' if read else 'refused by name'} in {seconds:.2f} processor seconds")
