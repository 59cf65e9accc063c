"""Build the Blender add-on as an extension that Blender installs from disk: `python tools/build_addon.py [FOLDER]`.

The same sources give the same bytes. Into build/ where no folder is named.
"""

import sys
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ADDON = ROOT / "blender" / "caesura_addon"
EARLIEST = (1980, 1, 1, 0, 0, 0)


def build_addon(folder: Path) -> Path:
    """The zip, with the manifest at its top as extensions have it; answers where it lies."""
    manifest = tomllib.loads((ADDON / "blender_manifest.toml").read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{manifest['id']}-blender-{manifest['version']}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for source in [*sorted(ADDON.glob("*.py")), ADDON / "blender_manifest.toml", ROOT / "LICENSE"]:
            info = zipfile.ZipInfo(source.name, EARLIEST)
            info.compress_type, info.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(info, source.read_bytes())
    return path


if __name__ == "__main__":
    print(build_addon(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build"))
