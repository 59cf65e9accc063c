"""Import Caesura's clips into Unreal, with their names, motions and loops as metadata.

    py "C:/path/caesura_import.py" "C:/path/clips.glb" "/Game/Take"

For the editor's own Python, with the Python Editor Script Plugin. Where the JSON of the same name lies beside the GLB,
motions that it marks as loops do loop too.
"""

import json
import sys
from pathlib import Path

import unreal

SUFFIX = "-loop"


def read_clips(glb):
    """What the GLB says of each of its clips, and whether it loops, by the name without the ending."""
    data = glb.read_bytes()
    root = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    beside = glb.with_suffix(".json")
    segments = json.loads(beside.read_text(encoding="utf-8"))["segments"] if beside.exists() else []
    clips = {}
    for animation in root.get("animations", []):
        clip = animation.get("extras", {}).get("caesura")
        if clip:
            name = animation["name"]
            marked = any(s["loop"] and s["start"] <= clip["start"] < s["end"] for s in segments)
            clips[name.removesuffix(SUFFIX)] = {**clip, "loop": name.endswith(SUFFIX) or marked}
    return clips


def clip_of_asset(asset_name, clips):
    """The clip that an asset is of: importers put the name of the file before it, and may write _ for -."""
    plain = asset_name.removesuffix(SUFFIX).removesuffix(SUFFIX.replace("-", "_"))
    return max((name for name in clips if plain == name or plain.endswith(f"_{name}")), key=len, default=None)


def import_clips(glb, folder):
    """Import `glb` into `folder`; call its Animation Sequences by their clips, and mark them."""
    task = unreal.AssetImportTask()
    for name, value in (
        ("filename", str(glb)), ("destination_path", folder), ("automated", True), ("replace_existing", True),
        ("save", True),
    ):  # fmt: skip
        task.set_editor_property(name, value)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    clips = read_clips(glb)
    library = unreal.EditorAssetLibrary
    for path in library.list_assets(folder, recursive=True):
        asset = library.load_asset(path)
        name = clip_of_asset(asset.get_name(), clips) if isinstance(asset, unreal.AnimSequence) else None
        if name is None:
            continue
        for tag in ("motion", "start", "end", "loop"):
            library.set_metadata_tag(asset, f"caesura.{tag}", str(clips[name][tag]))
        library.save_loaded_asset(asset)
        target = f"{asset.get_path_name().rpartition('/')[0]}/{name}"
        if asset.get_name() != name and not library.does_asset_exist(target):
            library.rename_asset(asset.get_path_name(), target)


if __name__ == "__main__":
    GLB, FOLDER = sys.argv[1:3] if len(sys.argv) > 2 else ("C:/path/clips.glb", "/Game/Take")
    import_clips(Path(GLB), FOLDER)
