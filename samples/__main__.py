"""`python -m caesura.samples FOLDER` writes the sample files that the page offers."""

import sys
from pathlib import Path

from caesura.samples.sample_files import write_sample_files

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"{__doc__}")
    write_sample_files(Path(sys.argv[1]))
