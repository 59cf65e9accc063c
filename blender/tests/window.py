"""The add-on in Blender's own window, step by step, as pictures; needs ImageMagick and xdotool.

    xvfb-run -s "-screen 0 1600x900x24" blender --factory-startup --window-geometry 0 0 1600 900 \
        --python window.py -- ZIP ADDRESS TAKE.glb FOLDER

A Blender older than 4.2 has no extensions: it is given the same files as an add-on of the old form. The longest slice
is printed.
"""

import subprocess
import sys
import traceback
import zipfile
from pathlib import Path

import bpy
import numpy as np

ZIP, ADDRESS, TAKE, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
OLD = '\n\nbl_info = {"name": "Caesura", "blender": (3, 4, 0), "category": "Animation"}\n'
for old in (bool, int, float):  # an importer of Blender 3.4 calls them by these names
    setattr(np, old.__name__, old)


def install():
    """The add-on's module."""
    if bpy.app.version >= (4, 2, 0):
        module = "bl_ext.user_default.caesura"
        bpy.ops.extensions.package_install_files(filepath=ZIP, repo="user_default", enable_on_install=True)
    else:
        import addon_utils

        module = "caesura_addon"
        folder = Path(bpy.utils.user_resource("SCRIPTS", path="addons", create=True)) / module
        with zipfile.ZipFile(ZIP) as archive:
            archive.extractall(folder)
        with (folder / "__init__.py").open("a") as source:
            source.write(OLD)
        sys.path.insert(0, str(folder.parent))
        addon_utils.enable(module, default_set=True)
    preferences = bpy.context.preferences.addons[module].preferences
    preferences.where, preferences.address = "ADDRESS", ADDRESS
    return sys.modules[f"{module}.running_work"].RUNNING


def window():
    return bpy.context.window_manager.windows[0]


def areas(kind):
    return [area for area in window().screen.areas if area.type == kind and area.height > 60]


def picture(number, name):
    subprocess.run(
        ["import", "-window", "root", "-resize", "1200x", "+dither", "-colors", "64", f"{FOLDER}/{number}-{name}.png"],
        check=True,
    )


def click(area, label_from_top):
    """Click a tab of the side bar of an area."""
    (region,) = (region for region in area.regions if region.type == "UI")
    x, y = region.x + region.width - 10, window().height - (region.y + region.height - label_from_top)
    subprocess.run(["xdotool", "mousemove", str(x), str(y), "click", "1"], check=True)


def view_all(area, operator, **selected):
    (region,) = (region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=area, region=region, **selected):
        operator()


def open_editors(rig):
    """The animation workspace: the figure, the dope sheet, and the side bars."""
    window().workspace = bpy.data.workspaces["Animation"]
    yield 1.5
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="OBJECT")
    for kind in ("VIEW_3D", "DOPESHEET_EDITOR"):
        for area in areas(kind):
            area.spaces.active.show_region_ui = True
    yield 1
    figure = max(areas("VIEW_3D"), key=lambda area: area.x)
    click(figure, 170)
    yield 0.5
    click(areas("DOPESHEET_EDITOR")[0], 125)
    yield 0.5
    subprocess.run(["xdotool", "mousemove", "700", "350"], check=True)
    view_all(figure, bpy.ops.view3d.view_selected)
    yield 0.5


def steps():
    running = install()
    bpy.context.preferences.view.show_splash = False
    for known in list(bpy.data.objects):
        bpy.data.objects.remove(known)
    bpy.ops.import_scene.gltf(filepath=TAKE)
    scene = bpy.context.scene
    (rig,) = (found for found in scene.objects if found.type == "ARMATURE")
    scene.frame_end = int(rig.animation_data.action.frame_range[1])
    yield from open_editors(rig)
    view_all(areas("DOPESHEET_EDITOR")[0], bpy.ops.action.view_all)
    yield 1
    picture(1, "before")
    with bpy.context.temp_override(window=window(), object=rig):
        bpy.ops.caesura.find()
    while running.stage not in {"reading frames", "analyse"}:
        yield 0.01
    yield 0.1
    picture(2, "running")
    while running.work is not None:
        yield 0.05
    print(f"longest slice {running.longest * 1e3:.0f} ms")
    assert not running.problem, running.problem
    yield 1
    picture(3, "found")
    markers = sorted(scene.timeline_markers, key=lambda marker: marker.frame)
    markers[1].frame += 12
    markers[-1].name = "bow"
    scene.caesura.motions[0].name = "walk"
    scene.caesura.motions[0].loop = True
    yield 1
    picture(4, "corrected")
    with bpy.context.temp_override(window=window()):
        bpy.ops.caesura.save()
    while running.work is not None:
        yield 0.05
    assert not running.problem, running.problem
    areas("DOPESHEET_EDITOR")[0].type = "NLA_EDITOR"
    yield 1
    view_all(areas("NLA_EDITOR")[0], bpy.ops.nla.view_all)
    yield 1
    picture(5, "saved")


TOUR = steps()


def tick():
    try:
        return next(TOUR)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=2)
