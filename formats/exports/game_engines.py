"""Where clips go: the engines and programs, and how each imports them. To add one, add its line here. Light: no NumPy.

`GET /v1/exports` and with it the page's choice read this table.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Engine:
    """A program that imports clips: its name for programs, its name for people, and how to import there."""

    name: str
    title: str
    advice: str
    options: tuple[tuple[str, str], ...] = ()
    """Choices of clips, `ClipOptions`, that suit it."""


ENGINES = (
    Engine(
        "any",
        "Any program",
        "The GLB is your own model with one animation for each clip.",
    ),
    Engine(
        "unity",
        "Unity",
        "Install the package glTFast (com.unity.cloud.gltfast) and put the GLB into Assets. Every clip is listed below"
        " it. Set Loop Time on a copy of a clip that loops.",
    ),
    Engine(
        "unreal",
        "Unreal Engine",
        "Drag the GLB into the Content Browser. Interchange makes one Animation Sequence of each clip. For a model that"
        " you have imported before, choose Import Only Animations and its Skeleton.",
    ),
    Engine(
        "godot",
        "Godot",
        "Put the GLB into the project. Its AnimationPlayer has every clip, and those called -loop repeat.",
    ),
    Engine(
        "blender",
        "Blender",
        "File, Import, glTF 2.0. Every clip is an Action, and has a track in the Nonlinear Animation editor.",
    ),
    Engine(
        "three",
        "three.js",
        "GLTFLoader answers the clips as gltf.animations. new AnimationMixer(gltf.scene).clipAction(clip) plays one.",
    ),
)
